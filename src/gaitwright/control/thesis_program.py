"""The thesis's force distribution, a linear program (row N3; equations.md §5).

Minimises peak normal force against joint power, weighed by ξ, under friction, normal-force and two-sided
torque limits. As printed in the thesis the objective is the same for every force of point feet that
balances; here power counts by its absolute value and the peak as a variable, unless asked otherwise.

Unknowns: per stance foot the force along two tangents and the normal [weights], with six components also
the moment about these axes [weight × height]; last the peak normal force. Rows: per foot friction (4),
torques over their limits (3), normal force less the peak (1), with six components also centre of pressure
and twist (6); last the balance (6). Power and torque limit are one row: |τ| has a price and an end.
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.control.forces import (
    FRICTION,
    MOMENT_WEIGHTS,
    MOST_NORMAL,
    PYRAMID,
    balance_rows,
    contact_frame,
    to_contact,
)
from gaitwright.control.inverse_dynamics import load_of
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, dot, vec
from gaitwright.numerics.piecewise_linear import COLUMN, blank, set_price

UNMET = 10.0
"""Price of an unmet share of the wrench, against the peak force in weights."""
XI = 0.5
"""ξ: price of the power; that of the peak normal force is 1 − ξ."""
CHANGE = 0.1
"""Price of a change of force from tick to tick: keeps the solution from jumping between vertices."""
ROLL_LEVER, PITCH_LEVER, TWIST_LEVER = 0.02, 0.03, 0.02
"""Largest moments of a foot with six components about its two tangents and normal, per normal force [m]."""


class LinearSettings(NamedTuple):
    """What counts in the distribution; in kernels as one array, `np.array(settings)`."""

    xi: float = XI
    unmet: float = UNMET
    """∞: the balance is an equation, as in the thesis, and may be impossible."""
    change: float = CHANGE
    """0: none, as in the thesis."""
    friction: float = FRICTION
    """μ′: half-width of the friction pyramid, at most; it is less on ground with less grip."""
    most_normal: float = MOST_NORMAL
    """Largest normal force of one foot [weights]."""
    components: float = 3.0
    """Unknowns of a foot: 3, or 6 with moments; the levers count for these."""
    roll_lever: float = ROLL_LEVER
    pitch_lever: float = PITCH_LEVER
    twist_lever: float = TWIST_LEVER
    literal: float = 0.0
    """1: the objective as printed, signed power and the sum of the normal forces."""


@kernel
def settings_of(numbers):
    """The `LinearSettings` packed in an array."""
    return LinearSettings(
        numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7],
        numbers[8], numbers[9],
    )  # fmt: skip


@kernel
def projected(rows, wanted):
    """`wanted` brought into the range of `rows`, by Gram and Schmidt.

    Two feet cannot make a moment about the line between them; without this the program would put that
    whole defect on one axis.
    """
    left = rows.copy()
    out = np.zeros(wanted.size)
    for j in range(left.shape[1]):
        length = along = 0.0
        for i in range(wanted.size):
            length += left[i, j] * left[i, j]
            along += left[i, j] * wanted[i]
        if length < 1e-12:
            continue
        for i in range(wanted.size):
            out[i] += along / length * left[i, j]
        for k in range(j + 1, left.shape[1]):
            shadow = 0.0
            for i in range(wanted.size):
                shadow += left[i, j] * left[i, k]
            for i in range(wanted.size):
                left[i, k] -= shadow / length * left[i, j]
    return out


@kernel
def write_balance(t, settings, c, load, stance, frame, weight, height):
    """Balance rows, exact or at a price."""
    m = stance.sum()
    n = c * m + 1
    forces, wanted = balance_rows(load.wrench, load.arm, stance, frame, weight, height)
    if m < 3 and c == 3 and settings.unmet < np.inf:
        wanted = projected(forces, wanted)
    r = n + (2 * c + 2) * m
    for i in range(6):
        for k in range(m):
            for j in range(3):
                t[COLUMN + c * k + j, r + i] = forces[i, 3 * k + j]
                if c == 6 and i >= 3:
                    t[COLUMN + 6 * k + 3 + j, r + i] = MOMENT_WEIGHTS[i - 3] * frame[j, i - 3]
        w = wanted[i]
        if settings.unmet < np.inf:
            set_price(t, r + i, -np.inf, w, np.inf, -settings.unmet, settings.unmet)
        else:
            set_price(t, r + i, w, w, w, 0.0, 0.0)


@kernel
def write_unknowns(t, settings, k, c, most, before, height):
    """Limits of the unknowns of stance foot k, and the price of their change.

    Those of tangents and moments lie beyond what friction and levers allow, so that it is these that cost.
    """
    x = c * k
    wide = (1.0 + settings.friction) * most
    for j in range(2):
        set_price(t, x + j, -wide, before[3 * k + j], wide, -settings.change, settings.change)
    set_price(t, x + 2, 0.0, before[3 * k + 2], most, -settings.change, settings.change)
    levers = (settings.roll_lever, settings.pitch_lever, settings.twist_lever)
    for j in range(3, c):
        limit = 2.0 * levers[j - 3] * most / height
        set_price(t, x + j, -limit, 0.0, limit, 0.0, 0.0)


@kernel
def write_torques(t, settings, r, x, c, load, leg, frame, limits, qd, weight, height):
    """Rows of a leg's torques over their limits, less those of the unloaded foot; priced as power."""
    pace = math.sqrt(GRAVITY * height)
    for j in range(3):
        limit = limits[leg, j]
        for i in range(3):
            t[COLUMN + x + i, r + j] = -dot(vec(load.push[leg, j]), vec(frame[i])) * weight / limit
            if c == 6:
                t[COLUMN + x + 3 + i, r + j] = (
                    -dot(vec(load.turn[leg, j]), vec(frame[i])) * weight * height / limit
                )
        rest = load.free[leg, j] / limit
        price = settings.xi * qd[leg, j] * limit / (weight * pace)
        low = price if settings.literal else -abs(price)
        high = price if settings.literal else abs(price)
        set_price(t, r + j, -1.0 - rest, -rest, 1.0 - rest, low, high)


@kernel
def write_foot(t, settings, r, x, c, friction, height):
    """Rows of a foot's friction, its share in the peak, its centre of pressure and its twist."""
    width = min(settings.friction, PYRAMID * friction)
    for i in range(4):
        t[COLUMN + x + i // 2, r + i] = 1.0 if i % 2 == 0 else -1.0
        t[COLUMN + x + 2, r + i] = -width
        set_price(t, r + i, -np.inf, 0.0, 0.0, 0.0, 0.0)
    t[COLUMN + x + 2, r + 7] = 1.0
    if settings.literal:
        set_price(t, r + 7, -np.inf, 0.0, np.inf, 1.0 - settings.xi, 1.0 - settings.xi)
    else:
        t[t.shape[0] - 1, r + 7] = -1.0
        set_price(t, r + 7, -np.inf, 0.0, 0.0, 0.0, 0.0)
    levers = (settings.roll_lever, settings.pitch_lever, settings.twist_lever)
    for i in range(6 if c == 6 else 0):
        t[COLUMN + x + 3 + i // 2, r + 8 + i] = 1.0 if i % 2 == 0 else -1.0
        t[COLUMN + x + 2, r + 8 + i] = -levers[i // 2] / height
        set_price(t, r + 8 + i, -np.inf, 0.0, 0.0, 0.0, 0.0)


@kernel
def linear_program(
    load_numbers, stance, share, friction, normal, previous, tau_max, weight, height, qd, numbers
):
    """The program as a table that `simplex.minimise` reads."""
    settings = settings_of(numbers)
    load = load_of(load_numbers)
    c = 6 if settings.components > 3.0 else 3
    m = stance.sum()
    n, each = c * m + 1, 2 * c + 2
    frame = contact_frame(normal)
    before = to_contact(previous, stance, frame, weight)
    t = blank(n, each * m + 6)
    peak = 0.0 if settings.literal else 1.0 - settings.xi
    set_price(t, n - 1, 0.0, 0.0, 2.0 * settings.most_normal, peak, peak)
    write_balance(t, settings, c, load, stance, frame, weight, height)
    k = 0
    for leg in range(stance.size):
        if stance[leg]:
            r = n + each * k
            write_unknowns(t, settings, k, c, settings.most_normal * share[leg], before, height)
            write_foot(t, settings, r, c * k, c, friction[leg], height)
            write_torques(
                t, settings, r + 4, c * k, c, load, leg, frame, tau_max, qd, weight, height
            )  # fmt: skip
            k += 1
    return t
