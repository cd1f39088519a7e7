"""Direct dynamics by other engines, and robots with as many legs as a test asks for."""

from dataclasses import fields, replace

import numpy as np

from gaitwright.bench.evidence.oracles import hinge_model, pinocchio
from gaitwright.dynamics.articulated import Accelerations
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from gaitwright.signals import Sensed
from oracles import State, any_state, mujoco_forward, robot_called, unlike

FOUR, SIX, EIGHT = ("go2", "thesis", "insect"), ("hexapod",), ("eight dogs' legs", "eight insects' legs")
ALL = (*FOUR, *SIX, *EIGHT)


def robot_of(name: str, rng: np.random.Generator) -> Robot:
    """A robot of that build with numbers drawn at random."""
    if name in EIGHT:
        return unlike(twice(robot_called("dog" if "dog" in name else "insect")), rng)
    return unlike(robot_called(name), rng)


def twice(robot: Robot) -> Robot:
    """The robot with every leg two times."""
    per_leg = {
        f.name: np.concatenate([getattr(robot, f.name)] * 2)
        for f in fields(robot)
        if isinstance(getattr(robot, f.name), np.ndarray) and str(f.type).find("legs") >= 0
    }
    return replace(robot, legs=(*robot.legs, *(f"{leg}2" for leg in robot.legs)), **per_leg)


def sensed_in(s: State) -> Sensed:
    """The state without its accelerations."""
    return Sensed(
        0.0, s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, s.q, s.qd,
        np.zeros(len(s.q)),
    )  # fmt: skip


def any_sensed(robot: Robot, rng: np.random.Generator) -> tuple[Sensed, Accelerations]:
    """A state and accelerations drawn at random."""
    s = any_state(robot, rng)
    return sensed_in(s), Accelerations(s.acceleration_w, s.angular_acceleration_b, s.qdd)


def by_mujoco(robot: Robot, s: Sensed, tau, arm_w, forces_w) -> Accelerations:
    """Accelerations under torques and point forces on the feet."""
    _, data = mujoco_forward(robot, s, tau, arm_w, forces_w)
    return Accelerations(
        data.qacc[:3].copy(), data.qacc[3:6].copy(), data.qacc[6:].reshape(robot.n, 3).copy()
    )


def by_pinocchio(robot: Robot, s: Sensed, tau, arm_w, push_w, wrench_w) -> Accelerations:
    """Accelerations under torques, six-component wrenches on the feet and one on the base."""
    pin = pinocchio()
    model = hinge_model(robot)
    data = model.createData()
    R, w = rotation(s.orientation_wb), s.angular_velocity_b
    v = R.T @ s.velocity_w
    q = np.concatenate([s.position_w, np.roll(s.orientation_wb, -1), s.q.ravel()])
    pin.forwardKinematics(model, data, q)
    outer = [pin.Force.Zero() for _ in range(model.njoints)]
    outer[1] = pin.Force(R.T @ wrench_w[:3], R.T @ wrench_w[3:])
    for leg in range(robot.n):
        last = 4 + 3 * leg
        at = s.position_w + arm_w[leg]
        f, g = push_w[leg, :3], push_w[leg, 3:]
        outer[last] = data.oMi[last].actInv(pin.Force(f, g + np.cross(at, f)))
    rates = np.concatenate([v, w, s.qd.ravel()])
    a = pin.aba(model, data, q, rates, np.concatenate([np.zeros(6), np.ravel(tau)]), outer)
    return Accelerations(R @ (a[:3] + np.cross(w, v)), a[3:6].copy(), a[6:].reshape(robot.n, 3).copy())


def unlikeness(one: Accelerations, two: Accelerations) -> float:
    """Largest difference of two motions, as a share of the largest acceleration of its kind."""
    pairs = ((one.linear_w, two.linear_w), (one.angular_b, two.angular_b), (one.qdd, two.qdd))
    return max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)
