"""How long a map of polygons takes to build, to add to and to ask for a way, beside other libraries."""

import gc
import math
from collections.abc import Callable, Iterator
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.bench.peers.rules_client import RulesPeer
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.signals import Sight

RADIUS = 0.16
"""Of the disc that is planned for [m]."""
ROOM = 50.0
"""So much field has each polygon [m²]."""
SIZES = (0.5, 2.0)
"""Least and largest distance of a corner from a polygon's middle [m]."""
ASKED, QUICK = 200, 20
"""Ways that are asked for."""
Point = tuple[float, float]


def drawn(seed: int, count: int) -> tuple[float, list[list[Point]]]:
    """Side of a square field [m], and so many star-shaped polygons of 3 to 8 corners in it; some overlap."""
    rng, side = np.random.default_rng(seed), math.sqrt(ROOM * count)
    polygons = []
    for _ in range(count):
        corners = int(rng.integers(3, 9))
        angles, away = np.sort(rng.uniform(0.0, 2.0 * math.pi, corners)), rng.uniform(*SIZES, corners)
        x, y = rng.uniform(0.0, side, 2)
        ring = np.stack([x + away * np.cos(angles), y + away * np.sin(angles)], axis=1)
        polygons.append([(float(px), float(py)) for px, py in ring])
    return side, polygons


def pairs(seed: int, side: float, count: int) -> list[tuple[Point, Point]]:
    """Places to go from and to [m]; most are free."""
    places = np.random.default_rng(seed).uniform(1.0, side - 1.0, (count, 2, 2)).tolist()
    return [((a[0], a[1]), (b[0], b[1])) for a, b in places]


def took(work: Callable[[], object]) -> float:
    """How long a piece of work takes [ms]."""
    gc.disable()
    began = perf_counter()
    work()
    spent = 1e3 * (perf_counter() - began)
    gc.enable()
    return spent


def outline(polygon: list[Point]) -> Sight:
    """A look that shows a whole polygon."""
    ring = np.array(polygon)
    pieces = np.hstack([ring, np.roll(ring, -1, axis=0)])
    return Sight(polygon[0], pieces, np.ones((len(ring), 2), dtype=bool), np.empty((0, 2)))


def ours(context: Context, count: int) -> Iterator[Figure]:
    """Building, adding and asking, for so many polygons."""
    side, polygons = drawn(context.seed, count)
    bounds = (0.0, 0.0, side, side)
    asked = pairs(context.seed + 1, side, QUICK if context.quick else ASKED)

    def whole(a: Point, b: Point) -> None:
        LearnedMap.of_polygons(bounds, RADIUS, polygons).way(a, b)

    whole(*asked[0])  # compiles
    new = [took(lambda pair=pair: whole(*pair)) for pair in asked[:QUICK]]
    yield figure(
        f"{count} polygons: map and first way from nothing", new, at_most(30.0) if count == 200 else None
    )
    learned, added = LearnedMap.of_polygons(bounds, RADIUS, polygons), []
    _ = learned.seen(outline(polygons[0])).road_map  # compiles
    for extra in drawn(context.seed + 2, count)[1][:QUICK]:
        sight = outline(extra)
        added.append(took(lambda sight=sight: learned.seen(sight).road_map))
    yield figure(f"{count} polygons: one more is added", added, at_most(2.5) if count == 200 else None)
    first = [took(lambda pair=pair: learned.way(*pair)) for pair in asked]
    again = [took(lambda pair=pair: learned.way(*pair)) for pair in asked]
    yield figure(f"{count} polygons: a way, its links not looked at before", first, None)
    yield figure(f"{count} polygons: a way, links stored", again, at_most(0.1 if count == 200 else 10.0))


def figure(what: str, times: list[float], wanted: Wanted | None) -> Figure:
    """The median, the largest beside it."""
    worst = f"p90 {np.percentile(times, 90):.3g}, most {max(times):.3g} ms"
    numbers = {"ms": [round(t, 5) for t in times]}
    return Figure(what, float(np.median(times)), "ms", wanted, len(times), worst, numbers)


def peers(context: Context, count: int = 200) -> Iterator[Figure]:
    """The same polygons, grown for a point: a graph by shapely and networkx, and extremitypathfinder."""
    side, polygons = drawn(context.seed, count)
    problem = {"side": side, "radius": RADIUS, "polygons": polygons,
               "pairs": pairs(context.seed + 1, side, QUICK)}  # fmt: skip
    with RulesPeer("paths", problem, 600.0) as peer:
        for name in ("shapely and networkx", "extremitypathfinder"):
            context.voice.say(f"maps: {name}")
            answer = peer.ask(name)
            for part in ("built from nothing", "a way"):
                what = f"{name}: {count} polygons, {part}"
                if answer is None:
                    yield Figure(what, math.nan, "ms", note=f"{peer.reason}")
                else:
                    yield figure(f"{what} ({answer['version']})", answer[part], None)
