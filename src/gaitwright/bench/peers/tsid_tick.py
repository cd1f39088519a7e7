"""TSID's whole-body control tick, timed: a standalone script for TSID's own interpreter.

Set up as a locomotion user would: base pose and swing feet as SE(3) tasks, posture regularisation, point
contacts with friction pyramids, torque bounds, eiquadprog-fast. One formulation per stance pattern is made
beforehand, so that adding and removing contacts costs the peer nothing, and so are its references.

    python tsid_tick.py robot.urdf states.npz [--serve] [--answers out.npz]
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from importlib.metadata import version

import numpy as np
import pinocchio as pin
from tick_protocol import Answer, Joints, States, arguments, configurations, main, read_states, rotation

with warnings.catch_warnings():
    warnings.simplefilter("ignore", RuntimeWarning)  # converters that TSID registers twice
    from tsid import tsid_pywrap as tsid  # the 1.7.1 wheel has its tsid/__init__.py one folder too deep

BASE_KP, BASE_WEIGHT = 100.0, 1.0  # 1/s²
SWING_KP, SWING_WEIGHT = 400.0, 1.0
POSTURE_KP, POSTURE_WEIGHT = 25.0, 1e-3
CONTACT_KP = 30.0
FORCE_WEIGHT = 1e-5
MIN_NORMAL_N, MAX_NORMAL_N = 1.0, 1000.0
HARD, SOFT = 0, 1

Reference = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Position and rotation by columns (12), velocity (6), acceleration (6), all world-aligned."""


@dataclass(frozen=True)
class Formulation:
    """One stance pattern's problem, its tasks and its solver."""

    problem: tsid.InverseDynamicsFormulationAccForce
    solver: tsid.SolverHQuadProgFast
    base: tsid.TaskSE3Equality
    contacts: dict[int, tsid.ContactPoint]  # by leg
    swings: dict[int, tsid.TaskSE3Equality]  # by leg
    kept: tuple[object, ...]  # TSID holds plain references: these must outlive the problem


class TsidTick:
    """TSID on one robot and one set of states."""

    peer = "TSID"
    note = (
        "solves for accelerations and contact forces together (weighted base, swing-foot and posture tasks "
        "under full dynamics), a richer problem than sharing forces; called from Python"
    )

    def __init__(self, urdf: str, states: States) -> None:
        self.version = version("tsid")
        self.states = states
        model = pin.buildModelFromUrdf(urdf, pin.JointModelFreeFlyer())
        self.effort = model.effortLimit[6:]
        self.joints = _joints(model, states)
        model.armature = np.concatenate([np.zeros(6), self._in_peer_order(states.armature)])
        self.robot = tsid.RobotWrapper(model, tsid.FLOATING_BASE_SYSTEM, False)
        self.q, self.v = configurations(states, self.joints)
        self.sample = tsid.TrajectorySample(12, 6)
        self.base_refs, self.foot_refs = _base_references(states), _foot_references(states)
        self.formulations = {
            pattern: self._formulation(np.array(pattern))
            for pattern in sorted({tuple(row) for row in states.stance})
        }

    def _formulation(self, stance: np.ndarray) -> Formulation:
        problem = tsid.InverseDynamicsFormulationAccForce("tsid", self.robot, False)
        problem.computeProblemData(0.0, self.q[0], self.v[0])
        base = self._se3_task("base", "base", BASE_KP, np.ones(6))
        problem.addMotionTask(base, BASE_WEIGHT, SOFT, 0.0)
        posture, torque = self._posture_task(), self._torque_task()
        problem.addMotionTask(posture, POSTURE_WEIGHT, SOFT, 0.0)
        problem.addActuationTask(torque, 1.0, HARD, 0.0)
        feet = self.states.foot_names()
        contacts = {leg: self._contact(feet[leg]) for leg in np.flatnonzero(stance)}
        position_only = np.array([1.0, 1, 1, 0, 0, 0])
        swings = {
            leg: self._se3_task(feet[leg], feet[leg], SWING_KP, position_only)
            for leg in np.flatnonzero(~stance)
        }
        for contact in contacts.values():
            problem.addRigidContact(contact, FORCE_WEIGHT)
        for swing in swings.values():
            problem.addMotionTask(swing, SWING_WEIGHT, SOFT, 0.0)
        solver = tsid.SolverHQuadProgFast("eiquadprog-fast")
        solver.resize(problem.nVar, problem.nEq, problem.nIn)
        return Formulation(problem, solver, base, contacts, swings, (posture, torque))

    def _se3_task(self, name: str, frame: str, kp: float, mask: np.ndarray) -> tsid.TaskSE3Equality:
        task = tsid.TaskSE3Equality(f"{name}_task", self.robot, frame)
        task.setKp(kp * np.ones(6))
        task.setKd(2 * np.sqrt(kp) * np.ones(6))
        task.setMask(mask)
        task.useLocalFrame(False)
        return task

    def _posture_task(self) -> tsid.TaskJointPosture:
        hinges = self.robot.na
        task = tsid.TaskJointPosture("posture", self.robot)
        task.setKp(POSTURE_KP * np.ones(hinges))
        task.setKd(2 * np.sqrt(POSTURE_KP) * np.ones(hinges))
        rest = tsid.TrajectorySample(hinges)
        rest.value(self._in_peer_order(self.states.posture))
        task.setReference(rest)
        return task

    def _in_peer_order(self, values: np.ndarray) -> np.ndarray:
        """(legs, 3) in our order → (hinges,) in TSID's."""
        ordered = np.zeros(values.size)
        ordered[self.joints.in_v - 6] = values.ravel()
        return ordered

    def _torque_task(self) -> tsid.TaskActuationBounds:
        task = tsid.TaskActuationBounds("torque", self.robot)
        task.setBounds(-self.effort, self.effort)
        return task

    def _contact(self, foot: str) -> tsid.ContactPoint:
        up = np.array([0.0, 0.0, 1.0])
        contact = tsid.ContactPoint(
            foot, self.robot, foot, up, self.states.friction, MIN_NORMAL_N, MAX_NORMAL_N
        )
        contact.setKp(CONTACT_KP * np.ones(3))
        contact.setKd(2 * np.sqrt(CONTACT_KP) * np.ones(3))
        contact.useLocalFrame(False)
        return contact

    def prepare(self, state: int) -> None:
        """Not timed: choose the formulation of the stance, set its footholds."""
        self.stance = tuple(self.states.stance[state])
        self.now = self.formulations[self.stance]
        for leg, contact in self.now.contacts.items():
            contact.setReference(pin.SE3(np.eye(3), self.states.foot_position_w[state, leg]))

    def step(self, state: int) -> bool:
        """Timed: references, problem data, solve, torques."""
        now = self.now
        self._refer(now.base, self.base_refs[state])
        for leg, swing in now.swings.items():
            self._refer(swing, self.foot_refs[state][leg])
        data = now.problem.computeProblemData(0.0, self.q[state], self.v[state])
        self.solution = now.solver.solve(data)
        self.torques = now.problem.getActuatorForces(self.solution)
        return self.solution.status == 0

    def _refer(self, task: tsid.TaskSE3Equality, reference: Reference) -> None:
        pose, velocity, acceleration = reference
        self.sample.value(pose)
        self.sample.derivative(velocity)
        self.sample.second_derivative(acceleration)
        task.setReference(self.sample)

    def answer(self) -> Answer:
        """Torques and forces of the last step, in our leg order."""
        forces_w = np.zeros((len(self.states.leg_names), 3))
        for leg in self.now.contacts:
            forces_w[leg] = self.now.problem.getContactForce(self.states.foot_names()[leg], self.solution)
        return Answer(self.torques[self.joints.in_v - 6].reshape(-1, 3), forces_w)


def _joints(model: pin.Model, states: States) -> Joints:
    ids = [model.getJointId(name) for name in states.joint_names()]
    return Joints(np.array([model.idx_qs[i] for i in ids]), np.array([model.idx_vs[i] for i in ids]))


def _base_references(states: States) -> list[Reference]:
    """The base's reference of each state, made beforehand."""
    references = []
    for i in range(len(states)):
        turn = rotation(states.target_quat[i])
        pose = np.concatenate([states.target_position[i], turn.ravel(order="F")])
        velocity = np.concatenate([states.target_velocity_w[i], turn @ states.target_angular_velocity_b[i]])
        spin_up_w = turn @ states.target_angular_acceleration_b[i]
        references.append((pose, velocity, np.concatenate([states.target_acceleration_w[i], spin_up_w])))
    return references


def _foot_references(states: States) -> list[list[Reference]]:
    """Each state's reference of each foot, made beforehand; the mask leaves the rotations out."""
    level, still = np.eye(3).ravel(), np.zeros(3)
    return [
        [
            (
                np.concatenate([place, level]),
                np.concatenate([velocity, still]),
                np.concatenate([acceleration, still]),
            )
            for place, velocity, acceleration in zip(*feet, strict=True)
        ]
        for feet in zip(
            states.foot_position_w, states.foot_velocity_w, states.foot_acceleration_w, strict=True
        )
    ]


if __name__ == "__main__":
    options = arguments("TSID's whole-body control tick, timed")
    states = read_states(options.states)
    main(TsidTick(str(options.urdf), states), states, options)
