"""The navigator passes way-points in order, says where it has come to, and why there is no way."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.navigation.known_field import known_field
from gaitwright.navigation.navigator import Navigator
from gaitwright.navigation.reached import ARRIVED, PASSED, STOP_AT
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.travel import Travel
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import GroundMap, Mission, Route, Sensed
from robots_by_hand import dog

DOG = dog()
UNIT = DOG.body_length
BOUNDS = (-4.0, -4.0, 10.0, 4.0)
places = st.tuples(st.floats(-3.9, 9.9), st.floats(-3.9, 3.9))


@dataclass(frozen=True)
class Pilot:
    """The dog's navigator over a map of its own, without eyes; it turns wherever it is."""

    ground: GroundMap
    navigator: Navigator = field(default_factory=lambda: Navigator(DOG, makes_room=False))

    def set_out(self, mission: Mission, sensed: Sensed) -> Route:
        return self.navigator.set_out(mission, sensed, self.ground)[0]

    def plan(self, route: Route, sensed: Sensed) -> Route:
        return self.navigator.plan(route, sensed, self.ground, None, self.memory(route))[0]

    def memory(self, route: Route) -> Travel:
        """Of a route to one goal."""
        return Travel(known_field(self.ground, half_width(DOG)), route.path[-1:])


def among(*boxes: Box) -> Pilot:
    return Pilot(map_of(Scene("test", Flat(), boxes, BOUNDS), DOG))


def at(x: float, y: float) -> Sensed:
    still, joints = np.zeros(3), np.zeros((4, 3))
    return Sensed(
        1.0, np.array([x, y, 0.29]), np.array([1.0, 0, 0, 0]), still, still, joints, joints, np.ones(4)
    )


@given(places, st.lists(places, min_size=1, max_size=4))
def test_a_free_field_is_crossed_from_way_point_to_way_point(start, points) -> None:
    assume(all(math.dist(a, b) > 1e-6 for a, b in zip([start, *points], points, strict=False)))
    route = among().set_out(Mission(tuple(points), 0.3, "numerical"), at(*start))
    assert route.path == tuple(points) and route.no_way is None and not route.arrived
    length = sum(math.dist(a, b) for a, b in zip([start, *points], points, strict=False))
    assert route.remaining == pytest.approx(length)
    assert route.speed == 0.3


def test_it_is_known_which_way_a_mission_begins_and_ends() -> None:
    pilot = among()
    route = pilot.set_out(Mission(((2.0, 0.0), (2.0, 3.0)), None), at(0.0, 0.0))
    assert (route.begins, route.ends) == (0.0, math.pi / 2)
    later = pilot.plan(route, at(2.0, 0.0))
    assert len(later.path) == 1 and (later.begins, later.ends) == (0.0, math.pi / 2)


def test_a_mission_without_way_points_has_nowhere_to_go() -> None:
    route = among().set_out(Mission(()), at(0.0, 0.0))
    assert route.path == () and route.no_way is None
    assert among().plan(route, at(3.0, 0.0)) == route


def test_following_the_path_drops_its_points_and_ends_arrived() -> None:
    block = Box(3.0, 0.1, 0.0, 1.0, 1.0, 1.0)
    navigator, here = among(block), np.zeros(2)
    route = navigator.set_out(Mission(((6.0, 0.0), (6.0, 2.0))), at(*here))
    assert len(route.path) > 3 and (6.0, 0.0) in route.path
    left = [route.remaining]
    while not route.arrived and len(left) < 2000:
        way = np.array(route.path[0]) - here
        here = here + 0.02 * way / max(np.linalg.norm(way), 0.02)
        route = navigator.plan(route, at(*here))
        left.append(route.remaining)
    assert route.arrived and len(route.path) == 1
    assert math.dist(here, (6.0, 2.0)) <= ARRIVED * UNIT
    # Cutting a corner within PASSED may only shorten what is left.
    assert (np.diff(left) <= 1e-9).all()


@pytest.mark.parametrize("goal", [(6.0, 0.0), (3.7, 0.3), (3.8, -0.3)])
def test_on_its_way_around_a_box_the_feet_keep_clear_of_it(goal) -> None:
    """Corners are dropped before they are reached: what is cut off must stay within the clearance."""
    block = Box(3.0, 0.1, 0.4, 0.6, 1.6, 1.0)
    navigator, here, box = among(block), np.zeros(2), Polygon(block.corners())
    route, nearest = navigator.set_out(Mission((goal,)), at(*here)), math.inf
    assert len(route.path) > 1
    while not route.arrived:
        way = np.array(route.path[0]) - here
        here = here + 0.02 * way / max(np.linalg.norm(way), 0.02)
        route = navigator.plan(route, at(*here))
        nearest = min(nearest, box.distance(Point(here)))
    assert nearest >= np.abs(DOG.nominal_feet[:, 1]).max()


def test_once_arrived_it_stays_arrived_until_it_is_pushed_off_the_goal() -> None:
    navigator = among()
    route = navigator.plan(
        navigator.set_out(Mission(((1.0, 0.0),)), at(0.0, 0.0)), at(1.0, 0.5 * STOP_AT * UNIT)
    )
    assert route.arrived
    assert navigator.plan(route, at(1.0, 0.9 * ARRIVED * UNIT)).arrived
    assert not navigator.plan(route, at(1.0, 1.1 * ARRIVED * UNIT)).arrived


@given(st.floats(0.0, 3.0), st.floats(-math.pi, math.pi))
def test_the_goal_counts_within_its_radius_and_no_farther(away: float, angle: float) -> None:
    assume(abs(away - ARRIVED) > 1e-6 and abs(away - STOP_AT) > 1e-6)
    navigator, mission = among(), Mission(((1.0, 0.0),))
    here = at(1.0 + away * UNIT * math.cos(angle), away * UNIT * math.sin(angle))
    assert navigator.plan(navigator.set_out(mission, at(0.0, 0.0)), here).arrived == (away < STOP_AT)


def test_a_way_point_is_passed_near_enough_and_the_last_one_never() -> None:
    navigator = among()
    route = navigator.set_out(Mission(((1.0, 0.0), (2.0, 0.0))), at(0.0, 0.0))
    assert len(navigator.plan(route, at(1.0 - 1.01 * PASSED * UNIT, 0.0)).path) == 2
    assert navigator.plan(route, at(1.0 - 0.99 * PASSED * UNIT, 0.0)).path == ((2.0, 0.0),)
    assert navigator.plan(route, at(2.0, 0.0)).path == ((1.0, 0.0), (2.0, 0.0)), "the order is kept"


@pytest.mark.parametrize(
    ("goal", "boxes", "sentence"),
    [
        ((20.0, 0.0), (), "(20, 0) lies outside the scene"),
        ((3.0, 0.0), (Box(3.0, 0.0, 0.0, 1.0, 1.0, 1.0),), "on (3, 0) stands an obstacle"),
        ((3.0, 0.6), (Box(3.0, 0.0, 0.0, 1.0, 1.0, 1.0),), "on (3, 0.6) stands an obstacle"),
        ((6.0, 0.0), (Box(3.0, 0.0, 0.0, 0.2, 9.0, 1.0),), "to (6, 0) leads no way"),
    ],
)
def test_where_there_is_no_way_it_says_why(goal, boxes, sentence: str) -> None:
    route = among(*boxes).set_out(Mission(((1.0, 0.0), goal)), at(0.0, 0.0))
    assert (route.no_way, route.path) == (sentence, ())


def test_a_robot_that_was_pushed_aside_goes_on_from_there_and_keeps_clear() -> None:
    """The straight line back to its path would lead through the corner of the block."""
    block = Box(3.0, 0.0, 0.0, 2.0, 2.0, 1.0)
    pilot = among(block)
    route = pilot.set_out(Mission(((6.0, 0.0),)), at(0.0, 0.0))
    side = math.copysign(1.0, route.path[0][1])
    pushed = (1.7, -side * 1.1)
    later = pilot.plan(route, at(*pushed))
    assert later.path != route.path and later.path[-1] == (6.0, 0.0)
    assert Polygon(block.corners()).distance(LineString([pushed, *later.path])) > half_width(DOG) - 1e-5


def test_a_robot_that_is_pushed_where_no_way_leads_from_goes_on_as_well_as_it_can() -> None:
    """Nothing new is known: that there is no way would be a word of its own place alone."""
    pen = [Box(2.0, s * 0.35, 0.0, 1.0, 0.1, 1.0) for s in (1, -1)] + [Box(1.45, 0.0, 0.0, 0.1, 0.8, 1.0)]
    pilot = among(*pen, Box(2.55, 0.0, 0.0, 0.1, 0.8, 1.0))
    route = pilot.set_out(Mission(((6.0, 0.0),)), at(0.0, 2.0))
    later = pilot.plan(route, at(2.0, 0.0))
    assert later.no_way is None and later.path == route.path


def test_known_ground_that_is_arranged_anew_on_the_way_is_planned_anew() -> None:
    before, after = among(), among(Box(3.0, 0.1, 0.0, 0.5, 1.0, 1.0))
    route = before.set_out(Mission(((6.0, 0.0),)), at(0.0, 0.0))
    again, memory = Navigator(DOG).plan(route, at(0.1, 0.0), after.ground, None, before.memory(route))
    assert len(again.path) > 1 and memory.known is after.memory(route).known
    shut = among(Box(3.0, 0.0, 0.0, 0.2, 9.0, 1.0))
    ended, _ = Navigator(DOG).plan(route, at(0.1, 0.0), shut.ground, None, before.memory(route))
    assert (ended.no_way, ended.path) == ("to (6, 0) leads no way", ())
