"""What is known of each rule after a case more is what all cases say of it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_tables import (
    decisions_of,
    place_of,
    places_of,
    random_cases,
    random_lines,
    table_of,
)

from gaitwright.induction.cases import picked
from gaitwright.induction.decision_list import Bound, Lines, RuleLine
from gaitwright.induction.standing import Standing, standing_of

seeds = st.integers(0, 2**32 - 1)
INF = np.inf


def check_same(one: Standing, other: Standing) -> None:
    np.testing.assert_array_equal(one.fire, other.fire)
    np.testing.assert_array_equal(one.right, other.right)
    np.testing.assert_array_equal(one.rights, other.rights)
    np.testing.assert_array_equal(one.wrongs, other.wrongs)
    np.testing.assert_array_equal(one.firm, other.firm)
    np.testing.assert_array_equal(one.aside, other.aside)
    assert one.scenes == other.scenes
    for a, b in ((one.low, other.low), (one.high, other.high)):
        finite = np.isfinite(a)
        np.testing.assert_array_equal(finite, np.isfinite(b))  # nothing measured: no number, or an open end
        np.testing.assert_array_equal(a[finite], b[finite])


@given(seeds)
def test_cases_taken_in_one_by_one_are_the_cases_looked_at_at_once(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 30))
    cases, lines = random_cases(rng, n, 3, 3, missing=0.3), random_lines(rng, 3, 3, 3)
    scene = rng.integers(0, 6, n)
    start = int(rng.integers(0, n))
    standing = standing_of(lines, picked(cases, np.arange(start)), scene[:start])
    decided = decisions_of(lines, cases.x)
    for k in range(start, n):
        right = bool(decided[k] == cases.action[k])
        upto = picked(cases, np.arange(k + 1))
        standing.take_in(upto, int(scene[k]), place_of(lines, cases.x[:, k]), right)
        check_same(standing, standing_of(lines, upto, scene[: k + 1]))


@given(seeds)
def test_a_standing_is_what_the_cases_say(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 30))
    cases, lines = random_cases(rng, n, 3, 3), random_lines(rng, 3, 3, 3)
    scene = rng.integers(0, 6, n)
    standing = standing_of(lines, cases, scene)
    places, right = places_of(lines, cases.x), decisions_of(lines, cases.x) == cases.action
    assert standing.aside.tolist() == [i for i in range(n) if not right[i]]
    for r in range(len(lines.rules) + 1):
        mine = [i for i in range(n) if places[i] == r and right[i]]
        assert standing.rights[r] == len(mine)
        assert standing.wrongs[r] == sum(1 for i in range(n) if places[i] == r and not right[i])
        assert standing.scenes[r] == {int(scene[i]) for i in mine}
        for c in range(3):
            values = [cases.x[c, i] for i in mine if not np.isnan(cases.x[c, i])]
            if values:
                assert (standing.low[r, c], standing.high[r, c]) == (min(values), max(values))


ONE_RULE = Lines((RuleLine(1, (Bound(0, 0.5, INF),)),), 0)


@pytest.mark.parametrize(
    ("rights", "wrongs", "scenes", "firm"),
    [
        (6, 0, 3, True),
        (5, 0, 3, False),
        (6, 0, 2, False),
        (6, 1, 3, False),
        (12, 1, 3, True),  # one in thirteen
        (11, 1, 3, False),
        (40, 4, 5, False),
    ],
)
def test_a_rule_is_firm_from_six_cases_in_three_scenes_with_few_aside(rights, wrongs, scenes, firm):
    n = rights + wrongs
    cases = table_of(np.ones((2, n)), np.array([1] * rights + [0] * wrongs))
    scene = np.array([k % scenes for k in range(rights)] + [99] * wrongs)
    assert standing_of(ONE_RULE, cases, scene).firm.tolist() == [firm, False]


def test_a_case_is_held_where_it_lies_among_the_right_ones_in_every_plain_column():
    x = np.array([[1.0, 2.0, 5.0], [0.0, 4.0, 9.0], [np.nan, np.nan, 1.0]])
    cases = table_of(x, np.array([1, 1, 0]))
    standing = standing_of(ONE_RULE, cases, np.zeros(3, np.int64))
    asked = np.array([[1.0, 1.5, 2.0, 2.5, np.nan], [0.0, 2.0, 4.1, 2.0, 2.0]])
    rules = np.zeros(5, np.int64)
    assert standing.holds(rules, asked, np.array([0, 1])).tolist() == [True, True, False, False, False]
    assert standing.holds(rules, asked[:1], np.array([0])).tolist() == [True, True, True, False, False]
    unmeasured = np.array([[1.0], [0.0]])
    assert not standing.holds(rules[:1], unmeasured, np.array([0, 2])).any()
    assert not standing.holds(np.ones(1, np.int64), unmeasured, np.array([0, 1])).any()
