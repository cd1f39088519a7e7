"""MotorCommand → Measured: the thesis's plant, ball joints moved by Armstrong's recursion (rows N6 … N8).

Next to MuJoCo it is the second opinion: other mechanics, other contact, other integration, same doors.
Only feet touch the ground; whether the body fell, the watch says.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.armstrong import accelerations
from gaitwright.dynamics.tree_laws import closed_form_accelerations
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.plant.armstrong.build import any_poses, row_name, state_of, system_of
from gaitwright.plant.armstrong.integrators import advance, method_named
from gaitwright.plant.armstrong.rotors import newton_matrix
from gaitwright.plant.armstrong.stiffness import MARGIN, stiffest_mode
from gaitwright.plant.armstrong.system import Drive, System, loads, mobility_of_hinges, parts, sensed
from gaitwright.plant.armstrong.touch_planes import Ground
from gaitwright.plant.instruments import specific_force
from gaitwright.plant.limits import check_force, check_timestep
from gaitwright.plant.start import start_of
from gaitwright.signals import Measured, MotorCommand


@dataclass
class ArmstrongPlant:
    """A robot standing in a scene; every `step` advances one control period.

    Raises `WrongUse` where `timestep` is longer than the springs of the joints and feet stand with this
    integrator, and for robots that a tree of ball joints cannot be.
    """

    robot: Robot
    scene: Scene
    dt: float = 0.002
    """Control period [s], an integer multiple of `timestep`."""
    integrator: str = "semi-implicit"
    """A name of `plant.names.INTEGRATORS`."""
    timestep: float | None = None
    """Step of the physics [s]; where none is given the longest share of `dt` that is safe. Integrator
    `adaptive` begins with it and then chooses its own."""
    refresh: int = 1
    """Armstrong's slow coefficients are new at every evaluation (1), or at every so-manieth step; always at
    the start of a control period."""
    check: bool = False
    """Whether the recursion is compared with the closed form in every control period."""
    tolerance: float = 1e-4
    """What integrator `adaptive` allows to go wrong in a step, per 1 + the size of each number."""
    worst_residual: float = field(default=0.0, init=False)
    """Largest difference of recursion and closed form since `reset`, per the largest acceleration; with
    `check`. No number where one of them was none."""
    system: System = field(init=False, repr=False)

    def __post_init__(self) -> None:
        if self.refresh < 1:
            raise WrongUse(f"slow coefficients are refreshed every 1, 2, 3 … steps, not every {self.refresh}")
        if not (math.isfinite(self.tolerance) and self.tolerance > 0.0):
            raise WrongUse(f"a tolerance of {self.tolerance:g} is asked; it is finite and greater than 0")
        self.method = method_named(self.integrator)
        self.system = system_of(self.robot, self.scene.friction)
        self.timestep = self._safe_timestep()
        self.ground = Ground.of(self.scene.at(0.0))
        self.reset(vary=False)

    def _safe_timestep(self) -> float:
        """The step that was asked for, or the longest share of the control period that is stable."""
        asked = self.timestep
        if asked is not None:
            check_timestep(asked, self.dt)
        if self.method.error.any():
            return asked or self.dt
        mode = stiffest_mode(self.system, any_poses(self.robot, self.system))
        longest = MARGIN * mode.longest_step(self.method, self.dt / MARGIN)
        if asked is None:
            return self.dt / math.ceil(self.dt / longest - 1e-9)
        if asked > longest * (1.0 + 1e-9):
            leg, joint, spring = row_name(self.robot, mode.row)
            raise WrongUse(
                f"leg {leg}, {joint}: {spring} needs steps of at most {longest * 1e3:.2g} ms with "
                f"{self.integrator} integration; {asked * 1e3:g} ms asked"
            )
        return asked

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot on its feet at the scene's start; `vary` draws small differences from `seed`.

        They are those of every plant (`plant.start`).
        """
        start = start_of(self.robot, self.scene, seed, vary)
        self.state = state_of(self.robot, self.system, start.position_w, start.rotation_wb, start.q)
        parts(self.system, self.state).v[:] = start.velocity_w
        self.time, self.trial_step, self.worst_residual = 0.0, self.timestep, 0.0
        if self.scene.movers:
            self.ground = Ground.of(self.scene.at(0.0))
        self.centres = feet(self.robot, start.q) @ start.rotation_wb.T + start.position_w
        self.velocity = start.velocity_w
        self.drive = self._drive(np.zeros((self.robot.n, 3)), np.zeros(3))
        self.measured = self.sense()
        return self.measured

    def step(self, command: MotorCommand) -> Measured:
        """One control period under constant torques [N·m], within the robot's limits.

        What gains ask for is taken as the period begins. Torques that are no numbers switch the motors off.
        """
        self.velocity = parts(self.system, self.state).v.copy()
        if self.scene.movers:
            self.ground = Ground.of(self.scene.at(self.time))
        self.drive = self._drive(command.torques(self.measured.q, self.measured.qd), self.drive.push)
        if self.scene.patches:
            grip = self.scene.friction_at(self.centres[:, 0], self.centres[:, 1])
            self.system = self.system._replace(feet=self.system.feet._replace(friction=grip))
        if self.check:
            self._compare()
        y = self.state.copy()
        self.trial_step, _ = advance(
            self.system, self.drive, y, self.method, self.trial_step, self.dt, self.refresh, self.tolerance
        )
        self.state, self.time = y, self.time + self.dt
        self.measured = self.sense()
        return self.measured

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        check_force(force_w)
        self.drive = self.drive._replace(push=np.array(force_w, dtype=float))

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of the world from now on; robot and friction stay as they are."""
        self.scene, self.ground = scene, Ground.of(scene.at(self.time))

    def sense(self) -> Measured:
        """The true state, copied; angles and rates of the hinges as the ball joints have them."""
        n, p = self.robot.n, parts(self.system, self.state)
        numbers = sensed(self.system, self.drive, self.state)
        self.centres = numbers[7 * n :].reshape(n, 3)
        return Measured(
            time=self.time,
            position_w=p.x.copy(),
            orientation_wb=p.quaternion[0].copy(),
            velocity_w=p.v.copy(),
            angular_velocity_b=p.w[0].copy(),
            q=numbers[: 3 * n].reshape(n, 3),
            qd=numbers[3 * n : 6 * n].reshape(n, 3),
            load=numbers[6 * n : 7 * n],
            specific_force_b=specific_force(p.quaternion[0], p.v, self.velocity, self.dt),
        )

    def _drive(self, tau: Float[np.ndarray, "legs 3"], push: Float[np.ndarray, "3"]) -> Drive:
        """What acts in the next control period."""
        motor = np.clip(tau, -self.robot.tau_max, self.robot.tau_max).ravel()
        if not np.isfinite(motor).all():
            motor = np.zeros_like(motor)
        rotor = self.system.joints.rotor
        newton = np.zeros((0, 0))
        if rotor.any():
            newton = newton_matrix(mobility_of_hinges(self.system, self.state), rotor)
        return Drive(motor, self.ground.planes(self.centres), push, newton)

    def _compare(self) -> None:
        """Recursion against closed form for what acts now (row N8)."""
        system = self.system
        R, torque, force, moment, _ = loads(system, self.drive, self.state)
        w = parts(system, self.state).w
        acting = (system.tree, R, w, torque, force, moment, system.gravity)
        difference = relative_difference(accelerations(*acting), closed_form_accelerations(*acting))
        self.worst_residual = float(np.maximum(self.worst_residual, difference))  # max() would hide a NaN


def relative_difference(one: Float[np.ndarray, "*any"], other: Float[np.ndarray, "*any"]) -> float:
    """Largest difference of two arrays, per the largest number of the second."""
    return float(np.abs(one - other).max() / np.abs(other).max())
