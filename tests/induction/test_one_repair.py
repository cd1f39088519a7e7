"""One correction never costs more than to leave the case aside, and mends what a bound can mend."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_tables import (
    bits_by_hand,
    decisions_of,
    in_arrays,
    places_of,
    random_cases,
    random_lines,
    rule_holds,
    table_of,
)

from gaitwright.induction.cases import Cases, picked
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, fired
from gaitwright.induction.repair import bits_of, candidates, repaired, with_new_rule

seeds = st.integers(0, 2**32 - 1)
KINDS = {"", "widened", "narrowed", "moved", "changed", "new"}
INF = np.inf


def drawn(seed: int) -> tuple[Cases, Lines, int]:
    """A table whose last case, and some others, a list decides wrongly."""
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, int(rng.integers(1, 40)), 3, 3), random_lines(rng, 4, 3, 3)
    action = decisions_of(lines, cases.x)
    slips = rng.random(cases.n) < rng.choice([0.0, 0.1, 0.5])
    action = np.where(slips, cases.action, action)
    action[-1] = (decisions_of(lines, cases.x)[-1] + rng.integers(1, 3)) % 3
    return cases._replace(action=action), lines, cases.n - 1


@given(seeds)
def test_a_repair_never_costs_more_than_to_leave_the_case_aside(seed):
    cases, lines, case = drawn(seed)
    after, how = repaired(lines, cases, case)
    assert how in KINDS
    assert (how == "") == (after == lines)
    assert bits_by_hand(after, cases) <= bits_by_hand(lines, cases)
    assert repaired(lines, cases, case) == (after, how)


@given(seeds)
def test_no_change_that_was_tried_is_shorter(seed):
    cases, lines, case = drawn(seed)
    _, n, holds, _ = in_arrays(lines, cases)
    fire = places_of(lines, cases.x)
    least = bits_by_hand(repaired(lines, cases, case)[0], cases)
    for candidate, kind in candidates(lines, cases, case, holds[:n], fire):
        assert kind in KINDS
        assert bits_by_hand(candidate, cases) >= least - 1e-6
        check_kind(candidate, kind, lines, cases.x[:, case], fire[case])


def check_kind(candidate: Lines, kind: str, lines: Lines, row: np.ndarray, at: int) -> None:
    """Each change is what it is called."""
    if kind == "moved":
        assert sorted(map(repr, candidate.rules)) == sorted(map(repr, lines.rules))
        assert candidate.rules[:at] == lines.rules[:at] and candidate != lines
    elif kind == "new":
        assert len(candidate.rules) == len(lines.rules) + 1
        assert any(
            lines.rules == candidate.rules[:k] + candidate.rules[k + 1 :] for k in range(len(lines.rules) + 1)
        )
    elif kind == "widened" and not np.isnan(row).any():
        (new,) = [b for a, b in zip(lines.rules, candidate.rules, strict=True) if a != b]
        assert rule_holds(new, row)
    elif kind == "narrowed":
        assert not rule_holds(candidate.rules[at], row)
        assert candidate.rules[:at] == lines.rules[:at]
        assert candidate.rules[at + 1 :] == lines.rules[at + 1 :]


def two_thresholds(seed: int, n: int = 30) -> tuple[np.ndarray, np.ndarray]:
    x = np.random.default_rng(seed).random((4, n))
    return x, np.where(x[0] >= 0.6, 1, np.where(x[1] < 0.3, 2, 0))


def as_seen(x: np.ndarray, action: np.ndarray) -> Lines:
    """The list of two thresholds with its bounds at the outermost of what was seen."""
    high, rest = action == 1, action == 2
    first = float(x[0][high].min()) if high.any() else 0.9
    second = float(np.nextafter(x[1][rest].max(), INF)) if rest.any() else 0.1
    return Lines((RuleLine(1, (Bound(0, first, INF),)), RuleLine(2, (Bound(1, -INF, second),))), 0)


@given(seeds)
def test_a_case_of_two_thresholds_is_decided_rightly_after_its_repair(seed):
    x, action = two_thresholds(seed)
    for n in range(5, 30):
        lines = as_seen(x[:, :n], action[:n])
        if decisions_of(lines, x)[n] == action[n]:
            continue
        cases = table_of(x[:, : n + 1], action[: n + 1], 3)
        after, how = repaired(lines, cases, n)
        assert how == "widened"
        assert (decisions_of(after, cases.x) == cases.action).all()


@given(seeds)
def test_a_bound_that_lets_too_much_in_is_moved_in(seed):
    x, action = two_thresholds(seed)
    loose = Lines((RuleLine(1, (Bound(0, 0.5, INF),)), RuleLine(2, (Bound(1, -INF, 0.3),))), 0)
    wrong = np.flatnonzero(decisions_of(loose, x) != action)
    if not len(wrong) or action[wrong[0]] == 2:  # a new rule could say that, too
        return
    first = int(wrong[0])
    cases = table_of(x, action)
    some = picked(cases, np.append(np.setdiff1d(np.arange(cases.n), wrong), first))
    after, how = repaired(loose, some, some.n - 1)
    assert how == "narrowed"
    assert (decisions_of(after, some.x) == some.action).all()
    assert after.rules[0].bounds[0].low > 0.5


def row_of(*values: float) -> np.ndarray:
    return np.array([values])


@pytest.mark.parametrize(
    ("lines", "how"),
    [
        (Lines((), 0), "changed"),
        (Lines((RuleLine(0, (Bound(0, 0.0, INF),)), RuleLine(1, (Bound(0, 0.5, INF),))), 0), "moved"),
        (Lines((RuleLine(0, (Bound(0, 0.5, INF),)),), 2), "changed"),
        (Lines((RuleLine(1, (Bound(0, 1.5, INF),)),), 0), "widened"),
        (Lines((RuleLine(0, (Bound(0, -INF, 7.0),)),), 1), "narrowed"),
    ],
)
def test_each_kind_of_change_is_found_where_it_is_the_shortest(lines, how):
    x = row_of(-1.0, -0.5, 2.0, 1.0)
    truth = {"changed": np.array([2, 2, 1, 1]), "narrowed": np.array([0, 0, 1, 1])}
    action = truth.get(how, np.array([0, 0, 1, 1]))
    if lines == Lines((), 0):
        x, action = row_of(1.0, 2.0), np.array([1, 1])
    cases = table_of(x, action, 3)
    after, kind = repaired(lines, cases, cases.n - 1)
    assert kind == how
    assert (decisions_of(after, x) == action).all()


def test_an_exception_gets_a_rule_of_its_own_where_it_comes_often_enough():
    x = np.random.default_rng(8).random((3, 80))
    action = ((x[0] > 0.4) & (x[0] < 0.6)).astype(int)
    cases = table_of(x, action)
    after, how = repaired(Lines((), 0), cases, int(np.flatnonzero(action)[-1]))
    assert how == "new" and len(after.rules) == 1
    assert (decisions_of(after, x) == action).all()


def test_a_single_slip_among_many_is_left_aside():
    x = np.random.default_rng(8).random((3, 80))
    action = (x[0] > 0.5).astype(int)
    middle = int(np.argsort(x[0])[10])
    action[middle] = 1
    lines = Lines((RuleLine(1, (Bound(0, 0.5, INF),)),), 0)
    cases = table_of(x, action)
    assert repaired(lines, cases, middle) == (lines, "")


def test_a_case_that_was_not_measured_is_repaired_without_bounds_that_are_no_numbers():
    cases = table_of(np.array([[0.0, 0.2, 0.8, np.nan], [np.nan] * 4]), np.array([0, 0, 1, 2]))
    lines = Lines((RuleLine(2, (Bound(0, 2.0, 3.0),)), RuleLine(1, (Bound(0, 0.5, INF),))), 0)
    after, _ = repaired(lines, cases, 3)
    ends = [end for rule in after.rules for bound in rule.bounds for end in (bound.low, bound.high)]
    assert not np.isnan(ends).any()


@given(seeds)
def test_a_full_rule_is_not_narrowed_in_a_seventh_column(seed):
    rng = np.random.default_rng(seed)
    cases = random_cases(rng, 20, 8, 2, missing=0.0)
    full = RuleLine(0, tuple(Bound(c, -2.0, INF) for c in range(6)))
    cases = cases._replace(action=np.append(cases.action[:-1], 1))
    after, _ = repaired(Lines((full,), 1), cases, 19)
    assert all(len(rule.bounds) <= 6 for rule in after.rules)


def test_a_new_rule_is_only_made_where_it_saves_bits():
    x, action = two_thresholds(1)
    cases = table_of(x, action, 3)
    right = as_seen(x, action)
    assert with_new_rule(right, cases, fired(right, x), 0, -1) is None
    first = replace(right, rules=right.rules[1:])
    longer = with_new_rule(first, cases, fired(first, x), 0, -1)
    assert longer is not None and longer.rules[1:] == first.rules
    assert bits_of(longer, cases) < bits_of(first, cases)
