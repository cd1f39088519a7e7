"""A table that grows case by case is the table of all its cases."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.induction.cases import NOBODY, Cases, no_cases, picked, with_case

seeds = st.integers(0, 2**32 - 1)
READS = np.array([[True, False], [False, True], [True, True]])
PRICE = np.array([0.0, 0.0, 2.0])


def grown(rng: np.random.Generator, n: int) -> tuple[Cases, np.ndarray, list[int], list[int]]:
    """A table of so many lessons, and their rows, actions and reasons."""
    rows = rng.integers(-2, 3, (n, 3)) / 2.0
    rows[rng.random((n, 3)) < 0.2] = np.nan
    rows[rng.random((n, 3)) < 0.1] *= -1.0  # −0.0 is 0.0
    cases, actions, reasons = no_cases(READS, PRICE), [], []
    for row in rows:
        actions.append(int(rng.integers(0, max([-1, *actions]) + 2)))
        reasons.append(int(rng.integers(NOBODY, 2)))
        cases = with_case(cases, row, actions[-1], reasons[-1])
    return cases, rows, actions, reasons


def check_order(cases: Cases) -> None:
    """Every column's cases stand in ascending order, those that were not measured last."""
    for x, order in zip(cases.x, cases.order, strict=True):
        assert sorted(order.tolist()) == list(range(cases.n))
        values = x[order]
        measured = values[~np.isnan(values)]
        assert (np.diff(measured) >= 0.0).all()
        assert np.isnan(values[len(measured) :]).all()


@given(seeds, st.integers(0, 25))
def test_a_table_keeps_all_it_is_given_in_order(seed, n):
    cases, rows, actions, reasons = grown(np.random.default_rng(seed), n)
    assert cases.n == n
    np.testing.assert_array_equal(cases.x, rows.T)
    assert (cases.action.tolist(), cases.reason.tolist()) == (actions, reasons)
    assert (cases.weight == 1.0).all()
    check_order(cases)


@given(seeds, st.integers(0, 25))
def test_a_reason_names_all_columns_that_are_read_from_its_fact(seed, n):
    cases, _, actions, reasons = grown(np.random.default_rng(seed), n)
    assert cases.named.shape == (max(actions, default=-1) + 1, 3)
    for action in range(len(cases.named)):
        given_for_it = {r for a, r in zip(actions, reasons, strict=True) if a == action} - {NOBODY}
        expected = [any(READS[c, r] for r in given_for_it) for c in range(3)]
        assert cases.named[action].tolist() == expected


@given(seeds, st.integers(1, 25))
def test_picked_cases_are_those_named_in_their_order(seed, n):
    rng = np.random.default_rng(seed)
    cases, *_ = grown(rng, n)
    cases = cases._replace(weight=rng.uniform(0.05, 1.0, n))
    which = rng.permutation(n)[: rng.integers(1, n + 1)]
    some = picked(cases, which)
    assert some.n == len(which) and some.x.flags.c_contiguous
    np.testing.assert_array_equal(some.x, cases.x[:, which])
    for part in ("action", "weight", "reason"):
        np.testing.assert_array_equal(getattr(some, part), getattr(cases, part)[which])
    assert some.named is cases.named and some.price is cases.price
    check_order(some)
    assert picked(cases, which.tolist()).action.tolist() == some.action.tolist()


def test_one_more_case_leaves_the_table_before_it_alone():
    cases, *_ = grown(np.random.default_rng(1), 10)
    copies = [np.copy(part) for part in cases]
    with_case(cases, np.array([0.0, 1.0, np.nan]), 0, 1)
    for part, copy in zip(cases, copies, strict=True):
        np.testing.assert_array_equal(part, copy)


def test_an_action_that_leaves_one_out_is_refused():
    with pytest.raises(WrongUse, match="action"):
        with_case(no_cases(READS, PRICE), np.zeros(3), 2, NOBODY)
