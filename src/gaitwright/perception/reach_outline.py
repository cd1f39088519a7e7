"""Where each foot can be put on the ground, as outlines seen from above (row V3)."""

import numpy as np
import shapely
from jaxtyping import Bool, Float

from gaitwright.model.reachable import reachable
from gaitwright.model.robot import Robot
from gaitwright.numerics.cell_rings import traced
from gaitwright.signals import Elevation

FINE = 20
"""Cells that are looked at along a stretched leg."""
RIM = 64
"""Rows of an outline; files have as many."""
SMOOTH = 2
"""Each place of an outline is the mean of so many before and behind it: cells show no more."""
NEAR, LEAST, COARSER = 0.2, 1.0, 1.5
"""How far an outline may then be from its places, in cells, and in cells the smallest part or hole; so many
times as much where there are too many corners, as often as it takes."""


def reach_outlines(
    robot: Robot,
    position_w: Float[np.ndarray, "3"],
    R_wb: Float[np.ndarray, "3 3"],
    elevation: Elevation | None,
) -> Float[np.ndarray, "legs rim 2"]:
    """Outlines, world [m], of where each foot can stand on known ground, for a pose of the base.

    A row of NaN after each; those of parts anticlockwise, those of holes clockwise. All NaN where nothing is
    known, or nothing within reach.
    """
    out = np.full((robot.n, RIM, 2), np.nan)
    if elevation is None:
        return out
    spacing = robot.leg_length / FINE
    x, y = window(robot, position_w, spacing)
    heights = np.array(elevation.height(x[None, :], y[:, None]), dtype=float)
    for leg, mask in enumerate(reachable(robot, position_w, R_wb, (x, y), heights)):
        rings = rings_of(mask)
        out[leg, : len(rings)] = (x[0], y[0]) + spacing * rings
    return out


def window(
    robot: Robot, position_w: Float[np.ndarray, "3"], spacing: float
) -> tuple[Float[np.ndarray, "columns"], Float[np.ndarray, "rows"]]:
    """x of the columns and y of the rows of all cells of a lattice that some foot may reach, world [m]."""
    farthest = (np.linalg.norm(robot.hip, axis=1) + np.linalg.norm(robot.offset, axis=2).sum(axis=1)).max()
    around = np.arange(-np.ceil(farthest / spacing), np.ceil(farthest / spacing) + 1.0)
    x, y = (spacing * (np.round(position_w[axis] / spacing) + around) for axis in (0, 1))
    return x, y


def rings_of(cells: Bool[np.ndarray, "rows columns"]) -> Float[np.ndarray, "corners 2"]:
    """Outlines of a set of cells, whose middles are at whole numbers, in at most `RIM` rows."""
    if not cells.any():
        return np.empty((0, 2))
    places, numbers = traced(cells)
    rings = [smoothed(ring) for ring in np.split(places, np.flatnonzero(np.diff(numbers)) + 1)]
    whole = np.asarray(shapely.linearrings(np.concatenate(rings), indices=numbers))
    near, least = NEAR, LEAST
    while True:
        large = whole[shapely.area(shapely.polygons(whole)) >= least]
        simple = shapely.simplify(large, near)
        if (shapely.get_num_points(simple) + 1).sum() <= RIM:
            break
        near, least = COARSER * near, COARSER * least
    gap = np.full((1, 2), np.nan)
    pieces = [piece for ring in simple for piece in (shapely.get_coordinates(ring), gap)]
    return np.concatenate([np.empty((0, 2)), *pieces])


def smoothed(ring: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "n 2"]:
    """Places around a ring, each the mean of those about it."""
    return np.mean([np.roll(ring, k, axis=0) for k in range(-SMOOTH, SMOOTH + 1)], axis=0)


def separate(outline: Float[np.ndarray, "rim 2"]) -> list[Float[np.ndarray, "corners 2"]]:
    """The rings of an outline, each closed, so of four rows or more."""
    known = np.isfinite(outline.sum(axis=1))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]])))
    return [outline[start:end] for start, end in edges.reshape(-1, 2) if end - start > 3]


def area_in(outline: Float[np.ndarray, "rim 2"]) -> float:
    """Area within an outline, without its holes [m²]."""
    rings = (ring - ring[0] for ring in separate(outline))
    return float(sum(0.5 * (x[:-1] @ y[1:] - x[1:] @ y[:-1]) for x, y in (ring.T for ring in rings)))
