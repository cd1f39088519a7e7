"""Rules of balance come from what saved runs, are confirmed on others, and are none where nothing helps."""

import numpy as np
import pytest

from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES, in_mirror
from gaitwright.learning.balance_lessons import (
    Lesson,
    bands_of,
    counted,
    is_sure,
    lessons_of,
    rules_from,
)
from gaitwright.learning.balance_trials import SKILLS, Run, Trial, trial
from oracles import robot_called

DRIFTS, LOW = (0, 0, 0, 0, 1, 0), (-1, 0, 0, 0, 0, 0)


def lesson(skill: str, pattern: tuple[int, ...], fell: bool, *saves: str) -> Lesson:
    """A run that these actions alone change."""
    return Lesson(skill, pattern, fell, {action: fell != (action in saves) for action in ACTIONS})


def test_what_saves_is_a_rule_and_reads_for_whom():
    drifting = [lesson("walk", (DRIFTS, in_mirror(DRIFTS))[k // 2 % 2], True, "stop") for k in range(20)]
    others = [lesson(SKILLS[k % 4], LOW, False, "stop") for k in range(40)]
    (rule,) = rules_from([*drifting, *others])
    assert (rule.action, rule.met, rule.saved, rule.lost) == ("stop", 20, 20, 0)
    assert rule.holds("walk", DRIFTS) and not rule.holds("walk", LOW)


def test_what_saves_as_often_as_it_loses_is_no_rule():
    chance = np.random.default_rng(1)
    runs = [lesson(SKILLS[k % 4], DRIFTS, bool(chance.integers(2)), *ACTIONS) for k in range(80)]
    assert rules_from(runs) == []


def test_a_rule_that_the_other_half_does_not_confirm_is_none():
    lucky = [lesson("walk", DRIFTS, True, *(("stop",) if k % 2 == 0 else ())) for k in range(20)]
    assert rules_from(lucky) == [], "every second run found it, and none of the others was saved"


def test_a_second_rule_is_for_what_the_first_is_not_for():
    first = [lesson("walk", DRIFTS, True, "stop") for _ in range(30)]
    second = [lesson("trot", LOW, True, "quicker") for _ in range(20)]
    assert [rule.action for rule in rules_from([*first, *second])] == ["stop", "quicker"]


@pytest.mark.parametrize(
    ("saved", "lost", "sure"), [(5, 0, True), (4, 0, False), (9, 2, True), (9, 3, False)]
)
def test_a_few_runs_prove_nothing(saved: int, lost: int, sure: bool):
    assert is_sure(saved, lost) == sure


def test_counts_are_of_the_runs_that_a_rule_is_for():
    runs = [lesson("walk", DRIFTS, True, "stop"), lesson("walk", DRIFTS, False, "stop"),
            lesson("run", DRIFTS, True, "stop"), lesson("walk", LOW, True, "stop")]  # fmt: skip
    rule = counted(BalanceRule(DRIFTS, "stop", ("walk",)), runs)
    assert (rule.met, rule.saved, rule.lost) == (2, 1, 1)


def test_bands_are_as_wide_as_what_is_off_by_itself_and_a_little_more():
    runs = [Run("walk", False, (), 0, (0.1, 0.2, 0.3, 0.4, 0.5, k), 9) for k in (0.1, 0.6)]
    assert list(bands_of(runs).values()) == pytest.approx([0.11, 0.22, 0.33, 0.44, 0.55, 0.66])


def test_every_action_is_tried_on_the_same_runs_in_which_something_was_off():
    asked: list[Trial] = []

    def make(trials):
        asked.extend(trials)
        return [
            Run("walk", one.rules is None or not one.rules.rules, DRIFTS if one.number != 7 else (), 0, (), 9)
            for one in trials
        ]

    bands = BalanceRules(dict.fromkeys(QUANTITIES, 0.1))
    lessons = lessons_of(robot_called("dog"), {"walk": ()}, bands, range(5, 9), make)
    assert len(lessons) == 3 and all(one.fell and not any(one.fell_with.values()) for one in lessons)
    tried = [(one.number, one.rules.rules[0].action) for one in asked[4:] if one.rules]
    assert tried == [(number, action) for number in (5, 6, 8) for action in ACTIONS]


def test_a_run_has_the_profiles_that_it_needs():
    profiles = {skill: () for skill in SKILLS}
    made = trial(robot_called("dog"), profiles, 6, None)
    assert made.skill == "run" and sorted(made.profiles) == ["run", "trot"]
