"""The thesis's force distribution, a linear program (row N3; equations.md §5).

Minimises peak normal force against joint power, weighed by ξ. As printed in the thesis the objective is
the same for every feasible force; power counts here as its absolute value and the peak as a variable.
"""

import math

import numpy as np

from gaitwright.compiled import kernel
from gaitwright.control.demand import load_of
from gaitwright.control.forces import balance_rows, contact_frame, limit_rows, to_contact
from gaitwright.geometry import GRAVITY, dot, vec

UNMET = 10.0
"""Price of an unmet share of the wrench, against the peak force in weights."""
XI = 0.5
"""ξ: price of the power; that of the peak normal force is 1 − ξ."""
CHANGE = 0.1
"""Price of a change of force from tick to tick: keeps the solution from jumping between vertices."""
FAR = 100.0
"""A bound that no unknown reaches, in weights."""


@kernel
def projected(rows, wanted):
    """`wanted` brought into the range of `rows`, by Gram and Schmidt.

    Two feet cannot make a moment about the line between them; without this the program would put that
    whole defect on one axis.
    """
    left = rows.copy()
    out = np.zeros(wanted.size)
    for j in range(left.shape[1]):
        column = left[:, j]
        length = math.sqrt((column * column).sum())
        if length < 1e-6:
            continue
        unit = column / length
        out += (unit * wanted).sum() * unit
        for k in range(j + 1, left.shape[1]):
            left[:, k] -= (unit * left[:, k]).sum() * unit
    return out


@kernel
def power_rows(load, qd, stance, frame, weight, pace, out, bound):
    """Writes rows with power_j = bound_j − out_j · x, in weights times √(g h), of the stance joints."""
    k = 0
    for leg in range(stance.size):
        if not stance[leg]:
            continue
        for j in range(3):
            rate = qd[leg, j] / pace
            for i in range(3):
                out[3 * k + j, 3 * k + i] = rate * dot(vec(load.push[leg, j]), vec(frame[i]))
            bound[3 * k + j] = rate * load.free[leg, j] / weight
        k += 1


@kernel
def linear_program(load_numbers, stance, share, normal, previous, tau_max, weight, height, qd):
    """The program in the form `solve_lp` reads: cost, rows, lower and upper bounds.

    Unknowns: forces x (3m), unmet balance (6), peak normal force (1), power (3m), change of force (3m);
    all but the first are at least the absolute value of what they stand for.
    """
    load = load_of(load_numbers)
    m = stance.sum()
    frame = contact_frame(normal)
    balance, wanted = balance_rows(load.wrench, load.arm, stance, frame, weight, height)
    if m < 3:
        wanted = projected(balance, wanted)
    limits, low, high = limit_rows(load.free, load.push, stance, share, frame, tau_max, weight)
    x_prev = to_contact(previous, stance, frame, weight)
    f = 3 * m
    unmet, peak, power, change = f, f + 6, f + 7, 2 * f + 7
    n = 3 * f + 7
    cost = np.zeros(n)
    cost[unmet:peak] = UNMET
    cost[peak] = 1.0 - XI
    cost[power:change] = XI
    cost[change:] = CHANGE

    count = 12 + 7 * m + m + 4 * f
    rows = np.zeros((count, n))
    lower, upper = np.full(n + count, -FAR), np.full(n + count, FAR)
    lower[:f], upper[:f] = low[:f], high[:f]
    lower[f:n] = 0.0
    r = 0
    for i in range(6):
        r = bound_absolute(rows, upper, n, r, balance[i], wanted[i], unmet + i)
    rows[r : r + 7 * m, :f] = limits
    lower[n + r : n + r + 7 * m], upper[n + r : n + r + 7 * m] = low[f:], high[f:]
    r += 7 * m
    for k in range(m):
        rows[r, 3 * k + 2], rows[r, peak] = 1.0, -1.0
        upper[n + r] = 0.0
        r += 1
    works, free = np.zeros((f, f)), np.zeros(f)
    power_rows(load, qd, stance, frame, weight, math.sqrt(GRAVITY * height), works, free)
    unit = np.zeros(f)
    for k in range(f):
        r = bound_absolute(rows, upper, n, r, works[k], free[k], power + k)
        unit[:] = 0.0
        unit[k] = 1.0
        r = bound_absolute(rows, upper, n, r, unit, x_prev[k], change + k)
    return cost, rows, lower, upper


@kernel
def bound_absolute(rows, upper, n, r, row, value, variable):
    """Two rows that keep |row · x − value| below a variable; returns the next free row."""
    for i in range(row.size):
        rows[r, i], rows[r + 1, i] = row[i], -row[i]
    rows[r, variable] = rows[r + 1, variable] = -1.0
    upper[n + r], upper[n + r + 1] = value, -value
    return r + 2
