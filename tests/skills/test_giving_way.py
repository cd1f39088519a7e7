"""A robot slows down for what crosses its way, waits, steps aside from what comes at it, and says so."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.ground.scene import load_scene
from gaitwright.ground.terrain import rectangle
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import Blocked, GroundMap, Moving, Route, Sensed, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from gaitwright.skills.foothold_guard import FootholdGuard
from gaitwright.skills.giving_way import AHEAD, HAIR, ROOM, STOPS, GivesWay
from oracles import robot_called

GO2 = robot_called("go2")
FLAT = map_of(load_scene("flat"), GO2)
ON = Route(((6.0, 0.0),), 6.0, 0.4)
TROT = fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical")
POLITE = GivesWay(FootholdGuard(TROT, GO2), GO2)


def at(x: float = 0.0, y: float = 0.0, yaw: float = 0.0, time: float = 0.0) -> Sensed:
    """The robot standing at a place of level ground."""
    still, joints = np.zeros(3), np.zeros((4, 3))
    turn = np.array(yaw_quaternion(yaw))
    return Sensed(time, np.array([x, y, GO2.height]), turn, still, still, joints, joints, np.zeros(4))


def block(x: float, y: float, velocity: tuple[float, float], time: float = 0.0, side: float = 0.4) -> Moving:
    return Moving(rectangle(x, y, 0.0, side, side), velocity, time)


def among(*moving: Moving, ground: GroundMap = FLAT) -> GroundMap:
    return replace(ground, moving=moving)


def chosen(*moving: Moving, sensed: Sensed | None = None, now: SkillCall | None = None) -> SkillCall:
    return POLITE.choose(ON, sensed or at(), now, among(*moving))


def closest(call: SkillCall, thing: Moving, until: float = AHEAD) -> float:
    """How near a thing comes to the middle of a robot that goes on with a call, for a time [m]."""
    times = np.arange(0.0, AHEAD, 0.02)[:, None]
    robot = np.minimum(times, until) * np.array(call.velocity)
    gaps = [np.abs(thing.edge.mean(axis=0) + times * thing.velocity - robot) - 0.2]
    return float(np.hypot(*np.maximum(gaps[0], 0.0).T).min())


def test_where_nothing_moves_the_choice_is_the_others() -> None:
    call = FootholdGuard(TROT, GO2).choose(ON, at(), None, FLAT)
    assert POLITE.choose(ON, at(), None, FLAT) is call or POLITE.choose(ON, at(), None, FLAT) == call
    assert POLITE.choose(ON, at()) == TROT.skill_call, "and where nothing is known"


@pytest.mark.parametrize(
    "thing",
    [
        block(1.0, 3.0, (0.0, 0.2)),  # goes away
        block(3.0, 2.5, (0.0, -0.3)),  # will have passed, or not yet come
        block(-2.0, 0.0, (-0.4, 0.0)),  # behind, and goes the other way
        block(1.0, 0.0, (0.9, 0.0)),  # ahead, and faster
    ],
)
def test_what_will_not_come_near_changes_nothing(thing: Moving) -> None:
    call = chosen(thing)
    assert call == TROT.skill_call and not call.yields


@pytest.mark.parametrize(("y", "side"), [(0.9, "the left"), (-0.9, "the right")])
def test_what_crosses_is_let_pass(y: float, side: str) -> None:
    thing = block(0.75, y, (0.0, -math.copysign(0.4, y)))
    call = chosen(thing)
    assert call.yields and call.halt is None
    assert 0.0 <= call.velocity[0] < 0.4 and call.velocity[1] == 0.0
    assert call.because.startswith(f"gives way to what comes from {side}: ")
    assert closest(call, thing, STOPS) > closest(TROT.skill_call, thing, STOPS)
    assert closest(call, thing, STOPS) > POLITE.reach + (ROOM - 2.0 * HAIR) * GO2.height


def test_far_away_it_does_not_stop_yet_and_near_it_does() -> None:
    far, near = block(2.3, 1.3, (0.0, -0.5)), block(0.62, 0.6, (0.0, -0.5))
    assert chosen(far).velocity[0] > 0.0
    call = chosen(near)
    assert call.skill in ("stop", "walk-backward") and call.velocity[0] <= 0.0


def test_it_goes_on_once_the_thing_has_passed() -> None:
    waits = chosen(block(0.75, 0.5, (0.0, -0.4)))
    assert waits.yields
    later = chosen(block(0.75, -1.0, (0.0, -0.4)), now=waits)
    assert later == TROT.skill_call


def test_who_gives_way_goes_on_a_little_later_than_who_need_not_begin_to() -> None:
    """Else it would begin and stop again from look to look."""
    waits = chosen(block(0.75, 0.5, (0.0, -0.4)))
    away = np.arange(-0.2, -1.5, -0.02)
    first, then = (
        next(y for y in away if not chosen(block(0.75, y, (0.0, -0.1)), now=now).yields)
        for now in (None, waits)
    )
    assert then < first


def test_what_comes_at_it_is_stepped_out_of_the_way_of() -> None:
    thing = block(1.6, 0.0, (-0.5, 0.0))
    call = chosen(thing)
    assert call.because.startswith("gives way to what comes from ahead: steps")
    assert closest(call, thing) > closest(replace(call, velocity=(0.0, 0.0)), thing)


def test_who_only_stands_steps_aside_too() -> None:
    stands = GivesWay(FootholdGuard(fixed_skill(GO2, "stand", 0.0, 0.0, 0.0, ""), GO2), GO2)
    thing = block(0.0, 1.2, (0.0, -0.5))
    call = stands.choose(Route((), 0.0, None), at(), None, among(thing))
    assert call.yields and "the left: steps" in call.because
    assert (
        stands.choose(Route((), 0.0, None), at(), None, among(block(0.0, 1.2, (0.0, 0.5)))).skill == "stand"
    )


def test_it_does_not_step_into_what_stands_there_nor_out_of_the_field() -> None:
    thing = block(1.4, 0.0, (-0.5, 0.0))
    walls = (rectangle(0.0, 0.5, 0.0, 3.0, 0.2), rectangle(0.0, -0.5, 0.0, 3.0, 0.2))
    call = POLITE.choose(ON, at(), None, among(thing, ground=replace(FLAT, obstacles=walls)))
    assert call.velocity[0] < 0.0 and call.velocity[1] == 0.0, "between walls it can only go back"
    shut = replace(FLAT, obstacles=(*walls, rectangle(-0.6, 0.0, 0.0, 0.2, 3.0)))
    call = POLITE.choose(ON, at(), None, among(thing, ground=shut))
    assert call.skill == "stop" and call.yields
    narrow = replace(FLAT, bounds=(-0.3, -0.3, 8.0, 0.3))
    assert POLITE.choose(ON, at(), None, among(thing, ground=narrow)).skill == "stop"


def test_it_does_not_step_where_no_foot_can_stand() -> None:
    banks = map_of(load_scene("gap:1"), GO2)  # a gap begins at x = 1.2
    thing = block(-0.6, 0.0, (0.5, 0.0))
    before = POLITE.choose(ON, at(0.7, 0.0, math.pi), None, among(thing, ground=banks))
    assert before.velocity[0] >= 0.0, "who looks back has the gap behind it"


def test_a_halt_before_what_moves_is_a_wait_and_one_before_a_wall_stays_one() -> None:
    blocked = Blocked(((0.6, 0.0),), 0.0, is_seen=True)
    call = replace(TROT.skill_call, velocity=(0.0, 0.0), halt="a wall is ahead", blocked=blocked)
    halting = GivesWay(HeldSkill(call), GO2)
    near, far = block(0.9, 0.0, (0.0, 0.3)), block(5.0, 3.0, (0.0, 0.3))
    assert halting.choose(ON, at(), None, among(far)).halt == "a wall is ahead"
    call = halting.choose(ON, at(), None, among(near))
    assert call.halt is None and call.yields and "waits" in call.because
    assert call.blocked is None, "it goes away: nothing for the map"


def test_a_thing_is_where_it_has_come_to_since_it_was_seen() -> None:
    thing = block(0.75, 1.5, (0.0, -0.5), time=0.0)
    now = block(0.75, 0.5, (0.0, -0.5), time=2.0)
    assert chosen(thing, sensed=at(time=2.0)) == chosen(now, sensed=at(time=2.0))


def test_the_side_is_told_as_the_robot_sees_it() -> None:
    """It looks along y; what comes along x comes from its left."""
    thing = block(-0.9, 0.75, (0.4, 0.0))
    call = POLITE.choose(Route(((0.0, 6.0),), 6.0, 0.4), at(yaw=math.pi / 2), None, among(thing))
    assert "from the left" in call.because


def test_room_and_reach_are_of_the_robots_size() -> None:
    large = robot_called("thesis")
    assert GivesWay(TROT, large).reach / GivesWay(TROT, GO2).reach > 4.0
    assert GivesWay(TROT, GO2).reach + ROOM * GO2.height < 0.55
