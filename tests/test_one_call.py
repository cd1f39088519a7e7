"""Gait and law in one compiled call are the two of them, to the bit, whoever drives and whatever happens."""

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from gaitwright.control.learned.profile import Profile
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.led import Led
from gaitwright.ground.scene import load_scene
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain, Lap
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Gait, Mission, MotionTarget, Route, Sensed, SkillCall
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

DOG = robot_called("dog")
SECONDS, TURNS_AT, PUSHED_AT = 2.4, 1.2, 0.8


@cache
def profile() -> Profile:
    return taught(DOG, "trot")


@cache
def trot(turn: float | None = None) -> SkillCall:
    return replace(fixed_skill(DOG, "trot", None, 0.0, turn, "").skill_call, firm=True)


class Turns:
    """Asks for a trot, and from some time on for one that turns, which nobody taught."""

    def choose(self, route: Route, sensed: Sensed, now=None, ground=None) -> SkillCall:
        return trot() if sensed.time < TURNS_AT else trot(0.6)


def session(driver: str, at_once: bool, scene: str = "flat", watches: bool = True) -> Session:
    ground = load_scene(scene, 3)
    brain = Brain.of(DOG, ground, Turns(), DT, watches=watches).with_profiles({"trot": (profile(),)})
    if not at_once:
        vars(brain.driving)["one_call"] = None
    run = Session(brain, MujocoPlant(DOG, ground, DT), Mission((), driver=driver), SECONDS, 3)
    run.push(Push(0.5, 90.0, PUSHED_AT))
    return run


def numbers_of(lap: Lap, run: Session) -> list[np.ndarray]:
    """All that a tick comes to."""
    memories, where = run.mind.memories, MotionTarget.layout.slices(DOG.n)
    target = np.delete(lap.target.row, np.arange(where["q"].start, where["q"].stop))
    played = memories.control
    return [lap.sensed.row, target, lap.target.q, lap.command.row, memories.gait.row, played]


@pytest.mark.parametrize(
    ("driver", "scene"), [("learned", "flat"), ("learned", "rough:0.02"), ("hybrid", "flat")]
)
def test_one_call_is_the_two_calls_to_the_bit(driver: str, scene: str) -> None:
    one, two = session(driver, True, scene), session(driver, False, scene)
    drivers = []
    for lap, other in zip(one, two, strict=True):
        for ours, theirs in zip(numbers_of(lap, one), numbers_of(other, two), strict=True):
            np.testing.assert_array_equal(ours, theirs)
        assert (lap.call, lap.command.status) == (other.call, other.command.status)
        assert one.mind.memories.drive == two.mind.memories.drive
        drivers.append((type(lap.target) is Led, lap.call.driver))
        assert type(other.target) is MotionTarget
    assert not lap.fell and (True, "learned") in drivers, "the one call was never made"
    if driver == "hybrid":
        changes = [b for a, b in pairwise(drivers) if a != b]
        assert changes == [(False, "learned"), (True, "learned"), (False, "numerical")], (
            "it takes over, and gives back in the turn"
        )


def test_where_nothing_was_taught_of_a_gait_the_teacher_drives() -> None:
    ground = load_scene("flat", 3)
    brain = Brain.of(DOG, ground, fixed_skill(DOG, "walk", None, 0.0, None, "learned"), DT)
    run = Session(
        brain.with_profiles({"trot": (profile(),)}), MujocoPlant(DOG, ground, DT), Mission(()), 0.1, 3
    )
    assert {type(lap.target) for lap in run} == {MotionTarget}


def test_another_coordinator_or_controller_is_asked_itself() -> None:
    brain = Brain.of(DOG, load_scene("flat"), dt=DT)
    assert brain.driving.one_call is None
    brain = brain.with_profiles({"trot": (profile(),)})
    assert brain.driving.one_call is not None

    class Other(Coordinator):
        """Might move the legs in its own way."""

    other = replace(brain, coordinator=Other(DOG, DT))
    assert other.driving.one_call is None
    slower = replace(brain, coordinator=replace(brain.coordinator, dt=2 * DT))
    assert slower.driving.one_call.coordinator is slower.coordinator


def test_gaits_of_one_name_are_told_apart_when_they_are_looked_up() -> None:
    gait = trot().gait
    slower = replace(gait, period=1.1 * gait.period)
    known = {gait: 1, slower: 2}
    assert known[Gait(*(getattr(gait, name) for name in ("name", "period", "duty", "offsets")))] == 1
    assert known[replace(slower)] == 2 and len(known) == 2
