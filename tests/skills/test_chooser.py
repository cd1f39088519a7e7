"""The chooser's rules: turn first, then go, no faster than asked, and stand at the end."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.numerics.geometry import wrap, yaw_quaternion
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.chooser import KEEP_TURNING, TURN_FIRST, DefaultChooser, fixed_skill
from gaitwright.skills.library import LIBRARY, MANY_LEGGED, fastest, gait_of, speed_scale
from oracles import robot_called

DOG = robot_called("dog")
CHOOSER = DefaultChooser(DOG)
angles = st.floats(-math.pi, math.pi)
places = st.tuples(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))


def sensed(place=(0.0, 0.0), yaw: float = 0.0) -> Sensed:
    still, joints = np.zeros(3), np.zeros((4, 3))
    return Sensed(
        1.0, np.array([*place, 0.29]), yaw_quaternion(yaw), still, still, joints, joints, np.ones(4)
    )


def route(*path, speed: float | None = None, arrived: bool = False, remaining: float | None = None) -> Route:
    left = math.fsum(math.dist(a, b) for a, b in zip([(0.0, 0.0), *path], path, strict=False))
    return Route(path, left if remaining is None else remaining, speed, arrived)


def off(place, goal, yaw: float) -> float:
    """How far the goal is off the robot's nose, to the left [rad]."""
    return float(wrap(math.atan2(goal[1] - place[1], goal[0] - place[0]) - yaw))


@given(places, places, angles, st.none() | st.floats(0.05, 2.0))
def test_far_off_it_turns_towards_the_path_and_does_not_go(place, goal, yaw: float, speed) -> None:
    assume(math.dist(place, goal) > 0.01)
    error = off(place, goal, yaw)
    assume(abs(abs(error) - TURN_FIRST) > 1e-6)
    call = CHOOSER.choose(route(goal, speed=speed), sensed(place, yaw))
    assert (call.skill == "turn-in-place") == (abs(error) > TURN_FIRST)
    assert call.turn * error >= 0.0, "towards the path"
    if call.skill == "turn-in-place":
        assert call.velocity == (0.0, 0.0) and abs(call.turn) > 0.0


@given(angles)
def test_a_turn_once_begun_goes_on_until_the_path_is_near(error: float) -> None:
    assume(abs(abs(error) - KEEP_TURNING) > 1e-6)
    turning = SkillCall(
        "turn-in-place", gait_of(LIBRARY["turn-in-place"], DOG), (0.0, 0.0), 1.0, "numerical", ""
    )
    call = CHOOSER.choose(route((math.cos(error), math.sin(error))), sensed(), turning)
    assert (call.skill == "turn-in-place") == (abs(error) > KEEP_TURNING)


@given(st.floats(-0.69, 0.69), angles, st.floats(0.05, 2.0), st.floats(0.0, 20.0))
def test_it_goes_forward_no_faster_than_asked_and_slows_down_before_the_goal(error, yaw, speed, left) -> None:
    goal = (5.0 * math.cos(yaw + error), 5.0 * math.sin(yaw + error))
    call = CHOOSER.choose(route(goal, speed=speed, remaining=left), sensed(yaw=yaw))
    assert 0.0 < call.velocity[0] <= speed and call.velocity[1] == 0.0
    nearer = CHOOSER.choose(route(goal, speed=speed, remaining=0.5 * left), sensed(yaw=yaw))
    assert nearer.velocity[0] <= call.velocity[0] * (1 + 1e-12)
    assert (call.velocity[0] < 0.99 * speed * math.cos(error)) <= ("slowing down" in call.because)


def test_at_the_goal_it_stands() -> None:
    for end in (route((1.0, 0.0), arrived=True), route()):
        call = CHOOSER.choose(end, sensed())
        assert (call.skill, call.velocity, call.turn, call.gait.duty) == ("stand", (0.0, 0.0), 0.0, 1.0)


def test_without_a_way_it_stands_and_says_why() -> None:
    call = CHOOSER.choose(Route((), 0.0, None, no_way="on (1, 2) stands an obstacle"), sensed())
    assert (call.skill, call.because) == ("stand", "on (1, 2) stands an obstacle")


@given(places, angles)
def test_a_choice_says_why_and_leaves_the_driver_to_the_mission(place, yaw: float) -> None:
    call = CHOOSER.choose(Route(((3.0, 1.0),), 3.0, None), sensed(place, yaw))
    assert call.because and call.driver == ""
    assert call.gait == gait_of(LIBRARY[call.skill], DOG)


# --- which gait for which speed ------------------------------------------------------------------
ORDER = ("walk", "trot", "run")


def gait_at(speed: float) -> str:
    return CHOOSER.choose(route((100.0, 0.0), speed=speed), sensed()).skill


TOP = fastest(LIBRARY["run"], DOG)


@given(st.floats(0.01, TOP), st.floats(0.01, TOP))
def test_a_faster_wish_never_gets_a_slower_gait_and_each_can_do_it(one: float, two: float) -> None:
    slow, fast = sorted((one, two))
    assert ORDER.index(gait_at(slow)) <= ORDER.index(gait_at(fast))
    assert slow <= fastest(LIBRARY[gait_at(slow)], DOG)


@pytest.mark.parametrize("name", ORDER)
def test_at_the_speed_a_gait_is_meant_for_it_is_chosen(name: str) -> None:
    assert gait_at(LIBRARY[name].speed * speed_scale(DOG)) == name


@pytest.mark.parametrize("share", [1.05, 1.3, 1.5])
def test_a_little_faster_than_a_trot_is_meant_for_is_still_a_trot(share: float) -> None:
    assert gait_at(share * LIBRARY["trot"].speed * speed_scale(DOG)) == "trot"


def test_without_a_wish_it_trots() -> None:
    call = CHOOSER.choose(route((100.0, 0.0)), sensed())
    assert call.skill == "trot"
    assert call.velocity[0] == pytest.approx(LIBRARY["trot"].speed * speed_scale(DOG))


@pytest.mark.parametrize("away", [0.5, 5.0, 500.0])
def test_a_wish_beyond_every_gait_is_refused_however_near_the_goal_is(away: float) -> None:
    with pytest.raises(WrongUse, match="run at 99 m/s is beyond the reach of dog"):
        CHOOSER.choose(route((away, 0.0), speed=99.0), sensed())


@pytest.mark.parametrize("speed", [0.05, 0.1, 0.15, 0.2])
def test_six_legs_walk_and_trot(speed: float) -> None:
    robot = robot_called("hexapod")
    call = DefaultChooser(robot).choose(route((100.0, 0.0), speed=speed), sensed())
    assert call.skill in ("walk", "trot") and len(call.gait.offsets) == 6


# --- one skill, held -----------------------------------------------------------------------------
@given(places, angles)
def test_a_fixed_skill_is_held_whatever_happens(place, yaw: float) -> None:
    fixed = fixed_skill(DOG, "pace", 0.5, 0.1, 0.2, "numerical")
    call = fixed.choose(route((5.0, 5.0)), sensed(place, yaw))
    assert (call.skill, call.velocity, call.turn) == ("pace", (0.5, 0.1), 0.2)
    assert call is fixed.choose(route(arrived=True), sensed())


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_a_fixed_skill_without_a_speed_takes_its_own(name: str) -> None:
    robot = robot_called("hexapod") if name in MANY_LEGGED else DOG
    call = fixed_skill(robot, name, None, 0.0, None, "numerical").skill_call
    speed, way = LIBRARY[name].speed * speed_scale(robot), LIBRARY[name].way
    assert call.velocity == (speed * way[0], speed * way[1])
    assert call.turn == LIBRARY[name].turn / speed_scale(robot)


def test_an_old_name_still_answers() -> None:
    call = fixed_skill(DOG, "turn", None, 0.0, None, "numerical").skill_call
    assert call.skill == "turn-in-place" and call.turn > 0.0


def test_a_fixed_skill_counts_sideways_speed_too() -> None:
    limit = fastest(LIBRARY["trot"], DOG)
    with pytest.raises(WrongUse):
        fixed_skill(DOG, "trot", 0.8 * limit, 0.8 * limit, 0.0, "numerical")


@pytest.mark.parametrize(("gap", "skill"), [(0.1, "trot"), (0.15, "trot"), (0.2, "walk"), (0.25, "walk")])
def test_over_a_wide_gap_it_goes_foot_by_foot_no_faster_than_asked(gap: float, skill: str) -> None:
    scene = load_scene(f"gap:{gap:g}")
    edge = next(x for x in np.arange(0.0, 3.0, 0.01) if scene.height(x, 0.0) < 0.1)
    for place, asked in ((edge - 0.5, skill), (edge + gap / 2.0, skill), (0.0, "trot")):
        onwards = Route(((5.0, 0.0),), 5.0 - place, 0.5)
        call = CHOOSER.choose(onwards, on_blocks(place), ground=map_of(scene, DOG))
        assert call.skill == asked, place
        assert call.velocity[0] <= (0.5 if asked == "trot" else 0.3)
    creeping = Route(((5.0, 0.0),), 5.0, 0.1)
    call = CHOOSER.choose(creeping, on_blocks(edge - 0.5), ground=map_of(scene, DOG))
    assert call.velocity[0] <= 0.1 + 1e-12


def on_blocks(x: float) -> Sensed:
    """At its height over ground of 0.5 m."""
    return replace(sensed(), position_w=np.array([x, 0.0, 0.5 + DOG.height]))
