"""Trees of ball-jointed links drawn at random, and the same trees in Pinocchio and MuJoCo."""

from dataclasses import dataclass

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from gaitwright.bench.evidence.oracles import ball_model, pinocchio
from gaitwright.dynamics.tree import Tree, about_point, checked_tree
from gaitwright.numerics.geometry import rotation
from oracles import any_inertia

QUADRUPED = (-1, 0, 1, 0, 3, 0, 5, 0, 7)
"""Four legs of two links: parents of nine links."""


@dataclass(frozen=True)
class Motion:
    """What `accelerations` takes besides the tree, and a place and velocity of the root in the world."""

    R: np.ndarray
    w: np.ndarray
    torque: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    gravity: np.ndarray
    x: np.ndarray
    v: np.ndarray

    @property
    def arguments(self) -> tuple[np.ndarray, ...]:
        return self.R, self.w, self.torque, self.force, self.moment, self.gravity


def any_tree(rng: np.random.Generator) -> Tree:
    """A quadruped every other time, else up to twelve links that branch anywhere; no two links alike."""
    parent = QUADRUPED
    if rng.random() < 0.5:
        parent = (-1, *(int(rng.integers(k)) for k in range(1, rng.integers(1, 13))))
    n = len(parent)
    mass = rng.uniform(0.2, 5.0, n)
    com = rng.normal(0.0, 0.3, (n, 3))
    inertia = [any_inertia(rng, m, 1.0) + about_point(m, c) for m, c in zip(mass, com, strict=True)]
    hinge = rng.normal(0.0, 0.5, (n, 3))
    hinge[0] = 0.0
    return checked_tree(Tree(np.array(parent), hinge, mass, com, np.array(inertia)))


def any_motion(tree: Tree, rng: np.random.Generator) -> Motion:
    """Links turned anyhow in rapid motion, torques in every joint and wrenches on every link."""
    n = tree.mass.size
    R = np.array([rotation(quaternion) for quaternion in rng.normal(size=(n, 4))])
    w, torque, force, moment = rng.normal(0.0, 3.0, (4, n, 3))
    torque[0] = 0.0
    return Motion(R, w, torque, force, moment, *rng.normal(0.0, 5.0, (3, 3)))


def joint_wrenches(tree: Tree, R, w, a0, wd, force, moment, gravity) -> np.ndarray:
    """Wrenches `(links, 6)` that a motion asks of the joints: force [N], then torque [N·m] (equations.md §4).

    By Newton and Euler about the centres of mass. `a0 (3,)`: acceleration of the root's origin, world axes;
    `wd (links, 3)`: angular accelerations, link axes. Row k: from the parent on link k at its hinge, link
    axes, -f and -g of the thesis (eq. 4-16, 4-17). Row 0: what would have to hold the root.
    """
    a, out = [R[0].T @ a0], np.zeros((len(w), 6))

    def carried(k: int, r: np.ndarray) -> np.ndarray:
        """Acceleration of a point at `r` on link `k` (eq. 4-12)."""
        return a[k] + np.cross(wd[k], r) + np.cross(w[k], np.cross(w[k], r))

    for k in range(1, len(w)):
        p = tree.parent[k]
        a.append(R[k].T @ R[p] @ carried(p, tree.hinge[k]))
    for k in range(len(w) - 1, -1, -1):
        m, c, p = tree.mass[k], tree.com[k], tree.parent[k]
        about_centre = tree.inertia[k] - about_point(m, c)
        F = m * (carried(k, c) - R[k].T @ gravity)
        N = about_centre @ wd[k] + np.cross(w[k], about_centre @ w[k])
        out[k, :3] += F - R[k].T @ force[k]
        out[k, 3:] += N + np.cross(c, F) - R[k].T @ moment[k]
        if k > 0:
            f, g = (R[p].T @ R[k] @ out[k].reshape(2, 3).T).T
            out[p] += [*f, *(g + np.cross(tree.hinge[k], f))]
    return out


def relative(tree: Tree, s: Motion) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of all links but the root: R of the recursion, the parent's w and w relative to it, link axes."""
    above = tree.parent[1:]
    R = s.R[above].transpose(0, 2, 1) @ s.R[1:]
    carried = np.einsum("kji,kj->ki", R, s.w[above])
    return R, carried, s.w[1:] - carried


def absolute(tree: Tree, s: Motion, root, qdd) -> np.ndarray:
    """Accelerations as ours from those of the root and of w_rel, which turn with the links."""
    R, carried, rates = relative(tree, s)
    out = [*np.asarray(root)]
    for k, p in enumerate(tree.parent):
        if k:
            out.append(qdd[k - 1] + R[k - 1].T @ out[1 + p] - np.cross(rates[k - 1], carried[k - 1]))
    return np.array(out)


# --- Pinocchio -----------------------------------------------------------------------------------
def pinocchio_arguments(tree: Tree, s: Motion) -> tuple:
    """q, v, tau and external forces for `pin.aba`."""
    pin = pinocchio()
    R, _, rates = relative(tree, s)
    turns = [Rotation.from_matrix(turn).as_quat() for turn in (s.R[0], *R)]
    outside = pin.StdVec_Force()
    outside.append(pin.Force.Zero())
    for turn, f, g in zip(s.R, s.force, s.moment, strict=True):
        outside.append(pin.Force(turn.T @ f, turn.T @ g))
    q = np.concatenate([s.x, *turns])
    v = np.concatenate([s.R[0].T @ s.v, s.w[0], rates.ravel()])
    return q, v, np.concatenate([np.zeros(6), s.torque[1:].ravel()]), outside


def pinocchio_accelerations(tree: Tree, s: Motion) -> np.ndarray:
    """By Featherstone's articulated bodies, which counts a free body's motion in its own axes."""
    pin = pinocchio()
    model = ball_model(tree, s.gravity)
    qdd = pin.aba(model, model.createData(), *pinocchio_arguments(tree, s))
    a = s.R[0] @ (qdd[:3] + np.cross(s.w[0], s.R[0].T @ s.v))
    return absolute(tree, s, (a, qdd[3:6]), qdd[6:].reshape(-1, 3))


# --- MuJoCo --------------------------------------------------------------------------------------
def mujoco_tree(tree: Tree, gravity: np.ndarray) -> mujoco.MjModel:
    """The tree with a free joint and ball joints; nothing collides."""
    spec = mujoco.MjSpec()
    spec.option.gravity = gravity
    bodies = [spec.worldbody]
    for k, p in enumerate(tree.parent):
        body = bodies[int(p) + 1].add_body(name=f"link{k}", pos=tree.hinge[k])
        body.add_joint(type=mujoco.mjtJoint.mjJNT_BALL if k else mujoco.mjtJoint.mjJNT_FREE)
        J = tree.inertia[k] - about_point(tree.mass[k], tree.com[k])
        body.mass, body.ipos, body.explicitinertial = tree.mass[k], tree.com[k], True
        body.fullinertia = [J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]]
        bodies.append(body)
    return spec.compile()


def mujoco_accelerations(tree: Tree, s: Motion) -> np.ndarray:
    """By MuJoCo's mass matrix; it numbers bodies depth first, so all goes by names."""
    model = mujoco_tree(tree, s.gravity)
    data = mujoco.MjData(model)
    R, _, rates = relative(tree, s)
    bodies = [model.body(f"link{k}").id for k in range(tree.mass.size)]
    dofs = [model.body_dofadr[body] for body in bodies]
    places = [model.jnt_qposadr[model.body_jntadr[body]] for body in bodies]
    data.qpos[:3] = s.x
    data.qvel[:6] = [*s.v, *s.w[0]]
    places[0] += 3
    for place, turn in zip(places, (s.R[0], *R), strict=True):
        data.qpos[place : place + 4] = Rotation.from_matrix(turn).as_quat(scalar_first=True)
    for k in range(1, tree.mass.size):
        data.qvel[dofs[k] : dofs[k] + 3] = rates[k - 1]
        data.qfrc_applied[dofs[k] : dofs[k] + 3] = s.torque[k]
    for k, body in enumerate(bodies):
        about_centre = s.moment[k] - np.cross(s.R[k] @ tree.com[k], s.force[k])
        data.xfrc_applied[body] = [*s.force[k], *about_centre]
    mujoco.mj_forward(model, data)
    qdd = np.array([data.qacc[dof : dof + 3] for dof in dofs[1:]])
    return absolute(tree, s, data.qacc[:6].reshape(2, 3), qdd)
