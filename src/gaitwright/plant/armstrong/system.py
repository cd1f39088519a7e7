"""What moves, as one flat array, and how fast: the right-hand side that the integrators share.

The array holds what changes with the rates first, then the rates:

    position of the root (3) | unit quaternions (links × 4) | bristles (slots × 3) | velocity of the root (3)
    | angular velocities (links × 3, link axes)
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.armstrong import fast_accelerations, slow_coefficients
from gaitwright.dynamics.tree import Tree
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross
from gaitwright.numerics.matrices import add_row, apply, mat, put_row, row
from gaitwright.plant.armstrong.contact import NOWHERE, SLOTS, Feet, contact_forces, let_go, slip_rates
from gaitwright.plant.armstrong.joints import Joints, hinge_states, joint_torques
from gaitwright.plant.armstrong.rotors import hinge_mobility, with_rotors


class System(NamedTuple):
    """Links, what joins them, and what they stand on; constant while they move."""

    tree: Tree
    joints: Joints
    feet: Feet
    gravity: np.ndarray
    """`(3,)` [m/s²]."""


class Drive(NamedTuple):
    """What acts on a system for one control period."""

    motor: np.ndarray
    """`(hinges,)` torques about the hinges [N·m]."""
    planes: np.ndarray
    """`(slots, 6)` the ground under the feet: point and normal, world."""
    push: np.ndarray
    """`(3,)` force on the root's centre of mass, world [N]."""
    newton: np.ndarray
    """`(hinges, hinges)` `rotors.newton_matrix`; `(0, 0)` where there are no rotors."""


class Parts(NamedTuple):
    """Views of a state's parts."""

    x: np.ndarray
    quaternion: np.ndarray
    slip: np.ndarray
    v: np.ndarray
    w: np.ndarray


@kernel
def rates_begin(system):
    """Where a state's rates begin."""
    return 3 + 4 * system.tree.mass.size + 3 * SLOTS * system.feet.link.size


@kernel
def parts(system, y):
    """The `Parts` of a state."""
    n = system.tree.mass.size
    a, b = 3 + 4 * n, rates_begin(system)
    return Parts(
        y[:3],
        y[3:a].reshape(n, 4),
        y[a:b].reshape((b - a) // 3, 3),
        y[b : b + 3],
        y[b + 3 :].reshape(n, 3),
    )


@kernel
def rotations(quaternion):
    """Orientations `(links, 3, 3)`, link → world, of quaternions of about unit length."""
    n = quaternion.shape[0]
    R = np.empty((n, 3, 3))
    for r in range(n):
        w, x, y, z = quaternion[r, 0], quaternion[r, 1], quaternion[r, 2], quaternion[r, 3]
        k = 2.0 / (w * w + x * x + y * y + z * z)
        R[r, 0, 0], R[r, 0, 1], R[r, 0, 2] = 1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)
        R[r, 1, 0], R[r, 1, 1], R[r, 1, 2] = k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)
        R[r, 2, 0], R[r, 2, 1], R[r, 2, 2] = k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)
    return R


@kernel
def hinges_in_world(tree, R, p):
    """Positions and velocities `(links, 3)` of the links' hinges, world, for the parts of a state."""
    n = tree.mass.size
    at, rate = np.empty((n, 3)), np.empty((n, 3))
    put_row(at, 0, (p.x[0], p.x[1], p.x[2]))
    put_row(rate, 0, (p.v[0], p.v[1], p.v[2]))
    for r in range(1, n):
        k = tree.parent[r]
        put_row(at, r, add(row(at, k), apply(mat(R, k), row(tree.hinge, r))))
        put_row(rate, r, add(row(rate, k), apply(mat(R, k), cross(row(p.w, k), row(tree.hinge, r)))))
    return at, rate


@kernel
def loads(system, drive, y):
    """What acts in a state: R, torque, force, moment as `armstrong.accelerations` wants, and foot loads."""
    tree, p = system.tree, parts(system, y)
    R = rotations(p.quaternion)
    at, rate = hinges_in_world(tree, R, p)
    torque = joint_torques(tree, system.joints, R, p.w, drive.motor)
    force, moment = np.zeros((tree.mass.size, 3)), np.zeros((tree.mass.size, 3))
    push = (drive.push[0], drive.push[1], drive.push[2])
    add_row(force, 0, push)
    add_row(moment, 0, cross(apply(mat(R, 0), row(tree.com, 0)), push))
    load = contact_forces(system.feet, drive.planes, p.slip, R, at, rate, p.w, force, moment)
    return R, torque, force, moment, load


@kernel
def velocity_rates(system, drive, y, slow, fresh, out):
    """Writes the accelerations of a state into the last part of `out`.

    `fresh`: with Armstrong's slow coefficients of this state; else with `slow`.
    """
    R, torque, force, moment, _ = loads(system, drive, y)
    if fresh:
        slow = slow_coefficients(system.tree, R)
    w = parts(system, y).w
    load = (torque, force, moment, system.gravity)
    if drive.newton.size:
        a = with_rotors(system.tree, system.joints, slow, R, w, *load, drive.newton)
    else:
        a = fast_accelerations(system.tree, slow, R, w, *load)
    out[rates_begin(system) :] = a.ravel()


@kernel
def position_rates(system, drive, y, out):
    """Writes the rates of a state's first part into that of `out`."""
    p, d = parts(system, y), parts(system, out)
    d.x[:] = p.v
    for r in range(p.w.shape[0]):
        a, b, c, e = p.quaternion[r, 0], p.quaternion[r, 1], p.quaternion[r, 2], p.quaternion[r, 3]
        x, y_, z = row(p.w, r)
        d.quaternion[r, 0] = 0.5 * (-b * x - c * y_ - e * z)
        d.quaternion[r, 1] = 0.5 * (a * x + c * z - e * y_)
        d.quaternion[r, 2] = 0.5 * (a * y_ + e * x - b * z)
        d.quaternion[r, 3] = 0.5 * (a * z + b * y_ - c * x)
    if system.feet.link.size:
        R = rotations(p.quaternion)
        at, rate = hinges_in_world(system.tree, R, p)
        slip_rates(system.feet, drive.planes, R, at, rate, p.w, d.slip)


@kernel
def settle(system, drive, y):
    """After a step: quaternions of unit length, bristles that hold no more than friction does."""
    p = parts(system, y)
    for r in range(p.quaternion.shape[0]):
        a, b, c, d = p.quaternion[r, 0], p.quaternion[r, 1], p.quaternion[r, 2], p.quaternion[r, 3]
        k = 1.0 / np.sqrt(a * a + b * b + c * c + d * d)
        for i in range(4):
            p.quaternion[r, i] *= k
    if system.feet.link.size:
        R = rotations(p.quaternion)
        at, _ = hinges_in_world(system.tree, R, p)
        let_go(system.feet, drive.planes, R, at, p.slip)


@kernel
def sensed(system, drive, y):
    """What is sensed in a state, in one array: angles and rates of the hinges, foot loads, foot centres."""
    feet, p = system.feet, parts(system, y)
    R, _, _, _, load = loads(system, drive, y)
    angles = hinge_states(system.tree, system.joints, R, p.w)
    at, _ = hinges_in_world(system.tree, R, p)
    centres = np.empty((feet.link.size, 3))
    for f in range(feet.link.size):
        k = feet.link[f]
        put_row(centres, f, add(row(at, k), apply(mat(R, k), row(feet.at, f))))
    return np.concatenate((angles.ravel(), load, centres.ravel()))


@kernel
def mobility_of_hinges(system, y):
    """`rotors.hinge_mobility` of a state."""
    return hinge_mobility(system.tree, system.joints, rotations(parts(system, y).quaternion))


# --- a tree that floats freely -------------------------------------------------------------------
def floating(tree: Tree, gravity: Float[np.ndarray, "3"] | None = None) -> System:
    """A tree with nothing in its joints and nothing to stand on; without gravity unless said."""
    none, whole = np.zeros(0), np.zeros(0, dtype=np.int64)
    joints = Joints(
        whole, whole, whole, np.zeros((0, 3, 3)), none, np.zeros((0, 2)), np.zeros((0, 2)), *[none] * 7
    )
    feet = Feet(whole, np.zeros((0, 3)), *[none] * 4)
    return System(tree, joints, feet, np.zeros(3) if gravity is None else gravity)


def at_rest(system: System) -> Drive:
    """Motors off, no push, and no ground within reach."""
    planes = np.tile([0.0, 0.0, NOWHERE, 0.0, 0.0, 1.0], (SLOTS * system.feet.link.size, 1))
    return Drive(np.zeros(system.joints.lower.size), planes, np.zeros(3), np.zeros((0, 0)))
