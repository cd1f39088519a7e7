"""Starts, pruning and search: what they return belongs together, and is never longer than what they were
given."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_tables import (
    bits_by_hand,
    check_consistent,
    decisions_of,
    in_arrays,
    random_cases,
    random_lines,
    table_of,
)

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import ROOM, Lines, as_lines, room_for
from gaitwright.induction.prune import prune
from gaitwright.induction.repair import bits_of
from gaitwright.induction.revision import STARTS, begun, revised, sample
from gaitwright.induction.search import improve
from gaitwright.induction.starts import cover, from_tree

seeds = st.integers(0, 2**32 - 1)
NEAR = 1e-6
"""Steps that change bits by less than 1e-9 are taken for free, and there may be many."""


def drawn(seed: int) -> tuple[np.random.Generator, Cases, Lines]:
    """A table and a list by chance; sometimes the list half fits."""
    rng = np.random.default_rng(seed)
    cases = random_cases(rng, int(rng.integers(1, 40)), int(rng.integers(1, 5)), int(rng.integers(1, 5)))
    columns, actions = len(cases.x), len(cases.named)
    lines = random_lines(rng, int(rng.integers(0, 7)), columns, actions, most=min(3, columns))
    if rng.random() < 0.5:
        cases = cases._replace(action=decisions_of(lines, cases.x))
    return rng, cases, lines


@given(seeds)
def test_pruning_never_makes_a_list_longer(seed):
    _, cases, lines = drawn(seed)
    rules, n, holds, fire = in_arrays(lines, cases)
    before = bits_by_hand(lines, cases)
    m, bits = prune(cases, rules, n, holds, fire)
    after = check_consistent(rules, m, holds, fire, cases)
    assert m <= n
    assert bits == pytest.approx(bits_by_hand(after, cases), rel=1e-12)
    assert bits <= before + NEAR


@given(seeds)
def test_what_is_pruned_has_no_rule_that_costs_more_than_it_saves(seed):
    _, cases, lines = drawn(seed)
    rules, n, holds, fire = in_arrays(lines, cases)
    for _ in range(8):
        n, bits = prune(cases, rules, n, holds, fire)
    left = as_lines(rules, n)
    for k in range(n):
        shorter = Lines(left.rules[:k] + left.rules[k + 1 :], left.otherwise)
        assert bits_by_hand(shorter, cases) > bits - NEAR


@given(seeds, st.integers(0, 12))
def test_search_never_makes_a_list_longer(seed, rounds):
    rng, cases, lines = drawn(seed)
    room = int(rng.integers(0, 12))
    rules, n, holds, fire = in_arrays(lines, cases, room)
    before = bits_by_hand(lines, cases)
    m, bits = improve(cases, rules, n, holds, rounds, seed, fire)
    after = check_consistent(rules, m, holds, fire, cases)
    assert m <= n + room
    assert bits == pytest.approx(bits_by_hand(after, cases), rel=1e-12)
    assert bits <= before + NEAR
    if not rounds:
        assert after == lines


@given(seeds)
def test_covering_leaves_the_rules_before_it_and_says_what_is_left(seed):
    rng, cases, lines = drawn(seed)
    rules, n, holds, fire = in_arrays(lines, cases, room=20)
    use = rng.random(len(cases.x)) < 0.9
    m = cover(cases, rules, n, holds, float(rng.choice([1.0, 2.0, 4.0])), use, fire)
    after = check_consistent(rules, m, holds, fire, cases)
    assert n <= m <= n + 20 and after.rules[:n] == lines.rules
    added = after.rules[n:]
    assert all(use[bound.column] for rule in added for bound in rule.bounds)
    for k in range(n, m):
        mine = fire == k
        assert cases.weight[mine & (cases.action == after.rules[k].action)].sum() > 0.0
    check_otherwise(after, cases, fire == m)


def check_otherwise(lines: Lines, cases: Cases, rest: np.ndarray) -> None:
    """The last line does what is right for most of the cases that it decides."""
    if rest.any():
        counts = np.bincount(cases.action[rest], cases.weight[rest], len(cases.named))
        assert counts[lines.otherwise] == pytest.approx(counts.max())


@given(seeds)
def test_a_tree_is_a_list_of_its_leaves(seed):
    rng, cases, _ = drawn(seed)
    places, use = int(rng.choice([6, 9, 64])), rng.random(len(cases.x)) < 0.9
    rules, fire = room_for(places), np.zeros(cases.n, np.int64)
    holds = np.zeros((places - 1, cases.n), np.bool_)
    n = from_tree(cases, rules, holds, float(rng.choice([0.0, 8.0])), use, fire)
    lines = check_consistent(rules, n, holds, fire, cases)
    assert n <= places - 4
    assert all(use[bound.column] for rule in lines.rules for bound in rule.bounds)


def test_a_tree_finds_exceptions_to_exceptions():
    x = np.random.default_rng(2).random((4, 300))
    action = np.where(x[0] < 0.5, 0, np.where(x[1] < 0.5, 1, np.where(x[2] < 0.5, 2, 0)))
    cases = table_of(x, action)
    rules, fire = room_for(64), np.zeros(cases.n, np.int64)
    holds = np.zeros((63, cases.n), np.bool_)
    n = from_tree(cases, rules, holds, 0.0, np.ones(4, np.bool_), fire)
    lines = check_consistent(rules, n, holds, fire, cases)
    assert (decisions_of(lines, x) == action).all() and n == 3
    weights = np.bincount(fire, minlength=n + 1)
    assert (np.diff(weights) >= 0).all()  # small leaves first, the heaviest is the last line


@given(seeds, st.integers(0, len(STARTS) - 1))
def test_lists_begun_and_revised_have_the_bits_they_say(seed, kind):
    _, cases, lines = drawn(seed)
    for start in (begun(cases, kind, seed), lines):
        found, saved = revised(start, cases, 3, seed)
        before, after = bits_by_hand(start, cases), bits_by_hand(found, cases)
        assert saved == pytest.approx(before - after, abs=1e-6) and saved >= -NEAR


@pytest.mark.parametrize("kind", range(len(STARTS)))
def test_the_same_seed_begins_and_revises_the_same_list(kind):
    _, cases, lines = drawn(100 + kind)
    assert begun(cases, kind, 1) == begun(cases, kind, 1)
    assert revised(lines, cases, 10, 1) == revised(lines, cases, 10, 1)


def noise(n: int) -> Cases:
    """Actions that nothing explains."""
    rng = np.random.default_rng(0)
    return table_of(rng.random((4, n)), rng.integers(0, 4, n), 4)


def test_a_list_begun_in_much_noise_does_not_depend_on_what_was_drawn_before():
    cases, few, found = noise(400), noise(5), []
    for other in range(3):
        revised(Lines(), few, 1, other)
        found.append(begun(cases, 0, 7))
    assert found[0] == found[1] == found[2]


def test_search_finds_three_thresholds_from_nothing():
    x = np.random.default_rng(4).random((5, 200))
    action = np.where(x[0] < 0.3, 1, np.where(x[1] < 0.4, 2, 0))
    cases = table_of(x, action)
    for kind in range(len(STARTS)):
        lines, _ = revised(begun(cases, kind, kind), cases, 40, kind)
        assert (decisions_of(lines, x) == action).all(), kind
        assert len(lines.rules) == 2 and bits_of(lines, cases) < 50.0


@settings(max_examples=10)
@given(seeds)
def test_lists_stay_below_their_places_whatever_is_said(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 120))
    cases = random_cases(rng, n, 3, int(rng.integers(1, 6)), missing=float(rng.choice([0.0, 0.2, 1.0])))
    for kind in range(2):
        lines, saved = revised(begun(cases, kind, seed), cases, 8, seed)
        assert len(lines.rules) <= 60 + ROOM and np.isfinite(saved)


def test_a_sample_keeps_what_is_wrong():
    cases = noise(2000)
    wrong = np.arange(0, 2000, 7)
    some = sample(cases, wrong, 10, 3)
    assert some.n == 1500
    kept = {tuple(row) for row in some.x.T.tolist()}
    assert all(tuple(row) in kept for row in cases.x[:, wrong].T.tolist())
    assert len(kept) == 1500
    again = sample(cases, wrong, 10, 3)
    np.testing.assert_array_equal(some.x, again.x)
    few = noise(1500)
    assert sample(few, wrong[:3], 10, 3) is few
    assert sample(cases, np.arange(1600), 10, 3).n == 1150  # half of 1500, and all that are right
    assert sample(cases, wrong, 200, 3).n == 600
