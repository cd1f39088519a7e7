"""One rule at a time: the conditions that save most bits, by a beam over columns and actions."""

import numpy as np

from gaitwright.induction.decision_list import FIRST, MOST_CONDITIONS, NONE, copy_line, match, one_line
from gaitwright.induction.length import bound_bits, name_bits, rule_bits
from gaitwright.induction.scan import NEVER, best_intervals
from gaitwright.numerics.compiled import kernel

DEEPER = 3
"""Conditions that a seed may get beside its first."""
AS_MANY = 2
"""Columns that are tried for each further condition."""


@kernel
def grow(cases, active, gain, loss, strict, beam, use, rule):
    """Writes the rule that is worth most among the active cases into `rule`; how many bits that saves, 0.0
    where no rule saves any.

    `gain` is what deciding a case rightly saves [bits], `loss` what deciding it wrongly costs; `strict` are
    factors on the loss with which seeds are looked for: high ones find small pure rules, low ones large ones
    that need a second condition.
    """
    columns, n = cases.x.shape
    actions = len(cases.named)
    score, low, high = np.empty((3, columns, actions))
    price, best = bound_bits(cases), 0.0
    seed, holds, costs = one_line(), np.empty(n, np.bool_), np.empty(n)
    for factor in strict:
        costs[:] = factor * loss
        best_intervals(cases, active, gain, costs, NONE, use, price, score, low, high)
        charge_names(cases, score, NONE)
        for _ in range(beam):
            place = np.argmax(score)
            c, a = place // actions, place % actions
            if score[c, a] <= 0.5 * NEVER:
                break
            score[c, a] = NEVER
            seed.conditions[0], seed.action[0] = 1, a
            seed.column[0, 0], seed.low[0, 0], seed.high[0, 0] = c, low[c, a], high[c, a]
            best = refine(cases, active, gain, loss, strict, use, seed, holds, rule, best)
    return best


@kernel
def refine(cases, active, gain, loss, strict, use, seed, holds, rule, best):
    """Adds conditions to a seed while that saves bits; keeps the best rule so far, and its worth."""
    columns, actions, a = len(cases.x), len(cases.named), seed.action[0]
    score, low, high = np.empty((3, columns, actions))
    price, tried, found = bound_bits(cases), one_line(), one_line()
    inside, costs = np.empty(len(active), np.bool_), np.empty(len(active))
    worth, wrong = worth_of(cases, active, gain, loss, seed, holds)
    if worth > best:
        best = worth
        copy_line(seed, FIRST, rule, FIRST)
    for _ in range(DEEPER):
        if wrong <= 0.0:
            break
        match(cases.x, seed, FIRST, inside)
        inside &= active
        top, rest = NEVER, 0.0
        for factor in strict:
            costs[:] = factor * loss
            best_intervals(cases, inside, gain, costs, a, use, price, score, low, high)
            charge_names(cases, score, a)
            for _ in range(AS_MANY):
                c = np.argmax(score[:, a])
                if score[c, a] <= 0.5 * NEVER:
                    break
                score[c, a] = NEVER
                copy_line(seed, FIRST, tried, FIRST)
                if narrow(tried, c, low[c, a], high[c, a]):
                    more, errs = worth_of(cases, active, gain, loss, tried, holds)
                    if more > top:
                        top, rest = more, errs
                        copy_line(tried, FIRST, found, FIRST)
        if top <= worth + 1e-9:
            break
        worth, wrong = top, rest
        copy_line(found, FIRST, seed, FIRST)
        if worth > best:
            best = worth
            copy_line(seed, FIRST, rule, FIRST)
    return best


@kernel
def charge_names(cases, score, only):
    """Takes the bits of each column's name off its scores."""
    for c in range(score.shape[0]):
        for a in range(score.shape[1]):
            if score[c, a] > NEVER and (only < 0 or a == only):
                score[c, a] -= name_bits(cases, a, c)


@kernel
def worth_of(cases, active, gain, loss, rule, holds):
    """Bits that a rule saves among the active cases, and the weight of those it gets wrong."""
    match(cases.x, rule, FIRST, holds)
    bits, wrong = -rule_bits(cases, rule, FIRST), 0.0
    for i in range(len(active)):
        if active[i] and holds[i]:
            if cases.action[i] == rule.action[0]:
                bits += gain[i]
            else:
                bits -= loss[i]
                wrong += loss[i]
    return bits, wrong


@kernel
def narrow(rule, c, low, high):
    """Adds bounds in a column to a rule; whether there was room for them."""
    n = rule.conditions[0]
    for j in range(n):
        if rule.column[0, j] == c:
            rule.low[0, j], rule.high[0, j] = max(rule.low[0, j], low), min(rule.high[0, j], high)
            return True
    if n == MOST_CONDITIONS:
        return False
    rule.column[0, n], rule.low[0, n], rule.high[0, n] = c, low, high
    rule.conditions[0] = n + 1
    return True
