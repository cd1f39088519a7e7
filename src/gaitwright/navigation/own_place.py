"""Where the robot stands is free: how it leaves a place that the map has too near to something."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.navigation.piece_grid import PieceGrid, cell_of, clearance, leaves
from gaitwright.navigation.tolerances import HALF_STEP, LINK, NODE
from gaitwright.numerics.compiled import kernel

Point = tuple[float, float]
STEPS = (0.0625, 0.125, 0.25, 0.5, 1.0, 2.0)
"""How far it may step aside, in radii: the first step that gets it clear counts."""
DIRECTIONS = 12
"""In so many directions."""


def sources(grid: PieceGrid, start: Point, radius: float, ignored: float) -> Float[np.ndarray, "k 3"]:
    """Places to set out from: x, y [m] and what it costs to come there [m]; the first is the start.

    There are others only where the start is too near to something, or too near to a corner for the polygon on
    which paths turn around it: clear places aside, to which it comes without coming nearer to anything, and
    the one that is straight away from what is nearest. What is nearer than `ignored` [m] is not there.
    """
    return np.array(places(grid, *start, radius, ignored)).reshape(-1, 3)


@kernel
def places(grid, x, y, radius, ignored):
    found = [(x, y, 0.0)]
    clear = (radius + NODE) / math.cos(HALF_STEP)
    if not is_close(grid, x, y, radius - LINK, clear - 1e-9):
        return found
    ux, uy, own = away_from_nearest(grid, x, y)
    step = radius + NODE + 1e-9 - own
    ax, ay = x + step * ux, y + step * uy
    is_clear = step > 0.0 and not is_close(grid, ax, ay, radius + NODE, clear)
    if is_clear and leaves(grid, x, y, ax, ay, radius - LINK, ignored):
        found.append((ax, ay, step))
    for k in range(DIRECTIONS):
        angle = 2.0 * math.pi * k / DIRECTIONS
        for step in STEPS:
            bx, by = x + step * radius * math.cos(angle), y + step * radius * math.sin(angle)
            is_clear = not is_close(grid, bx, by, radius + NODE, clear)
            if is_clear and leaves(grid, x, y, bx, by, radius - LINK, ignored):
                found.append((bx, by, step * radius))
                break
    return found


@kernel
def is_close(grid, x, y, to_side, to_end):
    """Whether a place is nearer to a piece's side or to its end than these [m]."""
    if clearance(grid, x, y, to_end) < to_side:
        return True
    k = cell_of(grid.place, grid.size, x, y)
    for n in range(grid.begin[k], grid.begin[k + 1]):
        piece = grid.pieces[grid.items[n]]
        near0, near1 = math.hypot(x - piece[0], y - piece[1]), math.hypot(x - piece[2], y - piece[3])
        if min(near0, near1) < to_end:
            return True
    return False


@kernel
def away_from_nearest(grid, x, y):
    """Unit vector to a place from the nearest piece of its cell, and how far that is [m]."""
    k = cell_of(grid.place, grid.size, x, y)
    ux, uy, own = 0.0, 0.0, math.inf
    for n in range(grid.begin[k], grid.begin[k + 1]):
        piece = grid.pieces[grid.items[n]]
        px, py = nearest_on(piece, x, y)
        apart = math.hypot(x - px, y - py)
        if apart < own:
            own = apart
            ux, uy = ((x - px) / apart, (y - py) / apart) if apart > 0.0 else (0.0, 0.0)
    return ux, uy, own


@kernel
def nearest_on(piece, x, y):
    """The point of a piece that is nearest to a place."""
    dx, dy = piece[2] - piece[0], piece[3] - piece[1]
    length2 = dx * dx + dy * dy
    ex, ey = x - piece[0], y - piece[1]
    t = 0.0 if length2 == 0.0 else min(max((ex * dx + ey * dy) / length2, 0.0), 1.0)
    return piece[0] + t * dx, piece[1] + t * dy


@kernel
def pulled(grid, path, room, ignored):
    """A path without the steps aside that a straight line from its beginning leaves out."""
    first = 1
    while first + 1 < len(path):
        x, y = path[first + 1, 0], path[first + 1, 1]
        if not leaves(grid, path[0, 0], path[0, 1], x, y, room, ignored):
            break
        first += 1
    return np.concatenate((path[:1], path[first:]))
