"""Until when an action goes on: learned from hysteresis alone, and never against a case in which it ended."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.induction.cases import Cases, no_cases, table_of
from gaitwright.induction.decision_list import Bound
from gaitwright.induction.going_on import BAND, ENDINGS, only_goes_on, until_of

STAY, GO = 0, 1
KNOWN = ((0.5,), ())
BEGINS, ENDS = 0.4, 0.6


def table(x, action, reason=None) -> Cases:
    """Cases of two columns, each of a fact of its own."""
    reads = np.eye(2, dtype=bool)
    reasons = np.full(len(action), -1) if reason is None else np.asarray(reason)
    return table_of(np.asarray(x), np.asarray(action), reasons, 2, no_cases(reads, np.zeros(2)))


def driven(n: int, seed: int, side: float = 1.0):
    """Somebody who goes below 0.4 and stays gone until 0.6; the second column says nothing."""
    rng, x, in_use, action = np.random.default_rng(seed), rng_row(n, seed), [], []
    going = False
    for grip in x[:, 0]:
        in_use.append(going)
        going = grip < (ENDS if going else BEGINS)
        action.append(GO if going else STAY)
    scene = rng.integers(0, 4, n)
    return table(side * x, action), scene, np.array(in_use)


def rng_row(n: int, seed: int):
    return np.random.default_rng(seed + 1000).uniform(0.0, 1.0, (n, 2))


def learned(cases, scene, in_use, columns=(0, 1), said=None):
    return until_of(
        GO, cases, scene, in_use, np.zeros(cases.n, dtype=bool) if said is None else said, columns, KNOWN
    )


@given(st.integers(0, 10_000), st.sampled_from([1.0, -1.0]))
def test_hysteresis_is_found_between_where_it_went_on_and_where_it_ended(seed, side):
    cases, scene, in_use = driven(300, seed, side)
    bound = learned(cases, scene, in_use)
    assert bound is not None and bound.column == 0
    end = bound.high if side > 0 else -bound.low
    x = side * cases.x[0]
    went_on, ended = x[in_use & (cases.action == GO)], x[in_use & (cases.action == STAY)]
    assert went_on.max() < end <= ended.min()
    assert abs(end - ENDS) < 0.1


def test_what_an_end_says_is_what_nobody_would_begin():
    cases, scene, in_use = driven(300, 1)
    said = only_goes_on(learned(cases, scene, in_use), GO, cases, in_use)
    x, begun = cases.x[0], cases.x[0][~in_use & (cases.action == GO)].max()
    assert said.sum() > BAND
    assert np.array_equal(said, in_use & (cases.action == GO) & (x > begun) & (x < ENDS))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_one_end_elsewhere_forbids_it(side):
    """Where the teacher once broke off in the middle, going on there is not safe."""
    cases, scene, in_use = driven(300, 2, side)
    middle = side * 0.45
    x = np.vstack([cases.x.T, [middle, 0.5]])
    broken = table(x, [*cases.action.tolist(), STAY])
    assert learned(broken, np.append(scene, 0), np.append(in_use, True)) is None


def test_no_end_without_hysteresis():
    """What begins and ends at one bound is for the list to say."""
    rng = np.random.default_rng(3)
    x = rng.uniform(0.0, 1.0, (300, 2))
    action = np.where(x[:, 0] < 0.4, GO, STAY)
    in_use = np.append(False, action[:-1] == GO)
    assert learned(table(x, action), rng.integers(0, 4, 300), in_use) is None


def test_few_cases_and_one_scene_prove_nothing():
    cases, scene, in_use = driven(300, 4)
    assert learned(cases, np.zeros_like(scene), in_use) is None
    ended = np.flatnonzero(in_use & (cases.action == STAY))
    left = np.ones(300, dtype=bool)
    left[ended[ENDINGS - 1 :]] = False
    few = table(cases.x.T[left], cases.action[left])
    assert learned(few, scene[left], in_use[left]) is None
    nobody = np.zeros(300, dtype=bool)
    assert learned(cases, scene, nobody) is None


def test_the_number_that_was_named_comes_first():
    cases, scene, in_use = driven(300, 5)
    both = np.repeat(cases.x[:1].T, 2, axis=1)
    unnamed = learned(table(both, cases.action), scene, in_use)
    named = learned(table(both, cases.action, np.where(cases.action == GO, 1, -1)), scene, in_use)
    assert (unnamed.column, named.column) == (0, 1)
    assert named.high == pytest.approx(unnamed.high, abs=0.05)


def test_what_was_not_measured_says_nothing():
    cases, scene, in_use = driven(300, 6)
    x = cases.x.T.copy()
    x[np.flatnonzero(in_use)[0], 0] = np.nan
    assert learned(table(x, cases.action), scene, in_use) is None


def test_columns_that_may_not_be_asked_for_are_not():
    assert learned(*driven(300, 7), columns=(1,)) is None
    assert isinstance(learned(*driven(300, 7), columns=(0,)), Bound)


def test_the_partner_of_hysteresis_is_no_reason_for_another_end():
    """Who trots until 0.4 and not from 0.6 on has the same band: one end says it, not two."""
    cases, scene, in_use = driven(300, 8)
    resting = np.append(False, cases.action[:-1] == STAY)
    nobody = np.zeros(300, dtype=bool)
    assert until_of(STAY, cases, scene, resting, nobody, (0, 1), KNOWN) is not None
    said = only_goes_on(learned(cases, scene, in_use), GO, cases, in_use)
    assert until_of(STAY, cases, scene, resting, said, (0, 1), KNOWN) is None
