"""A list made shorter: rules, conditions and bounds that do not earn their bits go, rules move up."""

import numpy as np

from gaitwright.induction.decision_list import (
    FIRST,
    copy_line,
    first_that_holds,
    match,
    one_line,
    shift,
    take_out,
)
from gaitwright.induction.length import bits_as_it_is, list_bits
from gaitwright.induction.starts import set_otherwise
from gaitwright.numerics.compiled import kernel

ENOUGH = 1e-9
WORK = 1.5e6
"""Looks at one rule in one case that a round may take, about; where a list is longer, chance picks what is
tried."""


@kernel
def prune(cases, rules, n, holds, fire):
    """Two rounds over all rules from the last to the first; how many there are then, and the list's bits."""
    bits = bits_as_it_is(cases, rules, n, holds, fire)
    for turn in range(2):
        share = min(1.0, WORK / ((n * n / 2 + 4.0 * n + 1.0) * (0.5 * n + 1.0) * len(fire)))
        r = n - 1
        while r >= 0:
            if np.random.random() < share:
                n, bits, gone = without_rule(cases, rules, n, holds, r, bits, fire)
                if not gone:
                    bits = without_conditions(cases, rules, n, holds, r, bits, fire)
            r -= 1
        for r in range(1, n):
            for to in range(r):
                if np.random.random() >= share:
                    continue
                shift(rules, holds, r, to)
                now = bits_as_it_is(cases, rules, n, holds, fire)
                # In the first round a rule may also move for nothing: in front it may need fewer conditions.
                if now < bits - ENOUGH or (turn == 0 and now <= bits + ENOUGH):
                    bits = now
                    break
                shift(rules, holds, to, r)
    return n, bits_as_it_is(cases, rules, n, holds, fire)


@kernel
def without_rule(cases, rules, n, holds, r, bits, fire):
    """Takes a rule out where that costs nothing; how many there are, the bits, and whether it went."""
    first_that_holds(holds, n, r, fire)
    was = rules.action[n]
    set_otherwise(cases, rules, n, fire)
    now = list_bits(cases, rules, n, fire, r)
    if now <= bits + ENOUGH:
        return take_out(rules, n, holds, r), now, True
    rules.action[n] = was
    return n, bits, False


@kernel
def without_conditions(cases, rules, n, holds, r, bits, fire):
    """Takes out the conditions and bounds of a rule that cost more than they say; the bits then."""
    spare, held, j = one_line(), holds[r].copy(), FIRST
    while j < rules.conditions[r]:
        copy_line(rules, r, spare, FIRST)
        if rules.conditions[r] > 1:
            drop_condition(rules, r, j)
            now, kept = tried(cases, rules, n, holds, r, bits, fire)
            if kept:
                bits, held = now, holds[r].copy()
                continue
            restore(rules, r, spare, holds, held)
        if rules.low[r, j] > -np.inf and rules.high[r, j] < np.inf:
            rules.low[r, j] = -np.inf
            now, kept = tried(cases, rules, n, holds, r, bits, fire)
            if not kept:
                restore(rules, r, spare, holds, held)
                rules.high[r, j] = np.inf
                now, kept = tried(cases, rules, n, holds, r, bits, fire)
            if kept:
                bits, held = now, holds[r].copy()
            else:
                restore(rules, r, spare, holds, held)
        j += 1
    return bits


@kernel
def tried(cases, rules, n, holds, r, bits, fire):
    """The bits with a rule as it has become, and whether they are no more than before."""
    match(cases.x, rules, r, holds[r])
    now = bits_as_it_is(cases, rules, n, holds, fire)
    return now, now <= bits + ENOUGH


@kernel
def restore(rules, r, spare, holds, held):
    """A rule as it was."""
    copy_line(spare, FIRST, rules, r)
    for i in range(len(held)):
        holds[r, i] = held[i]


@kernel
def drop_condition(rules, r, j):
    """A rule without one of its conditions."""
    for k in range(j, rules.conditions[r] - 1):
        rules.column[r, k] = rules.column[r, k + 1]
        rules.low[r, k], rules.high[r, k] = rules.low[r, k + 1], rules.high[r, k + 1]
    rules.conditions[r] -= 1
