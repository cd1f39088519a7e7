"""What is off the taught cycle is coded, answered by the first rule that holds, and left alone once calm."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest

from gaitwright.control.balance import EVERY, LASTS, LONGEST, RESTS, STEADY, Balance, Balanced
from gaitwright.control.balance_file import as_text, load_balance
from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES, Comparator, coded, in_mirror, sentence
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import Profile
from gaitwright.errors import BadFile, WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain, Lap
from gaitwright.numerics.geometry import heading
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Gait, Mission, MotionTarget, Sensed, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from oracles import robot_called

DOG = robot_called("dog")
FLAT = load_scene("flat")
TROT = fixed_skill(DOG, "trot", None, 0.0, 0.0, "learned").skill_call
BANDS = dict.fromkeys(QUANTITIES, 0.1)
STOP = BalanceRule((0, 0, 0, 0, 1, 0), "stop")
RULES = BalanceRules(BANDS, (STOP,))
DRIFTS = (0, 0, 0, 0, 1, 0)


@cache
def profile() -> Profile:
    return taught(DOG, "trot")


def brain(rules: BalanceRules | None) -> Brain:
    plain = Brain.of(DOG, FLAT, HeldSkill(TROT), DT, watches=False)
    return plain.with_profiles({"trot": (profile(),)}).with_balance(rules)


def comparator() -> Comparator:
    learned = brain(None).controllers["learned"]
    assert isinstance(learned, LearnedController)
    return Comparator(DOG, learned)


def laps(seconds: float, rules: BalanceRules | None, push: Push | None = None) -> list[tuple[Lap, Balanced]]:
    """A trot by its profile, and after each lap what balance remembers."""
    session = Session(brain(rules), MujocoPlant(DOG, FLAT, DT), Mission((), driver="learned"), seconds, 3)
    if push:
        session.push(push)
    return [(lap, session.mind.memories.balance) for lap in session]


@cache
def last_lap() -> Lap:
    """One of a steady trot."""
    return laps(2.0, None)[-1][0]


# --- comparing -------------------------------------------------------------------------------------
def test_in_the_taught_cycle_nothing_is_off():
    lap = last_lap()
    off = comparator().off(TROT.gait, lap.target, lap.sensed)
    assert off is not None and np.abs(off).max() < 0.05


@pytest.mark.parametrize(("place", "forward", "left"), [(3, 0.3, 0.0), (4, 0.0, 0.3), (4, 0.0, -0.3)])
def test_a_velocity_beside_the_taught_one_is_off_by_that(place: int, forward: float, left: float):
    lap, compare = last_lap(), comparator()
    yaw = heading(lap.target.rotation_wb)
    more = np.array(
        [forward * np.cos(yaw) - left * np.sin(yaw), forward * np.sin(yaw) + left * np.cos(yaw), 0.0]
    )
    beside = replace(lap.sensed, velocity_w=lap.sensed.velocity_w + more)
    before, after = (compare.off(TROT.gait, lap.target, sensed) for sensed in (lap.sensed, beside))
    assert before is not None and after is not None
    moved = (after - before) * compare.units
    assert moved[place] == pytest.approx(forward + left, abs=0.02)
    assert np.abs(np.delete(moved, place)).max() < 0.02


def test_without_a_profile_nothing_is_compared():
    lap = last_lap()
    walk = fixed_skill(DOG, "walk", None, 0.0, 0.0, "learned").skill_call.gait
    assert comparator().off(walk, lap.target, lap.sensed) is None


def test_what_is_within_its_band_counts_as_nothing():
    assert coded(np.array([0.2, -0.2, 0.1, -0.1, 0.0, 5.0]), np.full(6, 0.15)) == (1, -1, 0, 0, 0, 1)


def test_the_mirror_turns_left_to_right_and_leaves_the_rest():
    assert in_mirror((1, 1, 1, 1, 1, 1)) == (1, -1, 1, 1, -1, -1)
    assert in_mirror(in_mirror((1, -1, 0, 1, -1, 1))) == (1, -1, 0, 1, -1, 1)


def test_a_pattern_reads_as_a_sentence():
    assert sentence((0, -1, 0, 0, 1, 0)) == "it is over to the left and it drifts left"


# --- rules -----------------------------------------------------------------------------------------
def test_a_rule_holds_for_its_pattern_and_the_mirror_image_in_its_skills():
    rule = replace(STOP, skills=("walk",))
    assert rule.holds("walk", DRIFTS) and rule.holds("walk", in_mirror(DRIFTS))
    assert rule.holds("walk", (1, 0, 0, 0, 1, 0)), "what it does not name is indifferent"
    assert not rule.holds("trot", DRIFTS) and not rule.holds("walk", (1, 0, 0, 0, 0, 0))
    anything = BalanceRule((0,) * 6, "stop")
    assert anything.holds("trot", DRIFTS) and not anything.holds("trot", (0,) * 6)


def test_the_first_rule_that_holds_answers_and_a_person_takes_one_out():
    slower = BalanceRule((0,) * 6, "slower")
    rules = BalanceRules(BANDS, (STOP, slower))
    assert rules.answer("trot", DRIFTS) == STOP
    assert rules.without("left+:stop").answer("trot", DRIFTS) == slower
    with pytest.raises(WrongUse, match=r"left\+:stop"):
        rules.without("left-:stop")


def test_a_rule_reads_as_a_sentence():
    told = replace(STOP, skills=("walk",), met=40, saved=9, lost=1).sentence
    assert told.startswith("IF in walk it drifts left (or the mirror image) THEN ask for no velocity")
    assert told.endswith("(of 40 pushed runs saved 9, lost 1)")


def test_what_is_no_rule_is_refused():
    with pytest.raises(WrongUse, match="jump"):
        BalanceRule(DRIFTS, "jump")
    with pytest.raises(WrongUse, match="turn"):
        BalanceRules({"height": 0.1})
    with pytest.raises(WrongUse, match="two rules"):
        BalanceRules(BANDS, (STOP, STOP))


# --- files -----------------------------------------------------------------------------------------
def test_rules_come_back_from_a_file_as_they_were(tmp_path):
    rules = BalanceRules(BANDS, (replace(STOP, met=7, saved=3), BalanceRule((0,) * 6, "quicker", ("walk",))))
    path = tmp_path / "mine.json"
    path.write_text(as_text(rules))
    assert load_balance(path) == rules


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ('{"bands": {}, "rules": []}', "bands are of"),
        (as_text(RULES).replace('"left":1', '"left":2'), "2"),
        (as_text(RULES).replace('"left":1', '"lefft":1'), "lefft"),
        (as_text(RULES).replace("stop", "jump"), "jump"),
        ('{"bands": ', "not JSON"),
    ],
)
def test_a_wrong_file_is_refused_with_what_is_wrong(tmp_path, text: str, what: str):
    path = tmp_path / "mine.json"
    path.write_text(text)
    with pytest.raises(BadFile, match=what):
        load_balance(path)


# --- answering -------------------------------------------------------------------------------------
def remembered(offs: list[float]) -> list[Balanced]:
    """What is remembered after looks at a robot that drifts by so much, in its own unit."""
    lap, out, was = last_lap(), [], STEADY
    known = comparator()
    balance = Balance(Drifting(known.robot, known.learned, iter(offs)), RULES)
    for k in range(len(offs)):
        was = balance.watch(TROT.gait, lap.target, replace(lap.sensed, time=k * EVERY), was)
        out.append(was)
    return out


@dataclass(frozen=True)
class Drifting(Comparator):
    """A comparator that sees what it is told to."""

    offs: Iterator[float]

    def off(self, gait: Gait, target: MotionTarget, sensed: Sensed) -> np.ndarray:
        return np.array([0.0, 0.0, 0.0, 0.0, next(self.offs), 0.0])


LATE, REST = round(LASTS / EVERY), round(RESTS / EVERY)


def test_what_lasts_is_answered_and_what_passes_is_not():
    assert not any(now.pattern for now in remembered([*[1.0] * LATE, 0.0] * 4))
    rules = [now.rule for now in remembered([1.0] * (LATE + 2))]
    assert rules == [None] * LATE + [STOP, STOP]


def test_a_rule_is_followed_until_all_is_calm_for_a_while():
    calm, between = 0.05, 0.08
    follows = [now.rule == STOP for now in remembered([1.0] * (LATE + 1) + [between] * 20 + [calm] * 20)]
    assert sum(follows) == 1 + 20 + REST and not follows[-1]


def test_a_rule_is_not_followed_for_ever():
    follows = [now.rule == STOP for now in remembered([1.0] * (LATE + 1) + [0.08] * 400)]
    assert sum(follows) * EVERY == pytest.approx(LONGEST, abs=2 * EVERY)


def answered(action: str, velocity: tuple[float, float] = (0.5, 0.3)) -> SkillCall:
    balance = Balance(comparator(), RULES)
    return balance.answered(TROT, Balanced(BalanceRule(DRIFTS, action), DRIFTS, velocity=velocity))


def test_each_action_does_what_it_says():
    forward = TROT.velocity[0]
    assert set(Balance(comparator(), RULES).answers) == set(ACTIONS)
    assert answered("stop").velocity == (0.0, 0.0) and answered("stop").gait == TROT.gait
    assert answered("slower").velocity == (0.5 * forward, 0.0)
    assert answered("go-with-it").velocity == pytest.approx((forward + 0.5 * (0.5 - forward), 0.15))
    assert answered("quicker").gait.period == pytest.approx(0.85 * TROT.gait.period)
    assert answered("quicker").velocity == TROT.velocity
    assert answered("trot-on-the-spot").gait == profile().gait
    assert Balance(comparator(), RULES).answered(TROT, STEADY) is TROT


# --- in physics ------------------------------------------------------------------------------------
def test_without_a_push_the_run_is_the_same_to_the_bit():
    anything = BalanceRules(dict.fromkeys(QUANTITIES, 0.3), (BalanceRule((0,) * 6, "stop"),))
    with_rules, without = laps(1.0, anything), laps(1.0, None)
    assert all(
        now == STEADY._replace(looked_at=now.looked_at, velocity=now.velocity) for _, now in with_rules
    )
    assert np.array_equal(with_rules[-1][0].sensed.row, without[-1][0].sensed.row)


def test_a_pushed_robot_is_answered_and_goes_on_afterwards():
    done = laps(4.0, RULES, Push(0.6, 90.0, 1.0))
    follows = [now.rule is not None for _, now in done]
    first = follows.index(True)
    assert 1.0 < done[first][0].sensed.time < 1.4 and not follows[-1]
    commands = np.array([lap.target.command[0] for lap, _ in done])
    assert commands[first:].min() < 0.5 * TROT.velocity[0], "it was asked for less"
    assert commands[-1] == pytest.approx(TROT.velocity[0]) and not done[-1][0].fell
