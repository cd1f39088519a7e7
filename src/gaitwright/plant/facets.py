"""Scene → facets: its heights in small cells, each a plane, over which a simulated camera casts its rays.

Where the planes of two cells do not meet stands a wall between them: slopes are smooth, and a block's face is
hit where it stands, to half a cell.
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.numerics.compiled import kernel

MOST_CELLS = 3_000_000
"""A scene of more is drawn as far as this many reach around the robot, and anew where it has walked on."""
TILE = 16
"""Cells along a side of a tile: rays above everything in a tile pass it in one stride."""
DRAWN = 250_000
"""Cells drawn at once: a scene's heights are asked for in parts, so that memory stays small."""


class Facets(NamedTuple):
    """The heights of a part of a scene, cell by cell."""

    place: np.ndarray
    """`(3,)` x, y of the lower corner, side of a cell [m]."""
    planes: np.ndarray
    """`(rows, columns, 3)` height in the middle of each cell [m], its slopes along x and y; rows along y."""
    tops: np.ndarray
    """`(rows / TILE, columns / TILE)` highest place in each tile [m]."""


def facets_of(scene: Scene, around: tuple[float, float], reach: float, cell: float) -> Facets:
    """The facets of a scene, or of the square of `MOST_CELLS` around a place x, y where it is larger.

    They go `reach` [m] beyond the scene's bounds: a robot at its rim looks out.
    """
    half = 0.5 * cell * math.sqrt(MOST_CELLS)
    x_min, y_min, x_max, y_max = scene.bounds
    low, high = (x_min - reach, y_min - reach), (x_max + reach, y_max + reach)
    if (high[0] - low[0]) * (high[1] - low[1]) > cell * cell * MOST_CELLS:
        low = max(low[0], around[0] - half), max(low[1], around[1] - half)
        high = min(high[0], around[0] + half), min(high[1], around[1] + half)
    columns, rows = (TILE * math.ceil((b - a) / (TILE * cell)) for a, b in zip(low, high, strict=True))
    x = low[0] + cell * (np.arange(columns) + 0.5)
    y = low[1] + cell * (np.arange(rows) + 0.5)
    parts = np.array_split(y, math.ceil(rows * columns / DRAWN))
    heights = np.concatenate([scene.height(x[None, :], part[:, None]) for part in parts])
    planes, tops = np.empty((rows, columns, 3), np.float32), np.empty((rows // TILE, columns // TILE))
    draw(np.ascontiguousarray(heights, dtype=float), cell, planes, tops)
    return Facets(np.array([*low, cell]), planes, tops)


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def limited(before, here, after, cell):
    """Slope of a cell between two neighbours: the lesser of both, none where they disagree (minmod)."""
    a, b = (here - before) / cell, (after - here) / cell
    if a * b <= 0.0:
        return 0.0
    return a if abs(a) < abs(b) else b


@kernel
def draw(heights, cell, planes, tops):
    """Writes the planes of cells with these heights in their middles, and the highest place of each tile."""
    rows, columns = heights.shape
    tops[:] = -math.inf
    for i in range(rows):
        south, north = max(i - 1, 0), min(i + 1, rows - 1)
        for j in range(columns):
            west, east = max(j - 1, 0), min(j + 1, columns - 1)
            here = heights[i, j]
            along = limited(heights[i, west], here, heights[i, east], cell)
            across = limited(heights[south, j], here, heights[north, j], cell)
            planes[i, j, 0], planes[i, j, 1], planes[i, j, 2] = here, along, across
            top = here + 0.5 * cell * (abs(along) + abs(across)) + 1e-6  # float32 rounds
            tops[i // TILE, j // TILE] = max(tops[i // TILE, j // TILE], top)
