"""What is true in unknown worlds: worlds by number, ways that exist, and how short they can be."""

import heapq
import math
from itertools import combinations

import numpy as np
import pytest
import shapely
from exact_planner import Exact
from shapely import LineString
from unknown_by_hand import boxes_by_lot, made

from gaitwright.bench.unknown_worlds.drawn import KINDS, SIDEWAYS, rearranged, world
from gaitwright.bench.unknown_worlds.eyes import Camera
from gaitwright.bench.unknown_worlds.families import FAMILIES
from gaitwright.bench.unknown_worlds.optimum import QUARTER, optimum, shortest
from gaitwright.bench.unknown_worlds.oracle import grown, has_way, truth
from gaitwright.bench.unknown_worlds.walker import ARRIVED, NONE, Walker
from gaitwright.bench.unknown_worlds.world import APART, FREE, RADIUS, WIDER, World


def barred(*openings: tuple[float, float]) -> World:
    """A wall from side to side with openings (low, high)."""
    edges = [0.0, *(y for opening in openings for y in opening), 20.0]
    return made([shapely.box(9.0, a, 9.4, b) for a, b in zip(edges[::2], edges[1::2], strict=True)])


# --- worlds ----------------------------------------------------------------------------------------
def same(one: World, other: World) -> bool:
    """Whether two worlds are the same to the bit."""
    return (one.start, one.goal, one.gap) == (other.start, other.goal, other.gap) and all(
        shapely.equals_exact(a, b) for a, b in zip(one.obstacles, other.obstacles, strict=True)
    )


@pytest.mark.parametrize("number", [0, 6, 12])
def test_the_same_number_is_the_same_world(number: int) -> None:
    assert same(world(3, number), world(3, number))
    assert world(3, number).start != world(4, number).start


def test_kinds_are_as_many_as_promised() -> None:
    kinds = [KINDS[number // len(FAMILIES) % len(KINDS)] for number in range(500)]
    assert kinds.count("gap") >= 50 and kinds.count("walled") >= 0.15 * 500


@pytest.mark.parametrize("number", [*range(10), 13, 14, 30, 33])
def test_a_world_is_what_it_is_called(number: int) -> None:
    one = world(5, number)
    assert min(one.clearance(one.start), one.clearance(one.goal)) >= FREE
    assert math.dist(one.start, one.goal) >= APART
    shapes = np.array(one.obstacles)
    np.testing.assert_allclose(shapely.area(shapely.convex_hull(shapes)), shapely.area(shapes), rtol=1e-9)
    said = truth(one)
    if one.gap is None:
        assert said == {"open": "way", "walled": "none"}[one.kind]
        return
    assert -0.005 <= one.gap <= 0.015
    assert said == ("none" if one.gap < 0.0 else "way" if one.gap > 2.0 * (WIDER - RADIUS) else "either")
    mouth = narrowest(one)
    assert shapely.distance(LineString([one.start, one.goal]), shapely.Point(mouth)) > SIDEWAYS - 0.6


def narrowest(one: World) -> tuple[float, float]:
    """The middle of the gap that decides: where a wider disc would have to pass."""
    half = RADIUS + (one.gap or 0.0) / 2.0
    wide, slim = (grown(one, half + off, 64) for off in (2e-4, -2e-4))
    free = [shapely.box(0.0, 0.0, 20.0, 20.0).difference(solid) for solid in (slim, wide)]
    ends = shapely.points([one.start, one.goal])
    (around,) = [p for p in shapely.get_parts(free[0]) if shapely.intersects(p, ends).all()]
    rooms = [next(p for p in shapely.get_parts(free[1]) if p.intersects(end)) for end in ends]
    assert around.area > 0.0 and not rooms[0].intersects(rooms[1])
    (x, y), _ = shapely.shortest_line(*rooms).coords
    return x, y


def test_what_moves_leaves_start_and_goal_free() -> None:
    old = world(0, 10)
    new = rearranged(old, 1)
    moved = [not shapely.equals_exact(a, b) for a, b in zip(old.obstacles, new.obstacles, strict=True)]
    assert 0.05 < np.mean(moved) < 0.5
    assert min(new.clearance(new.start), new.clearance(new.goal)) >= FREE
    assert same(new, rearranged(old, 1))


# --- existence -------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("over", "said"), [(-0.001, "none"), (0.001, "either"), (0.011, "either"), (0.012, "way")]
)
def test_a_door_as_wide_as_the_disc_decides(over: float, said: str) -> None:
    half = RADIUS + over / 2.0
    assert truth(barred((3.0 - half, 3.0 + half))) == said


@pytest.mark.parametrize("apart", [0.0, 1e-9, -1e-9, -0.05])
def test_a_wall_of_boxes_is_a_wall(apart: float) -> None:
    wall = [shapely.box(9.0, k, 9.4, k + 1.0 - apart) for k in range(20)]
    assert not has_way(made(wall), 0.01)
    assert has_way(made(wall[:10] + wall[11:]), RADIUS)


def test_boxes_that_touch_in_a_corner_shut_the_way() -> None:
    stairs = [shapely.box(k, k, k + 1.0, k + 1.0) for k in range(20)]
    assert not has_way(made(stairs, (3.0, 15.0), (15.0, 3.0)), 0.01)


@pytest.mark.parametrize("quarter", [QUARTER, 64])
def test_chords_lie_within_the_true_circles_and_tangents_around_them(quarter: int) -> None:
    one = made(boxes_by_lot(1, 20))
    within = shapely.points(shapely.get_coordinates(grown(one, RADIUS, quarter).boundary))
    assert shapely.distance(within, one.solid).max() <= RADIUS + 1e-9
    around = grown(one, RADIUS / math.cos(math.pi / (4.0 * quarter)), quarter)
    assert shapely.distance(around.boundary, one.solid) >= RADIUS - 1e-9


# --- optimum ---------------------------------------------------------------------------------------
def test_the_optimum_of_an_empty_field_is_straight() -> None:
    assert optimum(made([])) == pytest.approx((16.0, 16.0))


@pytest.mark.parametrize("high", [10.0, 10.5, 12.0])
def test_the_optimum_round_a_box_is_that_of_tangents_and_arcs(high: float) -> None:
    one = made([shapely.box(9.0, 0.0, 11.0, high)])
    to = math.hypot(7.0, high - 10.0)
    straight = math.sqrt(to**2 - RADIUS**2)
    up = math.atan2(high - 10.0, 7.0) + math.asin(RADIUS / to)
    exact = 2.0 * (straight + RADIUS * up) + 2.0
    lower, upper = optimum(one)
    assert lower <= exact + 1e-6 and exact <= upper + 1e-6
    assert upper - lower < 1e-3


def test_where_there_is_no_way_there_is_no_optimum() -> None:
    assert optimum(barred()) == (math.inf, math.inf)
    narrow = barred((3.0 - RADIUS + 1e-3, 3.0 + RADIUS - 1e-3))
    assert optimum(narrow) == (math.inf, math.inf)


@pytest.mark.parametrize("seed", range(4))
def test_the_optimum_is_that_of_every_pair_of_corners_by_shapely(seed: int) -> None:
    one = made(boxes_by_lot(seed, 9), (0.7, 0.7), (19.3, 19.3))
    assert shortest(one, RADIUS, one.start, one.goal) == pytest.approx(by_every_pair(one), abs=1e-5)


def by_every_pair(one: World) -> float:
    """Dijkstra over all pairs of corners that see each other, none left out, lines tried by shapely."""
    solid = grown(one, RADIUS, QUARTER)
    points = np.vstack([one.start, one.goal, shapely.get_coordinates(solid)])
    inside = solid.buffer(-1e-6, join_style="mitre")
    shapely.prepare(inside)
    pairs = np.array(list(combinations(range(len(points)), 2)))
    lines = np.asarray(shapely.linestrings(points[pairs]))
    free = ~shapely.intersects(inside, lines)
    around: dict[int, list[tuple[float, int]]] = {}
    for (a, b), long in zip(pairs[free].tolist(), shapely.length(lines[free]).tolist(), strict=True):
        around.setdefault(a, []).append((long, b))
        around.setdefault(b, []).append((long, a))
    best, queue = {0: 0.0}, [(0.0, 0)]
    while queue:
        length, here = heapq.heappop(queue)
        if here == 1:
            return length
        for long, there in around.get(here, []):
            if length + long < best.get(there, math.inf):
                best[there] = length + long
                heapq.heappush(queue, (length + long, there))
    return math.inf


# --- the oracle and everything that is tried, together -----------------------------------------------
@pytest.mark.parametrize(("number", "over", "end"), [(0, -1.2, NONE), (4, 2.3, ARRIVED), (72, 11.7, ARRIVED)])
def test_an_exact_planner_passes_gaps_that_are_wide_enough_and_refuses_others(
    number: int, over: float, end: str
) -> None:
    one = world(5, number)
    assert one.gap == pytest.approx(1e-3 * over, abs=1e-4)
    trip = Walker(one, Exact(), Camera()).trip(one.goal)
    assert trip.end == end
    back = Walker(one, Exact(one.edges), Camera()).trip(one.goal)
    assert back.end == end
    if end == ARRIVED:
        lower, upper = optimum(one)
        assert lower - 1e-6 <= back.metres <= upper * 1.001
        assert trip.promised <= upper * 1.001 and trip.metres >= lower - 1e-6
