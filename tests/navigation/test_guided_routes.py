"""A programme is gone as it is written, a person's commands as they come, unless something is in the way."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.description.load import load_robot
from gaitwright.errors import WrongUse
from gaitwright.ground.elevation import BLIND
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.missions import Programme, Steering, Stop, Velocity
from gaitwright.navigation.navigator import Navigator
from gaitwright.navigation.reached import ARRIVED, PASSED
from gaitwright.navigation.travel import Travel
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import GroundMap, Mission, Route, Sensed, Sight

GO2 = load_robot("go2")
UNIT = GO2.body_length
BOUNDS = (-5.0, -5.0, 10.0, 5.0)
OPEN = GroundMap(BOUNDS, (), None, BLIND, GO2.step_limit)
KNOWN, SEEING = Navigator(GO2), Navigator(GO2, noise=0.005)
STOPS = Programme((Stop(2.0, 0.0, 0.3), Stop(2.0, 2.0, None, 1.5), Stop(0.0, 2.0, 0.5)))


def at(x: float, y: float, time: float = 0.0, yaw: float = 0.0) -> Sensed:
    still, joints = np.zeros(3), np.zeros((4, 3))
    place = np.array([x, y, GO2.height])
    return Sensed(time, place, yaw_quaternion(yaw), still, still, joints, joints, np.ones(4))


def among(*boxes: Box) -> GroundMap:
    return map_of(Scene("test", Flat(), boxes, BOUNDS), GO2)


def seeing(*pieces: tuple[float, float, float, float]) -> GroundMap:
    edges = np.array(pieces).reshape(-1, 4)
    return replace(OPEN, sight=Sight((0.0, 0.0), edges, np.ones((len(edges), 2), bool), np.empty((0, 2))))


def programmed(programme: Programme, ground: GroundMap = OPEN, navigator: Navigator = KNOWN):
    return navigator.set_out(Mission((), 0.4, guidance=programme), at(0.0, 0.0), ground)


def gone(route: Route, memory: Travel, *moments: tuple[float, float, float, float]) -> list[Route]:
    """The routes at places (x, y, time, yaw)."""
    routes = []
    for x, y, time, yaw in moments:
        route, memory = KNOWN.plan(route, at(x, y, time, yaw), OPEN, None, memory)
        routes.append(route)
    return routes


# --- programmes -------------------------------------------------------------------------------------
def test_a_programme_leads_from_stop_to_stop_up_to_where_it_stands() -> None:
    route, _ = programmed(STOPS)
    assert route.path == ((2.0, 0.0), (2.0, 2.0)) and route.remaining == 4.0
    assert (route.speed, route.begins, route.ends) == (0.3, 0.0, math.pi), "0.3 m/s on the way to the first"


def test_stops_are_reached_in_their_order_with_their_speeds_and_waits() -> None:
    route, memory = programmed(STOPS)
    close = 0.5 * ARRIVED * UNIT
    on, passed, standing, still, going, there = gone(
        route,
        memory,
        (1.0, 0.3, 3.0, 0.0),
        (2.0 - close, 0.0, 6.0, 0.0),
        (2.0, 2.0 - 0.01, 10.0, 1.6),
        (2.0, 2.0, 11.4, 1.6),
        (2.0, 2.0, 11.5, 1.6),
        (0.01, 2.0, 16.0, math.pi),
    )
    assert on.path == route.path and on.speed == 0.3, "off its line it goes straight to the stop"
    assert passed.path == ((2.0, 2.0),) and passed.speed == 0.4 and passed.pause is None
    assert standing.pause == "it waits 1.5 s at (2, 2)" and still == standing
    assert going.path == ((0.0, 2.0),) and going.pause is None and going.speed == 0.5
    assert there.arrived and not going.arrived


def test_a_stop_that_was_walked_past_nearby_is_left_behind_and_one_far_aside_is_not() -> None:
    for off, left in ((0.5, 1), (1.5, 2)):
        route, memory = programmed(Programme((Stop(2.0, 0.0), Stop(4.0, 0.0))))
        (later,) = gone(route, memory, (2.0 + 0.02, off * PASSED * UNIT, 5.0, 0.0))
        assert len(later.path) == left
    route, memory = programmed(Programme((Stop(2.0, 0.0), Stop(4.0, 0.0))))
    (before,) = gone(route, memory, (2.0 - 0.1, 0.5 * PASSED * UNIT, 5.0, 0.0))
    assert len(before.path) == 2, "it lies ahead still"


def test_the_last_stop_may_be_waited_at_and_then_it_has_arrived() -> None:
    route, memory = programmed(Programme((Stop(1.0, 0.0, wait=2.0),)))
    waits, done = gone(route, memory, (1.0, 0.0, 4.0, 0.0), (1.0, 0.0, 6.0, 0.0))
    assert waits.pause and not waits.arrived and done.pause is None and done.arrived


@pytest.mark.parametrize(
    ("stops", "sentence"),
    [
        ((Stop(2.0, 0.0), Stop(20.0, 0.0)), "(20, 0) lies outside the scene"),
        (
            (Stop(0.0, 3.0), Stop(6.0, 3.0), Stop(6.0, -3.0)),
            "straight from (6, 3) to (6, -3) stands an obstacle",
        ),
        ((Stop(6.0, 0.5),), "straight from here to (6, 0.5) stands an obstacle"),
    ],
)
def test_a_leg_through_what_is_known_is_told_before_a_step_is_made(stops, sentence: str) -> None:
    route, _ = programmed(Programme(stops), among(Box(6.0, 0.0, 0.0, 1.0, 1.0, 1.0)))
    assert (route.no_way, route.path) == (sentence, ())


def test_nothing_is_planned_around_and_what_is_passed_by_is_passed() -> None:
    beside = among(Box(3.0, 0.9, 0.0, 1.0, 1.0, 1.0))
    route, _ = programmed(Programme((Stop(6.0, 0.0),)), beside)
    assert route.path == ((6.0, 0.0),) and route.no_way is None


def test_what_is_seen_in_the_way_is_walked_up_to_and_no_farther() -> None:
    wall = (3.0, -1.0, 3.0, 1.0)
    route, memory = programmed(Programme((Stop(6.0, 0.0),)), seeing(wall), SEEING)
    assert route.path == ((6.0, 0.0),) and route.no_way is None and route.halt is None
    far, memory = SEEING.plan(route, at(1.0, 0.0), seeing(wall), None, memory)
    assert far.halt is None
    near, memory = SEEING.plan(far, at(2.2, 0.0), seeing(wall), None, memory)
    assert near.halt == "something stands in the way to (6, 0), 0.6 m ahead"
    assert SEEING.plan(near, at(2.3, 0.0), OPEN, None, memory)[0] is near, "it stays so"


def test_the_same_mission_again_goes_on_and_another_begins_anew() -> None:
    """As where the world was arranged anew."""
    mission = Mission((), 0.4, guidance=STOPS)
    route, memory = KNOWN.set_out(mission, at(0.0, 0.0), OPEN)
    route, memory = KNOWN.plan(route, at(2.0, 0.0, 6.0), OPEN, None, memory)
    again, _ = KNOWN.set_out(mission, at(2.0, 0.1, 6.1), among(), None, memory)
    assert again.path == ((2.0, 2.0),)
    anew, _ = KNOWN.set_out(replace(mission), at(2.0, 0.1, 6.1), among(), None, memory)
    assert anew.path == ((2.0, 0.0), (2.0, 2.0))
    own = Mission(((1.0, 0.0), (2.0, 0.0)))
    route, memory = KNOWN.set_out(own, at(0.0, 0.0), OPEN)
    route, memory = KNOWN.plan(route, at(1.0, 0.0), OPEN, None, memory)
    assert KNOWN.set_out(own, at(1.1, 0.0), among(), None, memory)[0].path == ((2.0, 0.0),)


# --- commands ---------------------------------------------------------------------------------------
def steered(
    velocity: Velocity, ground: GroundMap = OPEN, pose=(0.0, 0.0, 0.0), ends: float | None = None
) -> Route:
    mission = Mission((), guidance=Steering((0.0,), (velocity,), ends))
    x, y, yaw = pose
    return KNOWN.set_out(mission, at(x, y, 0.0, yaw), ground)[0]


@given(st.floats(-0.3, 0.5), st.floats(-0.2, 0.2), st.floats(-1.0, 1.0))
def test_in_the_open_a_robot_goes_as_it_is_told(forward: float, left: float, turn: float) -> None:
    velocity = Velocity(forward, left, turn)
    route = steered(velocity)
    assert route.velocity == velocity and route.pause is None and route.halt is None and not route.path


def test_a_script_goes_by_the_time_since_it_was_given() -> None:
    script = Steering((1.0, 2.0), (Velocity(0.3), Velocity(0.0, 0.0, 0.5)), ends=3.0)
    route, memory = KNOWN.set_out(Mission((), guidance=script), at(0.0, 0.0, 7.0), OPEN)
    asked = [route.velocity]
    for time in (7.9, 8.0, 8.9, 9.0, 9.9, 10.0, 50.0):
        route, memory = KNOWN.plan(route, at(0.0, 0.0, time), OPEN, None, memory)
        asked.append(route.velocity)
    stand, walk, turn = Velocity(0.0), Velocity(0.3), Velocity(0.0, 0.0, 0.5)
    assert asked == [stand, stand, walk, walk, turn, turn, stand, stand]


@pytest.mark.parametrize(
    ("velocity", "box", "sentence"),
    [
        (Velocity(0.4), Box(0.8, 0.0, 0.0, 0.6, 2.0, 1.0), "something stands ahead: there is room for"),
        (Velocity(-0.3), Box(-0.82, 0.0, 0.0, 0.6, 2.0, 1.0), "something stands behind: there is room for"),
        (Velocity(0.0, 0.2), Box(0.0, 0.4, 0.0, 2.0, 0.3, 1.0), "something stands to the left"),
        (Velocity(0.0, -0.2), Box(0.0, -0.4, 0.0, 2.0, 0.3, 1.0), "something stands to the right"),
        (
            Velocity(0.0, 0.0, 0.8),
            Box(0.0, -0.35, 0.0, 2.0, 0.3, 1.0),
            "there is no room to turn to the left",
        ),
        (
            Velocity(0.0, 0.0, -0.8),
            Box(0.0, -0.35, 0.0, 2.0, 0.3, 1.0),
            "there is no room to turn to the right",
        ),
    ],
)
def test_where_there_is_no_room_it_stands_and_says_why(velocity: Velocity, box: Box, sentence: str) -> None:
    live, scripted = steered(velocity, among(box)), steered(velocity, among(box), ends=9.0)
    assert live.velocity == Velocity(0.0) and live.pause is not None and live.pause.startswith(sentence)
    assert live.halt is None and live.attended, "the person may give another command"
    assert scripted.halt is not None and scripted.halt.startswith(sentence) and not scripted.attended
    away = Velocity(-velocity.forward, -velocity.left)
    assert steered(away, among(box)).pause is None, "from there it may go away"


def test_at_the_edge_of_the_scene_it_stands() -> None:
    assert steered(Velocity(0.4), pose=(9.9, 0.0, 0.0)).pause == "the scene ends ahead"
    assert steered(Velocity(0.0, 0.2), pose=(0.0, 4.97, 0.0)).pause == "the scene ends to the left"
    assert steered(Velocity(0.4), pose=(9.9, 0.0, math.pi)).pause is None


def test_the_faster_the_farther_it_looks() -> None:
    box = among(Box(2.0, 0.0, 0.0, 0.6, 2.0, 1.0))
    assert steered(Velocity(0.4), box).pause is None
    assert steered(Velocity(1.5), box).pause is not None


def test_whoever_is_steered_learns_the_ground_all_the_same() -> None:
    mission = Mission((), guidance=Steering((0.0,), (Velocity(0.0),)))
    route, memory = SEEING.set_out(mission, at(0.0, 0.0), OPEN)
    route, memory = SEEING.plan(route, at(0.0, 0.0, 0.1), seeing((3.0, -1.0, 3.0, 1.0)), None, memory)
    assert len(memory.known.pieces) == 1
    route, memory = SEEING.set_out(Mission(((6.0, 0.0),)), at(0.0, 0.0, 1.0), OPEN, None, memory)
    assert len(route.path) > 1, "its own way then leads around it"


def test_a_mission_has_one_who_finds_the_way() -> None:
    with pytest.raises(WrongUse, match="a mission has way-points, a programme or somebody who steers"):
        Mission(((1.0, 0.0),), guidance=STOPS)
