"""A ring of walls around a place: shut, or with one gap as wide as the disc, more or less by millimetres.

Where such a gap stands on the straight line to the goal no corner has to be known; so it opens to another
side, and the place in the ring is not in its axis.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import Polygon

from gaitwright.bench.unknown_worlds.families import JOINTS, wall
from gaitwright.bench.unknown_worlds.world import RADIUS, Point

OVER = ((-0.005, -0.0012), (0.0002, 0.0112), (0.0114, 0.015))
"""Widths of gaps, less the disc's [m]: too narrow, as a planner of tangent polygons may have it, wide enough.

A disc that touches gives half a millimetre on either side, so none is nearly as wide as it.
"""
KINDS = ("ends", "deep", "tips", "skew")
"""Gaps between the ends of two walls, between long ends, between two tips, between slanting ends."""
MARGIN = 0.35
"""From the ring's walls to the place in it, at least [m]."""
AROUND = 1.4
"""Nothing else stands so near to a gap [m]."""


@dataclass(frozen=True)
class Pocket:
    """A ring of walls."""

    walls: tuple[Polygon, ...]
    room: shapely.Geometry
    """What must be free of other obstacles, so that nothing but the gap decides."""
    place: Point
    """The place in it."""
    mouth: Point | None
    """Middle of the gap."""


def pocket(rng: np.random.Generator, middle: Point, outward: float, over: float | None) -> Pocket:
    """A ring around `middle` [m], shut, or with a gap `over` wider than the disc [m], `outward` [rad]."""
    sides, apothem = int(rng.integers(4, 7)), rng.uniform(1.1, 1.7)
    thick, joint = rng.uniform(0.1, 0.25), rng.choice(JOINTS)
    half = apothem * math.tan(math.pi / sides) + thick / 2.0
    off = rng.uniform(0.25, 0.6) * (half - 0.35) * rng.choice((-1.0, 1.0))
    walls: list[Polygon] = []
    for side in range(sides):
        if side == 0 and over is not None:
            parts = with_gap(rng, (-half, half), off, thick, over)
        else:
            parts = wall(True, 0.0, (-half + thick / 2.0, half - thick / 2.0), thick, [], joint)
        turn = outward + 2.0 * math.pi * side / sides
        walls += [Polygon(put(one.exterior.coords, apothem, turn, middle)) for one in parts]
    solid = shapely.union_all(walls)
    hull = Polygon(shapely.get_coordinates(solid.convex_hull))
    inside = max(shapely.get_parts(hull.difference(solid)), key=lambda part: part.area)
    aside = -math.copysign(0.4 * apothem * rng.random(), off)
    (place,) = put([(aside, -apothem)], apothem, outward, middle)
    if not inside.buffer(-MARGIN).contains(shapely.Point(place)):
        place = middle
    if over is None:
        return Pocket(tuple(walls), hull, place, None)
    (mouth,) = put([(off, 0.0)], apothem, outward, middle)
    room = shapely.union_all([hull, shapely.Point(mouth).buffer(AROUND)]).convex_hull
    return Pocket(tuple(walls), room, place, mouth)


def put(points: Iterable[Sequence[float]], apothem: float, turn: float, middle: Point) -> list[Point]:
    """Points of a wall along x, put as a side of the ring: its y points outwards, in the direction `turn`."""
    ux, uy = math.cos(turn), math.sin(turn)
    return [
        (float(middle[0] + x * uy + (y + apothem) * ux), float(middle[1] - x * ux + (y + apothem) * uy))
        for x, y in points
    ]


def with_gap(
    rng: np.random.Generator, ends: tuple[float, float], middle: float, thick: float, over: float
) -> list[Polygon]:
    """Two walls along x, from end to end, with a gap between them `over` wider than the disc [m]."""
    half = RADIUS + over / 2.0
    kind = KINDS[int(rng.integers(len(KINDS)))]
    if kind == "deep":
        thick = rng.uniform(0.5, 1.0)
    y = thick / 2.0
    left, right = middle - half, middle + half
    if kind == "tips":
        a = [(ends[0], -y), (left - y, -y), (left, 0.0), (left - y, y), (ends[0], y)]
        b = [(ends[1], -y), (right + y, -y), (right, 0.0), (right + y, y), (ends[1], y)]
    else:
        lean = math.radians(rng.uniform(10.0, 35.0)) * rng.choice((-1.0, 1.0)) if kind == "skew" else 0.0
        wide, slant = half / math.cos(lean), y * math.tan(lean)
        left, right = middle - wide, middle + wide
        a = [(ends[0], -y), (left - slant, -y), (left + slant, y), (ends[0], y)]
        b = [(ends[1], -y), (right - slant, -y), (right + slant, y), (ends[1], y)]
    return [shapely.Polygon(a), shapely.Polygon(b)]


def gap_width(rng: np.random.Generator) -> float:
    """A gap's width, less the disc's [m]."""
    return float(rng.uniform(*OVER[int(rng.integers(len(OVER)))]))
