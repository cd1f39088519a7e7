"""One correction: the smallest change of a list after which a case is decided as it was taught."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.induction.cases import Cases, picked
from gaitwright.induction.decision_list import (
    MOST_CONDITIONS,
    NONE,
    Bound,
    Lines,
    RuleLine,
    actions_of,
    as_arrays,
    fire_all,
    first_that_holds,
    line_of,
    match_all,
    one_line,
    with_rule,
)
from gaitwright.induction.grow import grow
from gaitwright.induction.length import WRONG, bound_bits, list_bits, name_bits
from gaitwright.induction.scan import between
from gaitwright.induction.search import PLAIN, SLIGHT, WIDTH

NARROWINGS, WIDENINGS = 3, 3
"""So many of the best narrowings are weighed in full, and so many rules that lack least."""
MOST_LOOKED_AT = 1000
"""A new rule is grown on so many cases at most, the last ones."""


def repaired(lines: Lines, cases: Cases, case: int) -> tuple[Lines, str]:
    """The shortest of all lists that one change makes, and what the change was ("" where none is shorter than
    leaving the case aside).

    Tried are: an earlier rule widened just to here, the rule that fired narrowed by one bound, a new rule in
    front of it, a later rule moved in front of it, and another action for it.
    """
    rules, n = as_arrays(lines, 0)
    holds, fire = np.empty((n, cases.n), np.bool_), np.empty(cases.n, np.int64)
    match_all(cases.x, rules, n, holds)
    first_that_holds(holds, n, NONE, fire)
    least = float(list_bits(cases, rules, n, fire, NONE))
    best, how = lines, ""
    for candidate, kind in candidates(lines, cases, case, holds, fire):
        bits = bits_of(candidate, cases)
        if bits < least - 1e-9:
            least, best, how = bits, candidate, kind
    return best, how


def lightened(lines: Lines, cases: Cases, r: int) -> Lines:
    """The list without a rule, or without one of its conditions, where that costs more than it saves."""
    if r == len(lines.rules):
        return lines
    rule = lines.rules[r]
    without = replace(lines, rules=(*lines.rules[:r], *lines.rules[r + 1 :]))
    fewer = [replace(rule, bounds=(*rule.bounds[:j], *rule.bounds[j + 1 :])) for j in range(len(rule.bounds))]
    tried = [without, *(with_rule(lines, r, wider) for wider in fewer), lines]
    return min(tried, key=lambda candidate: bits_of(candidate, cases))


def bits_of(lines: Lines, cases: Cases) -> float:
    """Bits of a list and of what it gets wrong."""
    rules, n = as_arrays(lines, 0)
    fire = np.empty(cases.n, np.int64)
    fire_all(cases.x, rules, n, fire)
    return float(list_bits(cases, rules, n, fire, NONE))


def candidates(
    lines: Lines,
    cases: Cases,
    case: int,
    holds: Bool[np.ndarray, "rules cases"],
    fire: Int[np.ndarray, " cases"],
) -> Iterator[tuple[Lines, str]]:
    """Every list that one change makes, with what it is."""
    right, at = int(cases.action[case]), int(fire[case])
    row = cases.x[:, case]
    earlier = [r for r, rule in enumerate(lines.rules[:at]) if rule.action == right]
    for r in sorted(earlier, key=lambda r: unmet(lines.rules[r], row))[:WIDENINGS]:
        yield with_rule(lines, r, widened(lines.rules[r], row)), "widened"
    for r, rule in enumerate(lines.rules):
        if rule.action == right and r > at and holds[r, case]:
            moved = (*lines.rules[:at], rule, *lines.rules[at:r], *lines.rules[r + 1 :])
            yield replace(lines, rules=moved), "moved"
    if at < len(lines.rules):
        for rule in narrowings(lines, cases, case, holds, fire):
            yield with_rule(lines, at, rule), "narrowed"
        yield with_rule(lines, at, replace(lines.rules[at], action=right)), "changed"
    else:
        yield replace(lines, otherwise=right), "changed"
    for place, only in ((at, at), (0, -1)):
        longer = with_new_rule(lines, cases, fire, place, only)
        if longer is not None:
            yield longer, "new"


def unmet(rule: RuleLine, row: Float[np.ndarray, " columns"]) -> int:
    """How many conditions of a rule a case does not meet."""
    return sum(not bound.low <= row[bound.column] < bound.high for bound in rule.bounds)


def widened(rule: RuleLine, row: Float[np.ndarray, " columns"]) -> RuleLine:
    """The rule with its bounds moved out just as far as a case."""
    bounds = tuple(
        Bound(
            bound.column,
            min(bound.low, float(row[bound.column])),
            max(bound.high, float(np.nextafter(row[bound.column], np.inf))),
        )
        for bound in rule.bounds
    )
    return replace(rule, bounds=bounds)


def narrowings(
    lines: Lines,
    cases: Cases,
    case: int,
    holds: Bool[np.ndarray, "rules cases"],
    fire: Int[np.ndarray, " cases"],
) -> Iterator[RuleLine]:
    """The rule that fired with one bound more or moved in, so that it keeps the case out; the best of them.

    What it lets go falls to the rules behind it. In every column and from either side, the cut that lets go
    most that these decide better is found in one pass over the cases of the rule.
    """
    at = int(fire[case])
    rule, mine = lines.rules[at], np.flatnonzero(fire == at)
    later = np.vstack([holds[at + 1 :, mine], np.ones((1, len(mine)), np.bool_)])
    actions = actions_of(lines, at + 1 + later.argmax(axis=0))
    truth, weight = cases.action[mine], cases.weight[mine]
    lost = WRONG * weight * ((truth == rule.action).astype(float) - (actions == truth))
    x = cases.x[:, mine]
    order = np.argsort(x, axis=1, kind="stable")
    value, sums = np.take_along_axis(x, order, axis=1), np.cumsum(lost[order], axis=1)
    whole = sums[:, -1:]
    found = [*cuts(value, sums, cases.x[:, case], -1), *cuts(value, whole - sums, cases.x[:, case], 1)]
    first, _ = bound_bits(cases)
    held = {bound.column for bound in rule.bounds}
    ranked = sorted(
        (cost + (0.0 if c in held else first + float(name_bits(cases, rule.action, c))), c, side, cut)
        for cost, c, side, cut in found
    )
    full = len(rule.bounds) == MOST_CONDITIONS
    fitting = [option for option in ranked if option[1] in held or not full]
    for _, c, side, cut in fitting[:NARROWINGS]:
        yield bounded(rule, c, side, cut)


def cuts(
    value: Float[np.ndarray, "columns mine"],
    sums: Float[np.ndarray, "columns mine"],
    row: Float[np.ndarray, " columns"],
    side: int,
) -> Iterator[tuple[float, int, int, float]]:
    """Per column what the best cut costs that leaves a case out, on its upper (`side` 1: what is above goes)
    or lower side (−1: what is below goes), and where it is."""
    low, high = value[:, :-1], value[:, 1:]
    apart = low < high
    out = (high <= row[:, None]) if side > 0 else (low >= row[:, None])
    costs = np.where(apart & out, sums[:, :-1], np.inf)
    if not costs.shape[1]:
        return
    best = costs.argmin(axis=1)
    for c in np.flatnonzero(np.isfinite(costs[np.arange(len(costs)), best])).tolist():
        k = int(best[c])
        yield float(costs[c, k]), c, side, float(between(low[c, k], high[c, k]))


def bounded(rule: RuleLine, column: int, side: int, cut: float) -> RuleLine:
    """The rule with a bound in a column moved in to a cut."""
    low, high = (-np.inf, cut) if side > 0 else (cut, np.inf)
    for k, bound in enumerate(rule.bounds):
        if bound.column == column:
            closer = Bound(column, max(bound.low, low), min(bound.high, high))
            return replace(rule, bounds=(*rule.bounds[:k], closer, *rule.bounds[k + 1 :]))
    return replace(rule, bounds=(*rule.bounds, Bound(column, low, high)))


def with_new_rule(
    lines: Lines, cases: Cases, fire: Int[np.ndarray, " cases"], at: int, only: int
) -> Lines | None:
    """The list with the best rule put in at a place, for all cases or for those of one rule only; `None`
    where none saves anything."""
    there = np.flatnonzero(fire >= at if only < 0 else fire == only)[-MOST_LOOKED_AT:]
    some = picked(cases, there)
    right = actions_of(lines, fire[there]) == some.action
    gain = np.where(right, SLIGHT, WRONG) * some.weight
    loss = np.where(right, WRONG, 0.0) * some.weight
    rule, use, active = one_line(), np.ones(len(some.price), np.bool_), np.ones(some.n, np.bool_)
    if grow(some, active, gain, loss, PLAIN, WIDTH, use, rule) <= 0.0:
        return None
    return replace(lines, rules=(*lines.rules[:at], line_of(rule, 0), *lines.rules[at:]))
