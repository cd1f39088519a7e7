"""The primitives that stand on the ground beside `Box`: cylinder, pyramid, wedge, sphere, prism (row V1).

World frame, metres and radians. Below what they stand on their sides go on straight down, but a sphere's.
"""

import math
from dataclasses import dataclass
from typing import final

import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.ground.outlines import Outline, circle, convex_parts
from gaitwright.ground.terrain import (
    CYLINDER,
    PRISM,
    PYRAMID,
    SPHERE,
    WEDGE,
    OnRectangle,
    Solid,
    lifted,
    rectangle,
)


@final
@dataclass(frozen=True)
class Cylinder(Solid):
    """An upright cylinder with a level top: a pillar, a trunk."""

    x: float
    y: float
    """Axis, world [m]."""
    radius: float
    height: float
    base: float = 0.0

    @property
    def centre(self) -> tuple[float, float]:
        return self.x, self.y

    def corners(self) -> Float[np.ndarray, "corners 2"]:
        return circle(self.x, self.y, self.radius)

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        return (lifted(self.corners(), self.height),)

    def row(self, level: float) -> tuple[float, ...]:
        return (CYLINDER, self.x, self.y, 1.0, 0.0, self.radius, self.radius, level + self.height, 0.0, 0.0)


@final
@dataclass(frozen=True)
class Pyramid(OnRectangle):
    """A pyramid over a rectangle; cut off level, a frustum. A flat one is a slope to walk over."""

    x: float
    y: float
    """Centre, world [m]."""
    yaw: float
    """Direction of the side `lx` [rad]."""
    lx: float
    ly: float
    """Lengths of the sides of its base [m]."""
    height: float
    top: float = 0.0
    """Length of the sides of its level top over that of its base's, from 0 (a peak) to below 1."""
    base: float = 0.0

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        low = lifted(self.corners(), 0.0)
        high = lifted(
            rectangle(self.x, self.y, self.yaw, self.top * self.lx, self.top * self.ly), self.height
        )
        sides = [np.array([low[k - 1], low[k], high[k], high[k - 1]]) for k in range(4)]
        return (*sides, high) if self.top else tuple(side[:3] for side in sides)

    def row(self, level: float) -> tuple[float, ...]:
        turn, half = (math.cos(self.yaw), math.sin(self.yaw)), (self.lx / 2, self.ly / 2)
        return (PYRAMID, self.x, self.y, *turn, *half, level, self.height, self.top)

    @property
    def steepness(self) -> float:
        """Rise of its steeper sides [m/m]."""
        return self.height / (min(self.lx, self.ly) / 2 * (1.0 - self.top))

    def rises(self, step: float) -> bool:
        return bool(min(self.height, step * self.steepness) > step)


@final
@dataclass(frozen=True)
class Wedge(OnRectangle):
    """A ramp: over a rectangle it rises from nothing at one side to its height at the other."""

    x: float
    y: float
    """Centre, world [m]."""
    yaw: float
    """Direction in which it rises [rad]."""
    lx: float
    ly: float
    """Its length along that direction, and its width [m]."""
    height: float
    base: float = 0.0

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        return (lifted(self.corners(), np.array([self.height, 0.0, 0.0, self.height])),)

    @property
    def steepness(self) -> float:
        """Its rise [m/m]."""
        return self.height / self.lx

    def row(self, level: float) -> tuple[float, ...]:
        turn, half = (math.cos(self.yaw), math.sin(self.yaw)), (self.lx / 2, self.ly / 2)
        return (WEDGE, self.x, self.y, *turn, *half, level, self.height, 0.0)


@final
@dataclass(frozen=True)
class Sphere(Solid):
    """A sphere let into the ground, of which a cap is seen: a boulder. More than half of one overhangs: it is
    as high as it looks from above."""

    x: float
    y: float
    """Centre, world [m]."""
    radius: float
    height: float
    """Of the cap: up to twice the radius [m]."""
    base: float = 0.0

    @property
    def centre(self) -> tuple[float, float]:
        return self.x, self.y

    @property
    def rim(self) -> float:
        """Radius of what is seen of it from above on level ground [m]."""
        sunk = max(self.radius - self.height, 0.0)
        return math.sqrt((self.radius - sunk) * (self.radius + sunk))

    def corners(self) -> Float[np.ndarray, "corners 2"]:
        return circle(self.x, self.y, self.rim)

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        raise NotImplementedError("a sphere has no plane piece")

    def extent(self) -> tuple[float, float, float, float]:
        r = self.radius
        return self.x - r, self.y - r, self.x + r, self.y + r

    def row(self, level: float) -> tuple[float, ...]:
        middle = level + self.height - self.radius
        return (SPHERE, self.x, self.y, 1.0, 0.0, self.radius, self.radius, middle, 0.0, 0.0)

    def rises(self, step: float) -> bool:
        inside = max(self.rim - step, 0.0)
        return bool(self.height - self.radius + math.sqrt(self.radius**2 - inside**2) > step)


@final
@dataclass(frozen=True)
class Prism(Solid):
    """A block over a simple polygon, convex or not: vertical sides and a level top."""

    outline: Outline
    """Its corners, anticlockwise, world [m]."""
    height: float
    base: float = 0.0

    @property
    def centre(self) -> tuple[float, float]:
        middle = shapely.Polygon(self.outline).centroid
        return middle.x, middle.y

    def corners(self) -> Float[np.ndarray, "corners 2"]:
        return np.array(self.outline)

    def tops(self) -> tuple[Float[np.ndarray, "_ 3"], ...]:
        return tuple(lifted(part, self.height) for part in convex_parts(shapely.Polygon(self.outline)))

    def row(self, level: float) -> tuple[float, ...]:
        return (PRISM, *self.centre, 1.0, 0.0, 0.0, 0.0, level + self.height, 0.0, float(len(self.outline)))
