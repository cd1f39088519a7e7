"""What a route asks for itself: a person's velocity, to stand, or to go on without turning."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.missions import Velocity
from gaitwright.numerics.geometry import wrap, yaw_quaternion
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.chooser import DefaultChooser, fixed_skill
from gaitwright.skills.commanded import Commanded, check_velocity, guarded, skill_for
from gaitwright.skills.foothold_guard import FootholdGuard
from gaitwright.skills.library import LIBRARY, fastest, fastest_turn, gait_of
from oracles import robot_called

GO2 = robot_called("go2")
CHOOSER = Commanded(DefaultChooser(GO2), GO2)
angles = st.floats(-math.pi, math.pi)


def sensed(yaw: float = 0.0) -> Sensed:
    still, joints = np.zeros(3), np.zeros((4, 3))
    place = np.array([0.0, 0.0, GO2.height])
    return Sensed(1.0, place, yaw_quaternion(yaw), still, still, joints, joints, np.ones(4))


def steered(*velocity: float) -> SkillCall:
    return CHOOSER.choose(Route((), 0.0, None, velocity=Velocity(*velocity)), sensed())


def test_what_a_route_does_not_ask_for_is_the_others_choice() -> None:
    for route in (Route(((2.0, 0.0),), 2.0, 0.5), Route((), 0.0, None), Route(((0.0, 2.0),), 2.0, None)):
        assert CHOOSER.choose(route, sensed()) == DefaultChooser(GO2).choose(route, sensed())
    held = fixed_skill(GO2, "pace", 0.5, 0.1, 0.2, "numerical")
    assert Commanded(held, GO2).choose(Route(((2.0, 0.0),), 2.0, 0.5), sensed()) is held.skill_call


@pytest.mark.parametrize(
    ("velocity", "skill"),
    [
        ((0.0, 0.0, 0.0), "stand"),
        ((0.0, 0.0, 0.8), "turn-in-place"),
        ((0.2, 0.0, 0.0), "walk"),
        ((0.2, 0.1, 0.3), "walk"),
        ((0.5, 0.0, -0.5), "trot"),
        ((1.5, 0.0, 0.0), "run"),
        ((-0.3, 0.05, 0.0), "walk-backward"),
        ((0.0, 0.2, 0.0), "walk-sideways"),
        ((0.05, -0.2, 0.1), "walk-sideways"),
    ],
)
def test_a_velocity_gets_the_calmest_skill_that_goes_so(velocity: tuple[float, ...], skill: str) -> None:
    call = steered(*velocity)
    assert call.skill == skill and call.gait == gait_of(LIBRARY[skill], GO2)
    assert (*call.velocity, call.turn) == velocity and call.because == "as a person steers"


@given(angles, st.floats(0.0, 4.0), st.floats(-3.0, 3.0))
def test_whatever_passes_the_check_is_within_the_skills_reach(
    towards: float, speed: float, turn: float
) -> None:
    velocity = Velocity(speed * math.cos(towards), speed * math.sin(towards), turn)
    try:
        check_velocity(GO2, velocity)
    except WrongUse:
        return
    skill = skill_for(GO2, velocity)
    assert math.hypot(*velocity[:2]) <= fastest(skill, GO2) * (1 + 1e-9)
    assert abs(turn) <= fastest_turn(skill, GO2) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("velocity", "sentence"),
    [
        ((9.0, 0.0, 0.0), "run at 9 m/s is beyond the reach of go2"),
        ((-0.5, 0.0, 0.0), "walk-backward at 0.5 m/s is beyond the reach of go2"),
        ((0.0, 0.4, 0.0), "walk-sideways at 0.4 m/s is beyond the reach of go2"),
        ((0.3, 0.0, 9.0), "trot at a yaw rate of 9 rad/s is beyond the reach of go2"),
        ((0.0, 0.0, -9.0), "turn-in-place at a yaw rate of -9 rad/s is beyond"),
        ((math.nan, 0.0, 0.0), "a velocity is finite numbers, not nan, 0, 0"),
        ((0.0, math.inf, 0.0), "a velocity is finite numbers, not 0, inf, 0"),
    ],
)
def test_beyond_its_reach_is_refused_with_the_limit(velocity: tuple[float, ...], sentence: str) -> None:
    with pytest.raises(WrongUse, match=sentence):
        check_velocity(GO2, Velocity(*velocity))


def test_whoever_must_stand_stops_and_says_why_and_keeps_its_memory() -> None:
    now = SkillCall("trot", gait_of(LIBRARY["trot"], GO2), (0.4, 0.0), 0.0, memory={"note": "noted"})
    for said, halt in (({"halt": "a wall"}, "a wall"), ({"pause": "it waits"}, None)):
        call = CHOOSER.choose(Route(((2.0, 0.0),), 2.0, None, **said), sensed(), now)
        assert (call.skill, call.velocity, call.turn, call.gait.duty) == ("stop", (0.0, 0.0), 0.0, 1.0)
        assert call.because == next(iter(said.values())) and call.halt == halt and call.memory == now.memory


@given(angles, angles, angles)
def test_without_room_it_goes_to_the_next_point_as_it_looks(
    yaw: float, towards: float, facing: float
) -> None:
    point = (2.0 * math.cos(towards), 2.0 * math.sin(towards))
    call = CHOOSER.choose(Route((point,), 2.0, None, facing=facing), sensed(yaw))
    forward, left = call.velocity
    assert wrap(math.atan2(left, forward) + yaw - towards) == pytest.approx(0.0, abs=1e-6)
    assert call.turn * wrap(facing - yaw) >= 0.0, "and turns to where it is to look"
    off = abs(wrap(towards - yaw))
    names = (
        {"walk"}
        if off < 1.0
        else {"walk-backward"}
        if off > 2.15
        else {"walk", "walk-sideways", "walk-backward"}
    )
    assert call.skill in names and 0.0 < math.hypot(forward, left) <= LIBRARY["walk"].speed * 1.1


def test_the_nearer_the_slower_and_turning_slower_still() -> None:
    def speed(remaining: float, facing: float) -> float:
        route = Route(((0.0, 1.0),), remaining, None, facing=facing)
        return math.hypot(*CHOOSER.choose(route, sensed()).velocity)

    assert speed(0.05, 0.0) < speed(2.0, 0.0) and speed(2.0, 1.0) < speed(2.0, 0.0)


def test_feet_that_see_are_guarded_and_a_person_may_steer_on() -> None:
    assert isinstance(guarded(DefaultChooser(GO2), GO2), FootholdGuard)
    assert isinstance(guarded(DefaultChooser(GO2), GO2, sees=False), Commanded)
