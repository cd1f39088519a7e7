"""What a motion demands of feet and motors: accelerations by feedback, then inverse dynamics.

control.md, "Base acceleration", "Swing" and "Inverse dynamics": q̈ = J⁻¹(a_foot − J̇q̇ − J_b a_b), then one
pass of Newton and Euler gives the wrench that the feet must supply and the torques before they do.
"""

import math

import numpy as np
from gaitwright.compiled import kernel

from gaitwright.geometry import GRAVITY, add, cross, dot, rotation, rotation_vector, scale, sub, times, times_t, vec
from gaitwright.model.dynamics.newton_euler import hip_motion, inverse_dynamics, leg_motion, solve_columns
from gaitwright.model.kinematics import leg_points_and_jacobian, to_base

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
def base_acceleration(w0, position, velocity, rotation_wb, spin_w, want_p, want_v, want_a, want_r, want_w, want_wd):
    """Wanted linear and angular acceleration of the base, world axes, by feedback (control.md)."""
    dp, dv = sub(want_p, position), sub(want_v, velocity)
    h, v = HORIZONTAL, VERTICAL
    linear = (
        h[1] * w0 * dv[0] + h[0] * w0 * w0 * dp[0] + want_a[0],
        h[1] * w0 * dv[1] + h[0] * w0 * w0 * dp[1] + want_a[1],
        v[1] * w0 * dv[2] + v[0] * w0 * w0 * dp[2] + want_a[2],
    )
    error = rotation_vector(want_r @ rotation_wb.T)
    angular = add(
        add(scale(ATTITUDE[0] * w0 * w0, error), scale(ATTITUDE[1] * w0, sub(want_w, spin_w))), want_wd
    )
    return clipped(linear, MOST_ACCELERATION), clipped(angular, MOST_SPIN * w0)


@kernel
def demand(
    model,
    w0,
    radius,
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
    """Wrench wanted of the feet, torques before they push, and how their pushes act.

    Returns `wrench` (6,): force and moment about the base origin, world axes; `free` (legs, 3): joint
    torques [N·m] with unloaded feet; `arm` (legs, 3): base origin → contact point, world axes;
    `push` (legs, 3, 3): rows are the joints' Jacobian columns of the contact point in world axes, so
    that τ = free − push @ f.
    """
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
    v_b = times_t(R, vec(velocity))

    qdd = np.empty((n, 3))
    still = np.zeros(3)
    arm, push = np.empty((n, 3)), np.empty((n, 3, 3))
    for leg in range(n):
        frame, hip = model.leg_frame[leg], vec(model.hip[leg])
        foot, c1, c2, c3 = leg_points_and_jacobian(q[leg], model.offset[leg], model.sign[leg])
        in_base = to_base(frame, model.hip[leg], foot)
        goal = up_b
        if not stance[leg]:
            rate = add(add(scale(qd[leg, 0], c1), scale(qd[leg, 1], c2)), scale(qd[leg, 2], c3))
            foot_v = times(R, add(v_b, add(cross(w, in_base), times(frame, rate))))
            foot_p = add(vec(position), times(R, in_base))
            kp, kv = SWING_FOOT[0] * w0 * w0, SWING_FOOT[1] * w0
            feedback = add(scale(kp, sub(vec(feet_p[leg]), foot_p)), scale(kv, sub(vec(feet_v[leg]), foot_v)))
            goal = add(times_t(R, add(vec(feet_a[leg]), feedback)), up_b)
        hw, hwd, ha = hip_motion(frame, hip, w, wd, a)
        bias = leg_motion(q[leg], qd[leg], still, model.offset[leg], model.sign[leg], hw, hwd, ha)[3]
        step = solve_columns(c1, c2, c3, sub(times_t(frame, goal), bias))
        qdd[leg, 0], qdd[leg, 1], qdd[leg, 2] = step

        below_w = scale(-radius[leg], vec(normal))
        below = times_t(frame, times_t(R, below_w))
        axis2 = (0.0, math.cos(q[leg, 0]), math.sin(q[leg, 0]))
        columns = (
            add(c1, cross((1.0, 0.0, 0.0), below)),
            add(c2, cross(axis2, below)),
            add(c3, cross(scale(model.sign[leg], axis2), below)),
        )
        r = add(times(R, in_base), below_w)
        arm[leg, 0], arm[leg, 1], arm[leg, 2] = r
        for j in range(3):
            c = times(R, times(frame, columns[j]))
            push[leg, j, 0], push[leg, j, 1], push[leg, j, 2] = c

    force_b, moment_b, free = inverse_dynamics(model, w, wd, a, q, qd, qdd)
    force, moment = times(R, force_b), times(R, moment_b)
    wrench = np.array((force[0], force[1], force[2], moment[0], moment[1], moment[2]))
    return wrench, free, arm, push
