"""How the stance feet share a load by the thesis's linear program, and what each limit costs (row N3).

The program is in `thesis_program`, the method in `simplex`. The prices of the limits come with the forces:
they say how much the objective would fall if one gave way.
"""

from typing import NamedTuple

import numpy as np

from gaitwright.control.thesis_program import linear_program, settings_of
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.piecewise_linear import BOUND, COLUMN, HIGH, LOW, LOWER, UPPER, price_of
from gaitwright.numerics.simplex import minimise
from gaitwright.numerics.status import SOLVED


class Shared(NamedTuple):
    """How the feet share the load, and what each limit costs."""

    x: np.ndarray
    """`(components · feet,)` the unknowns of the stance feet."""
    multipliers: np.ndarray
    """`(legs, 9)` how much the objective falls per unit that a limit moves out: friction +t1, −t1, +t2, −t2,
    normal force at 0 and at its bound, and torques of three joints: + at the upper limit, − at the lower.
    Six components: `(legs, 15)`, then tipping ±t1, ±t2 and twisting ±n."""
    unmet: np.ndarray
    """`(6,)` the scaled balance that is missing."""
    objective: float
    code: int
    """Of `codes.SENTENCES`."""
    culprit: int
    """The quantity that cannot be kept within its limits, numbered as in `basis`; -1: none."""
    basis: np.ndarray
    """`(components · legs + 1,)` hints for the next tick, numbered as if all legs were down; -1: none."""
    steps: int


# --- numbers that last from tick to tick ---------------------------------------------------------
@kernel
def lasting(q, down, c, legs):
    """Quantity q of the program, numbered as if all legs were down; `down`: the legs in stance."""
    each, n, whole = 2 * c + 2, c * down.size + 1, c * legs + 1
    if q < n - 1:
        return c * down[q // c] + q % c
    if q == n - 1:
        return whole - 1
    k = (q - n) // each
    if k >= down.size:
        return whole + each * (legs - down.size) + q - n
    return whole + each * down[k] + (q - n) % each


@kernel
def current(q, slot, m, c):
    """The quantity of the program that has the lasting number q, or -1; `slot`: place of each leg or -1."""
    each, n, legs = 2 * c + 2, c * m + 1, slot.size
    whole = c * legs + 1
    if q < 0 or q >= whole + each * legs + 6:
        return -1
    if q < whole - 1:
        return c * slot[q // c] + q % c if slot[q // c] >= 0 else -1
    if q == whole - 1:
        return n - 1
    leg = (q - whole) // each
    if leg >= legs:
        return n + each * m + q - whole - each * legs
    return n + each * slot[leg] + (q - whole) % each if slot[leg] >= 0 else -1


@kernel
def hints_now(hints, down, c, legs):
    """Last tick's basis in the numbers of this one; where there is none, a guess (-1: no hint)."""
    n = c * down.size + 1
    slot = np.full(legs, -1)
    for k in range(down.size):
        slot[down[k]] = k
    out = np.full(n, -1)
    known = 0
    for h in hints:
        q = current(h // 3, slot, down.size, c)
        if q >= 0 and known < n:
            out[known] = 3 * q + h % 3
            known += 1
    if known == 0:
        # The balance holds, and all feet push alike.
        for i in range(n):
            k, row = i - 6, n + (2 * c + 2) * down.size + i
            if k < 0:
                out[i] = 3 * row + 1
            elif k < down.size:
                out[i] = 3 * (n + (2 * c + 2) * k + 7) + 2
    return out


# --- the answer ----------------------------------------------------------------------------------
@kernel
def limit_price(t, q, y):
    """What of the price y of quantity q rests on its limits: > 0 on the upper, < 0 on the lower."""
    below_top = t[HIGH, q] if t[BOUND, q] < t[UPPER, q] else t[LOW, q]
    above_bottom = t[LOW, q] if t[BOUND, q] > t[LOWER, q] else t[HIGH, q]
    return max(y - below_top, 0.0) + min(y - above_bottom, 0.0)


@kernel
def limit_prices(t, y, down, c, legs):
    """Prices of the limits `(legs, 9)`, with six components `(legs, 15)`, as in `Shared`."""
    out = np.zeros((legs, 15 if c == 6 else 9))
    n, each = c * down.size + 1, 2 * c + 2
    for k in range(down.size):
        prices, r, normal = out[down[k]], n + each * k, c * k + 2
        for i in range(4):
            prices[i] = limit_price(t, r + i, y[r + i])
        price = limit_price(t, normal, y[normal])
        prices[4], prices[5] = max(-price, 0.0), max(price, 0.0)
        for j in range(3):
            prices[6 + j] = limit_price(t, r + 4 + j, y[r + 4 + j])
        for i in range(9, out.shape[1]):
            prices[i] = limit_price(t, r + i - 1, y[r + i - 1])
    return out


@kernel
def total_price(t, x):
    """The objective, and how far the last six rows, the balance, are from their bounds."""
    total, off = 0.0, np.zeros(6)
    first = t.shape[1] - 6
    for q in range(t.shape[1]):
        v = 0.0
        for j in range(x.size):
            v += t[COLUMN + j, q] * x[j]
        total += price_of(t, q, v)
        if q >= first:
            off[q - first] = v - t[BOUND, q]
    return total, off


@kernel
def distribute_linear(
    load_numbers,
    stance,
    share,
    friction,
    normal,
    previous,
    tau_max,
    weight,
    height,
    qd,
    settings_numbers,
    hints,
):
    """How the stance feet share a packed `Load` by the thesis's program: a `Shared`.

    `previous` are the last foot forces `(legs, 3)` in world axes [N], `hints` the last basis; all -1: none.
    """
    legs = stance.size
    c = 6 if settings_of(settings_numbers).components > 3.0 else 3
    down = np.flatnonzero(stance)
    basis = np.full(c * legs + 1, -1)
    if down.size == 0:
        return Shared(
            np.zeros(0), np.zeros((legs, 15 if c == 6 else 9)), np.zeros(6), 0.0, SOLVED, -1, basis, 0
        )
    t = linear_program(
        load_numbers, stance, share, friction, normal, previous, tau_max, weight, height, qd, settings_numbers
    )
    start = hints_now(hints, down, c, legs)
    x, y, final, code, culprit, steps = minimise(t, start)
    for i in range(final.size):
        if final[i] >= 0:
            basis[i] = 3 * lasting(final[i] // 3, down, c, legs) + final[i] % 3
    objective, unmet = total_price(t, x)
    if culprit >= 0:
        culprit = lasting(culprit, down, c, legs)
    prices = limit_prices(t, y, down, c, legs)
    return Shared(x[: c * down.size], prices, unmet, objective, code, culprit, basis, steps)
