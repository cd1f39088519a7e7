"""Inverse dynamics of hinge legs on a floating base, by Newton and Euler (row N1; equations.md §4).

Out along each leg go angular velocities and accelerations, in come forces and torques; O(links), no
mass matrix. Gravity enters as an upward acceleration of the base. Every vector is in the axes of its
own link, so that a hinge costs one plane turn.
"""

import math

import numpy as np

from gaitwright.compiled import kernel
from gaitwright.geometry import add, cross, dot, scale, sub, times, times_t, turn_x, turn_y, vec


@kernel
def carried(a, w, wd, r):
    """Acceleration of a point at `r` on a body whose origin accelerates with `a` (eq. 4-12)."""
    return add(a, add(cross(wd, r), cross(w, cross(w, r))))


@kernel
def hinge_motion(w, wd, axis_rate, axis_acceleration):
    """Angular velocity and acceleration past a hinge; all in the child's axes (eq. 4-10, 4-11)."""
    return add(w, axis_rate), add(add(wd, axis_acceleration), cross(w, axis_rate))


@kernel
def leg_motion(q, qd, qdd, offset, sign, w, wd, a):
    """Angular velocity, angular and linear acceleration of the three links, each in its own axes.

    `w`, `wd`, `a` are those of the base at the first hinge, in the leg frame. The fourth item is the
    acceleration of the foot, leg frame.
    """
    c1, s1 = math.cos(q[0]), math.sin(q[0])
    c2, s2 = math.cos(q[1]), math.sin(q[1])
    c3, s3 = math.cos(q[2]), sign * math.sin(q[2])
    w1, wd1 = hinge_motion(turn_x(c1, -s1, w), turn_x(c1, -s1, wd), (qd[0], 0.0, 0.0), (qdd[0], 0.0, 0.0))
    a1 = turn_x(c1, -s1, a)
    a2 = turn_y(c2, -s2, carried(a1, w1, wd1, vec(offset[0])))
    w2, wd2 = hinge_motion(turn_y(c2, -s2, w1), turn_y(c2, -s2, wd1), (0.0, qd[1], 0.0), (0.0, qdd[1], 0.0))
    a3 = turn_y(c3, -s3, carried(a2, w2, wd2, vec(offset[1])))
    w3, wd3 = hinge_motion(
        turn_y(c3, -s3, w2), turn_y(c3, -s3, wd2), (0.0, sign * qd[2], 0.0), (0.0, sign * qdd[2], 0.0)
    )
    foot = carried(a3, w3, wd3, vec(offset[2]))
    foot = turn_x(c1, s1, turn_y(c2, s2, turn_y(c3, s3, foot)))
    return (w1, wd1, a1), (w2, wd2, a2), (w3, wd3, a3), foot


@kernel
def link_load(motion, mass, com, inertia):
    """Force and moment about its hinge that the motion of one link asks for (eq. 4-13 … 4-15)."""
    w, wd, a = motion
    force = scale(mass, carried(a, w, wd, com))
    moment = add(times(inertia, wd), cross(w, times(inertia, w)))
    return force, add(moment, cross(com, force))


@kernel
def leg_load(q, qdd, offset, sign, mass, com, inertia, armature, motion):
    """Force and moment at the first hinge (leg frame) and the three joint torques (eq. 4-16 … 4-18).

    They are what the leg needs from the base and the motors to move as `motion` says, with no load on
    the foot.
    """
    c1, s1 = math.cos(q[0]), math.sin(q[0])
    c2, s2 = math.cos(q[1]), math.sin(q[1])
    c3, s3 = math.cos(q[2]), sign * math.sin(q[2])
    f3, g3 = link_load(motion[2], mass[2], vec(com[2]), inertia[2])
    f, g = turn_y(c3, s3, f3), turn_y(c3, s3, g3)
    f2, g2 = link_load(motion[1], mass[1], vec(com[1]), inertia[1])
    f2, g2 = add(f2, f), add(g2, add(g, cross(vec(offset[1]), f)))
    f, g = turn_y(c2, s2, f2), turn_y(c2, s2, g2)
    f1, g1 = link_load(motion[0], mass[0], vec(com[0]), inertia[0])
    f1, g1 = add(f1, f), add(g1, add(g, cross(vec(offset[0]), f)))
    tau = (
        g1[0] + armature[0] * qdd[0],
        g2[1] + armature[1] * qdd[1],
        sign * g3[1] + armature[2] * qdd[2],
    )
    return turn_x(c1, s1, f1), turn_x(c1, s1, g1), tau


@kernel
def hip_motion(leg_frame, hip, w, wd, a):
    """Motion of the base at a first hinge, turned into the leg frame."""
    return times_t(leg_frame, w), times_t(leg_frame, wd), times_t(leg_frame, carried(a, w, wd, hip))


@kernel
def inverse_dynamics(model, w, wd, a, q, qd, qdd):
    """Wrench on the base and joint torques that a motion asks for, with no load on the feet.

    `w`, `wd`, `a` (3-vectors, base axes): angular velocity and acceleration of the base, acceleration
    of its origin *less gravity*. `q`, `qd`, `qdd`: `(legs, 3)`. Returns `(force, moment)` at the base
    origin in base axes and the torques `(legs, 3)`: the rows of M q̈ + h.
    """
    n = q.shape[0]
    tau = np.empty((n, 3))
    force, moment = link_load((w, wd, a), model.base_mass[0], vec(model.base_com), model.base_inertia)
    for leg in range(n):
        frame, hip = model.leg_frame[leg], vec(model.hip[leg])
        w0, wd0, a0 = hip_motion(frame, hip, w, wd, a)
        m1, m2, m3, _ = leg_motion(q[leg], qd[leg], qdd[leg], model.offset[leg], model.sign[leg], w0, wd0, a0)
        f, g, t = leg_load(
            q[leg],
            qdd[leg],
            model.offset[leg],
            model.sign[leg],
            model.mass[leg],
            model.com[leg],
            model.inertia[leg],
            model.armature[leg],
            (m1, m2, m3),
        )
        f, g = times(frame, f), times(frame, g)
        force = add(force, f)
        moment = add(moment, add(g, cross(hip, f)))
        tau[leg, 0], tau[leg, 1], tau[leg, 2] = t
    return force, moment, tau


@kernel
def solve_columns(c1, c2, c3, b):
    """x with c1 x₁ + c2 x₂ + c3 x₃ = b, by cofactors; near a singular pose the answer stays bounded.

    The volume below which a pose counts as singular is 1 % of the product of the column lengths.
    """
    n23 = cross(c2, c3)
    volume = dot(c1, n23)
    floor = 0.01 * math.sqrt(dot(c1, c1) * dot(c2, c2) * dot(c3, c3)) + 1e-12
    if abs(volume) < floor:
        volume = math.copysign(floor, volume)
    return scale(1.0 / volume, (dot(b, n23), dot(b, cross(c3, c1)), dot(b, cross(c1, c2))))


@kernel
def minus(a):
    return sub((0.0, 0.0, 0.0), a)
