"""What stands in a scene + step → what is walked around: high solids, deep holes, the sides of ramps.

*High* is what rises by more than a step within a step's length: a box, but not a pyramid of 20°. A hole is
walked around where it is deeper than a step and wider than `WIDE` steps; narrower ones are left to the feet,
which stand beside them and step over (`footholds`, `foothold_guard`). A solid that a ramp leads up to, and
the ramp itself, are walls only along those stretches of their outlines where the ground breaks. The steep
parts of a field of heights are told by `steep`.
"""

from collections.abc import Sequence

import numpy as np
import shapely
from jaxtyping import Bool, Float

from gaitwright.ground.holes import Hole
from gaitwright.ground.outlines import outline_of
from gaitwright.ground.solids import Prism, Pyramid, Wedge
from gaitwright.ground.terrain import Solid, Surface

WIDE = 2.0
"""A hole in which a circle of this diameter, in steps, has room is walked around: for a dog 0.21 m."""
PROBE = 0.2
"""An outline is looked at this often [steps]."""
BESIDE = 5e-3
"""The ground on both sides of an outline is asked this far from it [m]."""
THICK = 0.25
"""Thickness of the wall that a stretch of an outline is on the map [steps]."""


def walls(
    ground: Surface, solids: Sequence[Solid], holes: Sequence[Hole], step: float
) -> tuple[Solid | Hole, ...]:
    """What is walked around of what stands in a scene; `ground`: all of it, as high as it is [m]."""
    beside_ramp = _beside_ramps(solids, step)
    out: list[Solid | Hole] = []
    for solid, is_beside in zip(solids, beside_ramp, strict=True):
        if solid.rises(step):
            out.extend(_stretches(ground, solid, step) if is_beside else [solid])
    return (*out, *(hole for hole in holes if hole.depth > step and hole.width > WIDE * step))


def _beside_ramps(solids: Sequence[Solid], step: float) -> Bool[np.ndarray, "n"]:
    """Which solids are ramps, or meet one by the circles around them."""
    ramps = np.array([_leads_up(solid, step) for solid in solids], dtype=bool)
    if not ramps.any():
        return ramps
    x, y = np.array([solid.centre for solid in solids]).T
    reach = np.array([solid.reach for solid in solids]) + BESIDE
    away = np.hypot(x[:, None] - x[ramps], y[:, None] - y[ramps])
    return (away <= reach[:, None] + reach[ramps]).any(axis=1)


def _leads_up(solid: Solid, step: float) -> bool:
    """Whether one walks up on a solid, by more than a step."""
    return isinstance(solid, Wedge | Pyramid) and solid.height > step and solid.steepness <= 1.0


def _stretches(ground: Surface, solid: Solid, step: float) -> list[Solid]:
    """A solid as a wall: all of it, or the stretches of its outline where the ground breaks."""
    outline = shapely.Polygon(solid.corners())
    ring = outline.exterior
    count = max(int(ring.length / (PROBE * step)), 12)
    corners = shapely.line_locate_point(ring, shapely.points(solid.corners()))
    along = np.unique(np.concatenate([np.linspace(0.0, ring.length, count + 1), corners]))
    breaks = _breaks(ground, ring, (along[:-1] + along[1:]) / 2, step)
    if breaks.all():
        return [solid]
    places = shapely.get_coordinates(shapely.line_interpolate_point(ring, along))
    pieces = shapely.linestrings(np.stack([places[:-1], places[1:]], axis=1)[breaks])
    edge = shapely.line_merge(shapely.union_all(pieces))
    wall = edge.buffer(THICK * step, cap_style="flat", join_style="mitre").intersection(outline)
    parts = getattr(wall, "geoms", [wall])
    return [
        Prism(outline_of(shapely.get_coordinates(part.exterior)[:-1]), solid.height)
        for part in parts
        if part.area > 0.0
    ]


def _breaks(
    ground: Surface, ring: shapely.LinearRing, along: Float[np.ndarray, "n"], step: float
) -> Bool[np.ndarray, "n"]:
    """Where the ground inside an outline lies more than a step above that outside it."""
    here = shapely.get_coordinates(shapely.line_interpolate_point(ring, along))
    onwards = shapely.get_coordinates(shapely.line_interpolate_point(ring, along + BESIDE / 10))
    way = onwards - here
    left = np.column_stack([-way[:, 1], way[:, 0]]) * (BESIDE / np.linalg.norm(way, axis=1))[:, None]
    inner, outer = np.asarray(ground.height(*(here + left).T)), np.asarray(ground.height(*(here - left).T))
    return inner - outer > step
