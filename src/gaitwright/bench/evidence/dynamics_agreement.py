"""How far our dynamics are from Pinocchio's, and from a closed form, on random states."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from gaitwright.bench.evidence.oracles import ball_model, hinge_model
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.dynamics.armstrong import packed_accelerations
from gaitwright.dynamics.articulated import Accelerations, contact_arms, direct_dynamics
from gaitwright.dynamics.checks import recursion_check
from gaitwright.dynamics.newton_euler import dynamics_in, dynamics_of, state_numbers
from gaitwright.dynamics.tree import Tree, ball_tree, packed
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import Sensed

STATES = 200
"""Random states of each robot whose answers are compared."""
CLOSE = at_most(1e-10)
"""Largest difference, as a share of the largest number of its kind."""
UPRIGHT = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
UP = np.array([0.0, 0.0, 1.0])


def any_state(robot: Robot, rng: np.random.Generator) -> np.ndarray:
    """A robot in rapid motion, as `dynamics_of` reads it."""
    w, wd, a = rng.normal(0.0, 3.0, (3, 3))
    q, qd, qdd = rng.normal(0.0, 2.0, (3, robot.n, 3))
    return state_numbers(w, wd, a, q, qd, qdd)


def unlike(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Largest difference, as a share of their largest number."""
    return float(np.abs(ours - theirs).max() / np.abs(theirs).max())


# --- hinge legs ------------------------------------------------------------------------------------
def pinocchio_state(robot: Robot, state: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """q, v and a of the same state, base upright at the origin and at rest but for its omega."""
    w, wd, a = state[:9].reshape(3, 3)
    q, qd, qdd = state[9:].reshape(3, -1)
    true = a - GRAVITY * UP  # ours is less gravity
    return np.append(UPRIGHT, q), np.concatenate([np.zeros(3), w, qd]), np.concatenate([true, wd, qdd])


def inverse_agreement(pin: Any, robot: Robot, seed: int) -> Figure:
    """Inverse dynamics against Pinocchio's recursion."""
    model = hinge_model(robot)
    data, rng, worst = model.createData(), np.random.default_rng(seed), 0.0
    for _ in range(STATES):
        state = any_state(robot, rng)
        ours = dynamics_in(dynamics_of(robot.packed, state))
        theirs = pin.rnea(model, data, *pinocchio_state(robot, state))
        worst = max(worst, unlike(np.concatenate([ours.wrench, ours.tau.ravel()]), theirs))
    what = f"{robot.name}: inverse dynamics against Pinocchio, largest relative difference"
    return Figure(what, worst, "", CLOSE, STATES)


def direct_agreement(pin: Any, robot: Robot, seed: int) -> Figure:
    """Articulated bodies, with wrenches on base and feet, against Pinocchio's."""
    model = hinge_model(robot)
    data, rng, worst = model.createData(), np.random.default_rng(seed), 0.0
    for _ in range(STATES):
        sensed = any_sensed(robot, rng)
        tau, push, wrench = rng.normal(size=(robot.n, 3)), rng.normal(size=(robot.n, 6)), rng.normal(size=6)
        arm = contact_arms(robot, sensed, UP)
        w, pull = tuple(sensed.angular_velocity_b), (tuple(wrench[:3]), tuple(wrench[3:]))
        wd, a, qdd = direct_dynamics(robot.packed, w, sensed.q, sensed.qd, tau, arm, push, pull)
        place = np.append(UPRIGHT, sensed.q)
        outside = foot_wrenches(pin, model, data, place, arm, push)
        rates = np.concatenate([np.zeros(3), w, sensed.qd.ravel()])
        theirs = pin.aba(model, data, place, rates, np.append(wrench, tau), outside)
        worst = max(worst, unlike(np.concatenate([a - GRAVITY * UP, wd, qdd.ravel()]), theirs))
    what = (
        f"{robot.name}: direct dynamics (articulated bodies) against Pinocchio, largest relative difference"
    )
    return Figure(what, worst, "", CLOSE, STATES)


def foot_wrenches(pin: Any, model: Any, data: Any, place: np.ndarray, arm: np.ndarray, push: np.ndarray):
    """Wrenches at `arm` on the last links, in those links' axes, as `pin.aba` takes them."""
    pin.forwardKinematics(model, data, place)
    outside = [pin.Force.Zero() for _ in range(model.njoints)]
    for leg, (at, load) in enumerate(zip(arm, push, strict=True)):
        joint = 1 + 3 * (leg + 1)
        about_origin = pin.Force(load[:3], load[3:] + np.cross(at, load[:3]))
        outside[joint] = data.oMi[joint].actInv(about_origin)
    return outside


def any_sensed(robot: Robot, rng: np.random.Generator) -> Sensed:
    """An upright robot in rapid motion; its base does not move on."""
    w = rng.normal(0.0, 3.0, 3)
    q, qd = rng.normal(0.0, 2.0, (2, robot.n, 3))
    upright = np.array([1.0, 0.0, 0.0, 0.0])
    return Sensed(0.0, np.zeros(3), upright, np.zeros(3), w, q, qd, np.zeros(robot.n))


def closed_form_agreement(robot: Robot, seed: int) -> Figure:
    """Inverse dynamics by recursion against M q̈ + h by sums over bodies."""
    rng, checks = np.random.default_rng(seed), []
    for _ in range(STATES):
        linear, angular = rng.normal(0.0, 3.0, (2, 3))
        wanted = Accelerations(linear, angular, rng.normal(0.0, 2.0, (robot.n, 3)))
        checks.append(recursion_check(robot, any_sensed(robot, rng), wanted))
    worst = max(checks, key=lambda check: check.worst)
    what = f"{robot.name}: inverse dynamics against a closed form, largest relative difference"
    return Figure(what, worst.worst, "", CLOSE, STATES, f"at {worst.where}")


# --- ball-jointed trees ----------------------------------------------------------------------------
def armstrong_agreement(pin: Any, robot: Robot, seed: int) -> Iterator[Figure]:
    """Armstrong's recursion against Pinocchio's articulated bodies: the root, and all links' turning."""
    tree, _ = ball_tree(robot)
    n, numbers, rng = tree.mass.size, packed(tree), np.random.default_rng(seed)
    gravity = np.array([0.0, 0.0, -GRAVITY])
    model = ball_model(tree, gravity)
    data, root, turning = model.createData(), 0.0, 0.0
    for _ in range(STATES):
        R = np.array([rotation(quaternion) for quaternion in rng.normal(size=(n, 4))])
        w, torque, force, moment = rng.normal(0.0, 3.0, (4, n, 3))
        torque[0] = 0.0  # nothing holds the root
        load = np.concatenate([torque.ravel(), force.ravel(), moment.ravel(), gravity])
        ours = packed_accelerations(numbers, np.append(R, w), load)
        theirs = tree_accelerations(pin, (model, data), tree, R, w, (torque, force, moment))
        root = max(root, unlike(ours[0], theirs[0]))
        turning = max(turning, unlike(ours[1:], theirs[1:]))
    for what, worst in (("acceleration of the root", root), ("angular accelerations of the links", turning)):
        told = (
            f"{robot.name}, {n} links: Armstrong's recursion against Pinocchio, {what}, relative difference"
        )
        yield Figure(told, worst, "", CLOSE, STATES)


def tree_accelerations(
    pin: Any, engine: tuple[Any, Any], tree: Tree, R: np.ndarray, w: np.ndarray, load: tuple[np.ndarray, ...]
) -> np.ndarray:
    """By Pinocchio, laid out as `armstrong.accelerations`; the root at rest in the origin.

    Pinocchio counts a link's turning relative to its parent, in the link's axes: those add up here, with
    the turning of the axes, w_rel × w_parent.
    """
    above, (torque, force, moment) = tree.parent[1:], load
    own = np.concatenate([R[:1], R[above].transpose(0, 2, 1) @ R[1:]])
    carried = np.einsum("kji,kj->ki", own[1:], w[above])
    rates = w[1:] - carried
    turns = [pin.Quaternion(turn).coeffs() for turn in own]
    outside = [pin.Force.Zero()]
    outside += [pin.Force(turn.T @ f, turn.T @ g) for turn, f, g in zip(R, force, moment, strict=True)]
    v = np.concatenate([np.zeros(3), w[0], rates.ravel()])
    tau = np.concatenate([np.zeros(6), torque[1:].ravel()])
    qdd = pin.aba(*engine, np.concatenate([np.zeros(3), *turns]), v, tau, outside)
    out = [R[0] @ qdd[:3], qdd[3:6]]
    for k, p in enumerate(above):
        relative = qdd[6 + 3 * k : 9 + 3 * k] - np.cross(rates[k], carried[k])
        out.append(relative + own[k + 1].T @ out[1 + p])
    return np.array(out)
