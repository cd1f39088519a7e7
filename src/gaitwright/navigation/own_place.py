"""Where the robot stands is free: how it leaves a place that the map has too near to something."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.navigation.piece_grid import PieceGrid, clearance, leaves
from gaitwright.navigation.tolerances import LINK, NODE, TOUCH
from gaitwright.numerics.compiled import kernel

RINGS = 8
"""Places to step to lie on so many rings, a quarter of the radius apart."""
DIRECTIONS = 16
"""So many on a ring."""


def sources(
    grid: PieceGrid, start: tuple[float, float], radius: float, ignored: float
) -> Float[np.ndarray, "k 3"]:
    """Places to set out from: x, y [m] and what it costs to come there [m]; the first is the start.

    There are others only where the start is too near to something: places around it that a disc may stand on,
    and that it comes to without coming nearer to anything. What is nearer than `ignored` [m] is not there.
    """
    return np.array(places(grid, *start, radius, ignored)).reshape(-1, 3)


@kernel
def places(grid, x, y, radius, ignored):
    found = [(x, y, 0.0)]
    if clearance(grid, x, y, radius) >= radius - TOUCH:
        return found
    for ring in range(1, RINGS + 1):
        away = 0.25 * ring * radius
        for k in range(DIRECTIONS):
            angle = 2.0 * math.pi * k / DIRECTIONS
            bx, by = x + away * math.cos(angle), y + away * math.sin(angle)
            is_free = clearance(grid, bx, by, radius + NODE) >= radius + NODE
            if is_free and leaves(grid, x, y, bx, by, radius - LINK, ignored):
                found.append((bx, by, away))
    return found
