"""Direct dynamics of hinge legs on a floating base, by articulated bodies (row N6; equations.md §3, §4).

The accelerations that the rates alone give (`bias_motion`) are taken out first; what remains is linear.
A link with everything beyond it answers an acceleration of its hinge with

    moment = J ω̇ + H a + …      force = Hᵀ ω̇ + M a + …

(J, H, M: its *articulated inertia*, three 3×3 blocks as rows; the dots: its *load*). Going inward, a hinge
that gives way takes away what it does not pass on. At the base six equations are left; going outward,
each hinge says how far it gave.

The same as Armstrong's recursion, which is for ball joints, but with hinges, so a first link may be massless.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.newton_euler import bias_motion, link_load, motion_at_hip
from gaitwright.model.kinematics import feet
from gaitwright.model.leg import base_at, from_last_hinge, leg_at, leg_turns, to_last_link
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, add, cross, dot, rotation, scale, sub, turn_x, turn_y, vec
from gaitwright.numerics.matrices import (
    apply,
    apply_t,
    crossed,
    diagonal,
    inverse,
    less_outer,
    plus,
    seen_in_base,
    seen_past_x,
    seen_past_y,
    transpose,
    vec_at,
    write,
)
from gaitwright.signals import Sensed

NOTHING = (0.0, 0.0, 0.0)


# --- articulated inertia and load ----------------------------------------------------------------
@kernel
def rigid(mass, com, inertia):
    """Articulated inertia of a link with nothing beyond it, about its hinge: (J, H, M)."""
    x, y, z = scale(mass, com)
    J = plus(less_outer(inertia, (x, y, z), com), diagonal(mass * dot(com, com)))
    return J, ((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)), diagonal(mass)


@kernel
def join_bodies(body, load, beyond, load_beyond):
    """Two that move as one, about the same point."""
    (J, H, M), (f, g) = body, load
    (Jb, Hb, Mb), (fb, gb) = beyond, load_beyond
    return (plus(J, Jb), plus(H, Hb), plus(M, Mb)), (add(f, fb), add(g, gb))


@kernel
def shift_body(body, load, r):
    """The same about a point from which the present one lies at `r`."""
    (J, H, M), (f, g) = body, load
    Hr = plus(H, transpose(crossed(r, M)))
    Jr = plus(plus(J, crossed(r, H)), transpose(crossed(r, Hr)))
    return (Jr, Hr, M), (f, add(g, cross(r, f)))


@kernel
def given_way(body, load, axis, tau, armature):
    """What is left of a link past a hinge about its own axis number `axis`, driven with `tau`.

    The third item says how far the hinge gives: q̈ = given[2] − given[0]·ω̇ − given[1]·a.
    """
    (J, H, M), (f, g) = body, load
    u, h = J[axis], H[axis]
    k = 1.0 / (u[axis] + armature)
    free = k * (tau - g[axis])
    ku, kh = scale(k, u), scale(k, h)
    left = (less_outer(J, ku, u), less_outer(H, ku, h), less_outer(M, kh, h))
    return left, (add(f, scale(free, h)), add(g, scale(free, u))), (ku, kh, free)


@kernel
def link(leg, i, motion):
    """Inertia and load of link `i` alone."""
    mass, com, inertia = leg.mass[i], leg.com[i], leg.inertia[i]
    return rigid(mass, com, inertia), link_load(motion, mass, com, inertia)


@kernel
def inward(leg, turns, bias, tau, ground):
    """A whole leg as the base feels it at the first hinge (leg frame), and how far its hinges give.

    `ground`: force on the foot and its moment about the third hinge, in the last link's axes.
    """
    (c1, s1), (c2, s2), (c3, s3) = turns
    body, (f, g) = link(leg, 2, bias[2])
    load = (sub(f, ground[0]), sub(g, ground[1]))
    (J, H, M), (f, g), gave3 = given_way(body, load, 1, leg.sign * tau[2], leg.armature[2])
    beyond = (seen_past_y(c3, s3, J), seen_past_y(c3, s3, H), seen_past_y(c3, s3, M))
    beyond, load = shift_body(beyond, (turn_y(c3, s3, f), turn_y(c3, s3, g)), leg.offset[1])

    body, own = link(leg, 1, bias[1])
    body, load = join_bodies(body, own, beyond, load)
    (J, H, M), (f, g), gave2 = given_way(body, load, 1, tau[1], leg.armature[1])
    beyond = (seen_past_y(c2, s2, J), seen_past_y(c2, s2, H), seen_past_y(c2, s2, M))
    beyond, load = shift_body(beyond, (turn_y(c2, s2, f), turn_y(c2, s2, g)), leg.offset[0])

    body, own = link(leg, 0, bias[0])
    body, load = join_bodies(body, own, beyond, load)
    (J, H, M), (f, g), gave1 = given_way(body, load, 0, tau[0], leg.armature[0])
    body = (seen_past_x(c1, s1, J), seen_past_x(c1, s1, H), seen_past_x(c1, s1, M))
    return body, (turn_x(c1, s1, f), turn_x(c1, s1, g)), (gave1, gave2, gave3)


@kernel
def felt_by_base(leg, body, load):
    """The same about the base origin, base axes."""
    J, H, M = body
    frame = leg.frame
    body = (seen_in_base(frame, J), seen_in_base(frame, H), seen_in_base(frame, M))
    return shift_body(body, (apply(frame, load[0]), apply(frame, load[1])), leg.hip)


@kernel
def base_motion(body, load, wrench):
    """Angular and linear acceleration that a wrench (force, moment) gives to the whole."""
    (J, H, M), (f, g) = body, load
    f, g = sub(wrench[0], f), sub(wrench[1], g)
    Mi = inverse(M)
    HM = (apply(Mi, H[0]), apply(Mi, H[1]), apply(Mi, H[2]))
    schur = (
        sub(J[0], apply(H, HM[0])),
        sub(J[1], apply(H, HM[1])),
        sub(J[2], apply(H, HM[2])),
    )
    wd = apply(inverse(schur), sub(g, apply(HM, f)))
    return wd, apply(Mi, sub(f, apply_t(H, wd)))


@kernel
def outward(leg, turns, gave, wd, a):
    """Joint accelerations of a leg; `wd`, `a`: what its hinge does beyond the bias, leg frame."""
    (c1, s1), (c2, s2), (c3, s3) = turns
    gave1, gave2, gave3 = gave
    wd, a = turn_x(c1, -s1, wd), turn_x(c1, -s1, a)
    first = gave1[2] - dot(gave1[0], wd) - dot(gave1[1], a)
    wd = add(wd, (first, 0.0, 0.0))
    a = turn_y(c2, -s2, add(a, cross(wd, leg.offset[0])))
    wd = turn_y(c2, -s2, wd)
    second = gave2[2] - dot(gave2[0], wd) - dot(gave2[1], a)
    wd = add(wd, (0.0, second, 0.0))
    a = turn_y(c3, -s3, add(a, cross(wd, leg.offset[1])))
    wd = turn_y(c3, -s3, wd)
    return first, second, leg.sign * (gave3[2] - dot(gave3[0], wd) - dot(gave3[1], a))


@kernel
def foot_load(leg, turns, arm, force, moment):
    """A wrench at `arm` (base origin → contact), base axes, about the third hinge in the last link's axes."""
    at = from_last_hinge(turns, leg.offset, apply_t(leg.frame, sub(arm, leg.hip)))
    force = to_last_link(turns, apply_t(leg.frame, force))
    moment = to_last_link(turns, apply_t(leg.frame, moment))
    return force, add(moment, cross(at, force))


@kernel
def direct_dynamics(packed, w, q, qd, tau, arm, push, wrench):
    """Accelerations of a packed robot under torques and wrenches on feet and base.

    All in base axes, as `inverse_dynamics`, whose inverse this is. `w`: angular velocity of the base;
    `q`, `qd`, `tau`: `(legs, 3)`; `arm`: `(legs, 3)` base origin → contact points; `push`: `(legs, 6)`
    force and moment of the ground on each foot, about its contact point; `wrench`: `(force, moment)` on
    the base about its origin. Returns ω̇, the acceleration of the base origin *less gravity*, and q̈.
    """
    n = q.shape[0]
    mass, com, inertia = base_at(packed)
    body = rigid(mass, com, inertia)
    load = link_load((w, NOTHING, NOTHING), mass, com, inertia)
    gave = np.empty((n, 21))
    for k in range(n):
        leg = leg_at(packed, k)
        turns = leg_turns(q[k], leg.sign)
        w0, wd0, a0 = motion_at_hip(leg, w, NOTHING, NOTHING)
        bias = bias_motion(turns, vec(qd[k]), leg.offset, leg.sign, w0, wd0, a0)
        ground = foot_load(leg, turns, vec(arm[k]), vec_at(push[k], 0), vec_at(push[k], 3))
        limb, limb_load, gives = inward(leg, turns, bias, vec(tau[k]), ground)
        limb, limb_load = felt_by_base(leg, limb, limb_load)
        body, load = join_bodies(body, load, limb, limb_load)
        for i in range(3):
            write(gave[k], 7 * i, gives[i][0])
            write(gave[k], 7 * i + 3, gives[i][1])
            gave[k, 7 * i + 6] = gives[i][2]
    wd, a = base_motion(body, load, wrench)
    qdd = np.empty((n, 3))
    for k in range(n):
        leg, row = leg_at(packed, k), gave[k]
        turns = leg_turns(q[k], leg.sign)
        gives = (
            (vec_at(row, 0), vec_at(row, 3), row[6]),
            (vec_at(row, 7), vec_at(row, 10), row[13]),
            (vec_at(row, 14), vec_at(row, 17), row[20]),
        )
        at_hip = add(a, cross(wd, leg.hip))
        qdd[k, 0], qdd[k, 1], qdd[k, 2] = outward(
            leg, turns, gives, apply_t(leg.frame, wd), apply_t(leg.frame, at_hip)
        )
    return wd, a, qdd


# --- for people, not kernels ---------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Accelerations:
    """How a robot's motion changes; the axes are those of `Sensed`."""

    linear_w: Float[np.ndarray, "3"]
    """Acceleration of the base origin, gravity's fall included: -9.81 along z in free fall [m/s²]."""
    angular_b: Float[np.ndarray, "3"]
    """Angular acceleration of the base, its own axes [rad/s²]."""
    qdd: Float[np.ndarray, "legs 3"]
    """Joint accelerations [rad/s²]."""


def contact_arms(
    robot: Robot, sensed: Sensed, normal_w: Float[np.ndarray, "3"]
) -> Float[np.ndarray, "legs 3"]:
    """Base origin → the point where each round foot touches ground of that unit normal, world axes [m]."""
    feet_w = feet(robot, sensed.q) @ rotation(sensed.orientation_wb).T
    return feet_w - robot.foot_radius[:, None] * normal_w


def accelerations(
    robot: Robot,
    sensed: Sensed,
    tau: Float[np.ndarray, "legs 3"],
    arm_w: Float[np.ndarray, "legs 3"],
    push_w: Float[np.ndarray, "legs 6"],
    wrench_w: Float[np.ndarray, "6"] | None = None,
) -> Accelerations:
    """What torques [N·m] and wrenches do to a robot in a sensed state; no friction in the joints.

    `arm_w`: base origin → contact points [m]; `push_w`: force [N] on each foot there and moment [N·m]
    about that point; `wrench_w`: force and moment about the base origin on the base; all in world axes.
    """
    R = rotation(sensed.orientation_wb)
    push_b = (push_w.reshape(-1, 2, 3) @ R).reshape(-1, 6)
    six = np.zeros(6) if wrench_w is None else wrench_w
    wrench_b = (tuple(six[:3] @ R), tuple(six[3:] @ R))
    w = tuple(sensed.angular_velocity_b)
    wd, a, qdd = direct_dynamics(robot.packed, w, sensed.q, sensed.qd, tau, arm_w @ R, push_b, wrench_b)
    return Accelerations(R @ a - (0.0, 0.0, GRAVITY), np.array(wd), qdd)
