"""Whole lists from nothing, to begin a search with: by covering, and from a classification tree.

Covering finds short rules that stand alone; a tree finds exceptions to exceptions. Neither is better.
"""

import numpy as np

from gaitwright.induction.decision_list import (
    FIRST,
    MOST_CONDITIONS,
    NONE,
    copy_line,
    first_that_holds,
    one_line,
    put_in,
    room_for,
)
from gaitwright.induction.grow import grow
from gaitwright.induction.scan import between
from gaitwright.numerics.compiled import kernel

STRICT = np.array([8.0, 1.5])
BEAM = 3
SPARE = 4
"""Places of a list that a start leaves free."""
NODES = 256
"""Nodes of a tree at most."""


@kernel
def cover(cases, rules, n, holds, boldness, use, fire):
    """Puts rules behind the first n of a list until none saves anything; how many there are then.

    `boldness` is how much a case that is decided rightly counts, against the bits of its action's rarity.
    """
    size = len(fire)
    active, gain = np.empty(size, np.bool_), np.empty(size)
    rule = one_line()
    first_that_holds(holds, n, NONE, fire)
    for i in range(size):
        active[i] = fire[i] == n
    while n < len(holds) - SPARE and active.any():
        rarity_gains(cases, active, boldness, gain)
        if grow(cases, active, gain, cases.weight, STRICT, BEAM, use, rule) <= 0.0:
            break
        n = put_in(rules, n, holds, n, rule, cases.x)
        for i in range(size):
            active[i] = active[i] and not holds[n - 1, i]
    first_that_holds(holds, n, NONE, fire)
    set_otherwise(cases, rules, n, fire)
    return n


@kernel
def rarity_gains(cases, active, boldness, gain):
    """What a case saves when a rule says it: the bits of its action's rarity, times the boldness."""
    counts = np.full(len(cases.named), 0.5)
    for i in range(len(active)):
        if active[i]:
            counts[cases.action[i]] += cases.weight[i]
    total = counts.sum()
    for i in range(len(active)):
        rarity = -np.log2(counts[cases.action[i]] / total)
        gain[i] = boldness * min(5.0, rarity) * cases.weight[i]


@kernel
def set_otherwise(cases, rules, n, fire):
    """Makes the last line do what is most often right where no rule fires."""
    counts = np.zeros(len(cases.named))
    for i in range(len(fire)):
        if fire[i] == n:
            counts[cases.action[i]] += cases.weight[i]
    if counts.sum() > 0.0:
        rules.action[n] = np.argmax(counts)


# --- from a tree -----------------------------------------------------------------------------------
@kernel
def from_tree(cases, rules, holds, least_gain, use, fire):
    """A list of the leaves of a greedy tree, small ones first; how many rules it has.

    A node is cut where that saves most bits of its actions' entropy, if it saves more than `least_gain`.
    """
    size, nodes = len(fire), room_for(np.int64(NODES))
    node, active = np.zeros(size, np.int64), np.empty(size, np.bool_)
    waiting, last, made, n = np.zeros(NODES, np.int64), 0, 1, 0
    weights, leaf = np.zeros(len(holds)), one_line()
    while last >= 0:
        k = waiting[last]
        last -= 1
        counts = np.zeros(len(cases.named))
        for i in range(size):
            active[i] = node[i] == k
            if active[i]:
                counts[cases.action[i]] += cases.weight[i]
        c, cut = -1, 0.0
        if counts.max() < counts.sum() and made < NODES and last + 2 < NODES:
            c, cut = best_cut(cases, active, counts, least_gain, use)
        if c >= 0 and cut_node(nodes, k, made, c, cut):
            for i in range(size):
                if node[i] == k and not cases.x[c, i] < cut:
                    node[i] = made
            waiting[last + 1], waiting[last + 2] = k, made
            last, made = last + 2, made + 1
        elif n < len(holds) - SPARE:
            leaf_of(nodes, k, np.argmax(counts), leaf)
            n = put_by_weight(cases, rules, n, holds, leaf, counts.sum(), weights)
    n -= 1  # the heaviest leaf is the last line
    first_that_holds(holds, n, NONE, fire)
    return n


@kernel
def put_by_weight(cases, rules, n, holds, leaf, weight, weights):
    """Puts a leaf in before the first that weighs more."""
    at = 0
    while at < n and weights[at] <= weight:
        at += 1
    for r in range(n, at, -1):
        weights[r] = weights[r - 1]
    weights[at] = weight
    n = put_in(rules, n, holds, at, leaf, cases.x)
    rules.action[n] = rules.action[n - 1]
    return n


@kernel
def leaf_of(nodes, k, action, leaf):
    """A node as a rule."""
    copy_line(nodes, k, leaf, FIRST)
    leaf.action[0] = action


@kernel
def cut_node(nodes, k, new, c, cut):
    """Parts a node at a cut, itself and a new one; whether it had room for a further condition."""
    at = nodes.conditions[k]
    for j in range(nodes.conditions[k]):
        if nodes.column[k, j] == c:
            at = j
    if at == MOST_CONDITIONS:
        return False
    if at == nodes.conditions[k]:
        nodes.column[k, at], nodes.low[k, at], nodes.high[k, at] = c, -np.inf, np.inf
        nodes.conditions[k] += 1
    copy_line(nodes, k, nodes, new)
    nodes.high[k, at] = min(nodes.high[k, at], cut)
    nodes.low[new, at] = max(nodes.low[new, at], cut)
    return True


@kernel
def best_cut(cases, active, counts, least_gain, use):
    """The column and the cut that part the active cases best; column −1 where none saves enough."""
    total = counts.sum()
    whole, best, column, at = entropy_bits(counts, total), least_gain + 1e-9, -1, 0.0
    below, above = np.empty_like(counts), np.empty_like(counts)
    for c in range(len(use)):
        if not use[c]:
            continue
        x, price = cases.x[c], 0.5 * cases.price[c] + 1.0 - named_at_all(cases, c)
        below[:], above[:] = 0.0, counts
        weight, last, begun = 0.0, 0.0, False
        for i in cases.order[c]:
            if not active[i]:
                continue
            if np.isnan(x[i]):
                break
            if begun and x[i] != last:
                saved = whole - entropy_bits(below, weight) - entropy_bits(above, total - weight) - price
                if saved > best:
                    best, column, at = saved, c, between(last, x[i])
            below[cases.action[i]] += cases.weight[i]
            above[cases.action[i]] -= cases.weight[i]
            weight, last, begun = weight + cases.weight[i], x[i], True
    return column, at


@kernel
def named_at_all(cases, c):
    """1.0 where the teacher has named what the column reads, for any action."""
    return 1.0 if cases.named[:, c].any() else 0.0


@kernel
def entropy_bits(counts, total):
    """Bits that tell the actions of so many cases."""
    bits = 0.0
    for count in counts:
        if count > 1e-12:
            bits -= count * np.log2(count / total)
    return bits
