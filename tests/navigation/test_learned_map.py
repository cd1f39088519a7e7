"""The learned map: optimism, progress, two radii, walked ways bound, unlearning, noise."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from plane_world import (
    RADIUS,
    WIDER,
    box_at,
    by_mitred_corners,
    clearance_of,
    exists,
    fence_edges,
    look,
    maze,
    random_polygons,
    ring_edges,
    shortest,
    turned,
    walk,
)
from shapely import LineString, Point, Polygon

from gaitwright.errors import WrongUse
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.piece_rows import FELT, KIND, SEEN, SUPPOSED
from gaitwright.navigation.tolerances import CHECK, LINK, NODE, STOP, TOUCH, WORTH
from gaitwright.signals import Sight

BOUNDS = (0.0, 0.0, 6.0, 6.0)
START, GOAL = (0.6, 0.6), (5.4, 5.4)
NARROW = math.radians(90.0)


def walled(polygons, bounds=BOUNDS):
    """All edges of a world, the fence too."""
    return np.vstack([ring_edges(polygons), fence_edges(bounds)])


def random_world(seed: int):
    """Polygons of one of three kinds: a forest, a maze of touching boxes, a forest with a wall across."""
    rng = np.random.default_rng(seed)
    if seed % 3 == 1:
        return list(maze(rng, 6, doors=int(rng.integers(0, 4))))
    polygons = random_polygons(rng, int(rng.integers(2, 12)), BOUNDS, (0.2, 0.9), (START, GOAL))
    if seed % 3 == 2:
        polygons.append(box_at(3.0, 3.0, 0.1, 6.2 if seed % 2 else 4.0, rng.uniform(0.2, 1.3)))
    return polygons


def empty(**settings) -> LearnedMap:
    return LearnedMap.of(BOUNDS, RADIUS, **settings)


# --- turning ---------------------------------------------------------------------------------------
WALL_AHEAD = Sight((1.0, 3.0), np.array([[2.0, 1.54, 2.0, 4.47]]), np.ones((1, 2), bool), np.empty((0, 2)))
"""A wall that ends a little nearer on the right side of who comes along x."""


@pytest.mark.parametrize("facing", [-1.2, 0.0, 1.2, 1.2 - 2.0 * math.pi])
def test_of_ways_about_as_short_the_one_it_faces_is_taken(facing):
    """So that it does not turn to and fro before a wall of which it sees more with every look."""
    known, goal = empty().seen(WALL_AHEAD), (5.0, 3.0)
    right, facing_it = known.way((1.0, 3.0), goal), known.way((1.0, 3.0), goal, facing)
    assert right is not None and right.path[0][1] < 2.0
    assert facing_it is not None and not facing_it.is_walked
    turns_left = math.remainder(facing, 2.0 * math.pi) > 0.5
    assert (facing_it.path[0][1] > 4.0) == turns_left
    assert right.length <= facing_it.length <= 1.03 * right.length
    assert facing_it.optimistic == pytest.approx(right.length)
    ends = np.vstack([(1.0, 3.0), facing_it.path])
    assert facing_it.length == pytest.approx(np.hypot(*np.diff(ends, axis=0).T).sum())


def test_facing_changes_nothing_where_all_is_known():
    known = LearnedMap.of_polygons(BOUNDS, RADIUS, [[(2.0, 1.6), (2.1, 1.6), (2.1, 4.5), (2.0, 4.5)]])
    assert known.way((1.0, 3.0), (5.0, 3.0), 1.2) == known.way((1.0, 3.0), (5.0, 3.0))


# --- known from the start --------------------------------------------------------------------------
@given(st.integers(0, 10_000))
@settings(max_examples=6)
def test_a_known_field_is_crossed_as_short_as_brute_force_says_at_two_radii(seed: int) -> None:
    polygons = random_world(seed)[:5]
    edges, way = ring_edges(polygons), LearnedMap.of_polygons(BOUNDS, RADIUS, polygons).way(START, GOAL)
    if way is None:
        assert not exists(edges, BOUNDS, START, GOAL, WIDER)
        return
    assert exists(edges, BOUNDS, START, GOAL, RADIUS - 1e-6)
    assert way.path[-1] == GOAL and way.is_walked and way.optimistic == way.length
    assert clearance_of(walled(polygons), [START, *way.path]) >= RADIUS - 2.0 * LINK
    assert way.length == pytest.approx(LineString([START, *way.path]).length)
    assert way.length >= shortest(edges, BOUNDS, START, GOAL, RADIUS - 1e-6, 4) - 1e-6
    assert way.length <= shortest(edges, BOUNDS, START, GOAL, 1.01 * WIDER, 4) + 1e-3


def test_round_a_pole_a_disc_goes_along_its_polygon() -> None:
    """By hand: to the pole's circle along a tangent, round it and off along the other."""
    way = LearnedMap.of_polygons(BOUNDS, 0.5, [[(3.0, 3.0)]]).way((1.0, 3.0), (5.0, 3.0))
    straight, angle = math.sqrt(4.0 - 0.25), 2.0 * math.asin(0.25)
    exact = 2.0 * straight + 0.5 * angle
    assert exact <= way.length <= exact * 1.002


@given(st.integers(0, 10_000))
def test_it_is_as_good_as_corners_of_mitred_outlines(seed: int) -> None:
    """Beside a search among outlines that were grown without rounding them: never longer."""
    rng = np.random.default_rng(seed)
    drawn = np.hstack(
        [rng.uniform(1.0, 5.0, (8, 2)), rng.uniform(0.2, 1.5, (8, 2)), rng.uniform(0.0, 3.0, (8, 1))]
    )
    boxes = [box_at(*numbers) for numbers in drawn.tolist()]
    if any(Polygon(box).distance(Point(place)) <= RADIUS + 1e-3 for box in boxes for place in (START, GOAL)):
        return
    inner = (BOUNDS[0] + RADIUS, BOUNDS[1] + RADIUS, BOUNDS[2] - RADIUS, BOUNDS[3] - RADIUS)
    theirs = by_mitred_corners(boxes, inner, RADIUS + 1e-3, START, GOAL)
    way = LearnedMap.of_polygons(BOUNDS, RADIUS, boxes).way(START, GOAL)
    assert theirs == math.inf or way.length <= theirs + 1e-9


def test_a_goal_that_is_shut_in_is_found_to_be_from_its_side() -> None:
    """Among many polygons only few corners are looked at; with a door left open the way in is found."""
    rng, bounds = np.random.default_rng(5), (0.0, 0.0, 40.0, 40.0)
    goal = (20.0, 20.0)
    polygons = random_polygons(rng, 150, bounds, (0.3, 1.5), (goal, START), 3.0)
    walls = [box_at(20.0, 18.5, 3.0, 0.1), box_at(20.0, 21.5, 3.0, 0.1), box_at(18.5, 20.0, 0.1, 3.0)]
    door, shut = box_at(21.5, 19.5, 0.1, 2.0), box_at(21.5, 20.0, 0.1, 3.0)
    pole = box_at(20.5, 20.0, 0.2, 0.2)
    closed = LearnedMap.of_polygons(bounds, RADIUS, [*polygons, *walls, shut, pole])
    assert closed.way(START, goal) is None
    found = closed.road_map.roads.found[:, 0] >= 0
    assert 500 < found.sum() < 0.5 * len(found)
    way = LearnedMap.of_polygons(bounds, RADIUS, [*polygons, *walls, door, pole]).way(START, goal)
    assert way is not None and way.length > math.dist(START, goal)


WALLS = {
    "edge to edge": (0.0, 0.0),
    "a nanometre apart": (1e-9, 0.0),
    "a micrometre apart": (1e-6, 0.0),
    "a nanometre over each other": (-1e-9, 0.0),
    "corner to corner": (0.0, 0.2),
    "across each other": (-0.5, 0.1),
    "far over each other": (-0.3, 0.0),
}


@pytest.mark.parametrize("apart, aside", WALLS.values(), ids=list(WALLS))
def test_a_wall_of_separate_boxes_is_a_wall(apart: float, aside: float) -> None:
    for angle in np.linspace(0.0, 2.0, 7):
        pieces = [box_at(3.0 + aside * (k % 2), (1.0 + apart) * k - 0.5, 0.2, 1.0) for k in range(-6, 24)]
        wall = [turned(piece, angle, (3.0, 3.0)) for piece in pieces]
        start, goal = turned([(1.5, 3.0), (4.5, 3.3)], angle, (3.0, 3.0))
        assert LearnedMap.of_polygons(BOUNDS, RADIUS, wall).way(start, goal) is None
        assert LearnedMap.of_polygons(BOUNDS, RADIUS, wall[::4]).way(start, goal) is not None


@pytest.mark.parametrize("kind", ["wall ends", "skew walls", "corners"])
@pytest.mark.parametrize("off", [-0.003, -0.0005, 0.0005, 0.0125])
def test_gaps_as_wide_as_the_disc_are_judged_to_a_millimetre(kind: str, off: float) -> None:
    """Refused where r does not pass, passed where r / cos 15° does (11.3 mm wider), so in every turned copy;
    between wall ends and skew walls also half a millimetre decides."""
    for angle in np.arange(10) * 0.61:
        world = [turned(ring, angle, (3.0, 3.0)) for ring in gap(kind, 2.0 * RADIUS + off)]
        start, goal = turned([(1.9, 2.4), (4.1, 3.9)], angle, (3.0, 3.0))
        way = LearnedMap.of_polygons(BOUNDS, RADIUS, world).way(start, goal)
        if off < 0.0:
            assert way is None
        elif off > 0.0113 or kind != "corners":
            assert way is not None


def gap(kind: str, width: float):
    """Two obstacles across the field that leave a gap in the middle."""
    half = 0.5 * width
    if kind == "wall ends":
        return [box_at(3.0, 3.0 + side * (half + 5.0), 0.1, 10.0) for side in (1.0, -1.0)]
    if kind == "skew walls":
        walls = [box_at(3.0, 3.0 + side * (half + 5.0), 0.4, 10.0) for side in (1.0, -1.0)]
        return [turned(wall, 0.0) for wall in walls]
    return [
        [(3.0, 3.0 + s * half), (5.0, 3.0 + s * (half + 10.0)), (1.0, 3.0 + s * (half + 10.0))]
        for s in (1, -1)
    ]


@given(st.integers(0, 10_000))
@settings(max_examples=10)
def test_what_is_known_in_two_steps_is_known_at_once(seed: int) -> None:
    """The order of obstacles does not matter, nor that an obstacle is there twice."""
    polygons = random_world(seed)
    once = LearnedMap.of_polygons(BOUNDS, RADIUS, polygons).way(START, GOAL)
    again = LearnedMap.of_polygons(BOUNDS, RADIUS, [*polygons[::-1], *polygons[:2]]).way(START, GOAL)
    assert (once is None) == (again is None)
    assert once is None or once.length == pytest.approx(again.length, abs=1e-9)


# --- unknown ground --------------------------------------------------------------------------------
@pytest.mark.parametrize("seed", range(9))
def test_four_trips_arrive_get_shorter_and_believe_nothing_that_is_not_there(seed: int) -> None:
    """Optimism, progress, two radii and the bound on walked ways, in one walk: there, back, there, back."""
    polygons = random_world(seed)
    edges = walled(polygons)
    best = LearnedMap.of_polygons(BOUNDS, RADIUS, polygons).way(START, GOAL)
    learned, places, lengths = empty(), (START, GOAL), []
    for _ in range(4):
        trip = walk(edges, learned, *places, view=NARROW)
        learned, places = trip.learned, places[::-1]
        assert trip.arrived == (best is not None)
        assert pieces_off(edges, seen_of(learned)) < 2e-4  # optimism: each lies on a true edge
        assert trip.plans <= 5.0 + shapely.length(shapely.linestrings(edges.reshape(-1, 2, 2))).sum() / 0.01
        assert clearance_of(edges, trip.walked) >= RADIUS - TOUCH
        for place, way in trip.ways:
            assert way is None or way.optimistic <= way.length + 1e-9 <= WORTH * way.optimistic + 2e-9
            assert way is None or way.is_walked or way.length == way.optimistic
            assert best is None or place != places[1] or way.optimistic <= best.length * 1.01
        if not trip.arrived:
            return
        lengths.append(trip.length)
    assert lengths[3] <= 1.05 * best.length and lengths[3] <= lengths[0] + 0.01


def seen_of(learned: LearnedMap) -> np.ndarray:
    return learned.pieces[learned.rows[:, KIND] == SEEN]


def pieces_off(edges: np.ndarray, pieces: np.ndarray) -> float:
    """How far any of nine points of a piece is from the true edges."""
    lines = shapely.union_all(shapely.linestrings(edges.reshape(-1, 2, 2)))
    points = [piece[:2] + t * (piece[2:] - piece[:2]) for piece in pieces for t in np.linspace(0, 1, 9)]
    return float(shapely.distance(lines, shapely.points(points)).max()) if points else 0.0


def test_a_way_that_nothing_new_comes_near_stays_the_shortest() -> None:
    """Monotone: between looks at what is elsewhere, a new plan is as long as what is left of the old."""
    polygons = random_world(12)
    edges, learned, here = walled(polygons), empty(), START
    learned = learned.seen(look(edges, START))
    way = learned.way(START, GOAL)
    for eye in ((0.7, 5.0), (5.2, 0.7), (0.6, 3.0)):
        learned = learned.seen(look(edges, eye, reach=1.5))
        again = learned.way(here, GOAL)
        assert again.optimistic >= way.optimistic - 1e-9
        if not learned.is_cut((here, *way.path)):
            assert again.optimistic == pytest.approx(way.optimistic, abs=0.02)


def test_the_order_of_tolerances() -> None:
    assert NODE > 0.0 > -LINK > -STOP > -CHECK > -TOUCH


def test_pieces_of_a_line_join_and_ends_become_corners() -> None:
    learned = empty()
    for x0, x1, corners in ((1.0, 2.0, (False, False)), (1.5, 3.0, (False, True)), (0.5, 1.0, (True, False))):
        learned = learned.seen(sight([(x0, 3.0, x1, 3.0)], [corners]))
    np.testing.assert_allclose(np.sort(learned.pieces[:, ::2]), [[0.5, 3.0]])
    assert learned.corners.tolist() == [[True, True]]
    learned = learned.seen(sight([(3.5, 3.0, 4.0, 3.0), (0.5, 3.01, 3.0, 3.01)]))
    assert len(learned.pieces) == 3  # neither what stands apart nor what lies beside joins


def sight(pieces=(), corners=None, free=()) -> Sight:
    pieces = np.array(pieces, dtype=float).reshape(-1, 4)
    corners = np.zeros((len(pieces), 2), dtype=bool) if corners is None else np.array(corners)
    return Sight((3.0, 1.0), pieces, corners, np.array(free, dtype=float).reshape(-1, 2))


# --- what goes -------------------------------------------------------------------------------------
def test_a_box_that_was_taken_away_is_unlearned() -> None:
    box = box_at(3.0, 3.0, 1.0, 1.0, 0.3)
    there, gone = walled([box]), walled([])
    learned = empty()
    for eye in ((1.0, 1.0), (5.0, 5.0), (1.0, 5.0), (5.0, 1.0)):
        learned = learned.seen(look(there, eye, reach=4.0))
    assert learned.way(START, GOAL).length > 1.001 * math.dist(START, GOAL)
    for eye in ((1.0, 1.0), (5.0, 5.0)):
        learned = learned.seen(look(gone, eye, reach=4.0))
    assert learned.way(START, GOAL).path == (GOAL,)
    assert pieces_off(gone, learned.pieces) < 1e-6


def test_a_box_that_was_moved_is_where_it_is_now() -> None:
    learned, places = empty(), (START, GOAL)
    for x, y in ((3.0, 3.0), (3.4, 2.5), (2.2, 3.3)):
        edges = walled([box_at(x, y, 1.2, 1.2, 0.3)])
        for _ in range(2):
            trip = walk(edges, learned, *places)
            learned, places = trip.learned, places[::-1]
            assert trip.arrived
        best = LearnedMap.of_polygons(BOUNDS, RADIUS, [box_at(x, y, 1.2, 1.2, 0.3)]).way(START, GOAL)
        assert trip.length <= 1.05 * best.length


def test_only_what_lies_in_seen_ground_is_unlearned() -> None:
    learned = empty().seen(sight([(0.5, 3.0, 5.5, 3.0)], [(True, True)]))
    learned = learned.seen(sight(free=[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]))
    left = sorted(map(tuple, np.sort(learned.pieces[:, ::2]).tolist()))
    np.testing.assert_allclose(left, [(0.5, 2.02), (3.98, 5.5)], atol=1e-9)
    assert sorted(map(tuple, learned.corners.tolist())) == [(False, True), (True, False)]


def test_what_was_felt_stays_until_the_trip_is_over_or_leads_through_it() -> None:
    learned = empty().felt((3.0 - RADIUS, 3.0), 0.0)
    assert learned.is_cut([(2.5, 3.0), (3.5, 3.0)]) and not learned.is_cut([(3.5, 2.0), (3.5, 4.0)])
    assert len(learned.way((2.5, 3.0), (3.5, 3.0)).path) > 1 and len(learned.pieces) == 2
    learned = learned.seen(sight(free=[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]))
    np.testing.assert_allclose(np.sort(learned.pieces[:, 1::2]), [[2.999, 3.001]])
    assert len(learned.walked([(2.0, 3.0), (4.0, 3.0)]).pieces) == 0
    later = learned.walked([START, (1.0, 1.0)])
    assert (later.rows[:, KIND] == SUPPOSED).all() and (learned.rows[:, KIND] == FELT).all()
    assert len(later.seen(sight(free=[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)])).pieces) == 0


# --- the robot's own place, odd places ---------------------------------------------------------------
@pytest.mark.parametrize("off", [0.001, 0.01, 0.02, 0.035, 0.05, 0.07])
def test_off_the_middle_of_a_passage_that_is_just_wide_enough_it_finds_out(off: float) -> None:
    """Whoever stands nearer to one wall than r first has to go straight away from it, to the millimetre."""
    half = RADIUS + 0.0005
    walls = [box_at(3.0, 3.0 + side * (half + 0.05), 2.0, 0.1) for side in (-1.0, 1.0)]
    way = LearnedMap.of_polygons(BOUNDS, RADIUS, walls).way((3.0, 3.0 + off), GOAL)
    assert way is not None and abs(way.path[0][1] - 3.0) < 0.0005
    assert clearance_of(ring_edges(walls), way.path) >= RADIUS - 2.0 * LINK


@pytest.mark.parametrize("away", [0.0, 1e-9, 0.01, 0.05, 0.1, 0.15, 0.1599])
def test_a_start_too_near_to_something_is_left(away: float) -> None:
    wall = [(0.5, 3.0), (5.5, 3.0)]
    learned = LearnedMap.of_polygons(BOUNDS, RADIUS, [wall])
    start = (3.0, 3.0 + away)
    way = learned.way(start, (3.0, 5.0))
    assert way.length <= 2.0 - away + 0.1
    assert not learned.is_cut((start, *way.path))
    assert clearance_of(ring_edges([wall]), [way.path[0], *way.path]) >= RADIUS - 1e-6
    if away > 0.01:
        assert clearance_of(ring_edges([wall]), [start, *way.path]) >= away - 1e-6


def test_what_is_only_supposed_shuts_no_way() -> None:
    """A door as wide as the robot and a bit: felt at its post, it is not said to be shut."""
    world = [box_at(3.0, 3.0 + side * (0.2 + 5.0), 0.1, 10.0) for side in (1.0, -1.0)]
    learned = LearnedMap.of_polygons(BOUNDS, RADIUS, world).felt((2.95 - RADIUS, 3.2), 0.0)
    assert (learned.rows[:, KIND] == FELT).sum() == 1
    assert learned.road_map.roads.nodes.lean.size != learned.sure_road_map.roads.nodes.lean.size
    way = learned.way(START, GOAL)
    assert way is not None and not learned.is_cut((START, *way.path))


def test_a_robot_believed_within_a_wall_gets_out_and_one_beside_it_not_through() -> None:
    learned = LearnedMap.of_polygons(BOUNDS, RADIUS, [box_at(3.0, 3.0, 0.6, 8.0)])
    assert learned.way((2.75, 3.0), (1.0, 3.0)) is not None  # 5 cm within: it is not there
    assert learned.way((2.6, 3.0), (5.0, 3.0)) is None
    assert learned.way((2.6, 3.0), (1.0, 3.0)) is not None


def test_goals_that_cannot_be_stood_on() -> None:
    learned = LearnedMap.of_polygons(BOUNDS, RADIUS, [box_at(3.0, 3.0, 1.0, 1.0)])
    assert learned.way(START, (3.0, 3.0)) is None
    assert learned.way(START, (3.0, 2.45)) is None
    assert learned.way(START, (7.0, 3.0)) is None
    assert learned.way(START, (0.1, 3.0)) is None
    assert learned.way((3.0, 2.45), (3.0, 2.45)).length == 0.0
    assert learned.way((-1.0, 3.0), (1.0, 3.0)).path[-1] == (1.0, 3.0)


def test_obstacles_may_reach_as_far_as_they_like() -> None:
    """A wall from one end of what is allowed to the other, and things far from the field."""
    far = 9e6
    wall, beside = [(3.0, -far), (3.1, -far), (3.1, far), (3.0, far)], box_at(far, -far, 1.0, 1.0)
    assert LearnedMap.of_polygons(BOUNDS, RADIUS, [wall]).way(START, GOAL) is None
    assert LearnedMap.of_polygons(BOUNDS, RADIUS, [beside]).way(START, GOAL).path == (GOAL,)
    with pytest.raises(WrongUse, match="at most"):
        LearnedMap.of_polygons(BOUNDS, RADIUS, [box_at(1e8, 0.0, 1.0, 1.0)])


def test_what_makes_no_sense_is_said() -> None:
    with pytest.raises(WrongUse, match="no strategy 'best'"):
        LearnedMap.of(BOUNDS, RADIUS, strategy="best")
    for bounds, radius in (
        ((0.0, 0.0, 0.0, 1.0), 0.1),
        (BOUNDS, 0.0),
        ((0.0, 0.0, math.inf, 1.0), 0.1),
        ((0.0, 0.0, 2e5, 1.0), 0.1),
    ):
        with pytest.raises(WrongUse):
            LearnedMap.of(bounds, radius)
    with pytest.raises(WrongUse):
        empty().way(START, (math.nan, 1.0))
    with pytest.raises(WrongUse):
        empty().seen(sight([(1.0, 2.0, math.inf, 3.0)]))
    with pytest.raises(WrongUse):
        empty().felt(START, math.nan)
    with pytest.raises(WrongUse):
        empty().joined(LearnedMap.of((0.0, 0.0, 1.0, 1.0), RADIUS))


# --- noise, several maps, equal bits -----------------------------------------------------------------
@pytest.mark.parametrize("seed", [0, 3, 6])
def test_pieces_with_noise_lead_there_too(seed: int) -> None:
    rng = np.random.default_rng(seed)
    polygons = random_polygons(rng, 6, BOUNDS, (0.3, 0.8), (START, GOAL))
    edges, learned, places = walled(polygons), empty(noise=0.01), (START, GOAL)
    best = LearnedMap.of_polygons(BOUNDS, RADIUS, polygons).way(START, GOAL)
    for _ in range(2):
        trip = walk(edges, learned, *places, noise=rng)
        learned, places = trip.learned, places[::-1]
        assert trip.arrived and pieces_off(edges, seen_of(learned)) < 0.05
    assert trip.length <= 1.1 * best.length
    assert len(learned.pieces) <= 3 * len(edges)  # one line is one piece, or nearly


def test_what_two_robots_know_one_knows() -> None:
    polygons = random_world(0)
    edges = walled(polygons)
    one = empty().seen(look(edges, (1.0, 1.0))).walked([(1.0, 1.0), (1.2, 1.0)])
    other = empty().seen(look(edges, (5.0, 5.0))).walked([(5.0, 5.0), (5.2, 5.0)])
    both, sequence = one.joined(other), one.seen(look(edges, (5.0, 5.0)))
    assert both.trips == one.trips + other.trips
    assert (both.raster.cells == one.raster.cells | other.raster.cells).all()
    assert pieces_off(edges, both.pieces) < 2e-4
    assert both.way(START, GOAL).length == pytest.approx(sequence.way(START, GOAL).length, abs=1e-6)
    assert len(one.joined(one).pieces) == len(one.pieces)


def test_the_same_again_is_the_same_to_the_bit() -> None:
    edges = walled(random_world(4))
    first, second = (walk(edges, empty(), START, GOAL, view=NARROW) for _ in range(2))
    assert first.walked == second.walked
    assert first.learned.rows.tobytes() == second.learned.rows.tobytes()
    assert first.learned.raster.cells.tobytes() == second.learned.raster.cells.tobytes()


def test_a_map_is_a_value() -> None:
    learned = empty()
    learned.seen(sight([(0.5, 3.0, 5.5, 3.0)], free=[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0)]))
    learned.walked([START, GOAL])
    assert len(learned.rows) == 0 and not learned.raster.cells.any() and learned.trips == ()


# --- the thesis's own rule -----------------------------------------------------------------------------
@pytest.mark.parametrize("seed", range(6))
def test_the_thesis_rule_arrives_too_and_keeps_its_way(seed: int) -> None:
    polygons = random_world(seed)
    edges, best = walled(polygons), LearnedMap.of_polygons(BOUNDS, RADIUS, polygons).way(START, GOAL)
    learned, places, lengths = empty(strategy="thesis"), (START, GOAL), []
    for _ in range(3):
        trip = walk(edges, learned, *places, view=NARROW)
        learned, places = trip.learned, places[::-1]
        assert trip.arrived == (best is not None)
        assert clearance_of(edges, trip.walked) >= RADIUS - TOUCH
        if not trip.arrived:
            return
        lengths.append(trip.length)
        assert trip.length >= best.length * 0.999
    assert lengths[1] <= lengths[0] + 0.05 and lengths[2] <= lengths[1] + 0.05


def test_by_the_thesis_rule_an_edge_is_gone_along_to_its_end() -> None:
    """By hand: a wall across the way, its nearer end is gone to first, then the goal."""
    wall = [box_at(3.0, 2.5, 0.1, 3.0)]
    start, goal = (1.0, 3.0), (5.0, 3.0)
    learned = empty(strategy="thesis").seen(look(walled(wall), start, reach=4.0))
    way = learned.way(start, goal)
    assert way.path[-1] == goal and not way.is_walked
    assert all(y > 4.0 for _, y in way.path[:-1])
    assert way.length >= way.optimistic
