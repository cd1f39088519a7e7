"""Steps through time: the thesis's Euler, and three others (row N7; equations.md §3).

All are explicit, and all are rows of one table, run by one kernel over one right-hand side (`system`): a
right-hand side that is compiled into one place only compiles in a quarter of the time.

`refresh`: Armstrong's slow coefficients are computed anew at every evaluation (1), or at the start of
every so-manieth step and kept in between (2, 3, …).
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.dynamics.armstrong import slow_coefficients
from gaitwright.errors import unknown
from gaitwright.numerics.compiled import kernel
from gaitwright.plant.armstrong.system import (
    parts,
    position_rates,
    rates_begin,
    rotations,
    settle,
    velocity_rates,
)
from gaitwright.plant.names import INTEGRATORS

SHORTEST = 1e-7
"""Adaptive steps get no shorter [s]: at a blow, where no step is short enough, time must go on."""


class Method(NamedTuple):
    """An explicit Runge and Kutta method, or one like it."""

    stages: np.ndarray
    """`(stages, stages)` row s: the share of each earlier stage's rates in the point of stage s."""
    weights: np.ndarray
    """`(stages,)` of the rates in the step."""
    error: np.ndarray
    """`(stages,)` of the rates in what a method of lower order would do otherwise; all zero where none is."""
    order: int
    velocities_first: bool
    """Positions move with the velocities after the step."""


METHODS = {
    "euler": Method(np.zeros((1, 1)), np.ones(1), np.zeros(1), 1, False),
    "semi-implicit": Method(np.zeros((1, 1)), np.ones(1), np.zeros(1), 1, True),
    "rk4": Method(
        np.array([[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1.0, 0]]),
        np.array([1, 2, 2, 1]) / 6,
        np.zeros(4),
        4,
        False,
    ),
    # Bogacki and Shampine 1989: order 3, with order 2 inside.
    "adaptive": Method(
        np.array([[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 3 / 4, 0, 0], [2 / 9, 1 / 3, 4 / 9, 0]]),
        np.array([2 / 9, 1 / 3, 4 / 9, 0]),
        np.array([-5, 6, 8, -9]) / 72,
        3,
        False,
    ),
}


def method_named(integrator: str) -> Method:
    """The integrator of that name; `WrongUse` where there is none."""
    if integrator not in INTEGRATORS:
        raise unknown("integrator", integrator, INTEGRATORS)
    return METHODS[integrator]


@kernel
def stages(system, drive, y, method, h, slow, fresh, k, point):
    """Writes the rates of every stage of a step of `h` seconds into the rows of `k`."""
    begin = rates_begin(system)
    for s in range(method.weights.size):
        point[:] = y
        for j in range(s):
            for i in range(y.size):
                point[i] += h * method.stages[s, j] * k[j, i]
        velocity_rates(system, drive, point, slow, fresh, k[s])
        if method.velocities_first:
            for i in range(begin, y.size):
                point[i] += h * k[s, i]
        position_rates(system, drive, point, k[s])


@kernel
def error_of(y, method, h, k, tolerance):
    """How far a step is off, root mean square, as a multiple of what the tolerance allows."""
    total = 0.0
    for i in range(y.size):
        off = 0.0
        for s in range(method.error.size):
            off += method.error[s] * k[s, i]
        total += (h * off / (tolerance * (1.0 + abs(y[i])))) ** 2
    return math.sqrt(total / y.size)


@kernel
def advance(system, drive, y, method, h, seconds, refresh, tolerance):
    """Changes the state `y` into that after `seconds`; returns the step to go on with and the steps taken.

    `h`: the step [s]; where the method tells its error, the one to try first, and steps then become as
    long as `tolerance` allows (per 1 + the size of each number). A state that is no longer a number
    stays so.
    """
    adapts = np.abs(method.error).max() > 0.0
    k, point = np.zeros((method.weights.size, y.size)), np.empty(y.size)
    slow = slow_coefficients(system.tree, rotations(parts(system, y).quaternion))
    left, taken, since = seconds, 0, 0
    while left > 1e-9 * seconds:
        step = min(h, left)
        if refresh > 1 and since == refresh:
            slow, since = slow_coefficients(system.tree, rotations(parts(system, y).quaternion)), 0
        stages(system, drive, y, method, step, slow, refresh == 1, k, point)
        error = error_of(y, method, step, k, tolerance) if adapts else 0.0
        if not math.isfinite(error) and step <= SHORTEST:
            y[:] = math.nan
            break
        if error <= 1.0 or step <= SHORTEST:
            for s in range(method.weights.size):
                for i in range(y.size):
                    y[i] += step * method.weights[s] * k[s, i]
            settle(system, drive, y)
            left, taken, since = left - step, taken + 1, since + 1
        if adapts:
            h = next_step(h, step, error, method.order)
    return h, taken


@kernel
def next_step(h, step, error, order):
    """The step to try next, after one of `step` seconds, where `h` was wanted, was off by `error`."""
    change = 0.2
    if math.isfinite(error):
        change = min(4.0, max(0.2, 0.9 * max(error, 1e-12) ** (-1.0 / order)))
    if step < h and error <= 1.0:  # cut short by the end of the time, it says nothing against the longer one
        return max(h, step * change)
    return max(step * change, SHORTEST)
