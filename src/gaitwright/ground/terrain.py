"""What robots walk on: a surface that tells its height and its normal, and solids that stand on it.

World frame, metres and radians. Every method takes numbers or arrays `x`, `y` that broadcast together.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import final

import numpy as np
from jaxtyping import Bool, Float, Num

Number = Num[np.ndarray, "..."] | float | int
"""A number or an array of numbers."""
STEEPEST = 1.0
"""Ground that rises by more than this along a length of 1 is no place for feet: 45° [-]."""


class Surface(ABC):
    """Ground without overhangs: one height for every place."""

    @abstractmethod
    def height(self, x: Number, y: Number) -> Number:
        """Height of the ground [m]."""

    @abstractmethod
    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        """Unit normal of the ground, pointing up, world axes."""


@final
@dataclass(frozen=True)
class Slope(Surface):
    """A plane through the origin: z = x tan(pitch) + y tan(cross)."""

    pitch: float
    """Angle at which the ground rises towards +x [rad]."""
    cross: float = 0.0
    """Angle at which the ground rises towards +y [rad]."""

    def height(self, x: Number, y: Number) -> Number:
        return math.tan(self.pitch) * np.asarray(x) + math.tan(self.cross) * np.asarray(y)

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        shape = np.broadcast(x, y).shape
        return np.broadcast_to(upward(math.tan(self.pitch), math.tan(self.cross)), (*shape, 3))


@final
@dataclass(frozen=True)
class Flat(Surface):
    """Level ground at height zero."""

    def height(self, x: Number, y: Number) -> Number:
        return np.zeros(np.broadcast(x, y).shape)

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        return np.broadcast_to([0.0, 0.0, 1.0], (*np.broadcast(x, y).shape, 3))


@final
@dataclass(frozen=True, eq=False)
class HeightField(Surface):
    """Heights on a regular grid, straight in between.

    Every cell is two triangles that share the diagonal from its corner (−x, −y) to its corner (+x, +y):
    the very triangles that MuJoCo collides with. Beyond its edge the ground keeps the height of the edge.
    """

    x_min: float
    y_min: float
    spacing: float
    """Distance between neighbouring nodes, along x and y [m]."""
    heights: Float[np.ndarray, "rows columns"]
    """Heights [m]: rows along y, columns along x, at least two of each."""

    @property
    def x_max(self) -> float:
        return self.x_min + self.spacing * (self.heights.shape[1] - 1)

    @property
    def y_max(self) -> float:
        return self.y_min + self.spacing * (self.heights.shape[0] - 1)

    def height(self, x: Number, y: Number) -> Number:
        u, v, low, gain_x, gain_y = self._triangle(x, y)
        return low + gain_x * u + gain_y * v

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        _, _, _, gain_x, gain_y = self._triangle(x, y)
        return upward(gain_x / self.spacing, gain_y / self.spacing)

    def _triangle(self, x: Number, y: Number) -> tuple[Number, ...]:
        """Place (u, v) in its cell, 0 … 1, height of the cell's plane at (0, 0), its gains over u and v."""
        rows, columns = self.heights.shape
        u = np.clip((np.asarray(x, dtype=float) - self.x_min) / self.spacing, 0.0, columns - 1.0)
        v = np.clip((np.asarray(y, dtype=float) - self.y_min) / self.spacing, 0.0, rows - 1.0)
        u, v = np.broadcast_arrays(u, v)
        column = np.minimum(u.astype(int), columns - 2)
        row = np.minimum(v.astype(int), rows - 2)
        u, v = u - column, v - row
        first, last = self.heights[row, column], self.heights[row + 1, column + 1]
        at_x, at_y = self.heights[row, column + 1], self.heights[row + 1, column]
        right = u >= v  # the triangle with the corner (+x, -y)
        return (
            u,
            v,
            first,
            np.where(right, at_x - first, last - at_y),
            np.where(right, last - at_x, at_y - first),
        )


def smooth_step(t: np.ndarray) -> np.ndarray:
    """From 0 to 1 with no slope at either end; constant outside."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def sampled(surface: Surface, bounds: tuple[float, float, float, float], spacing: float) -> HeightField:
    """Any surface as a height field over `bounds` (x_min, y_min, x_max, y_max) [m]."""
    x_min, y_min, x_max, y_max = bounds
    x = x_min + spacing * np.arange(math.ceil((x_max - x_min) / spacing - 1e-9) + 1)
    y = y_min + spacing * np.arange(math.ceil((y_max - y_min) / spacing - 1e-9) + 1)
    return HeightField(x_min, y_min, spacing, np.asarray(surface.height(x[None, :], y[:, None])))


class Solid(ABC):
    """What stands on the ground without overhangs: an outline, and a height for every place within it."""

    height: float
    """From what it stands on to its highest point [m]."""
    base: float
    """What it stands on, above the surface under its centre [m]; not zero when it lies on another solid."""

    @property
    @abstractmethod
    def centre(self) -> tuple[float, float]:
        """The place whose ground it stands on [m]."""

    @abstractmethod
    def corners(self) -> Float[np.ndarray, "corners 2"]:
        """Corners of its outline, anticlockwise, world [m]."""

    @abstractmethod
    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        """The convex pieces of its top, anticlockwise from above: world x, y, height over its base [m]."""

    @abstractmethod
    def row(self, level: float) -> tuple[float, ...]:
        """Its numbers as kernels read them (`relief`), standing on a `level` [m]."""

    def rises(self, step: float) -> bool:
        """Whether it rises by more than `step` [m] within the same distance: then it cannot be stepped on."""
        return bool(self.height > step)

    @property
    def reach(self) -> float:
        """Radius of the circle around its centre that holds its outline [m]."""
        return float(np.linalg.norm(self.corners() - self.centre, axis=1).max())

    def extent(self) -> tuple[float, float, float, float]:
        """x_min, y_min, x_max, y_max of the places where it may be the ground [m]."""
        (x_min, y_min), (x_max, y_max) = self.corners().min(axis=0), self.corners().max(axis=0)
        return float(x_min), float(y_min), float(x_max), float(y_max)


class OnRectangle(Solid):
    """A solid over a rectangle."""

    x: float
    y: float
    """Centre, world [m]."""
    yaw: float
    """Direction of the side `lx` [rad]."""
    lx: float
    ly: float
    """Lengths of the sides [m]."""

    @property
    def centre(self) -> tuple[float, float]:
        return self.x, self.y

    def corners(self) -> Float[np.ndarray, "4 2"]:
        """Corners of its outline, anticlockwise, world [m]."""
        return rectangle(self.x, self.y, self.yaw, self.lx, self.ly)


BOX, CYLINDER, PYRAMID, WEDGE, SPHERE, PRISM = map(float, range(6))
"""Kinds of solids, as the first number of their rows."""


@final
@dataclass(frozen=True)
class Box(OnRectangle):
    """A block with vertical sides and a level top. Low ones are stepped on, high ones walked around."""

    x: float
    y: float
    """Centre, world [m]."""
    yaw: float
    """Direction of the side `lx` [rad]."""
    lx: float
    ly: float
    """Lengths of the sides [m]."""
    height: float
    """From what it stands on to its top [m]."""
    base: float = 0.0
    """What it stands on, above the surface under its centre [m]; not zero when it lies on a box."""

    def covers(self, x: Number, y: Number) -> Bool[np.ndarray, "..."] | np.bool:
        """Whether places lie within its outline."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = np.asarray(x) - self.x, np.asarray(y) - self.y
        return (np.abs(c * dx + s * dy) <= self.lx / 2) & (np.abs(c * dy - s * dx) <= self.ly / 2)

    @property
    def radius(self) -> float:
        """Radius of the circle around its outline [m]."""
        return math.hypot(self.lx, self.ly) / 2

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        return (lifted(self.corners(), self.height),)

    def extent(self) -> tuple[float, float, float, float]:
        c, s = abs(math.cos(self.yaw)), abs(math.sin(self.yaw))
        x, y = (c * self.lx + s * self.ly) / 2, (s * self.lx + c * self.ly) / 2
        return self.x - x, self.y - y, self.x + x, self.y + y

    def row(self, level: float) -> tuple[float, ...]:
        turn = float(np.cos(self.yaw)), float(np.sin(self.yaw))
        return (BOX, self.x, self.y, *turn, self.lx / 2, self.ly / 2, level + self.height, 0.0, 0.0)


def rectangle(x: float, y: float, yaw: float, lx: float, ly: float) -> Float[np.ndarray, "4 2"]:
    """Corners of a rectangle around a centre, anticlockwise [m]; `yaw`: direction of the side `lx` [rad]."""
    c, s = math.cos(yaw), math.sin(yaw)
    half = np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]) * (lx / 2, ly / 2)
    return half @ np.array([[c, s], [-s, c]]) + (x, y)


def lifted(
    places: Float[np.ndarray, "n 2"], height: Float[np.ndarray, "n"] | float
) -> Float[np.ndarray, "n 3"]:
    """Places with a height."""
    return np.column_stack([places, np.broadcast_to(height, len(places))])


def upward(slope_x: Number, slope_y: Number) -> Float[np.ndarray, "... 3"]:
    """Unit normal of ground that rises by `slope_x`, `slope_y` metres per metre along x and y."""
    slope_x, slope_y = np.broadcast_arrays(slope_x, slope_y)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(slope_x, dtype=float)], axis=-1)
    return normal / np.linalg.norm(normal, axis=-1, keepdims=True)
