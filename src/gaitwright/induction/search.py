"""A list made better: parts of it are taken out and put in anew, and what is shorter stays.

Large neighbourhood search (Shaw, 1998) with a little annealing. Each round changes some rules, picked by
chance and by where the list errs, and prunes.
"""

import numpy as np

from gaitwright.induction.decision_list import (
    FIRST,
    NONE,
    copy_list,
    first_that_holds,
    one_line,
    put_in,
    room_for,
    take_out,
)
from gaitwright.induction.grow import grow
from gaitwright.induction.length import WRONG, bits_as_it_is
from gaitwright.induction.prune import prune
from gaitwright.induction.starts import SPARE, cover, set_otherwise
from gaitwright.numerics.compiled import kernel

PLAIN = np.array([1.0])
PLAIN.flags.writeable = False  # as kernels see it: one version of each serves both
WIDTH = 2
"""Seeds that are tried for a rule put in."""
SLIGHT = 0.05
"""Bits that a new rule gains where the list is right already: of two rules the wider one is put in."""
WARMTH = 3.0
"""Bits by which a round may make a list longer at first; it falls to nothing in the last."""
SHARE = 0.35
"""Of the columns, so many are looked at in most rounds: it is quicker, and no round like another."""
BOLD = np.array([4.0, 2.0, 1.0])


@kernel
def draw_from(seed):
    """Begins the chance of all kernels here anew: the same seed, the same draws."""
    np.random.seed(seed)


@kernel
def improve(cases, rules, n, holds, rounds, seed, fire):
    """The list after so many rounds, in place; how many rules it has and its bits, never more than before."""
    draw_from(seed)
    bits = bits_as_it_is(cases, rules, n, holds, fire)
    best, kept = room_for(len(rules.action)), np.empty_like(holds)
    draft, drawn = room_for(len(rules.action)), np.empty_like(holds)
    copy_list(rules, holds, n, best, kept)
    least, size = bits, n
    use = np.ones(len(cases.price), np.bool_)
    for turn in range(rounds):
        copy_list(rules, holds, n, draft, drawn)
        pick_columns(rules, n, use)
        m = changed(cases, draft, n, drawn, use, fire)
        m, now = prune(cases, draft, m, drawn, fire)
        warmth = WARMTH * (1.0 - turn / rounds)
        if now <= bits or np.random.random() < np.exp((bits - now) / warmth):
            bits, n = now, m
            copy_list(draft, drawn, m, rules, holds)
            if bits < least - 1e-9:
                least, size = bits, n
                copy_list(rules, holds, n, best, kept)
    copy_list(best, kept, size, rules, holds)
    first_that_holds(holds, size, NONE, fire)
    return size, least


@kernel
def pick_columns(rules, n, use):
    """Columns to look at: some by chance, and most of those that the list reads."""
    share = SHARE if np.random.random() < 0.7 else 1.0
    for c in range(len(use)):
        use[c] = np.random.random() < share
    for r in range(n):
        for j in range(rules.conditions[r]):
            if np.random.random() < 0.7:
                use[rules.column[r, j]] = True


@kernel
def changed(cases, rules, n, holds, use, fire):
    """One of four changes: an exception in front of a rule that errs, a new tail, some rules out and others
    in, or a rule in front of all. How many rules there are then."""
    first_that_holds(holds, n, NONE, fire)
    errs = errors_of(cases, rules, n, fire)
    kind, cost = np.random.random(), WRONG if np.random.random() < 0.6 else 0.5 * WRONG
    if kind < 0.3 and errs.sum() > 0.0:
        at = drawn_by(errs)
        return exchanged(cases, rules, n, holds, at, at if kind < 0.2 else NONE, cost, use, fire)
    if kind < 0.4 and n > 1:
        at = np.random.randint(0, n)
        rules.action[at] = rules.action[n]
        return cover(cases, rules, at, holds, BOLD[np.random.randint(0, 3)], use, fire)
    if n == 0:
        return exchanged(cases, rules, n, holds, FIRST, NONE, cost, use, fire)
    out, at = np.random.randint(1, 4), 0
    for k in range(min(out, n)):
        at = np.random.randint(0, n)
        if k == 0 and errs.sum() > 0.0 and np.random.random() < 0.5:
            at = min(drawn_by(errs), n - 1)
        n = take_out(rules, n, holds, at)
    first_that_holds(holds, n, NONE, fire)
    set_otherwise(cases, rules, n, fire)
    for k in range(out + 1):
        place = min(at, n) if k == 0 else np.random.randint(0, n + 1)
        n = exchanged(cases, rules, n, holds, place, NONE, cost, use, fire)
    return n


@kernel
def errors_of(cases, rules, n, fire):
    """The weight of what each rule decides wrongly, the last line's behind."""
    errs = np.zeros(n + 1)
    for i in range(len(fire)):
        if rules.action[fire[i]] != cases.action[i]:
            errs[fire[i]] += cases.weight[i]
    return errs


@kernel
def drawn_by(weights):
    """A place drawn in proportion to its weight."""
    left = np.random.random() * weights.sum()
    for k in range(len(weights)):
        left -= weights[k]
        if left < 0.0:
            return k
    return len(weights) - 1


@kernel
def exchanged(cases, rules, n, holds, at, only, cost, use, fire):
    """Puts the best rule in at a place, given all others: it gains what they get wrong, and loses what they
    get right. With `only`, for cases that this rule decides alone. How many rules there are then."""
    if n >= len(holds) - SPARE:
        return n
    size = len(fire)
    active, gain, loss, rule = np.empty(size, np.bool_), np.empty(size), np.empty(size), one_line()
    first_that_holds(holds, n, NONE, fire)
    for i in range(size):
        active[i] = fire[i] >= at if only < 0 else fire[i] == only
        right = rules.action[fire[i]] == cases.action[i]
        gain[i] = (SLIGHT if right else cost) * cases.weight[i]
        loss[i] = cost * cases.weight[i] if right else 0.0
    if grow(cases, active, gain, loss, PLAIN, WIDTH, use, rule) <= 0.0:
        return n
    n = put_in(rules, n, holds, at, rule, cases.x)
    first_that_holds(holds, n, NONE, fire)
    set_otherwise(cases, rules, n, fire)
    return n
