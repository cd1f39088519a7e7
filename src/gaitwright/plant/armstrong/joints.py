"""Hinges made of ball joints: motors turn about the hinges, springs hold what a hinge forbids (row N7).

A ball joint allows three turns. Where the robot has a hinge, each turn that the hinge forbids is held by
a *guide*: a direction `p` of the parent and a direction `c` of the child that a perfect hinge keeps
perpendicular, s = p·c = 0. The guide's restorative torque on the child, -(k s + d ds/dt) (c × p), is the
gradient of the energy k s²/2 and a damper, so it never makes energy. Beyond a joint limit the same kind
of spring turns the hinge back (thesis 6.3, fig. 6.7).

A joint has its own axes: those of the parent, turned by `frame`, so that hinge 1 turns about x and the
others about y. `B` is child components → joint axes.
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub, wrap
from gaitwright.numerics.matrices import apply, apply_t, mat, put_row, row, t_product

ABOUT_X, ABOUT_Y, BOTH = 0, 1, 2
"""A hinge about x; one about y; x, then y, where the link between them has no mass."""
CREEP = 0.05
"""Up to this joint rate [rad/s] dry friction grows with it: what sticks is no torque, but a constraint."""


class Joints(NamedTuple):
    """Ball joints, one row each; the arrays per hinge are in the robot's order, leg by leg."""

    link: np.ndarray
    """`(joints,)` int64: the child."""
    kind: np.ndarray
    """`(joints,)` int64: `ABOUT_X`, `ABOUT_Y` or `BOTH`."""
    hinge: np.ndarray
    """`(joints,)` int64: number of the (first) hinge it holds."""
    frame: np.ndarray
    """`(joints, 3, 3)` joint components → parent components."""
    sign: np.ndarray
    """`(joints,)` ±1: a knee may turn the other way about its axis."""
    guide: np.ndarray
    """`(joints, 2)` stiffness of the guides [N·m/rad]; `BOTH` has only the first."""
    guide_damping: np.ndarray
    """`(joints, 2)` [N·m·s/rad]."""
    lower: np.ndarray
    upper: np.ndarray
    """`(hinges,)` joint limits [rad]."""
    stop: np.ndarray
    stop_damping: np.ndarray
    """`(hinges,)` spring and damper beyond a limit [N·m/rad, N·m·s/rad]."""
    viscous: np.ndarray
    dry: np.ndarray
    """`(hinges,)` the hinge's own friction [N·m·s/rad, N·m]."""
    rotor: np.ndarray
    """`(hinges,)` inertia of the motor's rotor, seen at the hinge [kg·m²]."""


@kernel
def relative(tree, joints, j, R):
    """B of joint `j` for orientations R."""
    k = joints.link[j]
    return t_product(mat(joints.frame, j), t_product(mat(R, tree.parent[k]), mat(R, k)))


@kernel
def relative_rate(tree, joints, j, B, w):
    """Angular velocity of the child less the parent's, joint axes [rad/s]; `w (links, 3)`, link axes."""
    k = joints.link[j]
    return sub(apply(B, row(w, k)), apply_t(mat(joints.frame, j), row(w, tree.parent[k])))


@kernel
def column(B, i):
    return (B[0][i], B[1][i], B[2][i])


@kernel
def hinge_axes(kind, sign, B):
    """Axes of the joint's one or two hinges, joint axes; the second is nothing where there is one."""
    none = (0.0, 0.0, 0.0)
    if kind == ABOUT_X:
        return (1.0, 0.0, 0.0), none
    if kind == ABOUT_Y:
        return (0.0, sign, 0.0), none
    return (1.0, 0.0, 0.0), column(B, 1)


@kernel
def hinge_angles(kind, sign, B):
    """Angles of the joint's one or two hinges [rad], in (-π, π]: what the forbidden turns leave of B."""
    if kind == ABOUT_X:
        return math.atan2(B[2][1] - B[1][2], B[1][1] + B[2][2]), 0.0
    if kind == ABOUT_Y:
        return sign * math.atan2(B[0][2] - B[2][0], B[0][0] + B[2][2]), 0.0
    return math.atan2(B[2][1], B[1][1]), math.atan2(B[0][2], B[0][0])


@kernel
def guides(kind, B):
    """(s, c × p) of the joint's two guides, joint axes; the second is nothing where there is one."""
    x, y, z = column(B, 0), column(B, 1), column(B, 2)
    if kind == ABOUT_X:
        p = (1.0, 0.0, 0.0)
        return dot(p, y), cross(y, p), dot(p, z), cross(z, p)
    if kind == ABOUT_Y:
        p = (0.0, 1.0, 0.0)
        return dot(p, x), cross(x, p), dot(p, z), cross(z, p)
    p = (1.0, 0.0, 0.0)
    return dot(p, y), cross(y, p), 0.0, (0.0, 0.0, 0.0)


@kernel
def unwound(joints, h, angle):
    """The same angle within half a turn of the middle of the hinge's range [rad]."""
    middle = 0.5 * (joints.lower[h] + joints.upper[h])
    return middle + wrap(angle - middle)


@kernel
def hinge_torque(joints, h, q, qd, motor):
    """Torque about hinge `h` at angle `q` and rate `qd`: motor, friction, and the stop beyond a limit."""
    out = motor - joints.viscous[h] * qd - joints.dry[h] * min(1.0, max(-1.0, qd / CREEP))
    if q > joints.upper[h]:
        out += min(0.0, joints.stop[h] * (joints.upper[h] - q) - joints.stop_damping[h] * qd)
    elif q < joints.lower[h]:
        out += max(0.0, joints.stop[h] * (joints.lower[h] - q) - joints.stop_damping[h] * qd)
    return out


@kernel
def joint_torques(tree, joints, R, w, motor):
    """Torques `(links, 3)` of parents on children, link axes [N·m]; `motor (hinges,)` about the hinges."""
    out = np.zeros((tree.mass.size, 3))
    for j in range(joints.link.size):
        k, kind, h = joints.link[j], joints.kind[j], joints.hinge[j]
        B = relative(tree, joints, j, R)
        rate = relative_rate(tree, joints, j, B, w)
        s1, n1, s2, n2 = guides(kind, B)
        torque = scale(-joints.guide[j, 0] * s1 - joints.guide_damping[j, 0] * dot(rate, n1), n1)
        held = scale(-joints.guide[j, 1] * s2 - joints.guide_damping[j, 1] * dot(rate, n2), n2)
        axis1, axis2 = hinge_axes(kind, joints.sign[j], B)
        q1, q2 = hinge_angles(kind, joints.sign[j], B)
        t1 = hinge_torque(joints, h, unwound(joints, h, q1), dot(rate, axis1), motor[h])
        torque = add(add(torque, held), scale(t1, axis1))
        if kind == BOTH:
            t2 = hinge_torque(joints, h + 1, unwound(joints, h + 1, q2), dot(rate, axis2), motor[h + 1])
            torque = add(torque, scale(t2, axis2))
        put_row(out, k, apply_t(B, torque))
    return out


@kernel
def hinge_states(tree, joints, R, w):
    """Angles [rad] and rates [rad/s] of all hinges, `(2, hinges)`."""
    out = np.zeros((2, joints.lower.size))
    for j in range(joints.link.size):
        h, kind = joints.hinge[j], joints.kind[j]
        B = relative(tree, joints, j, R)
        rate = relative_rate(tree, joints, j, B, w)
        axis1, axis2 = hinge_axes(kind, joints.sign[j], B)
        q1, q2 = hinge_angles(kind, joints.sign[j], B)
        out[0, h], out[1, h] = unwound(joints, h, q1), dot(rate, axis1)
        if kind == BOTH:
            out[0, h + 1], out[1, h + 1] = unwound(joints, h + 1, q2), dot(rate, axis2)
    return out


@kernel
def worst_sag(tree, joints, R):
    """The largest turn that a hinge forbids and a guide let happen [rad]."""
    most = 0.0
    for j in range(joints.link.size):
        s1, _, s2, _ = guides(joints.kind[j], relative(tree, joints, j, R))
        most = max(most, abs(s1), abs(s2))
    return math.asin(min(1.0, most))
