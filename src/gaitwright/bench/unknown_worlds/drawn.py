"""Worlds by number: the same seed and number give the same world."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely import Polygon
from shapely.affinity import translate

from gaitwright.bench.unknown_worlds.families import FAMILIES
from gaitwright.bench.unknown_worlds.oracle import has_way
from gaitwright.bench.unknown_worlds.pockets import gap_width, pocket
from gaitwright.bench.unknown_worlds.world import (
    APART,
    BOUNDS,
    FREE,
    RADIUS,
    SIZE,
    WIDER,
    Point,
    World,
    border,
)

KINDS = ("gap", "walled", "open", "open", "walled", "open", "gap", "open", "walled", "open", "open", "open",
         "walled", "open", "gap", "open", "open", "open", "open", "open")  # fmt: skip
"""Of twenty worlds of a family: 3 with a gap that decides, 4 walled in."""
PLACES, TRIES = 60, 10
"""Places for start and goal that are drawn at once, and how often in one set of obstacles."""
START_SHUT = 0.25
"""In such a share of the rings stands the start."""
SIDEWAYS = 1.0
"""A gap is so far from the straight line between start and goal [m]."""
HAIR = 1e-4
"""A gap decides: there is a way for a disc narrower than it by this [m], and none for a wider one."""
MOVED, BY, LARGEST = 0.25, 1.0, 5.0
"""Share of the obstacles that move between trips, how far at most [m], and none larger than this [m²]."""


def world(seed: int, number: int) -> World:
    """The world of this number: families in turn, and within a family the kinds of `KINDS`."""
    family = list(FAMILIES)[number % len(FAMILIES)]
    kind = KINDS[number // len(FAMILIES) % len(KINDS)]
    for draw in range(1000):
        rng = np.random.default_rng([seed, number, draw])
        found = drawn(rng, f"{family} {number}", family, kind)
        if found is not None:
            return found
    raise AssertionError(f"no world of kind {kind} in {family} {number} of seed {seed}")


def drawn(rng: np.random.Generator, name: str, family: str, kind: str) -> World | None:
    """One try."""
    obstacles = [*border(), *FAMILIES[family](rng)]
    if kind == "open":
        return with_way(rng, World(name, family, kind, tuple(obstacles), (0.0, 0.0), (0.0, 0.0)))
    return shut_in(rng, obstacles, (name, family, kind))


def with_way(rng: np.random.Generator, bare: World) -> World | None:
    """The world with a start and a goal between which there is a way."""
    for _ in range(TRIES):
        ends = places(rng, bare.solid)
        if ends is None:
            continue
        found = replace(bare, start=ends[0], goal=ends[1])
        if has_way(found, WIDER):
            return found
    return None


def places(rng: np.random.Generator, solid: shapely.Geometry) -> tuple[Point, Point] | None:
    """Two free places far enough apart, or `None` by bad luck."""
    free = [(x, y) for x, y in rng.uniform(FREE, SIZE - FREE, (PLACES, 2)).tolist()]
    away = shapely.distance(solid, shapely.points(free))
    free = [place for place, room in zip(free, away, strict=True) if room >= FREE]
    pairs = [(a, b) for a, b in zip(free[::2], free[1::2], strict=False) if math.dist(a, b) >= APART]
    return pairs[0] if pairs else None


def shut_in(
    rng: np.random.Generator, obstacles: Sequence[Polygon], about: tuple[str, str, str]
) -> World | None:
    """The world with a ring around its goal, or its start now and then, shut or with a gap that decides."""
    middle, other = rng.uniform(3.2, SIZE - 3.2, 2).tolist(), rng.uniform(1.0, SIZE - 1.0, 2).tolist()
    if math.dist(middle, other) < APART + 1.0:
        return None
    over = gap_width(rng) if about[2] == "gap" else None
    straight = math.atan2(other[1] - middle[1], other[0] - middle[0])
    outward = straight + rng.uniform(math.radians(60.0), math.radians(300.0))
    ring = pocket(rng, (middle[0], middle[1]), outward, over)
    room = ring.room if over is not None else shapely.Point(ring.place).buffer(FREE)
    clear = [one for one in obstacles if not shapely.intersects(one, room)]
    start, goal = (other[0], other[1]), ring.place
    if rng.random() < START_SHUT:
        start, goal = goal, start
    found = World(*about, (*clear, *ring.walls), start, goal, over)
    return found if is_as_wanted(found, ring.mouth) else None


def is_as_wanted(found: World, mouth: Point | None) -> bool:
    """Whether start and goal are free and apart, and the gap decides, or nothing leads in."""
    if min(found.clearance(found.start), found.clearance(found.goal)) < FREE:
        return False
    if math.dist(found.start, found.goal) < APART:
        return False
    if found.gap is None or mouth is None:
        return not has_way(found, 0.5 * RADIUS)
    if shapely.distance(shapely.linestrings([found.start, found.goal]), shapely.Point(mouth)) < SIDEWAYS:
        return False
    half = RADIUS + found.gap / 2.0
    return has_way(found, half - HAIR) and not has_way(found, half + HAIR)


def rearranged(old: World, seed: int) -> World:
    """The world after a share of its obstacles moved; what was said of gaps and rings need not hold then."""
    rng = np.random.default_rng([seed, 7])
    ends, square = shapely.multipoints([old.start, old.goal]), shapely.box(*BOUNDS)
    out = []
    for one in old.obstacles:
        moved, is_drawn = translate(one, *rng.uniform(-BY, BY, 2)), rng.random() < MOVED
        may = one.area < LARGEST and square.contains(moved) and shapely.distance(moved, ends) >= FREE
        out.append(moved if is_drawn and may else one)
    return replace(old, obstacles=tuple(out))
