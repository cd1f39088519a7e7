"""The alarm rings for a stumble under the learned controller, asks for no velocity, and falls silent."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from gaitwright.control.alarm import CALM, LASTS, LONGEST, LOUD, QUIET, RESTS, Alarm, Heard, capture_distance
from gaitwright.control.learned.profile import Profile
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain
from gaitwright.numerics.geometry import heading
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Mission, MotionTarget, Sensed
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from oracles import robot_called

DOG = robot_called("dog")
TROT = replace(fixed_skill(DOG, "trot", None, 0.0, 0.0, "hybrid").skill_call, firm=True)
ALARM = Alarm(DOG)


@cache
def target() -> MotionTarget:
    return desired_cycle(DOG, TROT.gait, TROT.velocity).target(0)


def sensed(place: tuple[float, float], velocity: tuple[float, float], time: float = 0.0) -> Sensed:
    """A robot whose body is at a place, seen from the middle of the feet, at a velocity beyond what is asked
    for; both in heights, the velocity times 1/w0."""
    middle, h, w0 = target().feet_w.mean(axis=0), DOG.height, DOG.natural_frequency
    yaw, (forward, left, _) = heading(target().rotation_wb), target().command
    asked = forward * np.array([math.cos(yaw), math.sin(yaw)]) + left * np.array(
        [-math.sin(yaw), math.cos(yaw)]
    )
    position = np.array([*(middle[:2] + h * np.array(place)), h])
    moved = np.array([*(asked + w0 * h * np.array(velocity)), 0.0])
    still = np.zeros((DOG.n, 3))
    level = np.array([1.0, 0.0, 0.0, 0.0])
    return Sensed(time, position, level, moved, np.zeros(3), still, still, np.zeros(DOG.n))


@pytest.mark.parametrize(
    ("place", "velocity", "wanted"),
    [((0.3, 0.0), (0.0, 0.0), 0.3), ((0.0, 0.0), (0.0, -0.5), 0.5), ((0.3, 0.0), (-0.3, 0.4), 0.4)],
)
def test_the_capture_distance_is_that_of_where_the_body_would_come_to_rest(place, velocity, wanted):
    seen = sensed(place, velocity)
    found = capture_distance(seen.row, target().row, DOG.natural_frequency, DOG.height)
    assert found == pytest.approx(wanted, abs=1e-9)


def heard(distances, was: Heard = QUIET) -> list[Heard]:
    """What it remembers after each tick of some capture distances [heights]."""
    out = []
    for k, distance in enumerate(distances):
        was = ALARM.listen(target(), sensed((distance, 0.0), (0.0, 0.0), k * DT), was)
        out.append(was)
    return out


def test_it_rings_for_what_lasts_and_not_for_what_passes():
    short = round(LASTS / DT) - 1
    assert not any(one.rings for one in heard([*[LOUD + 0.01] * short, 0.1] * 5))
    rings = [one.rings for one in heard([LOUD + 0.01] * (short + 3))]
    assert rings == [False] * (short + 1) + [True, True]


def test_it_falls_silent_after_some_calm_and_not_before():
    loud, between, calm = [LOUD + 0.1] * 10, [0.5 * (LOUD + CALM)] * 500, [CALM - 0.01]
    assert heard([*loud, *between])[-1].rings
    rest = round(RESTS / DT)
    assert heard([*loud, *calm * (rest - 1), LOUD, *calm * (rest - 1)])[-1].rings, "calm in one go"
    assert heard([*loud, *calm * (rest + 1)])[-1] == QUIET


def test_it_does_not_ring_for_ever():
    rings = [one.rings for one in heard([0.5 * (LOUD + CALM) if k > 9 else 2.0 for k in range(2000)])]
    assert sum(rings) * DT == pytest.approx(LONGEST, abs=0.01) and not rings[-1]


def test_while_it_rings_no_velocity_is_asked_for_in_the_same_gait():
    slow = ALARM.calmed(TROT, Heard(True))
    assert (slow.velocity, slow.turn, slow.gait, slow.skill) == ((0.0, 0.0), 0.0, TROT.gait, "trot")
    assert ALARM.calmed(TROT, QUIET) is TROT


# --- in physics ------------------------------------------------------------------------------------
@cache
def profile() -> Profile:
    return taught(DOG, "trot")


def pushed(driver: str, alarmed: bool) -> tuple[list[bool], list[str], float]:
    """A pushed trot: whether it rang at each tick, who drove, and the slowest that was asked for then."""
    scene = load_scene("flat", 3)
    brain = Brain.of(DOG, scene, HeldSkill(replace(TROT, driver="")), DT, watches=False)
    brain = brain.with_profiles({"trot": (profile(),)}, alarmed=alarmed)
    session = Session(brain, MujocoPlant(DOG, scene, DT), Mission((), driver=driver), 3.5, 3)
    session.push(Push(1.5, 90.0, 1.5))
    rings, drivers, slowest = [], [], math.inf
    for lap in session:
        rings.append(session.mind.memories.alarm.rings)
        drivers.append(lap.call.driver)
        if lap.sensed.time > 1.5:
            slowest = min(slowest, float(lap.target.command[0]))
    return rings, drivers, slowest


def test_a_pushed_robot_is_asked_to_stand_still_and_never_handed_back():
    rings, drivers, slowest = pushed("hybrid", True)
    began = rings.index(True)
    assert 1.5 < began * DT < 2.2 and not rings[-1]
    assert {drivers[k] for k in range(began, len(rings)) if rings[k - 1]} == {"learned"}
    assert slowest < 0.5 * TROT.velocity[0]


def test_it_can_be_left_out_and_does_not_listen_to_others():
    rings, _, slowest = pushed("hybrid", False)
    assert not any(rings) and slowest == pytest.approx(TROT.velocity[0], abs=0.01)
    assert not any(pushed("numerical", True)[0])
