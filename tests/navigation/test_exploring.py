"""A way through ground that is seen piece by piece."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from gaitwright.description.load import load_robot
from gaitwright.ground.elevation import BLIND
from gaitwright.model.robot import Robot
from gaitwright.navigation.navigator import Navigator
from gaitwright.navigation.piece_rows import FELT, KIND, SUPPOSED
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.travel import Travel
from gaitwright.signals import Blocked, GroundMap, Mission, Route, Sensed, Sight

GO2 = load_robot("go2")
R = half_width(GO2)
BOUNDS = (-5.0, -5.0, 15.0, 5.0)
EMPTY = GroundMap(BOUNDS, (), None, BLIND, GO2.step_limit)


def at(x: float, y: float, robot: Robot = GO2) -> Sensed:
    still, joints = np.zeros(3), np.zeros((robot.n, 3))
    level = np.array([1.0, 0.0, 0.0, 0.0])
    return Sensed(0.0, np.array([x, y, robot.height]), level, still, still, joints, joints, np.ones(robot.n))


def sight(*pieces: tuple[float, float, float, float], eye: tuple[float, float] = (0.0, 0.0)) -> Sight:
    """A look that shows whole edges, and nothing of what is free."""
    return Sight(eye, np.array(pieces).reshape(-1, 4), np.ones((len(pieces), 2), bool), np.empty((0, 2)))


def seeing(*pieces: tuple[float, float, float, float]) -> GroundMap:
    return replace(EMPTY, sight=sight(*pieces))


def clearance(path: list[tuple[float, float]], piece: tuple[float, float, float, float]) -> float:
    """The least distance of a path from a piece, by brute force [m]."""
    ways = [np.linspace(a, b, 400) for a, b in pairwise(path)]
    edge = np.linspace(piece[:2], piece[2:], 400)
    return min(float(np.hypot(*(w[:, None] - edge[None]).transpose(2, 0, 1)).min()) for w in ways)


def begun(goal: tuple[float, float] = (10.0, 0.0)) -> tuple[Navigator, Route, Travel]:
    explorer = Navigator(GO2, noise=0.005)
    return explorer, *explorer.set_out(Mission((goal,), 0.4), at(0.0, 0.0), EMPTY)


def test_what_is_unknown_is_taken_for_free():
    _, route, _ = begun()
    assert route.path == ((10.0, 0.0),) and route.no_way is None and route.speed == 0.4
    assert route.begins == route.ends == 0.0


def test_a_wall_that_is_seen_is_walked_around_at_once():
    explorer, route, memory = begun()
    wall = (3.0, -1.0, 3.0, 2.0)
    route, memory = explorer.plan(route, at(1.0, 0.0), seeing(wall), None, memory)
    path = [(1.0, 0.0), *route.path]
    assert route.path[-1] == (10.0, 0.0) and clearance(path, wall) > R - 0.02
    shortest = math.hypot(2.0, 1.0 + R) + math.hypot(7.0, 1.0 + R)
    assert route.remaining == pytest.approx(shortest, rel=0.02)


def test_a_way_that_nothing_new_comes_near_is_kept():
    explorer, route, memory = begun()
    again, memory = explorer.plan(route, at(1.0, 0.0), seeing((3.0, 2.0, 4.0, 2.0)), None, memory)
    assert again.path is route.path and len(memory.known.pieces) == 1


def test_a_look_is_learned_once_and_memory_is_a_value():
    explorer, route, memory = begun()
    ground = seeing((3.0, -1.0, 3.0, 2.0))
    once, after = explorer.plan(route, at(1.0, 0.0), ground, None, memory)
    twice, same = explorer.plan(route, at(1.0, 0.0), ground, None, memory)
    assert once == twice and len(memory.known.pieces) == 0
    _, later = explorer.plan(once, at(1.1, 0.0), ground, None, after)
    assert later.known is after.known and same.known is not after.known


def test_where_there_is_no_way_it_says_so_and_stays():
    explorer, route, memory = begun()
    ring = block(10.0, 0.0, 1.0)
    route, memory = explorer.plan(route, at(1.0, 0.0), seeing(*ring), None, memory)
    assert route.path == () and route.no_way == "to (10, 0) leads no way"
    assert explorer.plan(route, at(1.0, 0.0), EMPTY, None, memory)[0] is route


def block(x: float, y: float, half: float) -> tuple[tuple[float, float, float, float], ...]:
    """The four edges of a square."""
    x0, x1, y0, y1 = x - half, x + half, y - half, y + half
    return (x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)


def test_a_goal_on_a_thing_that_is_seen_is_said_to_be_there():
    explorer, route, memory = begun()
    route, memory = explorer.plan(route, at(8.0, 0.0), seeing(*block(10.0, 0.0, 0.15)), None, memory)
    assert (route.path, route.no_way) == ((), "on (10, 0) stands an obstacle")


def test_half_a_thing_is_enough_to_say_so():
    explorer, route, memory = begun()
    route, _ = explorer.plan(route, at(8.0, 0.0), seeing((9.9, -0.2, 9.9, 0.2)), None, memory)
    assert route.no_way == "on (10, 0) stands an obstacle"


@pytest.mark.parametrize(
    ("goal", "sentence"),
    [
        ((16.0, 0.0), "(16, 0) lies outside the scene"),
        ((14.9, 0.0), "(14.9, 0) lies too near to the edge of the scene"),
        ((0.0, -4.85), "(0, -4.85) lies too near to the edge of the scene"),
    ],
)
def test_a_goal_at_the_edge_of_the_field_is_said_to_be_there(goal: tuple[float, float], sentence: str):
    route = begun(goal)[1]
    assert (route.path, route.no_way) == ((), sentence)


def test_way_points_are_passed_in_their_order():
    explorer = Navigator(GO2, noise=0.005)
    mission = Mission(((2.0, 0.0), (2.0, 3.0), (6.0, 3.0)))
    route, memory = explorer.set_out(mission, at(0.0, 0.0), EMPTY)
    assert route.path == mission.waypoints
    route, memory = explorer.plan(route, at(2.0, 0.0), EMPTY, None, memory)
    assert memory.left == mission.waypoints[1:]
    wall = (1.0, 1.5, 2.5, 1.5)  # another way has to be found, and still over what is left
    route, memory = explorer.plan(route, at(2.0, 0.2), seeing(wall), None, memory)
    assert (2.0, 3.0) in route.path and route.path[-1] == (6.0, 3.0) and len(route.path) > 2
    assert not route.arrived
    route, memory = explorer.plan(replace(route, path=route.path[-1:]), at(6.0, 3.0), EMPTY, None, memory)
    assert route.arrived


def test_another_mission_goes_on_with_what_is_known():
    explorer, route, memory = begun()
    wall = (3.0, -1.0, 3.0, 2.0)
    _, memory = explorer.plan(route, at(1.0, 0.0), seeing(wall), None, memory)
    route, memory = explorer.set_out(Mission(((8.0, 1.0),)), at(1.0, 0.0), EMPTY, None, memory)
    assert len(route.path) > 1 and clearance([(1.0, 0.0), *route.path], wall) > R - 0.02
    fresh, _ = explorer.set_out(Mission(((8.0, 1.0),)), at(1.0, 0.0), EMPTY)
    assert fresh.path == ((8.0, 1.0),)


# --- where feet cannot go on ---------------------------------------------------------------------------
RIM = ((3.0, -1.0), (3.0, 0.5), (3.4, 2.0))


def stopped(*rim: tuple[float, float], is_seen: bool = True) -> tuple[Route, Travel]:
    """What becomes of a way along x when feet were stopped on it."""
    explorer, route, memory = begun()
    route = replace(route, blocked=Blocked(rim, 0.0, is_seen))
    return explorer.plan(route, at(2.5, 0.0), EMPTY, None, memory)


def test_what_feet_do_not_get_over_is_walked_around_like_a_wall():
    route, memory = stopped(*RIM)
    assert route.blocked is None and route.path[-1] == (10.0, 0.0)
    for (ax, ay), (bx, by) in pairwise(RIM):
        assert clearance([(2.5, 0.0), *route.path], (ax, ay, bx, by)) > R - 0.02
    assert route.path[0][1] < -1.0, "round the nearer end"
    assert len(memory.known.pieces) == 2


def test_it_is_learned_once():
    explorer, route, memory = begun()
    route = replace(route, blocked=Blocked(RIM, 0.0, is_seen=True))
    first, after = explorer.plan(route, at(2.5, 0.0), EMPTY, None, memory)
    _, later = explorer.plan(replace(first, blocked=route.blocked), at(2.5, 0.0), EMPTY, None, after)
    assert later.known is after.known


def test_no_look_takes_it_away_on_this_trip():
    explorer = begun()[0]
    route, memory = stopped(*RIM)
    around = np.array([(2.0, -3.0), (8.0, -3.0), (8.0, 3.0), (2.0, 3.0)])
    through = replace(EMPTY, sight=sight(eye=(2.5, 0.0))._replace(free=around))
    _, later = explorer.plan(route, at(2.5, 0.0), through, None, memory)
    assert len(later.known.pieces) == len(memory.known.pieces) == 2


def test_of_one_place_the_sides_are_supposed_and_shut_no_way():
    route, memory = stopped((3.0, 0.0))
    assert len(route.path) > 1 and route.no_way is None
    kinds = set(memory.known.rows[:, KIND].tolist())
    assert kinds == {FELT, SUPPOSED}


def test_where_nobody_saw_it_nothing_is_sure_and_a_look_may_show_better():
    explorer = begun()[0]
    route, memory = stopped((3.0, 0.0), is_seen=False)
    assert set(memory.known.rows[:, KIND].tolist()) == {SUPPOSED} and len(route.path) > 1
    around = np.array([(2.0, -3.0), (8.0, -3.0), (8.0, 3.0), (2.0, 3.0)])
    through = replace(EMPTY, sight=sight(eye=(2.5, 0.0))._replace(free=around))
    _, later = explorer.plan(route, at(2.5, 0.0), through, None, memory)
    assert len(later.known.pieces) == 0
