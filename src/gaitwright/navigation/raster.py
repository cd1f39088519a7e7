"""Which ground was seen to be free or walked on: a raster of cells."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.navigation.piece_grid import columns_of, point_apart2, rows_of
from gaitwright.numerics.compiled import kernel

CELL = 0.2
"""Size of a cell [m]; larger where the field has more than `MOST_CELLS`."""
MOST_CELLS = 4_000_000
"""Cells of a raster."""


class Raster(NamedTuple):
    """Cells of which it is known that they are free."""

    place: Float[np.ndarray, "3"]
    """x and y of the lower left corner, size of a cell [m]."""
    cells: Bool[np.ndarray, "rows columns"]


def blank(bounds: tuple[float, float, float, float]) -> Raster:
    """Nothing is known of a field."""
    x_min, y_min, x_max, y_max = bounds
    cell = max(CELL, math.sqrt((x_max - x_min) * (y_max - y_min) / MOST_CELLS))
    shape = (int((y_max - y_min) / cell) + 1, int((x_max - x_min) / cell) + 1)
    return Raster(np.array([x_min, y_min, cell]), np.zeros(shape, dtype=bool))


def with_sight(raster: Raster, free: Float[np.ndarray, "m 2"]) -> Raster:
    """With the cells whose centre lies in a region that was seen to be free."""
    if len(free) < 3:
        return raster
    cells = raster.cells.copy()
    fill(cells, raster.place, np.ascontiguousarray(free))
    return Raster(raster.place, cells)


def with_way(raster: Raster, way: Sequence[tuple[float, float]], radius: float) -> Raster:
    """With the cells that a disc went over."""
    cells = raster.cells.copy()
    for (x0, y0), (x1, y1) in pairwise(way):
        sweep(cells, raster.place, np.array([x0, y0, x1, y1]), radius)
    return Raster(raster.place, cells)


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def fill(cells, place, ring):
    """Marks the cells whose centre lies in a polygon (even-odd), row by row."""
    rows, columns = cells.shape
    first, last = rows_of(ring[:, 1].min(), ring[:, 1].max(), place, rows, 0.0)
    crossings = np.empty(len(ring))
    for row in range(first, last + 1):
        y, count = place[1] + (row + 0.5) * place[2], 0
        for k in range(len(ring)):
            xa, ya, xb, yb = ring[k - 1, 0], ring[k - 1, 1], ring[k, 0], ring[k, 1]
            if (ya > y) != (yb > y):
                crossings[count] = (xa + (y - ya) / (yb - ya) * (xb - xa) - place[0]) / place[2] - 0.5
                count += 1
        at = np.sort(crossings[:count])
        for n in range(0, count - 1, 2):
            for column in range(max(math.ceil(at[n]), 0), min(math.floor(at[n + 1]), columns - 1) + 1):
                cells[row, column] = True


@kernel
def sweep(cells, place, leg, radius):
    """Marks the cells that a leg of a way crosses, and those whose centre is within `radius` of it."""
    rows, columns = cells.shape
    first, last = rows_of(leg[1], leg[3], place, rows, radius)
    for row in range(first, last + 1):
        left, right = columns_of(leg, place, row, columns, radius)
        for column in range(left, right + 1):
            x, y = place[0] + (column + 0.5) * place[2], place[1] + (row + 0.5) * place[2]
            if point_apart2(x, y, leg) <= radius * radius:
                cells[row, column] = True
    first, last = rows_of(leg[1], leg[3], place, rows, 0.0)
    for row in range(first, last + 1):
        left, right = columns_of(leg, place, row, columns, 0.0)
        for column in range(left, right + 1):
            cells[row, column] = True


@kernel
def is_known(cells, place, ax, ay, bx, by):
    """Whether every cell that a straight line crosses is known."""
    rows, columns = cells.shape
    line = (ax, ay, bx, by)
    first, last = rows_of(ay, by, place, rows, 0.0)
    for row in range(first, last + 1):
        left, right = columns_of(line, place, row, columns, 0.0)
        for column in range(left, right + 1):
            if not cells[row, column]:
                return False
    return True
