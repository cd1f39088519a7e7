"""Other people's mechanics: our robots in MuJoCo and Pinocchio, and robots drawn at random."""

import sys
from dataclasses import dataclass, replace
from functools import cache

import mujoco
import numpy as np
import pytest

from gaitwright.bench.evidence.oracles import hinge_model, pinocchio
from gaitwright.description.load import load_robot
from gaitwright.ground.scene import load_scene
from gaitwright.model.kinematics import reached_branches, to_leg
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.plant.mujoco.world import Placed, build_world
from robots_by_hand import dog, insect

NEEDS_PINOCCHIO = pytest.mark.skipif(sys.platform == "win32", reason="Pinocchio has no wheels there")
"""On tests that compare with it. Anywhere else it is one of the test dependencies: without it they fail."""
BY_HAND = {"dog": dog, "insect": insect}


@cache
def robot_called(name: str) -> Robot:
    """A built-in robot, or one of the two by hand."""
    return BY_HAND[name]() if name in BY_HAND else load_robot(name)


@dataclass(frozen=True)
class State:
    """Pose, velocity and acceleration of a robot; conventions of `Sensed`, accelerations in the same axes."""

    position_w: np.ndarray
    orientation_wb: np.ndarray
    velocity_w: np.ndarray
    angular_velocity_b: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    acceleration_w: np.ndarray
    angular_acceleration_b: np.ndarray
    qdd: np.ndarray


def any_state(robot: Robot, rng: np.random.Generator) -> State:
    """A robot somewhere, turned anyhow, in rapid motion."""
    three, joints = (rng.normal(0.0, 3.0, (5, 3)), rng.normal(0.0, 5.0, (2, robot.n, 3)))
    quaternion = rng.normal(size=4)
    return State(
        three[0],
        quaternion / np.linalg.norm(quaternion),
        three[1],
        three[2],
        rng.uniform(-np.pi, np.pi, (robot.n, 3)),
        joints[0],
        three[3],
        three[4],
        4.0 * joints[1],
    )


def branches(robot: Robot, leg: str, foot_b: np.ndarray) -> dict[tuple[int, int], np.ndarray]:
    """Joint angles [rad] of each branch (sg, kn) that brings the foot of `leg` to `foot_b`, base frame [m].

    Four far inside the reach, none outside; at a singular pose two are the same. Joint limits are not asked.
    """
    i = robot.legs.index(leg)
    point = to_leg(robot.leg_frame[i], robot.hip[i], foot_b)
    return reached_branches(point, robot.offset[i], float(robot.sign[i]))


def unlike(robot: Robot, rng: np.random.Generator) -> Robot:
    """A robot of the same build with other lengths, axes, masses and inertias, no two alike."""
    n = robot.n
    massless = robot.mass == 0.0
    size = np.abs(robot.offset).max()
    return replace(
        robot,
        base_mass=robot.base_mass * rng.uniform(0.5, 2.0),
        base_com=rng.normal(0.0, 0.2 * size, 3),
        base_inertia=any_inertia(rng, robot.base_mass, size),
        hip=robot.hip + rng.normal(0.0, 0.2 * size, (n, 3)),
        leg_frame=np.stack([rotation(rng.normal(size=4)) for _ in range(n)]),
        offset=robot.offset + rng.normal(0.0, 0.2 * size, (n, 3, 3)),
        sign=rng.choice([-1.0, 1.0], n),
        mass=robot.mass * rng.uniform(0.5, 2.0, (n, 3)),
        com=np.where(massless[..., None], 0.0, rng.normal(0.0, 0.3 * size, (n, 3, 3))),
        inertia=np.stack(
            [[any_inertia(rng, m, size) if m else np.zeros((3, 3)) for m in masses] for masses in robot.mass]
        ),
        armature=robot.armature * rng.uniform(0.0, 3.0, (n, 3)),
    )


def any_inertia(rng: np.random.Generator, mass: float, size: float) -> np.ndarray:
    """Inertia of a cloud of points around its centre: always that of a possible body."""
    points = rng.normal(0.0, 0.3 * size, (8, 3))
    points -= points.mean(axis=0)
    return mass / 8 * sum(p @ p * np.eye(3) - np.outer(p, p) for p in points)


# --- MuJoCo --------------------------------------------------------------------------------------
def bare_world(robot: Robot) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The robot alone: no contact, no joint limit, no friction."""
    model = build_world([Placed(robot)], load_scene("flat"))
    model.dof_damping[:] = 0.0
    model.dof_frictionloss[:] = 0.0
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL
    return model, mujoco.MjData(model)


def put(data: mujoco.MjData, position_w, orientation_wb, velocity_w, angular_velocity_b, q, qd) -> None:
    """Sets pose and velocity."""
    data.qpos[:] = np.concatenate([position_w, orientation_wb, np.ravel(q)])
    data.qvel[:] = np.concatenate([velocity_w, angular_velocity_b, np.ravel(qd)])


def mujoco_inverse(robot: Robot, s: State) -> tuple[np.ndarray, np.ndarray]:
    """M q̈ + h by MuJoCo: wrench at the base origin in base axes `(6,)`, joint torques `(legs, 3)`."""
    model, data = bare_world(robot)
    put(data, s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, s.q, s.qd)
    data.qacc[:] = np.concatenate([s.acceleration_w, s.angular_acceleration_b, s.qdd.ravel()])
    mujoco.mj_inverse(model, data)
    force_b = rotation(s.orientation_wb).T @ data.qfrc_inverse[:3]
    return np.concatenate([force_b, data.qfrc_inverse[3:6]]), data.qfrc_inverse[6:].reshape(robot.n, 3)


def mujoco_forward(robot, sensed, tau, arm, forces_w) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Accelerations (`data.qacc`) under torques, and forces at `arm` from the base origin, world axes."""
    model, data = bare_world(robot)
    put(data, sensed.position_w, sensed.orientation_wb, sensed.velocity_w, sensed.angular_velocity_b,
        sensed.q, sensed.qd)  # fmt: skip
    mujoco.mj_fwdPosition(model, data)
    data.ctrl[:] = np.ravel(tau)
    pull = np.zeros(model.nv)
    for leg, r, f in zip(robot.legs, arm, forces_w, strict=True):
        shank = model.body(f"{leg}_shank").id
        mujoco.mj_applyFT(model, data, f, np.zeros(3), sensed.position_w + r, shank, pull)
    data.qfrc_applied[:] = pull
    mujoco.mj_forward(model, data)
    return model, data


def mujoco_foot_accelerations(robot: Robot, model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """Accelerations of the foot centres `(legs, 3)`, world axes [m/s²]."""
    mujoco.mj_rnePostConstraint(model, data)
    six, out = np.zeros(6), np.empty((robot.n, 3))
    for leg in range(robot.n):
        mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_SITE, leg, six, 0)
        out[leg] = six[3:] - (0.0, 0.0, GRAVITY)
    return out


# --- Pinocchio -----------------------------------------------------------------------------------
def pinocchio_inverse(robot: Robot, s: State) -> tuple[np.ndarray, np.ndarray]:
    """The same as `mujoco_inverse`, by Pinocchio, which counts a free body's motion in its own axes."""
    pin = pinocchio()
    model = hinge_model(robot)
    R = rotation(s.orientation_wb)
    w = s.angular_velocity_b
    v = R.T @ s.velocity_w
    quaternion = np.roll(s.orientation_wb, -1)
    spatial = R.T @ s.acceleration_w - np.cross(w, v)
    tau = pin.rnea(
        model,
        model.createData(),
        np.concatenate([s.position_w, quaternion, s.q.ravel()]),
        np.concatenate([v, w, s.qd.ravel()]),
        np.concatenate([spatial, s.angular_acceleration_b, s.qdd.ravel()]),
    )
    return tau[:6], tau[6:].reshape(robot.n, 3)
