"""PlaCo's whole-body control tick, timed: a standalone script for PlaCo's own interpreter.

The same problem as `tsid_tick.py`: base pose and swing feet as weighted tasks, posture regularisation,
unilateral point contacts with friction, torque limits. One solver per stance pattern is made beforehand.

    python placo_tick.py robot.urdf states.npz [--serve] [--answers out.npz]
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import version

import numpy as np
import placo
from tick_protocol import (
    PARTS,
    Answer,
    Joints,
    States,
    arguments,
    configurations,
    main,
    read_states,
    rotation,
)

BASE_KP, BASE_WEIGHT = 100.0, 1.0  # 1/s²; PlaCo damps critically by itself
SWING_KP, SWING_WEIGHT = 400.0, 1.0
POSTURE_KP, POSTURE_WEIGHT = 25.0, 1e-3
CONTACT_KP = 30.0
FORCE_WEIGHT = 1e-5
CRITICAL = -1.0


@dataclass(frozen=True)
class Problem:
    """One stance pattern's solver and its tasks."""

    solver: placo.DynamicsSolver
    base: placo.DynamicsFrameTask
    contacts: dict[int, placo.PointContact]  # by leg
    feet: dict[int, placo.DynamicsPositionTask]  # by leg, hard in stance, soft in swing


class PlacoTick:
    """PlaCo on one robot and one set of states."""

    peer = "PlaCo"
    note = (
        "solves for accelerations and contact forces together (weighted base, swing-foot and posture tasks "
        "under full dynamics), a richer problem than sharing forces; called from Python"
    )

    def __init__(self, urdf: str, states: States) -> None:
        self.version = version("placo")
        self.states = states
        self.robot = placo.RobotWrapper(urdf, placo.Flags.ignore_collisions)
        names = states.joint_names()
        for name, inertia in zip(names, states.armature.ravel(), strict=True):
            self.robot.set_rotor_inertia(name, inertia)
        self.joints = Joints(
            np.array([self.robot.get_joint_offset(name) for name in names]),
            np.array([self.robot.get_joint_v_offset(name) for name in names]),
        )
        self.q, self.v = configurations(states, self.joints)
        self.base_poses, self.base_rates = _base_targets(states)
        self.problems = {
            pattern: self._problem(pattern) for pattern in sorted({tuple(row) for row in states.stance})
        }

    def _problem(self, stance: tuple[bool, ...]) -> Problem:
        solver = placo.DynamicsSolver(self.robot)
        solver.enable_torque_limits(True)
        base = solver.add_frame_task("base", np.eye(4))
        base.configure("base", "soft", BASE_WEIGHT, BASE_WEIGHT)
        for part in (base.position(), base.orientation()):
            part.kp, part.kd = BASE_KP, CRITICAL
        self._add_posture(solver)
        feet, contacts = {}, {}
        for leg, name in enumerate(self.states.foot_names()):
            feet[leg] = solver.add_position_task(name, np.zeros(3))
            feet[leg].configure(name, "hard" if stance[leg] else "soft", SWING_WEIGHT)
            feet[leg].kp, feet[leg].kd = (CONTACT_KP if stance[leg] else SWING_KP), CRITICAL
            if stance[leg]:
                contacts[leg] = solver.add_unilateral_point_contact(feet[leg])
                contacts[leg].mu, contacts[leg].weight_forces = self.states.friction, FORCE_WEIGHT
        return Problem(solver, base, contacts, feet)

    def _add_posture(self, solver: placo.DynamicsSolver) -> None:
        task = solver.add_joints_task()
        for leg, angles in zip(self.states.leg_names, self.states.posture, strict=True):
            for part, angle in zip(PARTS, angles, strict=True):
                task.set_joint(f"{leg}_{part}_joint", float(angle), 0.0, 0.0)
        task.configure("posture", "soft", POSTURE_WEIGHT)
        task.kp, task.kd = POSTURE_KP, CRITICAL

    def prepare(self, state: int) -> None:
        """Not timed: choose the problem of the stance, set its footholds."""
        self.stance = tuple(self.states.stance[state])
        self.now = self.problems[self.stance]
        for leg in self.now.contacts:
            self.now.feet[leg].target_world = self.states.foot_position_w[state, leg]

    def step(self, state: int) -> bool:
        """Timed: state, references, solve (which gives torques)."""
        now, states, robot = self.now, self.states, self.robot
        robot.state.q, robot.state.qd = self.q[state], self.v[state]
        robot.update_kinematics()
        now.base.T_world_frame = self.base_poses[state]
        self._set_rates(now.base.position(), now.base.orientation(), state)
        for leg, task in now.feet.items():
            if leg not in now.contacts:
                task.target_world = states.foot_position_w[state, leg]
                task.dtarget_world = states.foot_velocity_w[state, leg]
                task.ddtarget_world = states.foot_acceleration_w[state, leg]
        self.result = now.solver.solve()
        self.torques = self.result.tau
        return self.result.success

    def _set_rates(
        self, position: placo.DynamicsPositionTask, orientation: placo.DynamicsOrientationTask, state: int
    ) -> None:
        velocity, acceleration, spin, spin_up = self.base_rates[state]
        position.dtarget_world, position.ddtarget_world = velocity, acceleration
        orientation.omega_world, orientation.domega_world = spin, spin_up

    def answer(self) -> Answer:
        """Torques and forces of the last step, in our leg order."""
        forces_w = np.zeros((len(self.states.leg_names), 3))
        for leg, contact in self.now.contacts.items():
            forces_w[leg] = contact.wrench
        return Answer(self.torques[self.joints.in_v].reshape(-1, 3), forces_w)


def _base_targets(states: States) -> tuple[np.ndarray, np.ndarray]:
    """Base poses (N, 4, 4), and rates (N, 4, 3): velocity, acceleration, spin, its rate, all in the world."""
    poses, rates = np.tile(np.eye(4), (len(states), 1, 1)), np.zeros((len(states), 4, 3))
    for i in range(len(states)):
        turn = rotation(states.target_quat[i])
        poses[i, :3, :3], poses[i, :3, 3] = turn, states.target_position[i]
        rates[i, 0], rates[i, 1] = states.target_velocity_w[i], states.target_acceleration_w[i]
        rates[i, 2] = turn @ states.target_angular_velocity_b[i]
        rates[i, 3] = turn @ states.target_angular_acceleration_b[i]
    return poses, rates


if __name__ == "__main__":
    options = arguments("PlaCo's whole-body control tick, timed")
    states = read_states(options.states)
    main(PlacoTick(str(options.urdf), states), states, options)
