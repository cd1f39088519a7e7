"""In a hybrid the learned controller drives where it knows the case, and gives back where it does not."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.law import LAYOUT
from gaitwright.control.numerical import NumericalController
from gaitwright.control.takeover import STAYS_BACK, STRETCH, TAKES_OVER, UNDECIDED, Drive, Takeover
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.trust import GRADES, Grade
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session, record
from gaitwright.signals import Mission, MotionTarget, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from oracles import robot_called

DOG = robot_called("dog")


@cache
def learned() -> LearnedController:
    return LearnedController(DOG, {"trot": (taught(DOG, "trot"),)}, NumericalController(DOG))


@cache
def asked_for(speed: float) -> MotionTarget:
    return desired_cycle(DOG, trot().gait, (speed, 0.0)).target(0)


@cache
def trot(turn: float | None = None) -> SkillCall:
    """A trot at what it is meant for, that a firm rule asks for."""
    return replace(fixed_skill(DOG, "trot", None, 0.0, turn, "hybrid").skill_call, firm=True)


def drives(
    seconds: float,
    call: Callable[[float], SkillCall] = lambda time: trot(),
    speed: Callable[[float], float] = lambda time: trot().velocity[0],
    own: Callable[[float], float] = lambda time: 1.0,
    grade: Grade | None = None,
) -> list[Drive]:
    """Who drives at each tick. `speed`: that is asked for then; `own`: share of the torques that is the
    profile's."""
    grades = {} if grade is None else {"trot": grade}
    takeover, was, out = Takeover(learned(), DT, grades), UNDECIDED, []
    for time in DT * np.arange(round(seconds / DT)):
        played = np.zeros(LAYOUT.size(DOG.n))
        played[-1] = own(float(time))
        was = takeover.decide(
            call(float(time)), trot().gait, asked_for(speed(float(time))), float(time), was, played
        )
        out.append(was)
    return out


def spells(found: list[Drive]) -> list[tuple[str, float]]:
    """Each driver in turn, and for how long [s]."""
    out: list[tuple[str, float]] = []
    for drive in found:
        if out and out[-1][0] == drive.driver:
            out[-1] = drive.driver, out[-1][1] + DT
        else:
            out.append((drive.driver, DT))
    return out


def assert_spells(found: list[Drive], wanted: list[tuple[str, float]]) -> None:
    assert [name for name, _ in spells(found)] == [name for name, _ in wanted]
    np.testing.assert_allclose([t for _, t in spells(found)], [t for _, t in wanted], atol=1.5 * DT)


def test_it_takes_over_once_the_case_was_known_for_a_while():
    found = drives(0.5)
    assert_spells(found, [("numerical", TAKES_OVER), ("learned", 0.4)])
    assert found[0].call == replace(trot(), driver="numerical")
    assert found[-1].call == replace(trot(), driver="learned")
    assert found[-1].call is found[-2].call, "one call, as long as nothing changes"


def test_only_a_firm_rule_is_taken_for_knowing():
    unsure = replace(trot(), firm=False)
    assert_spells(drives(0.5, lambda time: unsure), [("numerical", 0.5)])
    found = drives(1.0, lambda time: unsure if 0.4 <= time < 0.6 else trot())
    assert_spells(found, [("numerical", 0.1), ("learned", 0.3), ("numerical", 0.3), ("learned", 0.3)])


def test_a_command_that_leaves_the_cells_is_handed_back_at_once():
    found = drives(1.0, speed=lambda time: 0.9 if 0.4 <= time < 0.5 else trot().velocity[0])
    assert_spells(found, [("numerical", 0.1), ("learned", 0.3), ("numerical", 0.2), ("learned", 0.4)])


def test_an_obstacle_that_no_operator_is_for_is_not_the_taught_case():
    target = asked_for(trot().velocity[0])
    for number, is_known in ((0.0, True), (1.0, True), (-1.0, False)):
        ahead = replace(target, operator=np.array([0.0, number, 0.0, 0.0]))
        assert learned().covers(trot().gait, ahead) == is_known


def test_a_case_that_comes_and_goes_is_not_known():
    flickering = drives(1.0, speed=lambda time: 0.9 if time % 0.08 < 0.01 else trot().velocity[0])
    assert_spells(flickering, [("numerical", 1.0)])


def test_where_most_torques_are_foreign_for_a_cycle_it_stays_back_for_a_while():
    period = trot().gait.period
    until = -period * np.log(1.0 - 0.4 / 0.9)
    found = drives(5.0, own=lambda time: 0.1 if time < 1.0 else 1.0)
    assert_spells(
        found,
        [("numerical", 0.1), ("learned", until), ("numerical", STAYS_BACK), ("learned", 2.9 - until)],
    )
    assert found[-1].foreign < 0.01
    ((time, skill),) = found[-1].handed_back
    assert skill == "trot" and time == pytest.approx(0.1 + until, abs=2 * DT), "it is remembered"


def test_a_stumble_is_not_handed_back():
    found = drives(2.0, own=lambda time: 0.0 if 1.0 <= time < 1.0 + 0.4 * trot().gait.period else 0.95)
    assert_spells(found, [("numerical", 0.1), ("learned", 1.9)])


def test_who_stays_back_does_so_whatever_is_asked_for_meanwhile():
    """From 1 s on all torques are foreign, and for a moment the case is not known either."""
    found = drives(
        3.5,
        speed=lambda time: 0.9 if 1.5 < time < 1.52 else trot().velocity[0],
        own=lambda time: 0.0 if time >= 1.0 else 1.0,
    )
    back = next(k for k, drive in enumerate(found) if k > 100 and drive.driver == "numerical")
    assert 1.0 < back * DT < 1.3
    assert {drive.driver for drive in found[back : back + round(STAYS_BACK / DT) - 1]} == {"numerical"}


# --- trust -----------------------------------------------------------------------------------------
def test_an_apprentice_watches_an_assistant_drives_in_stretches_and_a_partner_all_the_way():
    assert_spells(drives(1.0, grade="apprentice"), [("numerical", 1.0)])
    turns = [("numerical", TAKES_OVER), *[("learned", STRETCH), ("numerical", STRETCH)] * 2]
    assert_spells(drives(TAKES_OVER + 4 * STRETCH, grade="assistant"), turns)
    assert_spells(drives(3.0, grade="partner"), [("numerical", 0.1), ("learned", 2.9)])


@pytest.mark.parametrize("grade", GRADES)
def test_only_a_skilled_one_drives_by_a_rule_that_is_not_firm_and_none_without_a_rule(grade):
    parted, plain = replace(trot(), firm=False, ruled=True), replace(trot(), firm=False)
    wanted = [("numerical", 0.1), ("learned", 0.4)] if grade == "skilled" else [("numerical", 0.5)]
    assert_spells(drives(0.5, lambda time: parted, grade=grade), wanted)
    assert_spells(drives(0.5, lambda time: plain, grade=grade), [("numerical", 0.5)])
    beyond = drives(0.5, lambda time: parted, speed=lambda time: 0.9, grade=grade)
    assert_spells(beyond, [("numerical", 0.5)])


def test_amid_a_stumble_nobody_changes_and_what_is_asked_for_is_noted():
    driven = drives(0.5)[-1]
    takeover = Takeover(learned(), DT)
    assert takeover.kept(driven.asked, driven) is driven
    unsure = replace(trot(), firm=False, because="not known")
    kept = takeover.kept(unsure, driven)
    assert (kept.driver, kept.asked, kept.call) == ("learned", unsure, replace(unsure, driver="learned"))


# --- in physics ------------------------------------------------------------------------------------
def session_of(call: SkillCall, seconds: float, driver: str = "hybrid") -> Session:
    """A run of a chooser who asks for one thing, in the trot that was taught."""
    scene = load_scene("flat", 3)
    brain = Brain.of(DOG, scene, HeldSkill(replace(call, driver="")), DT, watches=False)
    brain = brain.with_profiles({"trot": learned().profiles["trot"]})
    return Session(brain, MujocoPlant(DOG, scene, DT), Mission((), driver=driver), seconds, 3)


@pytest.mark.parametrize("push", [None, Push(0.4, 90.0, 1.8)])
def test_a_hybrid_goes_over_to_what_was_learned_and_stays_up(push):
    session = session_of(trot(), 3.0)
    if push:
        session.push(push)
    recording = record(session)
    assert not recording.fell and recording.drivers == ("numerical", "learned")
    assert (np.diff(recording["driver"]) >= 0).all(), "it takes over once"
    assert 0.5 < recording.report().driver_share["learned"] < 1.0 - TAKES_OVER / 3.0


def test_what_was_not_taught_is_driven_by_the_teacher():
    for call in (trot(turn=0.5), replace(trot(), firm=False)):
        session = session_of(call, 1.0)
        recording = record(session)
        assert not recording.fell and recording.drivers == ("numerical",)
        assert session.mind.call.driver == "hybrid"


def test_a_robot_that_drives_hybrid_from_now_on_takes_over_after_a_while():
    session, drivers = session_of(trot(), 2.0, "numerical"), []
    for lap in session:
        drivers.append((lap.sensed.time, lap.call.driver))
        if lap.sensed.time >= 1.5 and session.mind.mission.driver == "numerical":
            session.drive("hybrid")
            asked = lap.sensed.time
    taken = next(time for time, driver in drivers if driver == "learned")
    assert taken == pytest.approx(asked + DT + TAKES_OVER, abs=1.5 * DT)
