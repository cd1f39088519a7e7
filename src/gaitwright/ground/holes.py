"""Holes and trenches: where the ground lies lower, within an outline (row V1, thesis figure 6.3)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import final

import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.ground.outlines import Outline
from gaitwright.ground.relief import Relief
from gaitwright.ground.solids import Prism
from gaitwright.ground.terrain import Flat, HeightField, Number, Slope, Surface


@dataclass(frozen=True)
class Hole:
    """A depression with vertical walls; its floor lies as the ground around it does."""

    outline: Outline
    """Its corners, anticlockwise, world [m]."""
    depth: float
    """[m]."""

    def corners(self) -> Float[np.ndarray, "corners 2"]:
        """Corners of its outline, anticlockwise, world [m]."""
        return np.array(self.outline)

    @property
    def width(self) -> float:
        """Diameter of the largest circle in its outline [m]: what has to be stepped over, at most."""
        return 2.0 * shapely.maximum_inscribed_circle(shapely.Polygon(self.outline)).length


@final
@dataclass(frozen=True)
class Pitted(Surface):
    """A plane with holes in it; where several overlap the deepest counts."""

    plane: Flat | Slope
    holes: tuple[Hole, ...]

    def height(self, x: Number, y: Number) -> Number:
        return np.asarray(self.plane.height(x, y)) - depth_at(self._relief, x, y)

    def normal(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        return self.plane.normal(x, y)

    @cached_property
    def _relief(self) -> Relief:
        return relief_of(self.holes)


def relief_of(holes: Sequence[Hole]) -> Relief:
    """Holes sorted, as blocks that stand out as far as the holes are deep."""
    return Relief.of([Prism(hole.outline, hole.depth) for hole in holes], [0.0] * len(holes))


def depth_at(holes: Relief, x: Number, y: Number) -> Number:
    """How deep under the ground the floor lies [m]: zero beside the holes."""
    return np.maximum(holes.tops(x, y), 0.0)


def dug(surface: Surface, holes: Sequence[Hole]) -> Surface:
    """A surface with holes. In a height field their walls are as wide as one of its cells: there the nodes
    within the outlines are lowered."""
    if not holes:
        return surface
    if isinstance(surface, Flat | Slope):
        return Pitted(surface, tuple(holes))
    assert isinstance(surface, HeightField)
    return replace(surface, heights=surface.heights - _depth_of_nodes(surface, holes))


def filled(surface: Surface, holes: Sequence[Hole]) -> Surface:
    """The same ground without the holes that were dug in it."""
    if isinstance(surface, Pitted):
        return surface.plane
    if not holes:
        return surface
    assert isinstance(surface, HeightField)
    return replace(surface, heights=surface.heights + _depth_of_nodes(surface, holes))


def _depth_of_nodes(field: HeightField, holes: Sequence[Hole]) -> Float[np.ndarray, "rows columns"]:
    """How deep each node of a field lies in holes [m]."""
    rows, columns = field.heights.shape
    x = field.x_min + field.spacing * np.arange(columns)
    y = field.y_min + field.spacing * np.arange(rows)
    return np.asarray(depth_at(relief_of(holes), x[None, :], y[:, None]))
