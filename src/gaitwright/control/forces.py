"""How the stance feet share a load: quadratic program by default, the thesis's linear one by choice (row N3).

Unknowns are the foot forces in the contact frame (two tangents, normal), in units of the weight. Both
programs have the same limits: friction pyramid, normal force between 0 and a bound that ramps at both
ends of stance, torque limits of both signs (equations.md §5, control.md "Force distribution"). Every answer
tells what each limit costs, its *price*, as an array `(legs, LIMITS)`: four sides of the friction pyramid
(+t₁, −t₁, +t₂, −t₂), normal force at 0, at its bound, and the torques of the three joints, whose price is
positive at the upper limit and negative at the lower one. 0: not at that limit, or in swing.
"""

import numpy as np

from gaitwright.control.inverse_dynamics import load_of
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import cross, dot, scale, sub, vec
from gaitwright.numerics.quadratic_program import minimise
from gaitwright.signals import GRIP

PYRAMID = 0.625
"""Half-width of the friction pyramid, as a share of the cone's: its edges reach 0.884 of that."""
FRICTION = PYRAMID * GRIP
"""Half-width of the pyramid on ground of which nothing is known."""
MOST_NORMAL = 1.5
"""Largest normal force of one foot, in weights."""
FORCE_WEIGHTS = (1.0, 1.0, 1.5)
"""Weights of the force rows, once divided by the weight."""
MOMENT_WEIGHTS = (1.0, 1.0, 0.6)
"""Weights of the moment rows, once divided by weight times height."""
SMALL = 1e-4
"""Price of a force in itself (‖f‖²), which spreads the load."""
SMOOTH = 1e-3
"""Price of a change of force from tick to tick (‖f − f_prev‖²)."""
LIMITS = 9
"""Limits of one foot that have a price."""


@kernel
def contact_frame(normal):
    """Rows: two tangents and the normal of the ground, world axes `(3, 3)`."""
    n = vec(normal)
    t = sub((1.0, 0.0, 0.0), scale(n[0], n))
    t = scale(1.0 / np.sqrt(dot(t, t)), t)
    b = cross(n, t)
    out = np.empty((3, 3))
    for i in range(3):
        out[0, i], out[1, i], out[2, i] = t[i], b[i], n[i]
    return out


@kernel
def balance_rows(wrench, arm, stance, frame, weight, height):
    """Scaled balance: `rows @ x` should be `wanted`, `(6, 3m)` and `(6,)`, for `m` stance feet."""
    m = stance.sum()
    rows, wanted = np.empty((6, 3 * m)), np.empty(6)
    for i in range(3):
        wanted[i] = FORCE_WEIGHTS[i] * wrench[i] / weight
        wanted[3 + i] = MOMENT_WEIGHTS[i] * wrench[3 + i] / (weight * height)
    k = 0
    for leg in range(stance.size):
        if stance[leg]:
            for j in range(3):
                direction = vec(frame[j])
                moment = cross(vec(arm[leg]), direction)
                for i in range(3):
                    rows[i, 3 * k + j] = FORCE_WEIGHTS[i] * direction[i]
                    rows[3 + i, 3 * k + j] = MOMENT_WEIGHTS[i] * moment[i] / height
            k += 1
    return rows, wanted


@kernel
def limit_rows(free, push, stance, share, friction, frame, tau_max, weight):
    """Bounds on x and on `rows @ x`: `(7m, 3m)` rows, and lower, upper `(10m,)` with x's own first."""
    m = stance.sum()
    rows = np.zeros((7 * m, 3 * m))
    lower, upper = np.empty(10 * m), np.empty(10 * m)
    k = 0
    for leg in range(stance.size):
        if not stance[leg]:
            continue
        x = 3 * k
        most = MOST_NORMAL * share[leg]
        wide = (1.0 + PYRAMID * friction[leg]) * most  # beyond what friction allows: it is that which counts
        for j in range(2):
            lower[x + j], upper[x + j] = -wide, wide
        lower[x + 2], upper[x + 2] = 0.0, most
        # Friction: −∞ ≤ ±t − μ n ≤ 0, with a bound that no force reaches for −∞.
        for i in range(4):
            r = 4 * k + i
            rows[r, x + i // 2] = 1.0 if i % 2 == 0 else -1.0
            rows[r, x + 2] = -PYRAMID * friction[leg]
            lower[3 * m + r], upper[3 * m + r] = -10.0, 0.0
        for j in range(3):
            r = 4 * m + 3 * k + j
            limit = tau_max[leg, j]
            for i in range(3):
                rows[r, x + i] = -dot(vec(push[leg, j]), vec(frame[i])) * weight / limit
            room = free[leg, j] / limit
            lower[3 * m + r], upper[3 * m + r] = -1.0 - room, 1.0 - room
        k += 1
    return rows, lower, upper


@kernel
def to_contact(forces_w, stance, frame, weight):
    """World forces `(legs, 3)` as unknowns x `(3m,)`."""
    x = np.empty(3 * stance.sum())
    k = 0
    for leg in range(stance.size):
        if stance[leg]:
            for j in range(3):
                x[3 * k + j] = dot(vec(frame[j]), vec(forces_w[leg])) / weight
            k += 1
    return x


@kernel
def to_world(x, stance, frame, weight):
    """Unknowns x as world forces `(legs, 3)`, zero in swing."""
    forces = np.zeros((stance.size, 3))
    k = 0
    for leg in range(stance.size):
        if stance[leg]:
            for i in range(3):
                forces[leg, i] = weight * (
                    x[3 * k] * frame[0, i] + x[3 * k + 1] * frame[1, i] + x[3 * k + 2] * frame[2, i]
                )
            k += 1
    return forces


@kernel
def quadratic_program(load_numbers, stance, share, friction, normal, previous, tau_max, weight, height):
    """The program min ½‖balance‖² + ½ small ‖x‖² + ½ smooth ‖x − x_prev‖² under the limits.

    Takes a packed `Load`; returns hessian, gradient, rows, lower and upper bounds as `solve_qp` reads them.
    """
    load = load_of(load_numbers)
    frame = contact_frame(normal)
    rows, wanted = balance_rows(load.wrench, load.arm, stance, frame, weight, height)
    x_prev = to_contact(previous, stance, frame, weight)
    n = x_prev.size
    hessian, gradient = np.empty((n, n)), np.empty(n)
    for i in range(n):
        for j in range(i + 1):
            total = 0.0
            for r in range(6):
                total += rows[r, i] * rows[r, j]
            hessian[i, j] = hessian[j, i] = total
        hessian[i, i] += SMALL + SMOOTH
        total = SMOOTH * x_prev[i]
        for r in range(6):
            total += rows[r, i] * wanted[r]
        gradient[i] = -total
    limits, lower, upper = limit_rows(load.free, load.push, stance, share, friction, frame, tau_max, weight)
    return hessian, gradient, limits, lower, upper


@kernel
def distribute(load_numbers, stance, share, friction, normal, previous, tau_max, weight, height):
    """Solves the quadratic program: x `(3m,)`, prices `(legs, LIMITS)`, code of `minimise`, and culprit.

    The culprit is a torque limit wherever one is part of what excludes a solution.
    """
    hessian, gradient, rows, lower, upper = quadratic_program(
        load_numbers, stance, share, friction, normal, previous, tau_max, weight, height
    )
    x, prices, code, culprit = minimise(hessian, gradient, rows, lower, upper)
    torque_rows = 7 * stance.sum()
    if 0 <= culprit < torque_rows:
        dearest = torque_rows + np.argmax(np.abs(prices[torque_rows:]))
        culprit = dearest if prices[dearest] != 0.0 else culprit
    return x, by_leg(prices, stance), code, culprit


@kernel
def by_leg(prices, stance):
    """Prices of the program's bounds and rows, in the order of `limit_rows`, as `(legs, LIMITS)`."""
    m = stance.sum()
    out = np.zeros((stance.size, LIMITS))
    k = 0
    for leg in range(stance.size):
        if not stance[leg]:
            continue
        for side in range(4):
            out[leg, side] = -prices[3 * m + 4 * k + side]
        normal = prices[3 * k + 2]
        out[leg, 4], out[leg, 5] = max(normal, 0.0), max(-normal, 0.0)
        for j in range(3):
            out[leg, 6 + j] = -prices[7 * m + 3 * k + j]
        k += 1
    return out


@kernel
def torques(load_numbers, forces, tau_max):
    """τ = free − push @ f, kept within the limits `(legs, 3)` [N·m]."""
    load = load_of(load_numbers)
    tau = np.empty(forces.shape)
    for leg in range(forces.shape[0]):
        for j in range(3):
            t = load.free[leg, j] - dot(vec(load.push[leg, j]), vec(forces[leg]))
            tau[leg, j] = min(max(t, -tau_max[leg, j]), tau_max[leg, j])
    return tau


@kernel
def unmet(load_numbers, forces, stance, weight, height):
    """Length of the wrench that the forces lack, scaled as in the programs (a share of the weight).

    Nothing is asked of a robot without a foot down.
    """
    if not stance.any():
        return 0.0
    load = load_of(load_numbers)
    lack = -load.wrench
    for leg in range(forces.shape[0]):
        f = vec(forces[leg])
        moment = cross(vec(load.arm[leg]), f)
        for i in range(3):
            lack[i] += f[i]
            lack[3 + i] += moment[i]
    total = 0.0
    for i in range(3):
        force, moment = FORCE_WEIGHTS[i] * lack[i], MOMENT_WEIGHTS[i] * lack[3 + i] / height
        total += (force * force + moment * moment) / (weight * weight)
    return np.sqrt(total)
