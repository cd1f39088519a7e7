"""Inverse dynamics of hinge legs on a floating base, by Newton and Euler (row N1; equations.md §4).

Out along each leg go angular velocities and accelerations, in come forces and torques; O(links), no
mass matrix. Gravity enters as an upward acceleration of the base. Every vector is in the axes of its
own link, so that a hinge costs one plane turn.

Accelerations are linear in q̈ and angular velocities do not depend on it. So a leg's outward pass splits
exactly: `leg.bias_motion` runs it with q̈ = 0, `with_accelerations` adds what q̈ adds. A caller that first
needs the bias (to find q̈ from a wanted acceleration of the foot) thereby goes outward once.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.leg import (
    base_at,
    bias_motion,
    foot_acceleration,
    foot_and_columns,
    leg_at,
    leg_of,
    leg_turns,
    point_acceleration,
    solve_columns,
)
from gaitwright.model.robot import legs_of
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, scale, sub, turn_x, turn_y, vec
from gaitwright.numerics.matrices import apply, apply_t, rows, vec_at, write
from gaitwright.numerics.packing import Layout

NO_LOAD = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
"""Force and moment on a foot in the air."""


# --- outward -------------------------------------------------------------------------------------
@kernel
def motion_at_hip(leg, w, wd, a):
    """Motion of the base at a leg's first hinge, turned into the leg frame."""
    at_hip = point_acceleration(a, w, wd, leg.hip)
    return apply_t(leg.frame, w), apply_t(leg.frame, wd), apply_t(leg.frame, at_hip)


@kernel
def with_accelerations(turns, bias, qdd, offset, sign):
    """The `bias_motion` with what the joint accelerations add to it: the motion with q̈."""
    _, (c2, s2), (c3, s3) = turns
    (w1, wd1, a1), (w2, wd2, a2), (w3, wd3, a3) = bias
    more1 = (qdd[0], 0.0, 0.0)
    pull2 = turn_y(c2, -s2, cross(more1, offset[0]))
    more2 = add(turn_y(c2, -s2, more1), (0.0, qdd[1], 0.0))
    pull3 = turn_y(c3, -s3, add(pull2, cross(more2, offset[1])))
    more3 = add(turn_y(c3, -s3, more2), (0.0, sign * qdd[2], 0.0))
    return (
        (w1, add(wd1, more1), a1),
        (w2, add(wd2, more2), add(a2, pull2)),
        (w3, add(wd3, more3), add(a3, pull3)),
    )


@kernel
def links_motion(leg, turns, w, wd, a, qd, qdd):
    """Motion of the three links for that of the base (base axes) and of the joints, each in its axes."""
    w0, wd0, a0 = motion_at_hip(leg, w, wd, a)
    bias = bias_motion(turns, qd, leg.offset, leg.sign, w0, wd0, a0)
    return with_accelerations(turns, bias, qdd, leg.offset, leg.sign)


# --- inward --------------------------------------------------------------------------------------
@kernel
def link_load(motion, mass, com, inertia):
    """Force and moment about its hinge that the motion of one link asks for (eq. 4-13 … 4-15)."""
    w, wd, a = motion
    force = scale(mass, point_acceleration(a, w, wd, com))
    moment = add(apply(inertia, wd), cross(w, apply(inertia, w)))
    return force, add(moment, cross(com, force))


@kernel
def leg_load(turns, qdd, leg, motion, ground):
    """Wrench about the base origin (base axes, eq. 4-24) and the three joint torques (eq. 4-16 … 4-18).

    They are what the leg needs from the base and the motors to move as `motion` says. `ground`: the force
    on the foot and its moment about the third hinge, in the last link's axes (`NO_LOAD` in the air).
    """
    (c1, s1), (c2, s2), (c3, s3) = turns
    f3, g3 = link_load(motion[2], leg.mass[2], leg.com[2], leg.inertia[2])
    f3, g3 = sub(f3, ground[0]), sub(g3, ground[1])
    f, g = turn_y(c3, s3, f3), turn_y(c3, s3, g3)
    f2, g2 = link_load(motion[1], leg.mass[1], leg.com[1], leg.inertia[1])
    f2, g2 = add(f2, f), add(g2, add(g, cross(leg.offset[1], f)))
    f, g = turn_y(c2, s2, f2), turn_y(c2, s2, g2)
    f1, g1 = link_load(motion[0], leg.mass[0], leg.com[0], leg.inertia[0])
    f1, g1 = add(f1, f), add(g1, add(g, cross(leg.offset[0], f)))
    tau = (
        g1[0] + leg.armature[0] * qdd[0],
        g2[1] + leg.armature[1] * qdd[1],
        leg.sign * g3[1] + leg.armature[2] * qdd[2],
    )
    force = apply(leg.frame, turn_x(c1, s1, f1))
    moment = add(apply(leg.frame, turn_x(c1, s1, g1)), cross(leg.hip, force))
    return force, moment, tau


# --- the whole robot -----------------------------------------------------------------------------
@kernel
def inverse_dynamics(model, w, wd, a, q, qd, qdd):
    """Wrench on the base and joint torques that a motion asks for, with no load on the feet.

    `w`, `wd`, `a` (3-vectors, base axes): angular velocity and acceleration of the base, acceleration
    of its origin *less gravity*. `q`, `qd`, `qdd`: `(legs, 3)`. Returns `(force, moment)` at the base
    origin in base axes and the torques `(legs, 3)`: the rows of M q̈ + h.
    """
    n = q.shape[0]
    tau = np.empty((n, 3))
    force, moment = link_load((w, wd, a), model.base_mass[0], vec(model.base_com), rows(model.base_inertia))
    for k in range(n):
        leg = leg_of(model, k)
        turns = leg_turns(q[k], leg.sign)
        motion = links_motion(leg, turns, w, wd, a, vec(qd[k]), vec(qdd[k]))
        f, g, t = leg_load(turns, vec(qdd[k]), leg, motion, NO_LOAD)
        force, moment = add(force, f), add(moment, g)
        tau[k, 0], tau[k, 1], tau[k, 2] = t
    return force, moment, tau


class Dynamics(NamedTuple):
    """What a motion asks for, and where the feet are; base axes."""

    wrench: Float[np.ndarray, "6"]
    """Force [N] and moment about the base origin [N·m] on the base, feet unloaded."""
    tau: Float[np.ndarray, "legs 3"]
    """Joint torques [N·m], feet unloaded."""
    feet: Float[np.ndarray, "legs 3"]
    """Base origin → foot centre [m]."""
    columns: Float[np.ndarray, "legs 3 3"]
    """Rows: velocity of the foot centre per joint rate (columns of its Jacobian) [m]."""


DYNAMICS = Layout.of(Dynamics)
dynamics_in = DYNAMICS.views(Dynamics)
"""The `Dynamics` in a row, as views; for kernels too."""
empty_dynamics = DYNAMICS.empty()
wrench_at, tau_at, feet_at, columns_at = (DYNAMICS.start(name) for name in Dynamics._fields)


def state_numbers(
    w: Float[np.ndarray, "3"],
    wd: Float[np.ndarray, "3"],
    a: Float[np.ndarray, "3"],
    q: Float[np.ndarray, "legs 3"],
    qd: Float[np.ndarray, "legs 3"],
    qdd: Float[np.ndarray, "legs 3"],
) -> Float[np.ndarray, "numbers"]:
    """The arguments of `inverse_dynamics` in one array, as `dynamics_of` takes them."""
    return np.concatenate([w, wd, a, q.ravel(), qd.ravel(), qdd.ravel()])


@kernel
def dynamics_of(packed, numbers):
    """The packed `Dynamics` of a packed robot for `state_numbers`: inverse dynamics, feet and Jacobians.

    The same figures as `inverse_dynamics`; two arrays in and one out cost far less than its arguments do.
    """
    n = legs_of(packed)
    w, wd, a = vec_at(numbers, 0), vec_at(numbers, 3), vec_at(numbers, 6)
    out = empty_dynamics(n)
    mass, com, inertia = base_at(packed)
    force, moment = link_load((w, wd, a), mass, com, inertia)
    for k in range(n):
        leg = leg_at(packed, k)
        i = 9 + 3 * k
        turns = leg_turns(vec_at(numbers, i), leg.sign)
        qd, qdd = vec_at(numbers, i + 3 * n), vec_at(numbers, i + 6 * n)
        w0, wd0, a0 = motion_at_hip(leg, w, wd, a)  # `links_motion`, written out: an eighth faster
        bias = bias_motion(turns, qd, leg.offset, leg.sign, w0, wd0, a0)
        motion = with_accelerations(turns, bias, qdd, leg.offset, leg.sign)
        f, g, tau = leg_load(turns, qdd, leg, motion, NO_LOAD)
        force, moment = add(force, f), add(moment, g)
        foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
        write(out, tau_at(out) + 3 * k, tau)
        write(out, feet_at(out) + 3 * k, add(leg.hip, apply(leg.frame, foot)))
        at = columns_at(out) + 9 * k
        write(out, at, apply(leg.frame, c1))
        write(out, at + 3, apply(leg.frame, c2))
        write(out, at + 6, apply(leg.frame, c3))
    write(out, wrench_at(out), force)
    write(out, wrench_at(out) + 3, moment)
    return out


@kernel
def joint_accelerations(packed, w, wd, a, q, qd, feet_a):
    """q̈ `(legs, 3)` that gives the foot centres wanted accelerations: J q̈ = a_foot − (what q̈ = 0 gives).

    `feet_a`: `(legs, 3)`, base axes, *less gravity* as `a`; the rest as for `inverse_dynamics`.
    """
    n = q.shape[0]
    qdd = np.empty((n, 3))
    for k in range(n):
        leg = leg_at(packed, k)
        turns = leg_turns(q[k], leg.sign)
        w0, wd0, a0 = motion_at_hip(leg, w, wd, a)
        bias = bias_motion(turns, vec(qd[k]), leg.offset, leg.sign, w0, wd0, a0)
        short = sub(apply_t(leg.frame, vec(feet_a[k])), foot_acceleration(turns, bias, leg.offset))
        _, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
        write(qdd[k], 0, solve_columns(c1, c2, c3, short))
    return qdd
