"""Tables of cases and lists of rules drawn by chance, and the same laws as plain loops."""

import math

import numpy as np

from gaitwright.induction.cases import NOBODY, Cases
from gaitwright.induction.decision_list import (
    Bound,
    DecisionList,
    Lines,
    RuleLine,
    as_arrays,
    as_lines,
    match_all,
)


def table_of(x: np.ndarray, action: np.ndarray, actions: int | None = None, **more) -> Cases:
    """Cases with a fact for each column; `more` replaces fields."""
    columns, n = x.shape
    actions = actions or (int(action.max()) + 1 if n else 0)
    return Cases(
        np.ascontiguousarray(x, float),
        np.argsort(x, axis=1, kind="stable"),
        np.asarray(action, np.int64),
        np.ones(n),
        np.full(n, NOBODY),
        np.eye(columns, dtype=bool),
        np.zeros((actions, columns), np.bool_),
        np.zeros(columns),
    )._replace(**more)


def random_cases(rng: np.random.Generator, n: int, columns: int, actions: int, missing: float = 0.1) -> Cases:
    """Cases with many ties, some of them not measured, of any weights, with reasons for some."""
    x = rng.integers(-4, 5, (columns, n)) / 4.0
    x[rng.random((columns, n)) < missing] = np.nan
    action = rng.integers(0, actions, n)
    named, reason = np.zeros((actions, columns), np.bool_), np.full(n, NOBODY)
    given = np.flatnonzero(rng.random(n) < 0.3)
    reason[given] = rng.integers(0, columns, len(given))
    named[action[given], reason[given]] = True
    weight = np.where(rng.random(n) < 0.5, 1.0, rng.uniform(0.05, 1.0, n))
    price = rng.choice([0.0, 1.0, 2.0], columns)
    return table_of(x, action, actions, weight=weight, reason=reason, named=named, price=price)


def random_bound(rng: np.random.Generator, column: int) -> Bound:
    """A condition with one bound or two."""
    low, high = np.sort(rng.integers(-9, 10, 2) / 8.0)
    side = rng.integers(0, 3)
    return Bound(column, -np.inf if side == 0 else float(low), np.inf if side == 1 else float(high))


def random_lines(rng: np.random.Generator, rules: int, columns: int, actions: int, most: int = 3) -> Lines:
    """A list of rules of up to so many conditions, some of none."""
    made = []
    for _ in range(rules):
        about = rng.permutation(columns)[: rng.integers(0, most + 1)].tolist()
        made.append(RuleLine(int(rng.integers(0, actions)), tuple(random_bound(rng, c) for c in about)))
    return Lines(tuple(made), int(rng.integers(0, actions)))


def in_arrays(lines: Lines, cases: Cases, room: int = 8) -> tuple[DecisionList, int, np.ndarray, np.ndarray]:
    """A list as a search takes it: its arrays, its length, where its rules hold, and room for what fires."""
    rules, n = as_arrays(lines, room)
    holds, fire = np.zeros((len(rules.action) - 1, cases.n), np.bool_), np.zeros(cases.n, np.int64)
    match_all(cases.x, rules, n, holds)
    return rules, n, holds, fire


# --- the laws as plain loops -----------------------------------------------------------------------
def rule_holds(rule: RuleLine, x: np.ndarray) -> bool:
    return all(bound.low <= x[bound.column] < bound.high for bound in rule.bounds)


def place_of(lines: Lines, x: np.ndarray) -> int:
    """The first rule that holds in one case; behind all where none does."""
    return next((k for k, rule in enumerate(lines.rules) if rule_holds(rule, x)), len(lines.rules))


def places_of(lines: Lines, x: np.ndarray) -> np.ndarray:
    return np.array([place_of(lines, x[:, i]) for i in range(x.shape[1])], np.int64)


def decisions_of(lines: Lines, x: np.ndarray) -> np.ndarray:
    actions = np.array([*(rule.action for rule in lines.rules), lines.otherwise])
    return actions[places_of(lines, x)]


def doubt(n: int) -> float:
    """How much every word of the teacher is believed."""
    return min(1.0, max(0.25, (600.0 - n) / 500.0))


def bits_by_hand(lines: Lines, cases: Cases) -> float:
    """Bits of a list and of what it gets wrong, part by part."""
    doublings = math.log2(max(cases.n, 2))
    actions, columns = cases.named.shape
    bits = 0.0
    for rule in lines.rules:
        bits += math.log2(actions + 1) + 2.0
        for bound in rule.bounds:
            known = cases.named[rule.action, bound.column]
            free = 4.0 if cases.price[bound.column] >= 2.0 else 1.0
            bits += (free if known else math.log2(columns) + 1.0) + cases.price[bound.column]
            bits += 0.6 * doublings + 1.0
            if math.isfinite(bound.low) and math.isfinite(bound.high):
                bits += doublings + 2.0
    right = wrong = 0.0
    for i, place in enumerate(places_of(lines, cases.x).tolist()):
        rule = lines.rules[place] if place < len(lines.rules) else None
        if (rule.action if rule else lines.otherwise) != cases.action[i]:
            wrong += cases.weight[i]
            continue
        right += cases.weight[i]
        if rule and cases.reason[i] != NOBODY:
            read = [cases.reads[bound.column, cases.reason[i]] for bound in rule.bounds]
            bits += 0.0 if any(read) else cases.weight[i]
    rate = (wrong + 0.5) / (right + wrong + 20.0)
    coded = -wrong * math.log2(rate) - right * math.log2(1.0 - rate)
    coded += wrong * math.log2(max(actions - 1, 1)) + 0.5 * math.log2(right + wrong + 1.0)
    trust = doubt(cases.n)
    return bits + trust * 10.0 * wrong + (1.0 - trust) * min(10.0 * wrong, coded)


def check_consistent(rules: DecisionList, n: int, holds: np.ndarray, fire: np.ndarray, cases: Cases) -> Lines:
    """The list as a plain value, once where its rules hold and what fires proved to belong to it."""
    assert 0 <= n < len(rules.action)
    assert (rules.conditions[:n] >= 0).all() and (rules.conditions[:n] <= 6).all()
    assert (rules.action[: n + 1] >= 0).all() and (rules.action[: n + 1] < len(cases.named)).all()
    lines = as_lines(rules, n)
    for k, rule in enumerate(lines.rules):
        expected = [rule_holds(rule, cases.x[:, i]) for i in range(cases.n)]
        np.testing.assert_array_equal(holds[k], expected)
    np.testing.assert_array_equal(fire, places_of(lines, cases.x))
    return lines
