"""Paths as points: how long, and in which directions."""

import math
from collections.abc import Sequence
from itertools import pairwise

from gaitwright.navigation.planning import Point


def length(start: Point, path: Sequence[Point]) -> float:
    """Length of a path from a place [m]."""
    return math.fsum(math.dist(a, b) for a, b in pairwise((start, *path)))


def directions(points: Sequence[Point]) -> tuple[float, float] | tuple[None, None]:
    """World directions in which a way begins and ends [rad]; none of a way without a point to go to."""
    if len(points) < 2:
        return None, None
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = *points[:2], *points[-2:]
    return math.atan2(y1 - y0, x1 - x0), math.atan2(y3 - y2, x3 - x2)


def begin_of(start: Point, path: Sequence[Point], far: float) -> tuple[Point, ...]:
    """The first points of a path and the one that is so far along it [m]; all of a shorter one."""
    out, here = [], start
    for point in path:
        leg = math.dist(here, point)
        if leg >= far:
            share = far / leg if leg > 0.0 else 0.0
            return (*out, part_way(here, point, share))
        out.append(point)
        far, here = far - leg, point
    return tuple(out)


def part_way(here: Point, there: Point, share: float) -> Point:
    """The place a share of the way to another."""
    return here[0] + share * (there[0] - here[0]), here[1] + share * (there[1] - here[1])
