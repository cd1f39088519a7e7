"""How many bits a list takes together with what it gets wrong: the one number that decides between lists.

Rissanen's minimum description length for ordered rules: each rule, each condition, each bound and each case
that is decided otherwise than it was taught costs bits; fewer bits in all is the better explanation.
"""

import numpy as np

from gaitwright.induction.decision_list import NONE, first_that_holds
from gaitwright.numerics.compiled import kernel

NAMED, IN_A_PAIR, PAIR = 1.0, 4.0, 2.0
"""Bits of the name of a column that the teacher has named for that action; where it compares the number with
another one, which she did not say, more. A column is such a comparison from this price on."""
BOUND, BOUND_MORE = 0.6, 1.0
"""Bits of a condition's first bound: so many per doubling of the cases, and so many more."""
SECOND, SECOND_MORE = 1.0, 2.0
"""Bits of a second bound: between two bounds a few cases of one action lie by chance far oftener."""
WRONG = 10.0
"""Bits of a case that is decided otherwise than it was taught, while there are few."""
TRUSTING, DOUBTING, LEAST_TRUST = 100.0, 600.0, 0.25
"""Up to so many cases every word of the teacher is believed at `WRONG` bits. Beyond, the rate at which she is
contradicted counts more and more, as if it were all that counts from the second number on; but never for more
than all but this share."""


@kernel
def bound_bits(cases):
    """Bits of a condition's first and second bound."""
    doublings = np.log2(max(cases.x.shape[1], 2))
    return BOUND * doublings + BOUND_MORE, SECOND * doublings + SECOND_MORE


@kernel
def name_bits(cases, action, column):
    """Bits that say which column a condition is about."""
    free = np.log2(len(cases.price)) + 1.0
    if cases.named[action, column]:
        free = IN_A_PAIR if cases.price[column] >= PAIR else NAMED
    return free + cases.price[column]


@kernel
def rule_bits(cases, rules, r):
    """Bits of a rule."""
    first, second = bound_bits(cases)
    bits = np.log2(len(cases.named) + 1.0) + 2.0
    for j in range(rules.conditions[r]):
        bits += name_bits(cases, rules.action[r], rules.column[r, j]) + first
        if rules.low[r, j] > -np.inf and rules.high[r, j] < np.inf:
            bits += second
    return bits


@kernel
def wrong_bits(wrong, right, cases):
    """Bits of the cases that a list decides otherwise, from their weight and that of the others.

    Between believing each of them and coding them at the rate at which they occur: a teacher slips now and
    then, and then each slip must not become a rule.
    """
    total = wrong + right
    rate = (wrong + 0.5) / (total + 20.0)
    coded = -wrong * np.log2(rate) - right * np.log2(1.0 - rate)
    coded += wrong * np.log2(max(len(cases.named) - 1.0, 1.0)) + 0.5 * np.log2(total + 1.0)
    believed = WRONG * wrong
    trust = min(1.0, max(LEAST_TRUST, (DOUBTING - cases.x.shape[1]) / (DOUBTING - TRUSTING)))
    return trust * believed + (1.0 - trust) * min(believed, coded)


@kernel
def unread_bits(cases, rules, n, fire, i):
    """A bit where a rule is right for another reason than the teacher's."""
    if fire[i] == n or cases.reason[i] < 0:
        return 0.0
    for j in range(rules.conditions[fire[i]]):
        if cases.reads[rules.column[fire[i], j], cases.reason[i]]:
            return 0.0
    return cases.weight[i]


@kernel
def list_bits(cases, rules, n, fire, without):
    """Bits of a list and of what it gets wrong, where `fire` says which rule decides each case; `without`
    is a rule that is not counted."""
    right, wrong, bits = 0.0, 0.0, 0.0
    for i in range(len(fire)):
        if rules.action[fire[i]] == cases.action[i]:
            right += cases.weight[i]
            bits += unread_bits(cases, rules, n, fire, i)
        else:
            wrong += cases.weight[i]
    bits += wrong_bits(wrong, right, cases)
    for r in range(n):
        if r != without:
            bits += rule_bits(cases, rules, r)
    return bits


@kernel
def bits_as_it_is(cases, rules, n, holds, fire):
    """`list_bits` of the whole list, with `fire` filled in."""
    first_that_holds(holds, n, NONE, fire)
    return list_bits(cases, rules, n, fire, NONE)
