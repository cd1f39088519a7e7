"""The ground as feet know it: heights on a grid, and the places where no foot should stand (row J8)."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import STEEPEST, Flat, Slope
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import ElevationGrid

SPACING = 0.07
"""Distance between grid nodes, in body heights."""
MARGIN = 2
"""Nodes that a foot keeps away from an edge."""
EDGE = 0.1
"""A break of the ground by more than this, in body heights, is an edge."""
MOST_NODES = 4_000_000
"""Beyond this many the grid gets coarser."""
COARSEST = 0.25
"""A grid coarser than this, in body heights, is of no use to feet."""


BLIND = ElevationGrid(np.array([0.0, 0.0, 1.0]), np.empty((0, 0)), np.empty((0, 0)))
"""Nothing is known: feet trust the plane through their last footholds."""


def elevation_grid(scene: Scene, robot: Robot) -> ElevationGrid:
    """The known ground of a scene; a plane needs no grid, and a field too wide for one has none, but for
    level ground: there the grid is as wide as what stands on it, and beyond its rim all is as at the rim."""
    standing = (*scene.boxes, *scene.shapes)
    if isinstance(scene.surface, Flat | Slope) and not standing:
        return BLIND
    bounds = scene.bounds
    if spacing_of(bounds, robot) > COARSEST * robot.height and isinstance(scene.surface, Flat):
        extents, room = np.array([solid.extent() for solid in standing]), robot.height
        low, high = extents[:, :2].min(axis=0) - room, extents[:, 2:].max(axis=0) + room
        bounds = (*low.tolist(), *high.tolist())
    spacing = spacing_of(bounds, robot)
    if spacing > COARSEST * robot.height:
        return BLIND
    x_min, y_min, x_max, y_max = bounds
    x = np.arange(x_min, x_max + spacing, spacing)
    y = np.arange(y_min, y_max + spacing, spacing)
    heights = np.array(scene.height(x[None, :], y[:, None]), dtype=float)
    return ElevationGrid(
        np.array([x_min, y_min, spacing]), heights, edges(heights, EDGE * robot.height, spacing)
    )


def spacing_of(bounds: tuple[float, ...], robot: Robot) -> float:
    """Distance between nodes that are not more than `MOST_NODES` within bounds [m]."""
    x_min, y_min, x_max, y_max = bounds
    nodes = (x_max - x_min) * (y_max - y_min) / MOST_NODES
    return max(SPACING * robot.height, float(np.sqrt(nodes)))


def edges(
    heights: Float[np.ndarray, "rows columns"], step: float, spacing: float
) -> Float[np.ndarray, "rows columns"]:
    """1 at nodes from which the ground breaks by more than `step` [m] within `MARGIN` nodes, or is too steep
    to stand on, else 0. `spacing`: between nodes [m].

    A break is the second difference outwards, in eight directions: nothing on any plane.
    """
    rows, columns = heights.shape
    wide = np.pad(heights, MARGIN, mode="reflect", reflect_type="odd")  # a plane goes on as one
    out = np.zeros(heights.shape)

    def shifted(dy: int, dx: int) -> np.ndarray:
        return wide[MARGIN + dy : MARGIN + dy + rows, MARGIN + dx : MARGIN + dx + columns]

    half = MARGIN // 2
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            outer, inner = shifted(MARGIN * dy, MARGIN * dx), shifted(half * dy, half * dx)
            steep = STEEPEST * MARGIN * spacing * math.hypot(dx, dy)
            out[(np.abs(outer - 2.0 * inner + heights) > step) | (np.abs(outer - heights) > steep)] = 1.0
    return out


# --- for kernels -----------------------------------------------------------------------------------
@kernel
def is_known(ground):
    """Whether an `ElevationGrid` has nodes."""
    return ground.heights.size > 0


@kernel
def nearest(ground, x, y):
    """Row and column of the node nearest to a place, at the rim beyond it."""
    rows, columns = ground.heights.shape
    row = round((y - ground.place[1]) / ground.place[2])
    column = round((x - ground.place[0]) / ground.place[2])
    return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)


@kernel
def height_at(ground, x, y):
    """Height of the ground [m], straight between nodes."""
    rows, columns = ground.heights.shape
    u = min(max((x - ground.place[0]) / ground.place[2], 0.0), columns - 1.001)
    v = min(max((y - ground.place[1]) / ground.place[2], 0.0), rows - 1.001)
    column, row = int(u), int(v)
    u, v, z = u - column, v - row, ground.heights
    low = (1.0 - u) * z[row, column] + u * z[row, column + 1]
    high = (1.0 - u) * z[row + 1, column] + u * z[row + 1, column + 1]
    return (1.0 - v) * low + v * high
