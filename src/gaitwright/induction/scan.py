"""The best interval of every column for every action, in one pass over each column (Kadane's scan)."""

import numpy as np

from gaitwright.numerics.compiled import kernel

NEVER = -1e300
"""The score of what is no interval."""


@kernel
def best_intervals(cases, active, gain, loss, only, use, price, score, low, high):
    """For each column and action the interval of the highest score, into three tables of them.

    A case in it adds its `gain` where the action is its own, and takes its `loss` where it is another's;
    `price` are the bits of a first and of a second bound. Only cases that are `active` and columns in `use`
    are looked at, and only the action `only` where that is one. Cuts lie midway between two values that
    differ.
    """
    actions = score.shape[1]
    first, beyond = (0, actions) if only < 0 else (only, only + 1)
    state = np.empty((9, actions))
    for c in range(len(score)):
        score[c, :] = NEVER
        if use[c]:
            scan_column(cases, c, active, gain, loss, first, beyond, price, state)
            for a in range(first, beyond):
                pick_interval(state, a, price, score, low, high, c)


RUN, BEGAN, SUM, LEAST, LEAST_AT, BEST, BEST_LOW, BEST_HIGH, PREFIX = range(9)
"""Rows of a scan's state, by action: the sum of the run that ends here and where it began; the sum of all so
far, the least that was, and where; the best interval that ended, and its bounds; the best sum from the lower
end on."""


@kernel
def scan_column(cases, c, active, gain, loss, first, beyond, price, state):
    """One pass over a column: groups of cases of one value in ascending order."""
    order, x, n = cases.order[c], cases.x[c], cases.order.shape[1]
    state[:] = 0.0
    for a in range(first, beyond):
        state[RUN, a], state[BEGAN, a] = NEVER, -np.inf
        state[LEAST_AT, a], state[BEST, a], state[PREFIX, a] = -np.inf, NEVER, NEVER
    delta = np.empty(state.shape[1])
    i, last, begun = 0, 0.0, False
    while True:
        while i < n and not active[order[i]]:
            i += 1
        if i == n:
            return
        value, cut = x[order[i]], -np.inf
        if np.isnan(value):  # what was not measured stands last, and lies in no interval
            return
        if begun:
            cut = between(last, value)
            close_at(state, cut, first, beyond, price)
        delta[:] = 0.0
        taken = 0.0
        while i < n and (not active[order[i]] or x[order[i]] == value):
            k = order[i]
            if active[k]:
                taken -= loss[k]
                delta[cases.action[k]] += gain[k] + loss[k]
            i += 1
        for a in range(first, beyond):
            more = delta[a] + taken
            state[SUM, a] += more
            if state[RUN, a] > 0.0:
                state[RUN, a] += more
            else:
                state[RUN, a], state[BEGAN, a] = more, cut
        last, begun = value, True


@kernel
def between(low, high):
    """A number that keeps two neighbours apart: the lower one below it, the upper one not."""
    cut = 0.5 * (low + high)
    return cut if cut > low else high


@kernel
def close_at(state, cut, first, beyond, price):
    """What intervals that end at a cut are worth."""
    for a in range(first, beyond):
        if state[SUM, a] > state[PREFIX, a]:
            state[PREFIX, a] = state[SUM, a]
            if state[BEST, a] < state[SUM, a] - price[0]:
                state[BEST, a] = state[SUM, a] - price[0]
                state[BEST_LOW, a], state[BEST_HIGH, a] = -np.inf, cut
        worth = state[RUN, a] - price[0] - price[1]
        if state[BEGAN, a] > -np.inf and worth > state[BEST, a]:
            state[BEST, a], state[BEST_LOW, a], state[BEST_HIGH, a] = worth, state[BEGAN, a], cut
        if state[LEAST_AT, a] == -np.inf or state[SUM, a] < state[LEAST, a]:
            state[LEAST, a], state[LEAST_AT, a] = state[SUM, a], cut


@kernel
def pick_interval(state, a, price, score, low, high, c):
    """The best of the runs that ended and of those that go on to the upper end."""
    score[c, a], low[c, a], high[c, a] = state[BEST, a], state[BEST_LOW, a], state[BEST_HIGH, a]
    if state[LEAST_AT, a] > -np.inf:
        worth = state[SUM, a] - state[LEAST, a] - price[0]
        if worth > score[c, a]:
            score[c, a], low[c, a], high[c, a] = worth, state[LEAST_AT, a], np.inf
