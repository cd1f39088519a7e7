"""A scene: the ground, what stands on it, and where the robot starts (row V1)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.ground import layouts, scene_file, scenes_list
from gaitwright.ground.terrain import Box, Number, Surface

FEW = 100_000
"""So many pairs of place and box are looked at in one go; of more, only those that may lie together."""


@dataclass(frozen=True)
class Scene:
    """Where robots walk. World frame, metres and radians."""

    name: str
    surface: Surface
    boxes: tuple[Box, ...] = ()
    bounds: tuple[float, float, float, float] = (-4.0, -4.0, 10.0, 4.0)
    """x_min, y_min, x_max, y_max: robots stay inside."""
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """x, y, yaw."""
    friction: float = layouts.FRICTION
    """Coefficient of friction between ground and robots [-]."""
    seed: int = 0
    """What the random parts were drawn from."""

    def height(self, x: Number, y: Number) -> Number:
        """Height of the highest thing at a place, surface or box [m]."""
        ground = self.surface.height(x, y)
        return np.maximum(ground, self._tops(x, y)) if self.boxes else ground

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        """Unit normal of what is there, pointing up: the surface's, or straight up on a box."""
        normal = self.surface.normal(x, y)
        if not self.boxes:
            return normal
        on_box = np.asarray(self._tops(x, y) >= self.surface.height(x, y))
        return np.where(on_box[..., None], [0.0, 0.0, 1.0], normal)

    def top(self, box: Box) -> float:
        """Height of the top of one of the boxes [m]."""
        return float(self.surface.height(box.x, box.y)) + box.base + box.height

    def obstacles(self, step: float) -> tuple[Box, ...]:
        """The boxes that are too high to step on, by more than `step` [m], but for a floor made of boxes.

        Such a floor is what covers more than half of the field and is no higher than the start and a step.
        """
        x, y, _ = self.start
        level = float(self.height(x, y)) + step
        high = tuple(box for box in self.boxes if box.height > step)
        low = tuple(box for box in high if self.top(box) <= level)
        floor = set(low)
        x_min, y_min, x_max, y_max = self.bounds
        if sum(box.lx * box.ly for box in low) <= 0.5 * (x_max - x_min) * (y_max - y_min):
            return high
        return tuple(box for box in high if box not in floor)

    def _tops(self, x: Number, y: Number) -> Float[np.ndarray, "..."]:
        """Top of the highest box at a place [m], -inf where there is none."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        places = np.column_stack([x.ravel(), y.ravel()])
        few = len(places) * len(self.boxes) <= FEW
        return (self._tops_at(places) if few else self._tops_of_many(places)).reshape(x.shape)

    def _tops_at(self, places: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " n"]:
        """Every place held against every box."""
        x, y, c, s, half_x, half_y, top = self._box_columns
        dx, dy = places[:, :1] - x, places[:, 1:] - y
        covered = (np.abs(c * dx + s * dy) <= half_x) & (np.abs(c * dy - s * dx) <= half_y)
        return np.where(covered, top, -np.inf).max(axis=1)

    def _tops_of_many(self, places: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " n"]:
        """Every box held against the places in its stretch of x alone."""
        order = np.argsort(places[:, 0], kind="stable")
        x, y = places[order].T
        tops = np.full(len(order), -np.inf)
        columns = self._box_columns
        reach = np.hypot(columns[4], columns[5]) * (1 + 1e-9)
        first, last = np.searchsorted(x, columns[0] - reach), np.searchsorted(x, columns[0] + reach, "right")
        for (box_x, box_y, c, s, half_x, half_y, top), start, stop in zip(
            np.transpose(columns), first, last, strict=True
        ):
            dx, dy = x[start:stop] - box_x, y[start:stop] - box_y
            covered = (np.abs(c * dx + s * dy) <= half_x) & (np.abs(c * dy - s * dx) <= half_y)
            part = tops[start:stop]
            part[covered & (part < top)] = top
        out = np.empty(len(order))
        out[order] = tops
        return out

    @cached_property
    def _box_columns(self) -> tuple[np.ndarray, ...]:
        rows = [(b.x, b.y, np.cos(b.yaw), np.sin(b.yaw), b.lx / 2, b.ly / 2, self.top(b)) for b in self.boxes]
        return tuple(np.array(rows).T)


def load_scene(name_or_path: str, seed: int = 0, scale: float = 1.0) -> Scene:
    """A built-in scene (`scenes_list.scene_names`, e.g. `rough:0.05`) or a scene from a JSON file.

    `seed` draws the random parts of built-in scenes, `scale` multiplies their lengths; a file is
    taken as it is. Raises `WrongUse` for a name, number, seed or scale that makes no sense, `BadFile`
    for a file that cannot be used.
    """
    if name_or_path.endswith(".json"):
        return Scene(seed=seed, **scene_file.read(name_or_path))
    name, value = scenes_list.parse(name_or_path)
    if seed < 0:
        raise WrongUse(f"a seed is a whole number from 0, not {seed}")
    if not 0.01 <= scale <= 100.0:
        raise WrongUse(f"scene {name!r} can be scaled by 0.01 to 100, not by {scale:g}")
    layout = layouts.BUILDERS[name](value, scale, np.random.default_rng(seed))
    surface, boxes, bounds, friction = layout
    return Scene(name_or_path, surface, boxes, bounds, friction=friction, seed=seed)
