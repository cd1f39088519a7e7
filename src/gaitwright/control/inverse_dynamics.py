"""What a motion demands of feet and motors: accelerations by feedback, then inverse dynamics.

control.md, "Base acceleration", "Swing" and "Inverse dynamics": q̈ = J⁻¹(a_foot − J̇q̇ − J_b a_b), then one
pass of Newton and Euler gives the wrench that the feet must supply and the torques before they do.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.control.moments import moment_of, row
from gaitwright.dynamics.newton_euler import (
    NO_LOAD,
    bias_motion,
    foot_acceleration,
    leg_load,
    link_load,
    motion_at_hip,
    solve_columns,
    with_accelerations,
)
from gaitwright.model.leg import base_at, foot_and_columns, hinge_axes, leg_at, leg_turns
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import (
    GRAVITY,
    add,
    between,
    cross,
    length,
    rotation,
    rotation_vector,
    scale,
    sub,
    times,
    times_t,
    vec,
)
from gaitwright.numerics.matrices import apply, apply_t, write
from gaitwright.numerics.packing import Layout
from gaitwright.signals import MotionTarget, Sensed

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
    size = length(a)
    return a if size <= most else scale(most / size, a)


@kernel
def base_feedback(w0, rotation_wb, omega_w, moment):
    """Linear and angular acceleration by which the base is brought back to its reference, world axes."""
    dp = sub(vec(moment.position_d), vec(moment.position))
    dv = sub(vec(moment.velocity_d), vec(moment.velocity))
    h, v = HORIZONTAL, VERTICAL
    linear = (
        h[1] * w0 * dv[0] + h[0] * w0 * w0 * dp[0],
        h[1] * w0 * dv[1] + h[0] * w0 * w0 * dp[1],
        v[1] * w0 * dv[2] + v[0] * w0 * w0 * dp[2],
    )
    error = scale(ATTITUDE[0] * w0 * w0, rotation_vector(between(rotation_wb, moment.rotation_d)))
    damping = scale(ATTITUDE[1] * w0, sub(vec(moment.omega_d), omega_w))
    return linear, add(error, damping)


@kernel
def base_acceleration(w0, rotation_wb, omega_w, moment):
    """Wanted linear and angular acceleration of the base, world axes, by feedback (control.md).

    Without a foot down it is left to fall.
    """
    if not moment.stance.any():
        return (0.0, 0.0, -GRAVITY), (0.0, 0.0, 0.0)
    linear, angular = base_feedback(w0, rotation_wb, omega_w, moment)
    linear, angular = add(linear, vec(moment.acceleration_d)), add(angular, vec(moment.omega_rate_d))
    return clipped(linear, MOST_ACCELERATION), clipped(angular, MOST_SPIN * w0)


@kernel
def combined(rates, columns):
    """Velocity of a foot relative to its hip: the Jacobian's columns times the joint rates."""
    return add(add(scale(rates[0], columns[0]), scale(rates[1], columns[1])), scale(rates[2], columns[2]))


@kernel
def swing_acceleration(w0, R, w, in_base, rate, leg, moment):
    """Wanted acceleration of a foot in the air, world axes, by feedback.

    `in_base`, `rate`: where its centre is and how it moves as seen from the base, which spins with `w`.
    """
    position = add(vec(moment.position), times(R, in_base))
    velocity = add(vec(moment.velocity), times(R, add(cross(w, in_base), rate)))
    kp, kv = SWING_FOOT[0] * w0 * w0, SWING_FOOT[1] * w0
    off, late = sub(vec(moment.feet_p[leg]), position), sub(vec(moment.feet_v[leg]), velocity)
    return add(vec(moment.feet_a[leg]), add(scale(kp, off), scale(kv, late)))


@kernel
def write_maps(out, push, turn, R, leg, turns, columns, below):
    """Writes the Jacobian columns of the contact point and the hinge axes as rows in world axes.

    The point where a round foot touches lies `below` (leg frame) the centre that `columns` are of; `push`,
    `turn`: where the two begin in `out`.
    """
    axes = hinge_axes(turns, leg.sign)
    for j in range(3):
        column = add(columns[j], cross(axes[j], below))
        write(out, push + 3 * j, times(R, apply(leg.frame, column)))
        write(out, turn + 3 * j, times(R, apply(leg.frame, axes[j])))


class Load(NamedTuple):
    """What the feet are asked to do, and how their pushes act."""

    wrench: Float[np.ndarray, "6"]
    """Force [N] and moment [N·m] about the base origin wanted of the feet, world axes."""
    free: Float[np.ndarray, "legs 3"]
    """Joint torques with unloaded feet [N·m]."""
    arm: Float[np.ndarray, "legs 3"]
    """Base origin → contact point, world axes [m]."""
    push: Float[np.ndarray, "legs 3 3"]
    """Rows: the joints' Jacobian columns of the contact point, world: τ = free − push @ f."""
    turn: Float[np.ndarray, "legs 3 3"]
    """Rows: the joints' axes, world; a moment m on the foot takes turn @ m off the torques."""


LOAD = Layout.of(Load)
load_of = LOAD.views(Load)
"""The `Load` in a row, as views; for kernels too."""
empty_load = LOAD.empty()
wrench_at, free_at, arm_at, push_at, turn_at = (LOAD.start(name) for name in Load._fields)


AS_WANTED = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
"""The base accelerates as it should."""


@kernel
def demand(packed, moment, short):
    """The packed `Load` of a robot (`Robot.packed`) in a moment: what is sensed and what is wanted.

    `short`: what is added to the wanted acceleration of the base, linear and angular, world axes.
    """
    n, w0 = moment.stance.size, packed[-1]
    R, w = rotation(moment.orientation), vec(moment.omega_b)
    up_b = times_t(R, (0.0, 0.0, GRAVITY))
    linear, angular = base_acceleration(w0, R, times(R, w), moment)
    linear, angular = add(linear, short[0]), add(angular, short[1])
    a, wd = add(times_t(R, linear), up_b), times_t(R, angular)
    out = empty_load(n)
    mass, com, inertia = base_at(packed)
    force, torque = link_load((w, wd, a), mass, com, inertia)
    for k in range(n):
        leg = leg_at(packed, k)
        turns, rates = leg_turns(moment.q[k], leg.sign), vec(moment.qd[k])
        foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
        in_base = add(leg.hip, apply(leg.frame, foot))
        goal = up_b
        if not moment.stance[k]:
            rate = apply(leg.frame, combined(rates, (c1, c2, c3)))
            goal = add(times_t(R, swing_acceleration(w0, R, w, in_base, rate, k, moment)), up_b)
        hip_w, hip_wd, hip_a = motion_at_hip(leg, w, wd, a)
        bias = bias_motion(turns, rates, leg.offset, leg.sign, hip_w, hip_wd, hip_a)
        short = sub(apply_t(leg.frame, goal), foot_acceleration(turns, bias, leg.offset))
        qdd = solve_columns(c1, c2, c3, short)
        motion = with_accelerations(turns, bias, qdd, leg.offset, leg.sign)
        f, g, free = leg_load(turns, qdd, leg, motion, NO_LOAD)
        force, torque = add(force, f), add(torque, g)
        below_w = scale(-leg.foot_radius, vec(moment.normal))
        write(out, free_at(out) + 3 * k, free)
        write(out, arm_at(out) + 3 * k, add(times(R, in_base), below_w))
        below = apply_t(leg.frame, times_t(R, below_w))
        push, turn = push_at(out) + 9 * k, turn_at(out) + 9 * k
        write_maps(out, push, turn, R, leg, turns, (c1, c2, c3), below)
    write(out, wrench_at(out), times(R, force))
    write(out, wrench_at(out) + 3, times(R, torque))
    return out


def packed_load(robot: Robot, target: MotionTarget, sensed: Sensed) -> Float[np.ndarray, "numbers"]:
    """The packed `Load` of a robot for a target where it is; for people, not for the tick."""
    return demand(robot.packed, moment_of(row(sensed, target)), AS_WANTED)
