"""A list in arrays decides as its plain value says, and what changes it in place keeps all of it together."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from random_tables import in_arrays, places_of, random_cases, random_lines, rule_holds

from gaitwright.induction.decision_list import (
    MOST_CONDITIONS,
    NONE,
    Bound,
    Lines,
    RuleLine,
    actions_of,
    as_arrays,
    as_lines,
    copy_list,
    fired,
    first_that_holds,
    match,
    put_in,
    room_for,
    shift,
    take_out,
)

seeds = st.integers(0, 2**32 - 1)


@given(seeds)
def test_a_plain_list_survives_its_arrays(seed):
    rng = np.random.default_rng(seed)
    lines = random_lines(rng, int(rng.integers(0, 6)), 8, 4, most=MOST_CONDITIONS)
    room = int(rng.integers(0, 5))
    rules, n = as_arrays(lines, room)
    assert (n, len(rules.action)) == (len(lines.rules), len(lines.rules) + room + 1)
    assert as_lines(rules, n) == lines
    assert hash(as_lines(rules, n)) == hash(lines)


@given(seeds)
def test_the_first_rule_that_holds_decides(seed):
    rng = np.random.default_rng(seed)
    cases = random_cases(rng, 20, 3, 3, missing=0.2)
    lines = random_lines(rng, int(rng.integers(0, 6)), 3, 3)
    places = places_of(lines, cases.x)
    np.testing.assert_array_equal(fired(lines, cases.x), places)
    every = [*(rule.action for rule in lines.rules), lines.otherwise]
    assert actions_of(lines, places).tolist() == [every[k] for k in places]


@given(seeds)
def test_a_rule_left_out_decides_nothing(seed):
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, 20, 3, 3), random_lines(rng, 4, 3, 3)
    _, n, holds, fire = in_arrays(lines, cases)
    without = int(rng.integers(0, n))
    first_that_holds(holds, n, without, fire)
    left = Lines(lines.rules[:without] + lines.rules[without + 1 :], lines.otherwise)
    places = places_of(left, cases.x)
    np.testing.assert_array_equal(fire, places + (places >= without))


def test_a_condition_holds_from_its_low_bound_on_up_to_its_high_one_and_for_nothing_unmeasured():
    x = np.array([[0.0, 0.5, 1.0, 1.5, np.nan]])
    whole, part = RuleLine(1, (Bound(0, -np.inf, np.inf),)), RuleLine(1, (Bound(0, 0.0, 1.0),))
    assert fired(Lines((part,), 0), x).tolist() == [0, 0, 1, 1, 1]
    assert fired(Lines((whole,), 0), x).tolist() == [0, 0, 0, 0, 1]
    assert fired(Lines((RuleLine(1, ()),), 0), x).tolist() == [0] * 5
    assert fired(Lines(), x).tolist() == [0] * 5


def test_a_slice_of_a_table_is_decided_as_the_table():
    rng = np.random.default_rng(3)
    cases, lines = random_cases(rng, 30, 3, 3), random_lines(rng, 4, 3, 3)
    np.testing.assert_array_equal(fired(lines, cases.x[:, ::3]), places_of(lines, cases.x)[::3])


@given(seeds)
def test_changes_in_place_are_those_of_a_plain_row_of_rules(seed):
    rng = np.random.default_rng(seed)
    cases, lines = random_cases(rng, 12, 3, 3), random_lines(rng, 3, 3, 3)
    rules, n, holds, _ = in_arrays(lines, cases, room=9)
    model = list(lines.rules)
    for _ in range(15):
        kind = rng.integers(0, 4)
        if kind == 0 and n + 2 <= len(rules.action):
            new = random_lines(rng, 1, 3, 3).rules[0]
            at = int(rng.integers(0, n + 1))
            n = put_in(rules, n, holds, at, as_arrays(Lines((new,)), 0)[0], cases.x)
            model.insert(at, new)
        elif kind == 1 and n:
            at = int(rng.integers(0, n))
            n = take_out(rules, n, holds, at)
            model.pop(at)
        elif kind == 2 and n > 1:
            start, end = (int(k) for k in rng.integers(0, n, 2))
            shift(rules, holds, start, end)
            model.insert(end, model.pop(start))
        elif kind == 3:
            other, held = room_for(len(rules.action)), np.ones_like(holds)
            copy_list(rules, holds, n, other, held)
            rules, holds = other, held
        assert as_lines(rules, n) == Lines(tuple(model), lines.otherwise)
        for k, rule in enumerate(model):
            assert holds[k].tolist() == [rule_holds(rule, cases.x[:, i]) for i in range(cases.n)]


def test_matching_writes_over_what_was_there():
    rules, _ = as_arrays(Lines((RuleLine(0, (Bound(0, 0.0, 1.0),)),)), 0)
    for old in (True, False):
        holds = np.full(3, old)
        match(np.array([[0.5, 2.0, np.nan]]), rules, 0, holds)
        assert holds.tolist() == [True, False, False]
    assert NONE == -1
