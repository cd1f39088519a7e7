"""A scene: the ground, what stands on it, and where the robot starts (row V1)."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import final

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.ground import height_map, layouts, scene_file, scenes_list
from gaitwright.ground.holes import Hole, filled
from gaitwright.ground.layout import FRICTION
from gaitwright.ground.moving import Mover
from gaitwright.ground.patches import Patch, sorted_patches
from gaitwright.ground.relief import Relief
from gaitwright.ground.steep import steep_parts
from gaitwright.ground.terrain import Box, HeightField, Number, Solid, Surface, upward
from gaitwright.ground.walls import WIDE, walls


@final
@dataclass(frozen=True)
class Scene(Surface):
    """Where robots walk. World frame, metres and radians.

    Physics, feet and maps all ask its `height`, `normal` and `friction_at`.
    """

    name: str
    surface: Surface
    """The ground without what stands on it; its holes are in it."""
    boxes: tuple[Box, ...] = ()
    bounds: tuple[float, float, float, float] = (-4.0, -4.0, 10.0, 4.0)
    """x_min, y_min, x_max, y_max: robots stay inside."""
    start: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """x, y, yaw."""
    friction: float = FRICTION
    """Coefficient of friction between ground and robots [-], where no patch has its own."""
    seed: int = 0
    """What the random parts were drawn from."""
    shapes: tuple[Solid, ...] = ()
    """What stands there beside the boxes."""
    holes: tuple[Hole, ...] = ()
    """Where the holes are that its surface has (`holes.dug`)."""
    patches: tuple[Patch, ...] = ()
    """Where the ground has another friction; of several the last one counts."""
    goal: tuple[float, float] | None = None
    """Where a mission through it leads to [m], where it is made for one."""
    notes: tuple[str, ...] = ()
    """What was mended in its file, in sentences."""
    movers: tuple[Mover, ...] = ()
    """What moves, appears or vanishes: it stands in none of the solids, but in those of the scene `at` a
    time."""
    things: tuple[Solid, ...] = ()
    """The moving things where they are, in a scene `at` a time."""

    @property
    def solids(self) -> tuple[Solid, ...]:
        """All that stands on the ground: the boxes, then the shapes, then what is there at this time."""
        return (*self.boxes, *self.shapes, *self.things)

    def at(self, time: float) -> "Scene":
        """The scene at a time [s], with its moving things where they are; itself where there are none."""
        if not self.movers:
            return self
        there = (mover.at(time) for mover in self.movers)
        return self.with_things(tuple(thing for thing in there if thing is not None))

    def with_things(self, things: tuple[Solid, ...]) -> "Scene":
        """The scene with things in the place of its movers."""
        now = replace(self, movers=(), things=things)
        vars(now)["_relief"] = self._relief  # what stands there all the time is sorted once
        return now

    def height(self, x: Number, y: Number) -> Number:
        """Height of the highest thing at a place, surface or solid [m]."""
        height = self.surface.height(x, y)
        for relief in self._reliefs:
            height = np.maximum(height, relief.tops(x, y))
        return height

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        """Unit normal of what is there, pointing up: the surface's, or that of the top of a solid."""
        normal = self.surface.normal(x, y)
        if not self._reliefs:
            return normal
        top, *others = (relief.look(x, y) for relief in self._reliefs)
        for other in others:
            top = np.where(other[..., :1] > top[..., :1], other, top)
        on_solid = np.asarray(top[..., 0] >= self.surface.height(x, y))
        of_solid = upward(top[..., 1], top[..., 2]) + 0.0  # a level top has no negative zeros
        return np.where(on_solid[..., None], of_solid, normal)

    def friction_at(self, x: Number, y: Number) -> Number:
        """Coefficient of friction at a place [-]."""
        if not self.patches:
            return np.full(np.broadcast(x, y).shape, self.friction)
        of_patches = np.array([self.friction, *(patch.friction for patch in self.patches)])
        return of_patches[np.maximum(self._patches.tops(x, y), 0.0).astype(int)]

    def level(self, solid: Solid) -> float:
        """Height of what one of the solids stands on [m]."""
        return float(self.surface.height(*solid.centre)) + solid.base

    def top(self, solid: Solid) -> float:
        """Height of the highest point of one of the solids [m]."""
        return self.level(solid) + solid.height

    def obstacles(self, step: float) -> tuple[Solid | Hole, ...]:
        """What is walked around by a robot that steps up or down by `step` [m] (`walls`).

        A floor made of boxes is not: what covers more than half of the field and is no higher than the start
        and a step.
        """
        floor = self._floor(step)
        out = walls(self, [solid for solid in self.solids if solid not in floor], self.holes, step)
        ground = filled(self.surface, self.holes)
        return (*out, *steep_parts(ground, step, WIDE * step)) if isinstance(ground, HeightField) else out

    def _floor(self, step: float) -> set[Solid]:
        x, y, _ = self.start
        level = float(self.height(x, y)) + step
        low = [box for box in self.boxes if box.height > step and self.top(box) <= level]
        x_min, y_min, x_max, y_max = self.bounds
        is_floor = sum(box.lx * box.ly for box in low) > 0.5 * (x_max - x_min) * (y_max - y_min)
        return set(low) if is_floor else set()

    @property
    def _reliefs(self) -> tuple[Relief, ...]:
        return tuple(relief for relief in (self._relief, self._things) if relief is not None)

    @cached_property
    def _relief(self) -> Relief | None:
        return self._sorted((*self.boxes, *self.shapes))

    @cached_property
    def _things(self) -> Relief | None:
        return self._sorted(self.things)

    def _sorted(self, solids: tuple[Solid, ...]) -> Relief | None:
        return Relief.of(solids, [self.level(solid) for solid in solids]) if solids else None

    @cached_property
    def _patches(self) -> Relief:
        return sorted_patches(self.patches)


def load_scene(name_or_path: str, seed: int = 0, scale: float = 1.0) -> Scene:
    """A built-in scene (`scenes_list.scene_names`, e.g. `rough:0.05`), one from a JSON file, or a height map.

    `seed` draws the random parts of built-in scenes, `scale` multiplies their lengths; a file is
    taken as it is. Raises `WrongUse` for a name, number, seed or scale that makes no sense, `BadFile`
    for a file that cannot be used.
    """
    if name_or_path.endswith(".json"):
        return Scene(seed=seed, **scene_file.read(name_or_path))
    if height_map.is_named_by(name_or_path):
        return Scene(seed=seed, **height_map.read(name_or_path))
    name, value = scenes_list.parse(name_or_path)
    if seed < 0:
        raise WrongUse(f"a seed is a whole number from 0, not {seed}")
    if not 0.01 <= scale <= 100.0:
        raise WrongUse(f"scene {name!r} can be scaled by 0.01 to 100, not by {scale:g}")
    layout = layouts.BUILDERS[name](value, scale, np.random.default_rng(seed))
    return Scene(name_or_path, seed=seed, **layout._asdict())
