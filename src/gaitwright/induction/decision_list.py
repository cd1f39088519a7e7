"""An ordered list of rules, as arrays: the first rule all of whose conditions hold decides, else the last
line."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from gaitwright.numerics.compiled import kernel

MOST_CONDITIONS = 6
"""Conditions of one rule."""
ROOM = 8
"""Places for rules that a search may add to a list."""


class DecisionList(NamedTuple):
    """Rules in order; kernels change it in place. Condition k of rule r: low ≤ x[column] < high.

    `action[n]`, behind the n rules, is what is done where none of them fires.
    """

    column: Int[np.ndarray, "places conditions"]
    low: Float[np.ndarray, "places conditions"]
    high: Float[np.ndarray, "places conditions"]
    conditions: Int[np.ndarray, " places"]
    """How many conditions each rule has."""
    action: Int[np.ndarray, " places"]


@dataclass(frozen=True, slots=True)
class Bound:
    """One condition: low ≤ column < high, infinite where it is open."""

    column: int
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class RuleLine:
    """One rule as a plain value."""

    action: int
    bounds: tuple[Bound, ...]


@dataclass(frozen=True, slots=True)
class Lines:
    """A whole list as a plain value: what is kept, compared and explained."""

    rules: tuple[RuleLine, ...] = ()
    otherwise: int = 0


def with_rule(lines: Lines, r: int, rule: RuleLine) -> Lines:
    """The list with one rule replaced."""
    return replace(lines, rules=(*lines.rules[:r], rule, *lines.rules[r + 1 :]))


def as_arrays(lines: Lines, room: int = ROOM) -> tuple[DecisionList, int]:
    """The list with room for more rules behind, and how many there are."""
    n = len(lines.rules)
    rules = room_for(np.int64(n + room + 1))
    for k, rule in enumerate(lines.rules):
        rules.action[k], rules.conditions[k] = rule.action, len(rule.bounds)
        for j, bound in enumerate(rule.bounds):
            rules.column[k, j], rules.low[k, j], rules.high[k, j] = bound.column, bound.low, bound.high
    rules.action[n] = lines.otherwise
    return rules, n


def as_lines(rules: DecisionList, n: int) -> Lines:
    """The list as a plain value."""
    return Lines(tuple(line_of(rules, k) for k in range(n)), int(rules.action[n]))


def line_of(rules: DecisionList, k: int) -> RuleLine:
    """One rule as a plain value."""
    bounds = (
        Bound(int(rules.column[k, j]), float(rules.low[k, j]), float(rules.high[k, j]))
        for j in range(rules.conditions[k])
    )
    return RuleLine(int(rules.action[k]), tuple(bounds))


def fired(lines: Lines, x: Float[np.ndarray, "columns cases"]) -> Int[np.ndarray, " cases"]:
    """The place of the rule that decides each case; behind all of them where none fires."""
    rules, n = as_arrays(lines, 0)
    fire = np.empty(x.shape[1], np.int64)
    fire_all(np.ascontiguousarray(x), rules, n, fire)
    return fire


def actions_of(lines: Lines, places: Int[np.ndarray, " cases"]) -> Int[np.ndarray, " cases"]:
    """What the rules at these places do."""
    return np.array([*(rule.action for rule in lines.rules), lines.otherwise])[places]


# --- kernels ---------------------------------------------------------------------------------------
NONE, FIRST = np.int64(-1), np.int64(0)
"""No rule; the first one. Of a type that numba makes no further version of a kernel for, as it does for
literal numbers."""


@kernel
def fire_all(x, rules, n, fire):
    """The first rule that holds, case by case, into `fire`; n where none does."""
    fire[:] = n
    holds = np.empty(len(fire), np.bool_)
    for r in range(n - 1, -1, -1):
        match(x, rules, r, holds)
        for i in range(len(fire)):
            fire[i] = r if holds[i] else fire[i]


@kernel
def match(x, rules, r, holds):
    """Whether rule r holds, case by case, into `holds`."""
    holds[:] = True
    for j in range(rules.conditions[r]):
        values, low, high = x[rules.column[r, j]], rules.low[r, j], rules.high[r, j]
        for i in range(len(holds)):
            if not low <= values[i] < high:
                holds[i] = False


@kernel
def match_all(x, rules, n, holds):
    """`match` for each rule, into the rows of `holds`."""
    for r in range(n):
        match(x, rules, r, holds[r])


@kernel
def first_that_holds(holds, n, without, fire):
    """The first rule that holds, case by case, as if rule `without` were not there; n where none does."""
    for i in range(len(fire)):
        fire[i] = n
        for r in range(n):
            if holds[r, i] and r != without:
                fire[i] = r
                break


@kernel
def put_in(rules, n, holds, at, rule, x):
    """Puts the first rule of another list in at a place; how many there are then."""
    rules.action[n + 1] = rules.action[n]
    for r in range(n, at, -1):
        move_line(rules, holds, r - 1, r)
    copy_line(rule, FIRST, rules, at)
    match(x, rules, at, holds[at])
    return n + 1


@kernel
def take_out(rules, n, holds, at):
    """Takes a rule out; how many there are then."""
    for r in range(at, n - 1):
        move_line(rules, holds, r + 1, r)
    rules.action[n - 1] = rules.action[n]
    return n - 1


@kernel
def shift(rules, holds, start, end):
    """Moves a rule to another place; those between close up."""
    spare, held = one_line(), holds[start].copy()
    copy_line(rules, start, spare, FIRST)
    step = 1 if end > start else -1
    for r in range(start, end, step):
        move_line(rules, holds, r + step, r)
    copy_line(spare, FIRST, rules, end)
    for i in range(len(held)):
        holds[end, i] = held[i]


@kernel
def move_line(rules, holds, start, end):
    """Copies a rule, and where it holds, over another place."""
    copy_line(rules, start, rules, end)
    for i in range(holds.shape[1]):
        holds[end, i] = holds[start, i]


@kernel
def copy_line(source, start, target, end):
    """Copies a rule from list to list."""
    for j in range(MOST_CONDITIONS):
        target.column[end, j], target.low[end, j] = source.column[start, j], source.low[start, j]
        target.high[end, j] = source.high[start, j]
    target.conditions[end], target.action[end] = source.conditions[start], source.action[start]


@kernel
def copy_list(source, held, n, target, holds):
    """Copies a whole list, its last line and where its rules hold."""
    for r in range(n):
        copy_line(source, r, target, r)
        for i in range(holds.shape[1]):
            holds[r, i] = held[r, i]
    target.action[n] = source.action[n]


@kernel
def room_for(places):
    """An empty list with so many places."""
    shape = (places, MOST_CONDITIONS)
    return DecisionList(
        np.zeros(shape, np.int64),
        np.full(shape, -np.inf),
        np.full(shape, np.inf),
        np.zeros(places, np.int64),
        np.zeros(places, np.int64),
    )


@kernel
def one_line():
    """Room for one rule."""
    return room_for(np.int64(1))
