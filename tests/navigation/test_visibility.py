"""Paths keep clear, are as short as can be, and exist exactly where there is a way."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Point

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.navigation.obstacles import PlanView, half_width, plan_view
from gaitwright.navigation.visibility import length, shortest_path
from gaitwright.perception.known_ground import map_of
from robots_by_hand import dog

DOG = dog()
BOUNDS = (-1.0, -3.0, 7.0, 3.0)
START, GOAL = (0.0, 0.0), (6.0, 0.0)
HAIR = 1e-5

boxes = st.builds(
    Box,
    x=st.floats(0.5, 5.5),
    y=st.floats(-2.5, 2.5),
    yaw=st.floats(0.0, math.pi),
    lx=st.floats(0.1, 2.0),
    ly=st.floats(0.1, 2.0),
    height=st.just(1.0),
)
scenes = st.lists(boxes, max_size=6)
starts = st.tuples(st.floats(-0.9, 3.0), st.floats(-2.9, 2.9))
goals = st.tuples(st.floats(3.1, 6.9), st.floats(-2.9, 2.9))


def view_of(*obstacles: Box) -> PlanView:
    return plan_view(map_of(Scene("test", Flat(), obstacles, BOUNDS), DOG, sees=False), half_width(DOG))


def wall(x: float, y0: float, y1: float) -> Box:
    """A thin wall along y."""
    return Box(x, 0.5 * (y0 + y1), 0.0, 0.02, y1 - y0, 1.0)


def enters(view: PlanView, points: list[tuple[float, float]]) -> bool:
    """Whether a line runs more than a hair inside an obstacle, or leaves the field."""
    line = LineString(points) if len(points) > 1 else Point(points[0])
    inside = any(o.buffer(-HAIR, join_style="mitre").intersects(line) for o in view.obstacles)
    return inside or not view.field.covers(line)


# --- any boxes -----------------------------------------------------------------------------------
@given(scenes, starts, goals)
def test_a_path_keeps_clear_and_ends_at_the_goal(obstacles: list[Box], start, goal) -> None:
    view = view_of(*obstacles)
    path = shortest_path(view, start, goal)
    assume(path is not None)
    assert path[-1] == goal
    assert not enters(view, list(path) if view.blocked(start) else [start, *path])
    assert length(start, path) >= math.dist(start, goal) - 1e-9


@given(scenes, starts, goals)
def test_where_the_straight_line_is_free_it_is_the_path(obstacles: list[Box], start, goal) -> None:
    view = view_of(*obstacles)
    assume(not enters(view, [start, goal]))
    path = shortest_path(view, start, goal)
    assert length(start, path) == pytest.approx(math.dist(start, goal), abs=1e-4)


@given(scenes, starts, goals)
@settings(max_examples=60)
def test_it_is_as_short_as_a_search_over_all_pairs_of_corners_finds(
    obstacles: list[Box], start, goal
) -> None:
    view = view_of(*obstacles)
    assume(not view.blocked(start) and not view.blocked(goal))
    best, path = by_all_pairs(view, start, goal), shortest_path(view, start, goal)
    assert (path is None) == (best == math.inf)
    if path is not None:
        assert length(start, path) == pytest.approx(best, abs=1e-3)


def by_all_pairs(view: PlanView, start, goal) -> float:
    """Length of the shortest path: every ring's corners, every pair tested, then Dijkstra by scipy."""
    rings = [ring for o in view.obstacles for ring in (o.exterior, *o.interiors)]
    corners = [c for ring in rings for c in ring.coords[:-1] if view.field.covers(Point(c))]
    nodes = np.array([start, goal, *corners])
    i, j = np.triu_indices(len(nodes), 1)
    lines = shapely.linestrings(np.stack([nodes[i], nodes[j]], axis=1))
    inside = sum(
        (shapely.length(shapely.intersection(lines, o.buffer(-HAIR))) for o in view.obstacles), 0 * i
    )
    weights = np.where(inside > 0.0, 0.0, np.maximum(shapely.length(lines), 1e-12))
    graph = np.zeros((len(nodes), len(nodes)))
    graph[i, j] = weights
    return float(dijkstra(graph, directed=False, indices=0)[1])


@given(scenes)
@settings(max_examples=8)
def test_a_walk_over_a_dense_grid_is_never_shorter(obstacles: list[Box]) -> None:
    """A brute-force check that shares nothing with corners: steps to 16 neighbours, 5 cm apart."""
    view = view_of(*obstacles)
    assume(not view.blocked(START) and not view.blocked(GOAL))
    on_grid, path = by_grid(view, 0.05), shortest_path(view, START, GOAL)
    if path is None:
        assert on_grid == math.inf
    else:
        assert on_grid >= length(START, path) - 1e-3


def test_the_grid_comes_within_three_per_cent_of_the_path_around_a_wall() -> None:
    view = view_of(wall(2.0, -3.0, 1.0), wall(4.0, -1.0, 3.0))
    best = length(START, shortest_path(view, START, GOAL))
    assert best <= by_grid(view, 0.05) + 1e-3 <= 1.03 * best + 0.05


def by_grid(view: PlanView, spacing: float) -> float:
    x, y = np.arange(BOUNDS[0], BOUNDS[2] + 1e-9, spacing), np.arange(BOUNDS[1], BOUNDS[3] + 1e-9, spacing)
    solid = shapely.union_all([o.buffer(-1e-9) for o in view.obstacles])
    shapely.prepare(solid)
    free = ~shapely.intersects_xy(solid, *np.meshgrid(x, y, indexing="ij"))
    number = np.arange(free.size).reshape(free.shape)
    graph_from, graph_to, cost = [], [], []
    for dx, dy in [(1, 0), (0, 1), (1, 1), (1, -1), (1, 2), (2, 1), (1, -2), (2, -1)]:
        here = (slice(0, len(x) - dx), slice(max(0, -dy), len(y) - max(0, dy)))
        there = (slice(dx, None), slice(max(0, dy), len(y) - max(0, -dy)))
        both = free[here] & free[there]
        ends = np.stack([number[here][both], number[there][both]])
        points = np.column_stack([x.repeat(len(y)), np.tile(y, len(x))])
        clear = ~shapely.intersects(solid, shapely.linestrings(points[ends.T]))
        graph_from.append(ends[0][clear])
        graph_to.append(ends[1][clear])
        cost.append(np.full(clear.sum(), spacing * math.hypot(dx, dy)))
    shape = (free.size, free.size)
    graph = coo_array(
        (np.concatenate(cost), (np.concatenate(graph_from), np.concatenate(graph_to))), shape
    ).tocsr()
    at = [
        number[round((px - BOUNDS[0]) / spacing), round((py - BOUNDS[1]) / spacing)]
        for px, py in (START, GOAL)
    ]
    return float(dijkstra(graph, directed=False, indices=at[0])[at[1]])


# --- a few by hand -------------------------------------------------------------------------------
def test_the_empty_field_is_crossed_straight() -> None:
    assert shortest_path(view_of(), START, GOAL) == (GOAL,)


def test_one_box_in_the_way_is_passed_at_its_nearer_corners() -> None:
    box = Box(3.0, 0.2, 0.0, 1.0, 1.0, 1.0)
    path = shortest_path(view_of(box), START, GOAL)
    margin = half_width(DOG)
    low = 0.2 - 0.5 - margin
    np.testing.assert_allclose(path, [(2.5 - margin, low), (3.5 + margin, low), GOAL], atol=1e-9)


def test_low_boxes_are_stepped_on() -> None:
    low = Box(3.0, 0.0, 0.0, 1.0, 1.0, 0.05)
    assert shortest_path(view_of(low), START, GOAL) == (GOAL,)


def test_a_wall_right_across_leaves_no_way() -> None:
    assert shortest_path(view_of(wall(3.0, -4.0, 4.0)), START, GOAL) is None


def test_a_gap_narrower_than_the_robot_is_no_way() -> None:
    def gap(width: float) -> PlanView:
        return view_of(wall(3.0, -4.0, -0.5 * width), wall(3.0, 0.5 * width, 4.0))

    assert shortest_path(gap(2 * half_width(DOG) - 0.01), START, GOAL) is None
    assert shortest_path(gap(2 * half_width(DOG) + 0.01), START, GOAL) is not None


def test_a_goal_inside_an_obstacle_is_no_way() -> None:
    view = view_of(Box(6.0, 0.0, 0.0, 0.5, 0.5, 1.0))
    assert view.blocked(GOAL)
    assert shortest_path(view, START, GOAL) is None


def test_inside_a_courtyard_walls_are_walked_around_too() -> None:
    """Walls that close upon themselves and one that juts inwards: its corner lies on an inner ring."""
    yard = [
        Box(3.0, 2.0, 0.0, 6.0, 0.1, 1.0),
        Box(3.0, -2.0, 0.0, 6.0, 0.1, 1.0),
        Box(0.0, 0.0, 0.0, 0.1, 4.0, 1.0),
        Box(6.0, 0.0, 0.0, 0.1, 4.0, 1.0),
        wall(3.0, -2.0, 0.5),
    ]
    path = shortest_path(view_of(*yard), (1.0, -1.0), (5.0, -1.0))
    assert path is not None
    assert length((1.0, -1.0), path) == pytest.approx(by_all_pairs(view_of(*yard), (1.0, -1.0), (5.0, -1.0)))


def test_a_robot_that_stands_too_near_a_box_still_finds_its_way() -> None:
    """It stood up within the clearance of a box, not within the box: there is a way."""
    beside = Box(0.0, 0.05 + half_width(DOG) - 0.02, 0.0, 0.1, 0.1, 1.0)
    path = shortest_path(view_of(beside), START, GOAL)
    assert path is not None and not enters(view_of(beside), list(path))
    assert length(START, path) < math.dist(START, GOAL) + 0.05


def test_between_two_boxes_that_nearly_touch_it_finds_out_too() -> None:
    """Grown, they are half a millimetre apart: the way out of the one must not lead into the other."""
    margin = half_width(DOG)
    left, right = (Box(0.0, s * (margin + 0.05 + 0.00025), 0.0, 2.0, 0.1, 1.0) for s in (1, -1))
    start = (0.0, 0.01)
    view = view_of(left, right)
    assert len(view.obstacles) == 2 and view.blocked(start)
    path = shortest_path(view, start, GOAL)
    assert path is not None and not enters(view, list(path))


@pytest.mark.parametrize("seed", range(5))
def test_the_blocks_scene_is_crossed(seed: int) -> None:
    view = plan_view(map_of(load_scene("blocks", seed), DOG, sees=False), half_width(DOG))
    path = shortest_path(view, START, GOAL)
    assert path is not None and not enters(view, [START, *path])
