"""Where a shortest path of a disc may turn: vertices of polygons about the disc, round the pieces' ends.

Where pieces meet, only the directions from which the corner can be turned around get nodes: those that lean
outwards from all of the pieces. An end that nothing meets has half a circle of them, a corner between
walls none.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.navigation.piece_grid import PieceGrid, clearance
from gaitwright.navigation.tolerances import HALF_STEP, LEAN, NODE
from gaitwright.numerics.compiled import kernel

MEET = 1e-6
"""Ends nearer than this are one end [m]; where two are taken for apart there are more nodes, none wrong."""


class TurningNodes(NamedTuple):
    """Nodes of the visibility graph; each turns around one end of a piece."""

    at: Float[np.ndarray, "nodes 4"]
    """x, y [m] and the unit vector from the end that it turns around."""
    lean: Float[np.ndarray, " nodes"]
    """Sine of the angle by which a link may lean from the tangent."""


def turning_nodes(grid: PieceGrid, bounds: tuple[float, float, float, float], radius: float) -> TurningNodes:
    """The nodes of all ends that a disc of `radius` [m] may stand on, within the bounds."""
    pieces = grid.pieces
    if not len(pieces):
        return TurningNodes(np.empty((0, 4)), np.empty(0))
    direction = pieces[:, 2:] - pieces[:, :2]
    angle = np.arctan2(direction[:, 1], direction[:, 0])
    ends = np.concatenate([pieces[:, :2], pieces[:, 2:]])
    angles = np.concatenate([angle, np.where(angle > 0.0, angle - math.pi, angle + math.pi)])
    key = np.round(ends / MEET).astype(np.int64)
    order = np.lexsort((angles, key[:, 1], key[:, 0]))
    return TurningNodes(*fans(grid, ends[order], angles[order], key[order], np.array(bounds), radius))


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def fans(grid, ends, angles, keys, bounds, radius):
    """Nodes of all ends: those that meet follow each other, in the order of their angles [rad]."""
    nodes, lean = np.empty((6 * len(ends), 4)), np.empty(6 * len(ends))
    count = first = 0
    while first < len(ends):
        last = first
        while last + 1 < len(ends) and (keys[last + 1] == keys[first]).all():
            last += 1
        begin, wide = turnable(angles, first, last)
        steps = math.ceil(wide / (2.0 * HALF_STEP) - 1e-9)
        half = wide / 2.0 / max(steps, 1)
        away = (radius + NODE) / math.cos(half)
        for k in range(steps):
            angle = begin + (2 * k + 1) * half
            ux, uy = math.cos(angle), math.sin(angle)
            x, y = ends[first, 0] + away * ux, ends[first, 1] + away * uy
            if is_standable(grid, x, y, bounds, radius):
                nodes[count, 0], nodes[count, 1], nodes[count, 2], nodes[count, 3] = x, y, ux, uy
                lean[count] = math.sin(half + LEAN)
                count += 1
        first = last + 1
    return nodes[:count].copy(), lean[:count].copy()


@kernel
def turnable(angles, first, last):
    """From which direction on and how wide [rad] an end can be turned around, by its pieces' directions."""
    widest, begin = -1.0, 0.0
    for k in range(first, last + 1):
        after = angles[k + 1] if k < last else angles[first] + 2.0 * math.pi
        if after - angles[k] > widest:
            widest, begin = after - angles[k], angles[k] + 0.5 * math.pi
    wide = widest - math.pi
    return begin, wide if wide > 1e-6 else 0.0


@kernel
def is_standable(grid, x, y, bounds, radius):
    """Whether a disc may stand at a place."""
    inside = bounds[0] <= x <= bounds[2] and bounds[1] <= y <= bounds[3]
    return inside and clearance(grid, x, y, radius) >= radius
