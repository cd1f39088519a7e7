"""Rotors behind gears: inertia that feels only how a hinge turns, not how the robot does (row N6).

A rotor of inertia I at a hinge puts the torque t = -I q̈ between its links, with q̈ the acceleration that
comes of it: q̈ = q̈₀ + Y t, with Y the mobility of the hinges. Newton's steps t ← t - (1 + I Y)⁻¹ (t + I q̈)
end there, each with q̈ from the recursion. The matrix is *slow*: it depends on orientations only, is new
with every control period, and what it is off costs a step more, not accuracy.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.armstrong import fast_accelerations, slow_coefficients
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub
from gaitwright.numerics.matrices import add_row, apply, apply_t, mat, row
from gaitwright.plant.armstrong.joints import BOTH, hinge_axes, relative

ENOUGH = 1e-9
"""A rotor's torque may be off by this share of the largest."""
MOST_STEPS = 12
"""Most passes of the recursion for one state; three or four are usual."""


@kernel
def hinge_accelerations(tree, joints, R, w, a):
    """q̈ `(hinges,)` [rad/s²] of accelerations `a (1 + links, 3)`, as `armstrong.accelerations` gives them."""
    out = np.empty(joints.lower.size)
    for j in range(joints.link.size):
        k, h, p = joints.link[j], joints.hinge[j], tree.parent[joints.link[j]]
        B, frame = relative(tree, joints, j, R), mat(joints.frame, j)
        w_p = apply_t(frame, row(w, p))
        turning = sub(apply(B, row(a, 1 + k)), apply_t(frame, row(a, 1 + p)))
        turning = add(turning, cross(sub(apply(B, row(w, k)), w_p), w_p))
        axis1, axis2 = hinge_axes(joints.kind[j], joints.sign[j], B)
        out[h] = dot(turning, axis1)
        if joints.kind[j] == BOTH:
            out[h + 1] = dot(turning, axis2)
    return out


@kernel
def add_hinge_torque(tree, joints, j, R, about, torque):
    """Adds torques about the one or two hinges of joint `j` to those on its link (link axes)."""
    B = relative(tree, joints, j, R)
    axis1, axis2 = hinge_axes(joints.kind[j], joints.sign[j], B)
    add_row(torque, joints.link[j], apply_t(B, add(scale(about[0], axis1), scale(about[1], axis2))))


@kernel
def with_rotors(tree, joints, slow, R, w, torque, force, moment, gravity, newton):
    """As `armstrong.fast_accelerations`, with the rotors; `newton`: `newton_matrix`. Changes `torque`."""
    rotor = np.zeros(joints.lower.size)
    a = fast_accelerations(tree, slow, R, w, torque, force, moment, gravity)
    for _ in range(MOST_STEPS):
        taken = joints.rotor * hinge_accelerations(tree, joints, R, w, a)
        missing = rotor + taken
        if np.abs(missing).max() <= ENOUGH * np.abs(taken).max():
            break
        change = np.zeros(rotor.size)
        for h in range(rotor.size):
            for i in range(rotor.size):
                change[h] -= newton[h, i] * missing[i]
        rotor += change
        for j in range(joints.link.size):
            h = joints.hinge[j]
            second = change[h + 1] if joints.kind[j] == BOTH else 0.0
            add_hinge_torque(tree, joints, j, R, (change[h], second), torque)
        a = fast_accelerations(tree, slow, R, w, torque, force, moment, gravity)
    return a


@kernel
def hinge_mobility(tree, joints, R):
    """Y `(hinges, hinges)`: q̈ of all hinges under a unit torque on one, for links at rest."""
    slow = slow_coefficients(tree, R)
    none, still = np.zeros((tree.mass.size, 3)), np.zeros(3)
    out = np.empty((joints.lower.size, joints.lower.size))
    for j in range(joints.link.size):
        for i in range(2 if joints.kind[j] == BOTH else 1):
            torque = np.zeros((tree.mass.size, 3))
            add_hinge_torque(tree, joints, j, R, (1.0 - i, 1.0 * i), torque)
            a = fast_accelerations(tree, slow, R, none, torque, none, none, still)
            out[joints.hinge[j] + i] = hinge_accelerations(tree, joints, R, none, a)
    return out


def newton_matrix(
    mobility: Float[np.ndarray, "hinges hinges"], inertia: Float[np.ndarray, "hinges"]
) -> Float[np.ndarray, "hinges hinges"]:
    """(1 + I Y)⁻¹ for rotors of these inertias [kg·m²]."""
    return np.linalg.inv(np.eye(len(inertia)) + inertia[:, None] * mobility)
