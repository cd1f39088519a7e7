"""Cuts move to where a person would put them, and nothing is decided otherwise for it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_tables import decisions_of, places_of, random_cases, random_lines, rule_holds, table_of

from gaitwright.induction.cases import NOBODY, Cases
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, fired
from gaitwright.induction.marks import cut_in, gap_of, settled
from gaitwright.induction.repair import bits_of
from gaitwright.induction.standing import upper_marks

seeds = st.integers(0, 2**32 - 1)
INF = np.inf


def drawn(seed: int, most: int) -> tuple[Cases, Lines, tuple]:
    """Cases, of which most are as a list of conditions up to so many decides them, and known bounds."""
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, 30, 3, 3), random_lines(rng, 4, 3, 3, most=most)
    slips = rng.random(30) < 0.1
    action = np.where(slips, cases.action, decisions_of(lines, cases.x))
    cases = cases._replace(action=action, reason=np.full(30, NOBODY))
    known = tuple(tuple(rng.integers(-8, 9, rng.integers(0, 3)) / 8.0) for _ in range(3))
    return cases, lines, known


@given(seeds)
def test_a_cut_lies_between_the_marks(seed):
    rng = np.random.default_rng(seed)
    scale = 10.0 ** rng.integers(-9, 8)
    low, high = np.sort(rng.normal(size=2)) * scale
    if low == high:
        return
    cut = cut_in(low, high)
    assert low < cut <= high
    known = [high + scale, low, float(high), low - scale]
    assert cut_in(low, high, known) == high
    assert cut_in(low, high, known[:2]) == cut


def test_a_cut_has_the_fewest_digits_that_the_middle_of_the_gap_has_room_for():
    assert cut_in(0.9, 2.3) == 2.0 and cut_in(0.9, 2.2) == 1.6 and cut_in(0.12, 0.19) == 0.15
    assert cut_in(0.1234, 0.1236) == pytest.approx(0.1235, abs=0.0)
    assert cut_in(-1.0, 1.0) == 0.0 and cut_in(180.0, 230.0) == 200.0
    assert cut_in(0.12, 0.19, (0.3, 0.121)) == 0.121
    above = float(np.nextafter(1.0, 2.0))
    assert cut_in(1.0, above) == above


def fewest_digits(low: float, high: float) -> int:
    """The least number of decimals that some number in the middle 0.6 of a gap has."""
    edge = 0.2 * (high - low)
    for digits in range(-6, 12):
        step = 10.0**-digits
        first = np.ceil((low + edge) / step - 1e-9) * step
        if first <= high - edge + 1e-9 * step:
            return digits
    return 12


@given(seeds)
def test_no_number_in_the_middle_has_fewer_digits(seed):
    rng = np.random.default_rng(seed)
    low = float(rng.uniform(-5.0, 5.0))
    high = low + float(rng.choice([0.001, 0.1, 1.0, 40.0])) * float(rng.uniform(0.2, 1.0))
    cut = cut_in(low, high)
    digits = fewest_digits(low, high)
    assert round(cut, digits) == pytest.approx(cut, abs=1e-12)


@given(seeds)
def test_lists_of_one_condition_each_decide_as_before(seed):
    cases, lines, known = drawn(seed, most=1)
    check_settled(cases, lines, settled(lines, cases, known, Lines()))


def test_a_case_that_two_bounds_keep_out_stays_out():
    x = np.array([[0.0, 10.0, 0.0, 2.0], [0.0, 0.0, 10.0, 2.0]])
    cases = table_of(x, np.array([0, 1, 1, 1]))
    lines = Lines((RuleLine(0, (Bound(0, -INF, 1.0), Bound(1, -INF, 1.0))),), 1)
    check_settled(cases, lines, settled(lines, cases, ((), ()), Lines()))


def test_lists_of_several_conditions_decide_as_before():
    for seed in (*range(60), 255, 502, 873):
        cases, lines, known = drawn(seed, most=3)
        check_settled(cases, lines, settled(lines, cases, known, Lines()))


def check_settled(cases: Cases, before: Lines, after: Lines) -> None:
    """Nothing is decided otherwise, but what was wrong and is right now; the rules are the same else."""
    was, now = decisions_of(before, cases.x), decisions_of(after, cases.x)
    moved = was != now
    assert not (moved & (was == cases.action)).any()
    assert (now == cases.action)[moved].all()
    assert bits_of(after, cases) <= bits_of(before, cases) + 1e-9
    assert after.otherwise == before.otherwise
    for old, new in zip(before.rules, after.rules, strict=True):
        assert new.action == old.action
        for a, b in zip(old.bounds, new.bounds, strict=True):
            assert a.column == b.column and (b.low < b.high or a.low == a.high)
            assert (np.isfinite(a.low), np.isfinite(a.high)) == (np.isfinite(b.low), np.isfinite(b.high))


def test_a_known_bound_in_the_gap_is_taken():
    cases = table_of(np.array([[0.0, 0.3, 1.0, 2.0]]), np.array([0, 0, 1, 1]))
    lines = Lines((RuleLine(1, (Bound(0, 0.9, INF),)),), 0)

    def low_with(*known: float) -> float:
        return settled(lines, cases, (known,), Lines()).rules[0].bounds[0].low

    assert 0.3 < low_with() <= 1.0 and low_with() in (0.6, 0.7)
    assert low_with(1.0) == 1.0 and low_with(0.45) == 0.45
    assert low_with(0.3) == low_with(1.1) == low_with()


@given(seeds)
def test_marks_are_the_nearest_cases_on_either_side(seed):
    cases, lines, _ = drawn(seed, most=3)
    fire = places_of(lines, cases.x)
    for r, rule in enumerate(lines.rules):
        for j, bound in enumerate(rule.bounds):
            for side, end in ((1, bound.high), (-1, bound.low)):
                check_gap(cases, lines, fire, (r, j, side), end)


def check_gap(cases: Cases, lines: Lines, fire: np.ndarray, which: tuple[int, int, int], end: float) -> None:
    r, j, side = which
    rule = lines.rules[r]
    open_here = RuleLine(rule.action, (*rule.bounds[:j], *rule.bounds[j + 1 :]))
    x = cases.x[rule.bounds[j].column]
    inside, outside = [], []
    for i in range(cases.n):
        if fire[i] == r:
            inside.append(x[i])
        elif fire[i] > r and cases.action[i] != rule.action and rule_holds(open_here, cases.x[:, i]):
            outside += [x[i]] if (x[i] >= end if side > 0 else x[i] < end) else []
    gap = gap_of(rule, j, r, cases, fire, side)
    if not (np.isfinite(end) and inside and outside):
        assert gap is None
        return
    nearest = (max(inside), min(outside)) if side > 0 else (min(inside), max(outside))
    assert (gap.inner, gap.outer) == nearest
    assert (x[gap.inner_case], x[gap.outer_case]) == nearest


@given(seeds)
def test_a_list_as_wide_as_nothing_forbids_takes_in_more_and_nothing_its_bounds_alone_keep_out(seed):
    cases, lines, _ = drawn(seed, most=1)
    fire = fired(lines, cases.x)
    wide = upper_marks(lines, cases, fire)
    for r, (old, new) in enumerate(zip(lines.rules, wide.rules, strict=True)):
        for a, b in zip(old.bounds, new.bounds, strict=True):
            assert b.low <= a.low and b.high >= a.high
        for i in range(cases.n):
            if rule_holds(old, cases.x[:, i]):
                assert rule_holds(new, cases.x[:, i])
            elif fire[i] > r and cases.action[i] != old.action:
                assert not rule_holds(new, cases.x[:, i])
