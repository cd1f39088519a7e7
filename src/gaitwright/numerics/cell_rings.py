"""Outlines of sets of cells of a grid."""

import numpy as np

from gaitwright.numerics.compiled import kernel

EAST, NORTH = (1, 0, -1, 0), (0, 1, 0, -1)
"""Directions of the sides of a cell: below, right, above, left of it."""


@kernel
def traced(cells):
    """Rings through the middles of the sides of a set of cells, the cells on the left: places `(n, 2)` as
    column and row, and the number of the ring of each `(n,)`.

    `cells`: `(rows, columns)` of truths, their middles at whole numbers. Rings of parts are anticlockwise,
    those of holes clockwise; cells that meet in a corner alone have rings of their own.
    """
    sides = sides_of(cells)
    n, ring = 0, 0
    places, numbers = np.empty((4 * cells.sum(), 2)), np.empty(4 * cells.sum(), np.int64)
    for row in range(sides.shape[0]):
        for column in range(sides.shape[1]):
            for first in range(4):
                at, way, i, j = first, first, row, column
                if not sides[row, column, first]:
                    continue
                while at >= 0:
                    sides[i, j, at] = False
                    places[n, 0], places[n, 1] = j - 0.5 + 0.5 * EAST[at], i - 0.5 + 0.5 * NORTH[at]
                    numbers[n] = ring
                    n, i, j, way, at = n + 1, i + NORTH[at], j + EAST[at], at, -1
                    for turn in (1, 0, 3):  # to the left first: so it keeps to its own cells
                        onward = (way + turn) % 4
                        if i == row and j == column and onward == first:
                            break
                        if sides[i, j, onward]:
                            at = onward
                            break
                ring += 1
    return places[:n], numbers[:n]


@kernel
def sides_of(cells):
    """Which sides of cells have no cell beyond them, by the corner in which each begins, of `rows + 1` times
    `columns + 1`, and its direction: below a cell it goes east, at its right north, and so on around."""
    rows, columns = cells.shape
    out = np.zeros((rows + 1, columns + 1, 4), np.bool_)
    for i in range(rows):
        for j in range(columns):
            if cells[i, j]:
                out[i, j, 0] = i == 0 or not cells[i - 1, j]
                out[i, j + 1, 1] = j == columns - 1 or not cells[i, j + 1]
                out[i + 1, j + 1, 2] = i == rows - 1 or not cells[i + 1, j]
                out[i + 1, j, 3] = j == 0 or not cells[i, j - 1]
    return out
