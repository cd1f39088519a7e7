"""What a motion demands of feet and motors: accelerations by feedback, then inverse dynamics.

control.md, "Base acceleration", "Swing" and "Inverse dynamics": q̈ = J⁻¹(a_foot − J̇q̇ − J_b a_b), then one
pass of Newton and Euler gives the wrench that the feet must supply and the torques before they do.
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.compiled import kernel
from gaitwright.geometry import (
    GRAVITY,
    add,
    between,
    cross,
    dot,
    rotation,
    rotation_vector,
    scale,
    sub,
    times,
    times_t,
    vec,
)
from gaitwright.model.dynamics.newton_euler import hip_motion, inverse_dynamics, leg_motion, solve_columns
from gaitwright.model.kinematics import leg_points_and_jacobian, to_base
from gaitwright.model.robot import unpacked

# Gains, in units of the robot's own frequency w0 = √(g/h) (control.md, measured on five robots).
HORIZONTAL = (0.5, 1.2)
"""Position and velocity gains along x, y: times w0², w0."""
VERTICAL = (5.0, 3.5)
"""The same along z."""
ATTITUDE = (12.0, 5.6)
"""The same for the orientation."""
SWING_FOOT = (15.0, 5.6)
"""The same for a foot in the air."""
MOST_ACCELERATION = 15.0
"""Bound of the wanted acceleration of the base [m/s²]."""
MOST_SPIN = 20.0
"""Bound of the wanted angular acceleration, times w0 [rad/s²]."""


@kernel
def clipped(a, most):
    """`a` shortened to the length `most` where it is longer."""
    length = math.sqrt(dot(a, a))
    return a if length <= most else scale(most / length, a)


@kernel
def base_acceleration(
    w0, position, velocity, rotation_wb, spin_w, want_p, want_v, want_a, want_r, want_w, want_wd
):
    """Wanted linear and angular acceleration of the base, world axes, by feedback (control.md)."""
    dp, dv = sub(want_p, position), sub(want_v, velocity)
    h, v = HORIZONTAL, VERTICAL
    linear = (
        h[1] * w0 * dv[0] + h[0] * w0 * w0 * dp[0] + want_a[0],
        h[1] * w0 * dv[1] + h[0] * w0 * w0 * dp[1] + want_a[1],
        v[1] * w0 * dv[2] + v[0] * w0 * w0 * dp[2] + want_a[2],
    )
    error = rotation_vector(between(rotation_wb, want_r))
    angular = add(
        add(scale(ATTITUDE[0] * w0 * w0, error), scale(ATTITUDE[1] * w0, sub(want_w, spin_w))), want_wd
    )
    return clipped(linear, MOST_ACCELERATION), clipped(angular, MOST_SPIN * w0)


@kernel
def combined(rates, columns):
    """Velocity of a foot relative to its hip: the Jacobian's columns times the joint rates."""
    return add(add(scale(rates[0], columns[0]), scale(rates[1], columns[1])), scale(rates[2], columns[2]))


@kernel
def swing_acceleration(w0, position, velocity, want_p, want_v, want_a):
    """Wanted acceleration of a foot in the air, world axes, by feedback."""
    kp, kv = SWING_FOOT[0] * w0 * w0, SWING_FOOT[1] * w0
    return add(want_a, add(scale(kp, sub(want_p, position)), scale(kv, sub(want_v, velocity))))


@kernel
def write_push(out, R, frame, q1, sign, columns, below):
    """Writes the Jacobian columns of the contact point as rows in world axes.

    The point where a round foot touches lies `below` (leg frame) the centre that `columns` are of.
    """
    axis2 = (0.0, math.cos(q1), math.sin(q1))
    at_contact = (
        add(columns[0], cross((1.0, 0.0, 0.0), below)),
        add(columns[1], cross(axis2, below)),
        add(columns[2], cross(scale(sign, axis2), below)),
    )
    for j in range(3):
        out[j, 0], out[j, 1], out[j, 2] = times(R, times(frame, at_contact[j]))


class Load(NamedTuple):
    """What the feet are asked to do, and how their pushes act; arrays for `legs` legs."""

    wrench: np.ndarray
    """`(6,)` force [N] and moment [N·m] about the base origin wanted of the feet, world axes."""
    free: np.ndarray
    """`(legs, 3)` joint torques with unloaded feet [N·m]."""
    arm: np.ndarray
    """`(legs, 3)` base origin → contact point, world axes [m]."""
    push: np.ndarray
    """`(legs, 3, 3)` rows: the joints' Jacobian columns of the contact point, world: τ = free − push @ f."""


@kernel
def load_of(numbers):
    """The `Load` packed in one array, as views."""
    n = (numbers.size - 6) // 15
    return Load(
        numbers[:6],
        numbers[6 : 6 + 3 * n].reshape(n, 3),
        numbers[6 + 3 * n : 6 + 6 * n].reshape(n, 3),
        numbers[6 + 6 * n :].reshape(n, 3, 3),
    )


@kernel
def demand(
    packed,
    w0,
    position,
    orientation,
    velocity,
    spin_b,
    q,
    qd,
    stance,
    normal,
    want_p,
    want_v,
    want_a,
    want_r,
    want_w,
    want_wd,
    feet_p,
    feet_v,
    feet_a,
):
    """The packed `Load` of a robot (`Robot.packed`, frequency w0) in a sensed state for a motion target."""
    model = unpacked(packed)
    n = q.shape[0]
    R = rotation(orientation)
    w = vec(spin_b)
    linear, angular = base_acceleration(
        w0, vec(position), vec(velocity), R, times(R, w), vec(want_p), vec(want_v), vec(want_a), want_r,
        vec(want_w), vec(want_wd),
    )  # fmt: skip
    if not stance.any():
        linear, angular = (0.0, 0.0, -GRAVITY), (0.0, 0.0, 0.0)
    up_b = times_t(R, (0.0, 0.0, GRAVITY))
    a = add(times_t(R, linear), up_b)
    wd = times_t(R, angular)

    qdd = np.empty((n, 3))
    still = np.zeros(3)
    out = np.empty(6 + 15 * n)
    load = load_of(out)
    for leg in range(n):
        frame, hip = model.leg_frame[leg], vec(model.hip[leg])
        foot, c1, c2, c3 = leg_points_and_jacobian(q[leg], model.offset[leg], model.sign[leg])
        columns = (c1, c2, c3)
        in_base = to_base(frame, model.hip[leg], foot)
        goal = up_b
        if not stance[leg]:
            at = add(vec(position), times(R, in_base))
            rate = times(frame, combined(qd[leg], columns))
            moves = add(vec(velocity), times(R, add(cross(w, in_base), rate)))
            swing = swing_acceleration(w0, at, moves, vec(feet_p[leg]), vec(feet_v[leg]), vec(feet_a[leg]))
            goal = add(times_t(R, swing), up_b)
        hw, hwd, ha = hip_motion(frame, hip, w, wd, a)
        bias = leg_motion(q[leg], qd[leg], still, model.offset[leg], model.sign[leg], hw, hwd, ha)[3]
        need = sub(times_t(frame, goal), bias)
        qdd[leg, 0], qdd[leg, 1], qdd[leg, 2] = solve_columns(c1, c2, c3, need)
        below_w = scale(-model.foot_radius[leg], vec(normal))
        arm = add(times(R, in_base), below_w)
        load.arm[leg, 0], load.arm[leg, 1], load.arm[leg, 2] = arm
        below = times_t(frame, times_t(R, below_w))
        write_push(load.push[leg], R, frame, q[leg, 0], model.sign[leg], columns, below)
    force_b, moment_b, free = inverse_dynamics(model, w, wd, a, q, qd, qdd)
    force, moment = times(R, force_b), times(R, moment_b)
    for i in range(3):
        load.wrench[i], load.wrench[3 + i] = force[i], moment[i]
    load.free[:] = free
    return out
