"""The facets of a scene with its moving things where they are: only the tiles that these stand in are drawn
anew, from frame to frame."""

import math
from dataclasses import dataclass, field

import numpy as np

from gaitwright.ground.relief import Relief
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Solid
from gaitwright.plant.facets import TILE, Facets, draw

Tiles = tuple[slice, slice]
"""Rows and columns of tiles."""


@dataclass
class MovingFacets:
    """A copy of a still scene's facets, into which things are drawn where they are."""

    still: Facets
    now: Facets = field(init=False)
    drawn: list[Tiles] = field(init=False, default_factory=list)
    """Where a thing stands in `now`."""

    def __post_init__(self) -> None:
        place, planes, tops = self.still
        self.now = Facets(place, planes.copy(), tops.copy())

    def at(self, scene: Scene) -> Facets:
        """The facets of the scene at this time (`Scene.at`); a later call changes them."""
        for tiles in self.drawn:
            self.now.planes[cells_of(tiles)] = self.still.planes[cells_of(tiles)]
            self.now.tops[tiles] = self.still.tops[tiles]
        self.drawn = [tiles for thing in scene.things if (tiles := self.tiles_of(thing)) is not None]
        if self.drawn:
            things = Relief.of(scene.things, [scene.level(thing) for thing in scene.things])
            for tiles in self.drawn:
                self.draw(tiles, things)
        return self.now

    def tiles_of(self, thing: Solid) -> Tiles | None:
        """The tiles that a thing stands in, and its rim; `None`: in none of them."""
        x, y, cell = self.still.place
        x_min, y_min, x_max, y_max = thing.extent()
        rows, columns = self.still.tops.shape
        up, across = tiles_between(y_min, y_max, y, cell, rows), tiles_between(x_min, x_max, x, cell, columns)
        return (up, across) if up.start < up.stop and across.start < across.stop else None

    def draw(self, tiles: Tiles, things: Relief) -> None:
        """Draws things into some tiles of `now`. Slopes at the rim of what is drawn are wrong: it is drawn
        with a tile around it, of which nothing is kept."""
        wide = tuple(
            slice(max(one.start - 1, 0), min(one.stop + 1, most))
            for one, most in zip(tiles, self.still.tops.shape, strict=True)
        )
        inner = tuple(slice(a.start - b.start, a.stop - b.start) for a, b in zip(tiles, wide, strict=True))
        x, y, cell = self.still.place
        rows, columns = (cell * (np.arange(one.start, one.stop) + 0.5) for one in cells_of(wide))
        heights = np.maximum(
            self.still.planes[(*cells_of(wide), 0)], things.tops(x + columns[None, :], y + rows[:, None])
        )
        planes = np.empty((*heights.shape, 3), np.float32)
        tops = np.empty(tuple(one.stop - one.start for one in wide))
        draw(heights, cell, planes, tops)
        self.now.planes[cells_of(tiles)], self.now.tops[tiles] = planes[cells_of(inner)], tops[inner]


def cells_of(tiles: tuple[slice, ...]) -> tuple[slice, ...]:
    """The rows and columns of the cells in some tiles."""
    return tuple(slice(TILE * one.start, TILE * one.stop) for one in tiles)


def tiles_between(low: float, high: float, first: float, cell: float, count: int) -> slice:
    """Which of so many tiles, from `first` [m] on, lie within a cell of what is between two places [m]."""
    begin, end = ((place - first) / (TILE * cell) for place in (low - cell, high + cell))
    return slice(max(math.floor(begin), 0), min(math.floor(end) + 1, count))
