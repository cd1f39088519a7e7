"""The scan finds the interval that a look at all intervals finds, for every column and action."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_tables import random_cases, table_of

from gaitwright.induction.cases import Cases
from gaitwright.induction.scan import NEVER, best_intervals, between

seeds = st.integers(0, 2**32 - 1)
numbers = st.floats(-1e300, 1e300)
INF = np.inf


def scanned(cases: Cases, active, gain, loss, price, only: int = -1, use=None):
    """Score, low and high of the best interval per column and action."""
    shape = len(cases.x), len(cases.named)
    score, low, high = np.full(shape, 7.0), np.full(shape, 7.0), np.full(shape, 7.0)
    use = np.ones(shape[0], np.bool_) if use is None else use
    best_intervals(cases, active, gain, loss, only, use, price, score, low, high)
    return score, low, high


def worth(cases: Cases, active, gain, loss, c: int, a: int, low: float, high: float) -> float:
    """What the cases of an interval add and take, one after the other."""
    total = 0.0
    for i in range(cases.n):
        if active[i] and low <= cases.x[c, i] < high:
            total += gain[i] if cases.action[i] == a else -loss[i]
    return total


def intervals(cases: Cases, active, price, c: int):
    """All half lines and intervals between cuts, each with the bits of its bounds."""
    values = np.unique(cases.x[c, active & ~np.isnan(cases.x[c])])
    cuts = (0.5 * (values[:-1] + values[1:])).tolist()
    yield from ((-INF, cut, price[0]) for cut in cuts)
    yield from ((cut, INF, price[0]) for cut in cuts)
    yield from ((low, high, price[0] + price[1]) for low, high in combinations(cuts, 2))


@given(seeds)
def test_no_interval_is_worth_more_than_the_one_found(seed):
    rng = np.random.default_rng(seed)
    n, actions = int(rng.integers(0, 15)), int(rng.integers(1, 4))
    cases = random_cases(rng, n, int(rng.integers(1, 4)), actions, missing=float(rng.choice([0.0, 0.3, 1.0])))
    active = rng.random(n) < rng.choice([0.0, 0.7, 1.0])
    gain, loss = rng.exponential(2.0, n) + 0.01, rng.exponential(2.0, n) * rng.integers(0, 2)
    price = float(rng.uniform(0.0, 2.0)), float(rng.uniform(0.0, 2.0))
    use = rng.random(len(cases.x)) < 0.8
    only = int(rng.integers(-1, actions))
    score, low, high = scanned(cases, active, gain, loss, price, only, use)
    for c in range(len(cases.x)):
        every = list(intervals(cases, active, price, c))
        for a in range(actions):
            if not (use[c] and every and only in (-1, a)):
                assert score[c, a] <= 0.5 * NEVER
                continue
            best = max(worth(cases, active, gain, loss, c, a, lo, up) - cost for lo, up, cost in every)
            assert score[c, a] == pytest.approx(best, abs=1e-9)
            cost = {(lo, up): cost for lo, up, cost in every}[low[c, a], high[c, a]]
            own = worth(cases, active, gain, loss, c, a, low[c, a], high[c, a]) - cost
            assert own == pytest.approx(best, abs=1e-9)


def one_column(values, action):
    cases = table_of(np.array([values], float), np.array(action))
    ones = np.ones(cases.n)
    return cases, np.ones(cases.n, np.bool_), ones, ones


def test_a_second_bound_is_taken_only_where_it_pays():
    cases, active, gain, loss = one_column([0, 1, 2, 3, 4, 5], [1, 0, 0, 0, 1, 1])
    score, low, high = scanned(cases, active, gain, loss, (0.5, 0.25))
    assert (score[0, 0], low[0, 0], high[0, 0]) == (2.25, 0.5, 3.5)
    score, low, high = scanned(cases, active, gain, loss, (0.5, 1.75))
    assert (score[0, 0], low[0, 0], high[0, 0]) == (1.5, -INF, 3.5)
    assert (score[0, 1], low[0, 1], high[0, 1]) == (1.5, 3.5, INF)


def test_a_column_of_one_value_has_no_interval():
    score, _, _ = scanned(*one_column([2, 2, 2], [0, 0, 1]), (0.0, 0.0))
    assert (score <= 0.5 * NEVER).all()


def test_what_was_not_measured_lies_in_no_half_line():
    cases, active, gain, loss = one_column([0, 1, np.nan, np.nan], [0, 1, 1, 1])
    score, low, high = scanned(cases, active, gain, loss, (0.0, 0.0))
    assert (score[0, 1], low[0, 1], high[0, 1]) == (1.0, 0.5, INF)


@given(numbers, numbers)
def test_a_cut_keeps_two_numbers_apart(one, other):
    low, high = min(one, other), max(one, other)
    if low < high:
        assert low < between(low, high) <= high
        assert low < between(low, np.nextafter(low, INF)) <= np.nextafter(low, INF)


def test_neighbours_among_the_numbers_are_kept_apart():
    above = float(np.nextafter(1.0, 2.0))
    cases, active, gain, loss = one_column([1.0, above, 3.0], [0, 1, 0])
    score, low, high = scanned(cases, active, gain, loss, (0.0, 0.0))
    assert (score[0, 1], low[0, 1]) == (1.0, above) and above < high[0, 1] <= 3.0
