"""Pieces of edges in a grid of cells: which are near a place, and how far is a straight line from them?

A piece is filed in every cell that its surroundings (all within `reach`) touch: so whatever is near a point
is in the point's own cell, and a line asks only the cells that it crosses.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from gaitwright.numerics.compiled import kernel

CELL = 1.0
"""Size of a cell [m]; larger where the field has more than `MOST_CELLS`."""
MOST_CELLS = 400_000
"""Cells of a grid."""


class PieceGrid(NamedTuple):
    """Pieces, filed by cells."""

    pieces: Float[np.ndarray, "n 4"]
    """x0, y0, x1, y1 [m]."""
    place: Float[np.ndarray, "3"]
    """x and y of the lower left corner, size of a cell [m]."""
    size: Int[np.ndarray, "2"]
    """Rows (along y), columns."""
    begin: Int[np.ndarray, "cells_and_one"]
    items: Int[np.ndarray, "filed"]
    """Pieces of cell k: `items[begin[k] : begin[k + 1]]`."""


def piece_grid(
    pieces: Float[np.ndarray, "n 4"], bounds: tuple[float, float, float, float], reach: float
) -> PieceGrid:
    """Files pieces by the cells of the field that anything within `reach` [m] of them touches."""
    x_min, y_min, x_max, y_max = bounds
    cell = max(CELL, math.sqrt((x_max - x_min) * (y_max - y_min) / MOST_CELLS))
    size = np.array([int((y_max - y_min) / cell) + 1, int((x_max - x_min) / cell) + 1])
    place = np.array([x_min, y_min, cell])
    begin, items = filed(np.ascontiguousarray(pieces), place, size, reach)
    return PieceGrid(np.ascontiguousarray(pieces), place, size, begin, items)


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def filed(pieces, place, size, reach):
    """`begin` and `items` of a grid: counted, then filled."""
    begin = np.zeros(size[0] * size[1] + 1, np.int64)
    for p in range(len(pieces)):
        first, last = rows_of(pieces[p, 1], pieces[p, 3], place, size[0], reach)
        for row in range(first, last + 1):
            left, right = columns_of(pieces[p], place, row, size[1], reach)
            for column in range(left, right + 1):
                begin[row * size[1] + column + 1] += 1
    for k in range(len(begin) - 1):
        begin[k + 1] += begin[k]
    items, at = np.empty(begin[-1], np.int64), begin.copy()
    for p in range(len(pieces)):
        first, last = rows_of(pieces[p, 1], pieces[p, 3], place, size[0], reach)
        for row in range(first, last + 1):
            left, right = columns_of(pieces[p], place, row, size[1], reach)
            for column in range(left, right + 1):
                k = row * size[1] + column
                items[at[k]] = p
                at[k] += 1
    return begin, items


@kernel
def rows_of(y0, y1, place, rows, reach):
    """First and last row that what is within `reach` of a piece touches; last < first: none."""
    low, high = min(y0, y1) - reach, max(y0, y1) + reach
    return between((low - place[1]) / place[2], (high - place[1]) / place[2], rows)


@kernel
def columns_of(piece, place, row, columns, reach):
    """First and last column in a row that what is within `reach` of a piece touches."""
    x0, y0, x1, y1 = piece[0], piece[1], piece[2], piece[3]
    low = place[1] + row * place[2] - reach
    t0, t1 = part_between(y0, y1, low, low + place[2] + 2.0 * reach)
    xa, xb = x0 + t0 * (x1 - x0), x0 + t1 * (x1 - x0)
    left, right = min(xa, xb) - reach - place[0], max(xa, xb) + reach - place[0]
    return between(left / place[2], right / place[2], columns)


@kernel
def between(low, high, count):
    """First and last of `count` cells that a span touches, which may be as far away as it likes."""
    first = int(min(max(math.floor(low), 0.0), 1.0 * count))
    return first, int(min(max(math.floor(high), -1.0), count - 1.0))


@kernel
def part_between(y0, y1, low, high):
    """The part of a segment, from 0 to 1, whose y lies between two bounds; a hair more than that."""
    dy = y1 - y0
    if abs(dy) < 1e-12:
        return 0.0, 1.0
    ta, tb = (low - y0) / dy, (high - y0) / dy
    return max(min(ta, tb) - 1e-9, 0.0), min(max(ta, tb) + 1e-9, 1.0)


@kernel
def cell_of(place, size, x, y):
    """The cell of a point; of one outside the field the nearest."""
    column = int(min(max((x - place[0]) / place[2], 0.0), size[1] - 1.0))
    row = int(min(max((y - place[1]) / place[2], 0.0), size[0] - 1.0))
    return row * size[1] + column


@kernel
def point_apart2(x, y, piece):
    """Squared distance of a point from a piece [m²]."""
    dx, dy = piece[2] - piece[0], piece[3] - piece[1]
    ex, ey = x - piece[0], y - piece[1]
    length2 = dx * dx + dy * dy
    t = 0.0 if length2 == 0.0 else min(max((ex * dx + ey * dy) / length2, 0.0), 1.0)
    fx, fy = ex - t * dx, ey - t * dy
    return fx * fx + fy * fy


@kernel
def lines_apart2(line, piece):
    """Squared distance of two segments [m²]: 0 where they cross."""
    dx, dy = line[2] - line[0], line[3] - line[1]
    a = dx * (piece[1] - line[1]) - dy * (piece[0] - line[0])
    b = dx * (piece[3] - line[1]) - dy * (piece[2] - line[0])
    if a * b < 0.0:
        ex, ey = piece[2] - piece[0], piece[3] - piece[1]
        c = ex * (line[1] - piece[1]) - ey * (line[0] - piece[0])
        d = ex * (line[3] - piece[1]) - ey * (line[2] - piece[0])
        if c * d < 0.0:
            return 0.0
    ends = min(point_apart2(line[0], line[1], piece), point_apart2(line[2], line[3], piece))
    return min(ends, point_apart2(piece[0], piece[1], line), point_apart2(piece[2], piece[3], line))


@kernel
def is_apart(line, piece, room):
    """Whether two segments are surely more than `room` apart: their boxes are."""
    return (
        max(line[0], line[2]) + room < min(piece[0], piece[2])
        or min(line[0], line[2]) - room > max(piece[0], piece[2])
        or max(line[1], line[3]) + room < min(piece[1], piece[3])
        or min(line[1], line[3]) - room > max(piece[1], piece[3])
    )


@kernel
def clearance(grid, x, y, most):
    """Distance of a point from the nearest piece [m], at most `most` (not more than the grid's reach)."""
    k = cell_of(grid.place, grid.size, x, y)
    least = most * most
    for n in range(grid.begin[k], grid.begin[k + 1]):
        least = min(least, point_apart2(x, y, grid.pieces[grid.items[n]]))
    return math.sqrt(least)


@kernel
def is_free(grid, ax, ay, bx, by, room):
    """Whether a straight line keeps `room` [m] from every piece."""
    line, room2 = (ax, ay, bx, by), room * room
    first, last = rows_of(ay, by, grid.place, grid.size[0], 0.0)
    for row in range(first, last + 1):
        left, right = columns_of(line, grid.place, row, grid.size[1], 0.0)
        for k in range(row * grid.size[1] + left, row * grid.size[1] + right + 1):
            for n in range(grid.begin[k], grid.begin[k + 1]):
                piece = grid.pieces[grid.items[n]]
                if not is_apart(line, piece, room) and lines_apart2(line, piece) < room2:
                    return False
    return True


@kernel
def leaves(grid, ax, ay, bx, by, room, ignored):
    """Whether a straight line from the robot's own place comes no nearer to any piece than `room`, or than
    that place is already; what is nearer to the place than `ignored` [m] is not there."""
    line, room2 = (ax, ay, bx, by), room * room
    first, last = rows_of(ay, by, grid.place, grid.size[0], 0.0)
    for row in range(first, last + 1):
        left, right = columns_of(line, grid.place, row, grid.size[1], 0.0)
        for k in range(row * grid.size[1] + left, row * grid.size[1] + right + 1):
            for n in range(grid.begin[k], grid.begin[k + 1]):
                piece = grid.pieces[grid.items[n]]
                apart2 = lines_apart2(line, piece)
                if apart2 < room2:
                    own = math.sqrt(point_apart2(ax, ay, piece))
                    if own >= ignored and math.sqrt(apart2) < min(room, own) - 1e-9:
                        return False
    return True
