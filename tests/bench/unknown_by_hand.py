"""Worlds made by hand, and small ones by lot."""

import math
from collections.abc import Sequence

import numpy as np
import shapely
from shapely import Polygon
from shapely.affinity import rotate

from gaitwright.bench.unknown_worlds.world import Point, World, border


def made(obstacles: Sequence[Polygon], start: Point = (2.0, 10.0), goal: Point = (18.0, 10.0)) -> World:
    """The walled square with these obstacles in it."""
    return World("by hand", "by hand", "open", (*border(), *obstacles), start, goal)


def boxes_by_lot(seed: int, count: int) -> list[Polygon]:
    """Boxes at any angle, some of which overlap."""
    rng = np.random.default_rng(seed)
    out = []
    for _ in range(count):
        (x, y), (w, h) = rng.uniform(2.0, 18.0, 2), rng.uniform(0.2, 1.5, 2)
        out.append(rotate(shapely.box(x - w, y - h, x + w, y + h), math.degrees(rng.uniform(0.0, math.pi))))
    return out


def free_places(world: World, seed: int, count: int, room: float) -> list[Point]:
    """Places at least so far from every obstacle [m]."""
    rng = np.random.default_rng(seed)
    out: list[Point] = []
    while len(out) < count:
        x, y = rng.uniform(0.5, 19.5, 2).tolist()
        if world.clearance((x, y)) >= room:
            out.append((x, y))
    return out
