"""The planners that the learned map is compared with: exact on their lattice, never into what is known."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from unknown_by_hand import boxes_by_lot, free_places, made

from gaitwright.bench.unknown_worlds.baselines import AStar, DStarLite, GridWay, PulledAStar, ThetaStar
from gaitwright.bench.unknown_worlds.drawn import world
from gaitwright.bench.unknown_worlds.eyes import Camera
from gaitwright.bench.unknown_worlds.lattice import CELL, GO_X, GO_Y, Lattice
from gaitwright.bench.unknown_worlds.optimum import optimum
from gaitwright.bench.unknown_worlds.walker import ARRIVED, Walker
from gaitwright.bench.unknown_worlds.world import BOUNDS, RADIUS, Point, World

SMALL = Lattice.of(BOUNDS, RADIUS)


def knowing(one: World) -> Lattice:
    """The lattice of who knows every edge."""
    return SMALL.with_pieces(one.edges)


def room_of(start: Point, way: GridWay, one: World) -> float:
    """How near a way comes to what is solid, by shapely [m]."""
    return float(shapely.distance(shapely.LineString(np.vstack([start, way.path])), one.solid))


# --- the lattice -----------------------------------------------------------------------------------
@pytest.mark.parametrize("seed", range(3))
def test_a_link_is_open_if_and_only_if_a_walk_along_it_is_clear(seed: int) -> None:
    one = made(boxes_by_lot(seed, 20))
    lattice, rng = knowing(one), np.random.default_rng(seed)
    edges = shapely.union_all(shapely.linestrings(one.edges.reshape(-1, 2, 2)))
    rows, columns = lattice.closed.shape
    for _ in range(3000):
        row, column, k = int(rng.integers(rows)), int(rng.integers(columns)), int(rng.integers(8))
        there = row + GO_Y[k], column + GO_X[k]
        is_open = not lattice.closed[row, column] >> k & 1
        if not (0 <= there[0] < rows and 0 <= there[1] < columns):
            assert not is_open
            continue
        line = shapely.LineString(CELL * np.array([[column, row], there[::-1]]))
        away = float(shapely.distance(line, edges))
        assert is_open == (away >= RADIUS) or abs(away - RADIUS) < 1e-9


@given(st.integers(0, 10_000))
def test_pieces_seen_bit_by_bit_close_the_same_links(seed: int) -> None:
    one, rng = made(boxes_by_lot(seed, 6)), np.random.default_rng(seed)
    cuts = np.sort(rng.uniform(0.0, 1.0, (len(one.edges), 3)), axis=1)
    cuts = np.hstack([np.zeros((len(cuts), 1)), cuts, np.ones((len(cuts), 1))])
    a, b = one.edges[:, None, :2], one.edges[:, None, 2:]
    points = a + cuts[:, :, None] * (b - a)
    bits = np.concatenate([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 4)
    lattice = SMALL
    for k in rng.permutation(len(bits)):
        lattice = lattice.with_pieces(bits[k : k + 1])
    np.testing.assert_array_equal(lattice.closed, knowing(one).closed)
    assert lattice.with_pieces(bits) is lattice, "nothing new"
    assert SMALL.pieces.shape == (0, 4), "the empty one stays empty"


# --- searches --------------------------------------------------------------------------------------
def by_scipy(lattice: Lattice, start: Point, goal: Point) -> float:
    """Length of the shortest way over the lattice [m]."""
    rows, columns = lattice.closed.shape
    size, parts = rows * columns, []
    for k in range(8):
        here = np.flatnonzero((lattice.closed >> k & 1).ravel() == 0)
        there = here + GO_Y[k] * columns + GO_X[k]
        parts.append((here, there, np.full(len(here), CELL * math.hypot(GO_X[k], GO_Y[k]))))
    nodes, away = lattice.links(start)
    parts.append((np.full(len(nodes), size), nodes, away))
    nodes, away = lattice.links(goal)
    parts.append((nodes, np.full(len(nodes), size + 1), away))
    a, b, long = (np.concatenate(column) for column in zip(*parts, strict=True))
    return float(dijkstra(coo_array((long, (a, b)), (size + 2, size + 2)).tocsr(), indices=size)[size + 1])


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("planner", [AStar, DStarLite])
def test_a_search_finds_the_shortest_way_over_the_lattice(seed: int, planner: type[AStar]) -> None:
    one = made(boxes_by_lot(seed, 30))
    start, goal = free_places(one, seed, 2, 0.2)
    lattice = knowing(one)
    way = planner(lattice).found(start, goal)
    exact = by_scipy(lattice, start, goal)
    if way is None:
        assert exact == math.inf
        return
    assert way.length == pytest.approx(exact, rel=1e-6)
    assert room_of(start, way, one) >= RADIUS - 1e-9
    np.testing.assert_allclose(way.path[-1], goal)


@pytest.mark.parametrize("seed", range(6))
def test_any_angle_ways_are_clear_and_lie_between_optimum_and_lattice(seed: int) -> None:
    one = made(boxes_by_lot(seed, 30))
    start, goal = free_places(one, seed, 2, 0.2)
    lattice = knowing(one)
    shortest, least = AStar(lattice).way(start, goal), optimum(one, start, goal).lower
    for planner in (PulledAStar, ThetaStar):
        way = planner(lattice).way(start, goal)
        if shortest is None or way is None:
            assert way is shortest
            continue
        assert room_of(start, way, one) >= RADIUS - 1e-9
        assert least - 1e-9 <= way.length <= shortest.length + 1e-9


@dataclass(frozen=True)
class Checked(DStarLite):
    """D* Lite whose every plan is made by A* from nothing as well."""

    def found(self, start: Point, goal: Point) -> GridWay | None:
        mended, anew = super().found(start, goal), AStar(self.lattice).found(start, goal)
        PLANS.append(mended is not None)
        assert (mended is None) == (anew is None)
        if mended is not None and anew is not None:
            assert mended.length == pytest.approx(anew.length, rel=1e-6)
            points = np.vstack([start, mended.path[:-1]])
            assert (shapely.distance(shapely.points(points[1:]), shapely.Point(start)) > 0.0).all()
        return mended


PLANS: list[bool] = []


@pytest.mark.parametrize("number", [5, 11, 14, 18])
def test_d_star_lite_agrees_with_a_star_at_every_plan(number: int) -> None:
    one = world(0, number)
    PLANS.clear()
    walker = Walker(one, Checked(), Camera())
    ends = [
        walker.trip(goal).end for goal in (one.goal, one.start, one.goal)[: 3 if one.kind == "open" else 1]
    ]
    assert len(PLANS) > len(ends)
    assert all(PLANS) == (one.kind == "open") == (ends[-1] == ARRIVED)


def test_mending_a_search_looks_at_fewer_nodes() -> None:
    one = world(0, 14)
    looked_at = [Walker(one, planner, Camera()).trip(one.goal).expanded for planner in (DStarLite(), AStar())]
    assert looked_at[0] < looked_at[1]


def test_where_it_touches_something_stands() -> None:
    planner = AStar().felt((5.0, 5.0), 0.5 * math.pi)
    assert planner.is_cut(np.array([[5.0, 5.0], [5.0, 6.0]]))
    assert not planner.is_cut(np.array([[5.0, 5.0], [5.0, 4.0]]))
    assert AStar().way((5.0, 5.0), (5.0, 6.0)).length == 1.0 < planner.way((5.0, 5.0), (5.0, 6.0)).length
