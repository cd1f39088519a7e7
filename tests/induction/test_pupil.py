"""A pupil finds what its teacher goes by, and is sure of nothing that it has not seen."""

import numpy as np
import pytest
from pupils import School, held_out, nested, taught, three_thresholds

from gaitwright.induction.cases import NOBODY
from gaitwright.induction.decision_list import Lines
from gaitwright.induction.pupil import Lesson, Pupil

SEEDS = (0, 1, 2)


@pytest.mark.parametrize("seed", SEEDS)
def test_three_thresholds_are_found_among_six_columns_of_noise(seed):
    school = taught(three_thresholds, 300, 9, seed)
    share, right, sure = school.score(held_out(9), three_thresholds(held_out(9)))
    assert share >= 0.97
    assert len(school.pupil.lines.rules) <= 5
    assert sure.mean() > 0.5 and (sure & ~right).sum() <= 0.01 * sure.sum()


@pytest.mark.parametrize("seed", SEEDS)
def test_an_exception_to_an_exception_is_found(seed):
    school = taught(nested, 300, 6, seed)
    share, right, sure = school.score(held_out(6), nested(held_out(6)))
    assert share >= 0.97
    assert (sure & ~right).sum() <= 0.01 * sure.sum()


@pytest.mark.parametrize("seed", SEEDS[:2])
def test_a_teacher_who_slips_at_one_lesson_in_twenty_is_understood(seed):
    school = taught(three_thresholds, 400, 9, seed, slips=0.05)
    share, right, sure = school.score(held_out(9), three_thresholds(held_out(9)))
    assert share >= 0.95
    assert len(school.pupil.lines.rules) <= 6
    assert (sure & ~right).sum() <= 0.01 * sure.sum()


def sure_and_wrong(schools: list[School]) -> tuple[int, int]:
    """How many lessons were decided surely while they were taught, and how many of these wrongly."""
    sure = wrong = 0
    for school in schools:
        actions = school.pupil.cases.action.tolist()
        for heard, action in zip(school.heard, actions, strict=True):
            sure += heard.verdict.sure
            wrong += heard.verdict.sure and heard.verdict.action != action
    return sure, wrong


def test_what_is_sure_is_hardly_ever_wrong_while_it_is_learned():
    schools = [taught(three_thresholds, 300, 9, seed) for seed in SEEDS]
    schools += [taught(nested, 300, 6, seed) for seed in SEEDS]
    sure, wrong = sure_and_wrong(schools)
    assert sure > 500 and wrong <= 0.02 * sure


def test_no_case_is_sure_before_three_scenes():
    rng = np.random.default_rng(5)
    x, asked = rng.random((3, 120)), rng.random((3, 500))
    actions = (x[0] > 0.5).astype(int)
    school = School(3).teach(x, actions, scene=np.arange(120) % 2)
    assert not school.pupil.decide_all(asked)[2].any()
    assert not any(heard.verdict.sure for heard in school.heard)
    school.teach(x[:, :60], actions[:60], scene=np.full(60, 2))
    assert school.pupil.decide_all(asked)[2].mean() > 0.5


def test_nothing_beyond_what_was_seen_is_sure():
    school = taught(three_thresholds, 300, 9, 1)
    far = held_out(9)
    far[8] += 5.0
    assert not school.pupil.decide_all(far)[2].any()
    unmeasured = held_out(9)
    unmeasured[8] = np.nan
    assert not school.pupil.decide_all(unmeasured)[2].any()


# --- other minds -----------------------------------------------------------------------------------
def changing(seed: int, before: int, after: int, later) -> School:
    """A teacher who goes by one half of the first column, and later by something else."""
    rng = np.random.default_rng(seed)
    x = rng.random((4, before + after))
    x[0, 0] = 0.2  # the first action is that of the lower half
    actions = np.append(x[0, :before] > 0.5, later(x[:, before:])).astype(int)
    return School(4, seed).teach(x, actions)


def moved(x: np.ndarray) -> np.ndarray:
    return (x[0] > 0.7).astype(int)


def turned(x: np.ndarray) -> np.ndarray:
    return (x[0] <= 0.5).astype(int)


@pytest.mark.parametrize("seed", SEEDS[:2])
@pytest.mark.parametrize("later", [moved, turned])
def test_a_change_of_mind_is_followed_in_the_end(later, seed):
    school = changing(seed, 40, 260, later)
    assert school.score(held_out(4), later(held_out(4)))[0] >= 0.95


def test_a_mind_turned_round_is_followed_after_twice_as_many_lessons_as_before():
    shares = [changing(seed, 50, 100, turned).score(held_out(4), turned(held_out(4)))[0] for seed in (0, 1)]
    assert np.mean(shares) >= 0.9


def test_a_slip_is_soon_forgotten():
    rng = np.random.default_rng(3)
    x = rng.random((4, 160))
    actions = (x[0] > 0.5).astype(int)
    slip = 100
    x[:, slip], actions[slip] = (0.75, 0.5, 0.5, 0.5), 0
    x[0, 0], actions[0] = 0.1, 0
    school = School(4).teach(x, actions)
    assert school.score(held_out(4), (held_out(4)[0] > 0.5).astype(int))[0] >= 0.97
    assert school.heard[-1].aside == (slip,)
    assert school.heard[slip].verdict.sure and not school.heard[slip].how
    weight = school.pupil.cases.weight
    assert (np.delete(weight, slip) > 0.99).all()


# --- what the teacher names ------------------------------------------------------------------------
@pytest.mark.parametrize("reason", [0, 1])
def test_of_two_columns_that_say_the_same_the_named_one_is_bounded(reason):
    rng = np.random.default_rng(6)
    x = rng.random((2, 60))
    x[1] = x[0]
    school = School(2)
    for k in range(60):
        action = int(x[0, k] > 0.5)
        place = school.names.setdefault(action, len(school.names))
        school.pupil.hear(Lesson(x[:, k].copy(), place, reason, k))
    bounded = {bound.column for rule in school.pupil.lines.rules for bound in rule.bounds}
    assert bounded == {reason}


# --- small and odd schools -------------------------------------------------------------------------
def test_before_the_first_lesson_nothing_is_decided():
    pupil: Pupil = School(3).pupil
    verdict = pupil.decide(np.zeros(3))
    assert (verdict.action, verdict.sure) == (NOBODY, False)
    assert pupil.lines == Lines()


def test_one_lesson_is_what_is_done_everywhere():
    school = School(3).teach(np.zeros((3, 1)), np.array([5]))
    assert (school.pupil.decide_all(np.random.default_rng(0).random((3, 50)))[0] == 0).all()
    assert not school.pupil.decide(np.zeros(3)).sure


def test_a_second_action_is_told_apart_by_what_differs():
    x = np.array([[0.0] * 8 + [1.0] * 8, [3.0] * 16])
    school = School(2).teach(x, np.array([0] * 8 + [1] * 8))
    assert (school.pupil.decide_all(x)[0] == [0] * 8 + [1] * 8).all()
    assert {bound.column for rule in school.pupil.lines.rules for bound in rule.bounds} == {0}


def test_only_one_action_needs_no_rule():
    school = School(3).teach(np.random.default_rng(0).random((3, 40)), np.zeros(40, int))
    assert school.pupil.lines == Lines((), 0)
    assert school.pupil.decide(np.full(3, 0.5)).sure


def test_what_the_list_says_is_not_set_aside():
    school = School(3).teach(np.random.default_rng(0).random((3, 10)), np.zeros(10, int))
    assert school.heard[-1].aside == ()


def test_of_the_same_case_taught_both_ways_the_more_frequent_one_stays():
    actions = np.array([0, 1, 1] * 20)
    school = School(2).teach(np.ones((2, 60)), actions)
    assert len(school.pupil.lines.rules) == 0
    assert school.pupil.lines.otherwise == school.names[1]
    assert len(school.heard[-1].aside) == 20
    assert not school.pupil.decide(np.ones(2)).sure


@pytest.mark.parametrize("value", [0.0, np.nan])
def test_columns_that_never_change_are_never_bounded(value):
    rng = np.random.default_rng(2)
    x = np.vstack([np.full((3, 80), value), rng.random((1, 80))])
    school = School(4).teach(x, (x[3] > 0.4).astype(int))
    rules = school.pupil.lines.rules
    assert {bound.column for rule in rules for bound in rule.bounds} == {3}


def test_one_column_is_enough():
    x = np.random.default_rng(2).random((1, 120))
    between = ((x[0] > 0.3) & (x[0] < 0.7)).astype(int)
    school = School(1).teach(x, between)
    asked = held_out(1)
    assert school.score(asked, ((asked[0] > 0.3) & (asked[0] < 0.7)).astype(int))[0] >= 0.95


def test_nothing_measured_at_all_is_borne():
    school = School(2).teach(np.full((2, 30), np.nan), np.arange(30) % 3)
    assert len(school.pupil.lines.rules) == 0
