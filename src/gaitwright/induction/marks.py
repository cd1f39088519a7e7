"""Where a bound lies between what was right and what must stay out: the two marks of the thesis, and the cut.

The lower mark of a bound is the outermost case that the rule decides, the upper mark the nearest one that
only this bound keeps out; any cut between them says the cases equally well.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, fired, with_rule

MIDDLE = 0.6
"""A cut with few digits is looked for in this share of the gap."""
MOST_DIGITS = 12


@dataclass(frozen=True, slots=True)
class Gap:
    """The two marks of one bound: at each the number, and the place of the case that it is of."""

    inner: float
    inner_case: int
    outer: float
    outer_case: int


def settled(lines: Lines, cases: Cases, known: Sequence[Sequence[float]], before: Lines) -> Lines:
    """The list with each cut where a person would put it; what it decides rightly it still does.

    `known` are the bounds that have a name, per column: one that lies in the gap is taken, else the number
    of fewest digits in its middle. Rules that were so before keep their cuts.
    """
    fire, kept = fired(lines, cases.x), set(before.rules)
    for r, rule in enumerate(lines.rules):
        if rule in kept:
            continue
        for j, bound in enumerate(rule.bounds):  # one after the other: a case may be kept out by two
            upper, lower = (gap_of(rule, j, r, cases, fire, side) for side in (1, -1))
            high = cut_in(upper.inner, upper.outer, known[bound.column]) if upper else bound.high
            low = cut_in(lower.outer, lower.inner, known[bound.column]) if lower else bound.low
            moved = Bound(bound.column, low, high)
            rule = replace(rule, bounds=(*rule.bounds[:j], moved, *rule.bounds[j + 1 :]))  # noqa: PLW2901
        lines = with_rule(lines, r, rule)
    return lines


def gap_of(rule: RuleLine, j: int, r: int, cases: Cases, fire: np.ndarray, side: int) -> Gap | None:
    """The marks of a bound, the upper (`side` 1) or the lower (−1) one of condition j; `None` where it is
    open, or nothing lies on either side of it."""
    bound = rule.bounds[j]
    x = cases.x[bound.column]
    if not np.isfinite(bound.high if side > 0 else bound.low):
        return None
    inside = np.flatnonzero(fire == r)
    beyond = x >= bound.high if side > 0 else x < bound.low
    out = np.flatnonzero(beyond & (fire > r) & (cases.action != rule.action) & all_but(rule, j, cases.x))
    if not len(inside) or not len(out):
        return None
    k = inside[np.argmax(side * x[inside])]
    m = out[np.argmin(side * x[out])]
    return Gap(float(x[k]), int(k), float(x[m]), int(m))


def all_but(rule: RuleLine, j: int, x: Float[np.ndarray, "columns cases"]) -> Bool[np.ndarray, " cases"]:
    """Where all conditions of a rule hold but perhaps the j-th."""
    holds = np.ones(x.shape[1], np.bool_)
    for k, bound in enumerate(rule.bounds):
        if k != j:
            holds &= (x[bound.column] >= bound.low) & (x[bound.column] < bound.high)
    return holds


def cut_in(low: float, high: float, known: Sequence[float] = ()) -> float:
    """A number with low < cut ≤ high: of the known ones the nearest to the middle, else the one of fewest
    digits there, else the middle itself."""
    inside = [cut for cut in known if low < cut <= high]
    if inside:
        return float(min(inside, key=lambda cut: abs(cut - 0.5 * (low + high))))
    edge = 0.5 * (1.0 - MIDDLE) * (high - low)
    middle = low + 0.5 * (high - low)
    for digits in range(-6, MOST_DIGITS):
        cut = round(middle, digits) + 0.0  # no −0.0
        if low + edge <= cut <= high - edge and low < cut <= high:
            return cut
    return middle if middle > low else high
