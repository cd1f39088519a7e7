"""How much of a street network each search looks at; all lengths beside each other."""

import math
from collections.abc import Iterator

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most
from gaitwright.navigation.streets import SEARCHES, StreetMap, StreetRoute, route

SIDE, BLOCKED = 100, 0.2
"""Streets each way, and the share of their parts that is blocked."""
TRIPS, QUICK = 40, 5
"""Pairs of junctions."""
REFERENCES = {"breadth-first": ("alternating", "smaller-front"), "Dijkstra": ("two-way Dijkstra", "A*")}
"""Searches from one side, and those that must find equally short ways."""


def town(rng: np.random.Generator) -> StreetMap:
    """A grid with blocks of 50 to 150 m, a share of its streets blocked."""
    xs, ys = np.cumsum(rng.integers(50, 150, (2, SIDE)), axis=1).astype(float).tolist()
    streets = StreetMap.grid(xs, ys)
    every = sorted(streets.streets)
    return streets.blocked(*(every[k] for k in rng.permutation(len(every))[: int(BLOCKED * len(every))]))


def street_figures(context: Context) -> Iterator[Figure]:
    """Expansions of one search for each of another's, by sums over trips, and wrong lengths."""
    rng = np.random.default_rng(context.seed)
    trips = QUICK if context.quick else TRIPS
    towns = [town(rng) for _ in range(max(trips // 10, 1))]
    ends = rng.integers(0, SIDE * SIDE, (trips, 2)).tolist()
    asked = [(towns[k % len(towns)], a, b) for k, (a, b) in enumerate(ends)]
    found = {name: [route(*trip, name) for trip in asked] for name in SEARCHES}
    wrong = sum(
        not same(one, other)
        for first, others in REFERENCES.items()
        for name in others
        for one, other in zip(found[first], found[name], strict=True)
    )
    yield Figure("streets: lengths that differ between searches", float(wrong), "", at_most(0.0), 4 * trips)
    for one, other, wanted in (
        ("breadth-first", "smaller-front", at_least(1.4)),
        ("breadth-first", "alternating", None),
        ("Dijkstra", "two-way Dijkstra", None),
        ("Dijkstra", "A*", at_least(10.0)),
    ):
        yield ratio(f"streets: junctions of {one} for each of {other}", found[one], found[other], wanted)
    shut = [shut_in(*trip) for trip in asked]
    one_way, two_way = ([route(*trip, name) for trip in shut] for name in ("breadth-first", "smaller-front"))
    yield ratio("streets: the same where the goal is shut in", one_way, two_way, at_least(100.0))


def shut_in(streets: StreetMap, start: int, goal: int) -> tuple[StreetMap, int, int]:
    """The trip with every street out of the 3 × 3 junctions around its goal blocked; the start is outside."""
    column, row = min(max(goal % SIDE, 1), SIDE - 2), min(max(goal // SIDE, 1), SIDE - 2)
    block = {(row + dy) * SIDE + column + dx for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
    out = [street for street in streets.streets if (street[0] in block) != (street[1] in block)]
    outside = (start + SIDE * SIDE // 2) % (SIDE * SIDE) if start in block else start
    return streets.blocked(*out), outside, row * SIDE + column


def same(one: StreetRoute, other: StreetRoute) -> bool:
    """Whether two searches found equally short ways, or none."""
    return one.length == other.length or math.isclose(one.length, other.length)


def ratio(what: str, one: list[StreetRoute], other: list[StreetRoute], wanted: Wanted | None) -> Figure:
    """Of the sums of expansions."""
    sums = [sum(found.expansions for found in searches) for searches in (one, other)]
    note = f"{sums[0] / len(one):.0f} to {sums[1] / len(other):.0f} a trip"
    return Figure(what, sums[0] / max(sums[1], 1), "×", wanted, len(one), note)
