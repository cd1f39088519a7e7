"""The bits of a list are those of its parts, and say what they are meant to say."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_tables import bits_by_hand, doubt, in_arrays, random_cases, random_lines, table_of

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, first_that_holds
from gaitwright.induction.length import WRONG, bits_as_it_is, list_bits, wrong_bits
from gaitwright.induction.repair import bits_of

seeds = st.integers(0, 2**32 - 1)
INF = np.inf


@given(seeds)
def test_bits_are_the_sum_of_their_parts(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.choice([1, 2, 30, 250, 800]))
    cases, lines = random_cases(rng, n, 4, 3), random_lines(rng, int(rng.integers(0, 5)), 4, 3)
    assert bits_of(lines, cases) == pytest.approx(bits_by_hand(lines, cases), rel=1e-12)


@given(seeds)
def test_a_rule_that_is_left_out_costs_and_decides_nothing(seed):
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, 25, 3, 3), random_lines(rng, 4, 3, 3)
    rules, n, holds, fire = in_arrays(lines, cases)
    without = int(rng.integers(0, n))
    first_that_holds(holds, n, without, fire)
    bits = list_bits(cases, rules, n, fire, without)
    left = Lines(lines.rules[:without] + lines.rules[without + 1 :], lines.otherwise)
    assert bits == pytest.approx(bits_by_hand(left, cases), rel=1e-12)


def test_the_bits_of_a_list_fill_in_what_fires():
    rng = np.random.default_rng(5)
    cases, lines = random_cases(rng, 25, 3, 3), random_lines(rng, 4, 3, 3)
    rules, n, holds, fire = in_arrays(lines, cases)
    bits = bits_as_it_is(cases, rules, n, holds, fire)
    again = np.zeros_like(fire)
    first_that_holds(holds, n, -1, again)
    np.testing.assert_array_equal(fire, again)
    assert bits == bits_of(lines, cases)


@given(seeds)
def test_a_needless_rule_costs_bits(seed):
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, 30, 3, 3), random_lines(rng, 3, 3, 3)
    at = int(rng.integers(0, 4))
    never = RuleLine(int(rng.integers(0, 3)), (Bound(0, 7.0, 8.0),))
    longer = Lines((*lines.rules[:at], never, *lines.rules[at:]), lines.otherwise)
    assert bits_of(longer, cases) > bits_of(lines, cases) + 3.0


THRESHOLD = Lines((RuleLine(1, (Bound(0, 0.5, INF),)),), 0)


def columns_of(n: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).random((3, n))


def test_what_a_concept_needs_is_worth_its_bits():
    x = columns_of(60)
    cases = table_of(x, x[0] > 0.5)
    assert bits_of(THRESHOLD, cases) < bits_of(Lines((), 0), cases)
    assert bits_of(THRESHOLD, cases) < bits_of(Lines((RuleLine(1, (Bound(0, 0.5, 2.0),)),), 0), cases)


def test_a_case_that_counts_little_costs_little():
    x = columns_of(60)
    action = (x[0] > 0.5).astype(int)
    action[7] = 1 - action[7]
    full = bits_of(THRESHOLD, table_of(x, action))
    weight = np.ones(60)
    weight[7] = 0.05
    assert bits_of(THRESHOLD, table_of(x, action, weight=weight)) == pytest.approx(full - 0.95 * WRONG)


def test_a_named_column_costs_less_and_another_reason_costs_a_bit():
    x = columns_of(60)
    action = (x[0] > 0.5).astype(int)
    plain = bits_of(THRESHOLD, table_of(x, action))
    named = np.zeros((2, 3), np.bool_)
    named[1, 0] = True
    assert bits_of(THRESHOLD, table_of(x, action, named=named)) == pytest.approx(plain - np.log2(3.0))
    reason = np.full(60, -1)
    by_the_rule, by_the_rest = np.flatnonzero(action == 1)[0], np.flatnonzero(action == 0)[0]
    reason[by_the_rest] = 2
    assert bits_of(THRESHOLD, table_of(x, action, reason=reason)) == plain
    reason[by_the_rule] = 0
    assert bits_of(THRESHOLD, table_of(x, action, reason=reason)) == plain
    reason[by_the_rule] = 2
    assert bits_of(THRESHOLD, table_of(x, action, reason=reason)) == plain + 1.0


def so_many(n: int) -> Cases:
    """A table of n cases and three actions."""
    return table_of(np.zeros((3, n)), np.zeros(n, int), 3)


@pytest.mark.parametrize("n", [1, 99, 100, 101, 300, 600, 5000])
def test_slips_cost_what_was_said_while_few_and_less_when_they_recur(n):
    cases = so_many(n)
    assert wrong_bits(0.0, float(n), cases) == 0.0
    bits = [wrong_bits(float(k), float(n - k), cases) for k in range(n + 1)][:200]
    assert all(0.0 < b <= WRONG * k + 1e-9 for k, b in enumerate(bits) if k)
    assert all(b > a for a, b in pairwise(bits[:60]))
    if n <= 100:
        assert bits == [WRONG * k for k in range(len(bits))]
    if n == 5000:
        assert bits[150] < 0.9 * WRONG * 150
    assert doubt(n) <= 1.0


def test_doubt_grows_with_the_cases_and_not_in_jumps():
    bits = np.array([wrong_bits(30.0, 600.0, so_many(n)) for n in range(90, 700)])
    steps = np.diff(bits)
    assert (steps <= 1e-9).all() and steps.min() > -1.0
