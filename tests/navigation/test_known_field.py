"""Through ground that is known: paths keep clear, are as short as can be, and exist where there is a way."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from plane_world import by_mitred_corners, exists, ring_edges, shortest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Point, Polygon

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.navigation.known_field import is_blocked, is_within, known_field
from gaitwright.navigation.paths import length
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.tolerances import HALF_STEP, LINK, NODE
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import GroundMap
from robots_by_hand import dog

DOG = dog()
R = half_width(DOG)
WIDER = (R + NODE) / math.cos(HALF_STEP)
BOUNDS = (-1.0, -3.0, 7.0, 3.0)
AROUND = (BOUNDS[0] - R, BOUNDS[1] - R, BOUNDS[2] + R, BOUNDS[3] + R)
"""Walls here would keep the robot's middle within the bounds."""
START, GOAL = (0.0, 0.0), (6.0, 0.0)

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
Path = tuple[tuple[float, float], ...]


def ground_of(*obstacles: Box) -> GroundMap:
    return map_of(Scene("test", Flat(), obstacles, BOUNDS), DOG, sees=False)


def way(ground: GroundMap, start: tuple[float, float], goal: tuple[float, float]) -> Path | None:
    found = known_field(ground, R).way(start, goal)
    return found and found.path


def apart(ground: GroundMap, points: list[tuple[float, float]]) -> float:
    """The least distance of a path from what stands there, by shapely [m]."""
    line = LineString(points) if len(points) > 1 else Point(points[0])
    return min((Polygon(outline).distance(line) for outline in ground.obstacles), default=math.inf)


def wall(x: float, y0: float, y1: float) -> Box:
    """A thin wall along y."""
    return Box(x, 0.5 * (y0 + y1), 0.0, 0.02, y1 - y0, 1.0)


# --- any boxes -----------------------------------------------------------------------------------
@given(scenes, starts, goals)
def test_a_path_keeps_clear_and_ends_at_the_goal(obstacles: list[Box], start, goal) -> None:
    ground = ground_of(*obstacles)
    assume(not is_blocked(ground, R, start))
    path = way(ground, start, goal)
    assume(path is not None)
    assert path[-1] == goal
    assert apart(ground, [start, *path]) >= R - 2.0 * LINK
    assert all(is_within(BOUNDS, point, -NODE) for point in path)
    assert length(start, path) >= math.dist(start, goal) - 1e-9


@given(scenes, starts, goals)
def test_where_the_straight_line_is_free_it_is_the_path(obstacles: list[Box], start, goal) -> None:
    ground = ground_of(*obstacles)
    assume(apart(ground, [start, goal]) > R)
    assert way(ground, start, goal) == (goal,)


@given(scenes, starts, goals)
@settings(max_examples=40)
def test_it_is_as_short_as_a_search_over_all_pairs_finds_and_there_where_it_does(
    obstacles: list[Box], start, goal
) -> None:
    ground = ground_of(*obstacles)
    assume(not is_blocked(ground, R, start) and not is_blocked(ground, R, goal))
    path, edges = way(ground, start, goal), ring_edges(ground.obstacles)
    if path is None:
        assert not exists(edges, AROUND, start, goal, WIDER)
        return
    assert exists(edges, AROUND, start, goal, R - 1e-6)
    assert length(start, path) >= shortest(edges, AROUND, start, goal, R - 1e-6, 4) - 1e-6
    assert length(start, path) <= by_mitred_corners(ground.obstacles, BOUNDS, R + NODE, start, goal) + 1e-6


@given(scenes, starts)
def test_a_place_is_blocked_on_an_obstacle_and_too_near_to_one(obstacles: list[Box], place) -> None:
    ground = ground_of(*obstacles)
    away = apart(ground, [place])
    assume(abs(away - R) > 1e-6)
    assert is_blocked(ground, R, place) == (away < R)


@given(scenes)
@settings(max_examples=8)
def test_a_walk_over_a_dense_grid_is_never_shorter(obstacles: list[Box]) -> None:
    """A brute-force check that shares nothing with corners: steps to 16 neighbours, 5 cm apart."""
    ground = ground_of(*obstacles)
    assume(not is_blocked(ground, R, START) and not is_blocked(ground, R, GOAL))
    path = way(ground, START, GOAL)
    if path is None:
        assert by_grid(ground, WIDER, 0.05) == math.inf
    else:
        assert by_grid(ground, WIDER, 0.05) >= length(START, path) - 1e-3


def test_the_grid_comes_within_three_per_cent_of_the_path_around_a_wall() -> None:
    ground = ground_of(wall(2.0, -3.0, 1.0), wall(4.0, -1.0, 3.0))
    best = length(START, way(ground, START, GOAL))
    assert best <= by_grid(ground, WIDER, 0.05) + 1e-3 <= 1.03 * best + 0.05


def by_grid(ground: GroundMap, radius: float, spacing: float) -> float:
    x, y = np.arange(BOUNDS[0], BOUNDS[2] + 1e-9, spacing), np.arange(BOUNDS[1], BOUNDS[3] + 1e-9, spacing)
    solid = shapely.union_all([Polygon(outline).buffer(radius) for outline in ground.obstacles])
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
def test_the_empty_field_is_crossed_straight_and_its_edge_is_no_wall() -> None:
    assert way(ground_of(), START, GOAL) == (GOAL,)
    along = (-0.9, 2.999), (6.9, 2.999)
    assert way(ground_of(), *along) == (along[1],)


def test_one_box_in_the_way_is_passed_at_its_nearer_corners() -> None:
    path = way(ground_of(Box(3.0, 0.2, 0.0, 1.0, 1.0, 1.0)), START, GOAL)
    tangent = math.sqrt(2.5**2 + 0.3**2 - R**2)
    bend = math.atan2(0.3, 2.5) + math.asin(R / math.hypot(2.5, 0.3))
    exact = 2.0 * tangent + 1.0 + 2.0 * R * bend
    assert exact - 1e-6 <= length(START, path) <= 1.003 * exact
    assert apart(ground_of(Box(3.0, 0.2, 0.0, 1.0, 1.0, 1.0)), [START, *path]) == pytest.approx(R, rel=0.01)


def test_low_boxes_are_stepped_on() -> None:
    low = Box(3.0, 0.0, 0.0, 1.0, 1.0, 0.05)
    assert way(ground_of(low), START, GOAL) == (GOAL,)


def test_a_wall_right_across_leaves_no_way() -> None:
    assert way(ground_of(wall(3.0, -4.0, 4.0)), START, GOAL) is None


def test_a_gap_narrower_than_the_robot_is_no_way() -> None:
    def gap(width: float) -> GroundMap:
        return ground_of(wall(3.0, -4.0, -0.5 * width), wall(3.0, 0.5 * width, 4.0))

    assert way(gap(2 * R - 0.01), START, GOAL) is None
    assert way(gap(2 * R + 0.01), START, GOAL) is not None


def test_a_goal_inside_an_obstacle_is_no_way() -> None:
    ground = ground_of(Box(6.0, 0.0, 0.0, 1.5, 1.5, 1.0))
    assert is_blocked(ground, R, GOAL) and not known_field(ground, R).is_touched(GOAL)
    assert way(ground, START, GOAL) is None


def test_inside_a_courtyard_walls_are_walked_around_too() -> None:
    """Walls that close upon themselves and one that juts inwards."""
    yard = [
        Box(3.0, 2.0, 0.0, 6.0, 0.1, 1.0),
        Box(3.0, -2.0, 0.0, 6.0, 0.1, 1.0),
        Box(0.0, 0.0, 0.0, 0.1, 4.0, 1.0),
        Box(6.0, 0.0, 0.0, 0.1, 4.0, 1.0),
        wall(3.0, -2.0, 0.5),
    ]
    ground, start, goal = ground_of(*yard), (1.0, -1.0), (5.0, -1.0)
    found = length(start, way(ground, start, goal))
    assert found <= by_mitred_corners(ground.obstacles, BOUNDS, R + NODE, start, goal) + 1e-6
    assert found >= 2.0 * math.hypot(1.99, 1.5), "over the wall's end"


def test_a_robot_that_stands_too_near_a_box_still_finds_its_way() -> None:
    """It stood up within the clearance of a box, not within the box: there is a way."""
    beside = Box(0.0, 0.05 + R - 0.02, 0.0, 0.1, 0.1, 1.0)
    path = way(ground_of(beside), START, GOAL)
    assert path is not None and apart(ground_of(beside), [START, *path]) >= R - 0.02 - 1e-6
    assert length(START, path) < math.dist(START, GOAL) + 0.05


def test_between_two_boxes_that_nearly_touch_it_finds_out_too() -> None:
    """They leave half a millimetre of room: the way out of the one must not lead into the other."""
    left, right = (Box(0.0, s * (R + 0.05 + 0.00025), 0.0, 2.0, 0.1, 1.0) for s in (1, -1))
    start = (0.0, 0.01)
    ground = ground_of(left, right)
    assert is_blocked(ground, R, start)
    path = way(ground, start, GOAL)
    assert path is not None and apart(ground, [start, *path]) >= R - 0.01 - 1e-6


@pytest.mark.parametrize("seed", range(5))
def test_the_blocks_scene_is_crossed(seed: int) -> None:
    ground = map_of(load_scene("blocks", seed), DOG, sees=False)
    path = way(ground, START, GOAL)
    assert path is not None and apart(ground, [START, *path]) >= R - 2.0 * LINK
