"""A simplex method for priced programs: the solver of the thesis's linear program (row N3).

It is the dual simplex method with bound flips and long steps (Fourer 1985; Maros 2003). A quantity that is
not on the side of its price changes that price until it, or one of the basis, comes to the end of a piece
of its curve; the prices are right throughout, and at the end so are the values.
"""

import math

import numpy as np

from gaitwright.numerics.basis import (
    DX,
    INVERSE,
    LATEST,
    LEAST,
    MOST,
    PIECE,
    RATE,
    SHARE,
    SLACK,
    UNTIL,
    WHO,
    Y,
    build,
    exchange,
    move,
    outside_price,
    repair,
    set_inside,
    set_outside,
    set_piece,
    set_prices,
    set_share,
    set_values,
)
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.piecewise_linear import (
    ABOVE,
    CEILING,
    COLUMN,
    FAR,
    FLOOR,
    HIGH,
    KINK,
    LOW,
    PLACE,
    VALUE,
    prepare,
)
from gaitwright.numerics.status import INFEASIBLE, NOT_FINITE, SOLVED, TOO_MANY_STEPS, UNBOUNDED

TINY = 1e-9
"""A quantity this little beyond a kink is at it; rows should be of size one."""
PIVOT = 1e-8
"""Smallest share of a row that another may be exchanged for."""
STUCK = 30
"""Steps without progress after which the first candidate is taken (Bland), which cannot go in circles."""
REFRESH = 60
"""Steps after which the inverse is built anew."""
ROUNDS = 15
"""How often."""


# --- the steps -----------------------------------------------------------------------------------
@kernel
def wrong_side(t, first):
    """The quantity outside the basis that is furthest from where its price puts it, or the first; or -1."""
    worst, most = -1, TINY
    for q in range(t.shape[1]):
        v = t[VALUE, q]
        over, under = v - t[CEILING, q], t[FLOOR, q] - v
        d = over if over > under else under
        if d > most and not (first and worst >= 0):
            worst, most = q, d
    return worst


@kernel
def set_until(b, i):
    """Writes when price i of the basis comes to the end of its piece."""
    rate = b[RATE, i]
    if abs(rate) > PIVOT:
        b[UNTIL, i] = (b[Y, i] - (b[LEAST, i] if rate > 0.0 else b[MOST, i])) / rate
        b[LATEST, i] = b[UNTIL, i] + SLACK / abs(rate)
    else:
        b[UNTIL, i] = b[LATEST, i] = np.inf


@kernel
def first_end(b, own, first):
    """Which price of the basis comes to its end first, and when; -1: that of the newcomer, at `own`.

    Of those that come about together it is the one that changes fastest, or the first quantity.
    """
    limit = own
    for i in range(b.shape[1]):
        limit = b[LATEST, i] if b[LATEST, i] < limit else limit
    if limit == np.inf:
        return -1, own
    best = -1
    for i in range(b.shape[1]):
        if b[UNTIL, i] <= limit:
            better = b[WHO, i] < b[WHO, best] if first else abs(b[RATE, i]) > abs(b[RATE, best])
            if best < 0 or better:
                best = i
    if best < 0:
        return -1, own
    return best, (b[UNTIL, best] if b[UNTIL, best] > 0.0 else 0.0)


@kernel
def pass_ends(t, b, q, up, first):
    """Whose price ends the way of that of quantity q, after how far, and how far q is then off its kink.

    At the end of a piece it goes on as long as that pays: the quantity whose price ended moves on to its
    next kink (collected in dx). None (-1) and an infinite distance: it goes on for ever.
    """
    off = t[VALUE, q] - t[CEILING, q] if up else t[FLOOR, q] - t[VALUE, q]
    # The newcomer has an end of its own where it is between its two prices.
    own = t[HIGH, q] - t[LOW, q] if (t[ABOVE, q] > 0.0) != up and t[LOW, q] < t[HIGH, q] else np.inf
    while True:
        i, far = first_end(b, own, first)
        if i < 0:
            if far == np.inf:
                return i, far, off
            set_outside(t, q, up)
            off = t[VALUE, q] - t[CEILING, q] if up else t[FLOOR, q] - t[VALUE, q]
            for j in range(b.shape[1]):
                off += (1.0 if up else -1.0) * b[DX, j] * t[COLUMN + j, q]
            own = np.inf
            if off <= TINY:
                return i, far, off
            continue
        who, piece = int(b[WHO, i]), int(b[PIECE, i])
        beyond = piece - 1 if b[RATE, i] > 0.0 else piece + 1
        jump = t[KINK + beyond, who] - t[KINK + piece, who] if 0 <= beyond <= 2 else np.inf
        left = off - abs(b[RATE, i] * jump)
        if first or not left > TINY:
            return i, far, off
        off = left
        for j in range(b.shape[1]):
            b[DX, j] += b[INVERSE + j, i] * jump
        set_piece(t, b, i, beyond)
        set_until(b, i)


@kernel
def step(t, b, q, first):
    """Raises or lowers the price of quantity q as far as that pays, and returns how far; ∞: for ever."""
    n = b.shape[1]
    set_share(t, b, q)
    up = t[VALUE, q] > t[CEILING, q]
    sign, y = 1.0 if up else -1.0, outside_price(t, q)
    for i in range(n):
        b[RATE, i], b[DX, i] = sign * b[SHARE, i], 0.0
        set_until(b, i)
    i, far, off = pass_ends(t, b, q, up, first)
    if far == np.inf:
        return far
    for j in range(n):
        b[Y, j] -= far * b[RATE, j]
    if i >= 0:
        # The newcomer takes the place of i, and x goes to where the newcomer is at its kink.
        fall = off / b[RATE, i]
        for j in range(n):
            b[DX, j] -= fall * b[INVERSE + j, i]
        piece = 1 if (t[ABOVE, q] > 0.0) != up and t[LOW, q] < t[HIGH, q] else (2 if up else 0)
        set_outside(t, int(b[WHO, i]), b[PIECE, i] > (1.0 if b[RATE, i] > 0.0 else 0.0))
        exchange(b, i)
        set_inside(t, b, i, q, piece)
        b[Y, i] = y + sign * far
    move(t, b)
    return far


@kernel
def descend(t, b, most_steps):
    """Steps until every quantity is on the side of its price; returns code, last quantity, steps."""
    idle = 0
    for k in range(most_steps):
        q = wrong_side(t, idle > STUCK)
        if q < 0:
            return SOLVED, q, k
        far = step(t, b, q, idle > STUCK)
        if far == np.inf:
            return INFEASIBLE, q, k
        idle = idle + 1 if far <= SLACK else 0
    return TOO_MANY_STEPS, -1, most_steps


# --- the method ----------------------------------------------------------------------------------
@kernel
def hints_of(t, b, out):
    """Writes the basis as hints, in the order of the quantities."""
    at = 0
    for q in range(t.shape[1]):
        if t[PLACE, q] >= 0.0:
            out[at] = 3 * q + int(b[PIECE, int(t[PLACE, q])])
            at += 1


@kernel
def begin(t, b, hints, anew):
    """A basis near the hinted one in which every price is right; `anew`: outside it, go by the values."""
    build(t, b, hints)
    set_values(t, b)
    for q in range(t.shape[1]):
        if t[PLACE, q] < 0.0:
            set_outside(t, q, t[VALUE, q] > t[KINK + 1, q] if anew else t[ABOVE, q] > 0.0)
    set_prices(t, b)
    repair(t, b)
    set_values(t, b)


@kernel
def is_right(t, b):
    """Whether all prices and values, written anew, fit."""
    set_values(t, b)
    set_prices(t, b)
    for i in range(b.shape[1]):
        if b[Y, i] < b[LEAST, i] - TINY or b[Y, i] > b[MOST, i] + TINY:
            return False
    return wrong_side(t, True) < 0


@kernel
def solve(t, b, hints, basis):
    """Rounds of steps, each with a new inverse; writes the basis, returns code, quantity, steps."""
    steps = 0
    for turn in range(ROUNDS):
        begin(t, b, hints if turn == 0 else basis, turn == 0)
        code, quantity, more = descend(t, b, REFRESH)
        steps += more
        hints_of(t, b, basis)
        if code == INFEASIBLE and more < REFRESH // 2:
            return code, quantity, steps
        if code == SOLVED and (more == 0 or is_right(t, b)):
            return code, quantity, steps
    return TOO_MANY_STEPS, -1, steps


@kernel
def minimise(t, hints):
    """The least sum of prices of a program: x `(n,)`, y `(n + k,)`, basis `(n,)`, code, quantity, steps.

    `t` is the table (`priced.program`); this writes in its other rows. `hints` are integers `3 q + piece`,
    such as the basis of a like program: any are right, good ones fast. The quantity is that which cannot be
    brought within its limits (INFEASIBLE), grows (UNBOUNDED) or is no number (NOT_FINITE), else -1.
    """
    n, count = t.shape[0] - COLUMN, t.shape[1]
    x, y, basis = np.zeros(n), np.zeros(count), np.full(n, -1)
    bad = prepare(t)
    if bad >= 0:
        return x, y, basis, INFEASIBLE if t[KINK, bad] > t[KINK + 2, bad] else NOT_FINITE, bad, 0
    b = np.empty((INVERSE + n, n))
    code, quantity, steps = solve(t, b, hints, basis)
    for q in range(count):
        y[q] = b[Y, int(t[PLACE, q])] if t[PLACE, q] >= 0.0 else outside_price(t, q)
        if not math.isfinite(t[VALUE, q] + y[q]):
            code, quantity = NOT_FINITE, q
    for j in range(n):
        x[j] = t[VALUE, j]
        if code == SOLVED and abs(x[j]) >= FAR:
            code, quantity = UNBOUNDED, j
    return x, y, basis, code, quantity, steps
