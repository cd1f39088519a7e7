"""After a trip: the legs fold until the body lies on the ground, then the motors go off.

Joints are led from where they are to a crouch, as stiff as the servos of the drivers without dynamics, and
then let go. Where something is broken nothing but a damper is left: it needs neither angles nor contacts, and
the body sinks no faster than it lets the legs give way.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.control.servo import STIFF
from gaitwright.dynamics.joint_inertia import all_joint_inertias
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.signals import MotorCommand, Sensed

FOLDS = 0.8
"""The legs fold within this time, times √(h / 0.29 m) [s]."""
RESTS = 0.3
"""Then the servos fade within this time [s], likewise."""
LIMP = 2.0
"""The damper alone lasts for this time [s], likewise."""
DAMPING = 1.0
"""Of that damper, times m g h √(h / g)."""
BEARABLE = (0.1, 0.4)
"""The most of stiffness and damping that a joint can bear from tick to tick, times I / dt² and I / dt."""

SPARE = 0.02
"""Joints stay this far from their limits [rad]."""
LOWERED = "solved by letting the robot down"


class Lowering:
    """How one robot is let down from where it is; `limp`: by the damper alone."""

    def __init__(
        self, robot: Robot, dt: float, sensed: Sensed, command: MotorCommand, limp: bool = False
    ) -> None:
        self.robot, self.q, self.limp = robot, sensed.q, limp
        self.tau = np.clip(command.tau, -robot.tau_max, robot.tau_max)
        self.way = crouch(robot) - sensed.q
        weight, height, natural = robot.measures
        size = float(np.sqrt(height / 0.29))
        self.folds, self.rests = (LIMP * size, 0.0) if limp else (FOLDS * size, RESTS * size)
        stiffness, damping = STIFF.stiffness * weight * height, STIFF.damping * weight * height / natural
        inertia = all_joint_inertias(robot, sensed.q)
        self.stiffness = np.minimum(stiffness, BEARABLE[0] * inertia / dt**2)
        damping = DAMPING * weight * height / natural if limp else damping
        self.damping = np.minimum(damping, BEARABLE[1] * inertia / dt)

    @property
    def lasts(self) -> float:
        """How long all of it lasts [s]."""
        return self.folds + self.rests

    def command(self, after: float) -> MotorCommand:
        """What the motors are told `after` so many seconds."""
        nothing = np.zeros((self.robot.n, 3))
        if self.limp:
            return MotorCommand(nothing, nothing, status=LOWERED, kd=self.damping)
        x = min(1.0, after / self.folds)
        share, rate = x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / self.folds
        left = 1.0 if x < 1.0 else max(0.0, 1.0 - (after - self.folds) / self.rests)
        return MotorCommand(
            (1.0 - share) * self.tau,
            nothing,
            0.0,
            LOWERED,
            self.q + share * self.way,
            rate * self.way,
            left * self.stiffness,
            self.damping,
        )

    def given(self, told: MotorCommand, sensed: Sensed) -> MotorCommand:
        """The command as a recording keeps it: with the torques that come of it."""
        tau = told.given(sensed.q, sensed.qd, self.robot.tau_max)
        return MotorCommand(tau, told.forces_w, 0.0, told.status)


def crouch(robot: Robot) -> Float[np.ndarray, "legs 3"]:
    """Joint angles with the trunk's underside on the ground, or as low as legs and limits let it."""
    feet, stand = robot.nominal_feet.copy(), robot.nominal_feet[:, 2]
    lying = np.minimum(robot.trunk[0, 2] - robot.trunk[1, 2] + robot.foot_radius, 0.0)
    for share in np.linspace(1.0, 0.0, 21):
        feet[:, 2] = stand + share * (np.maximum(lying, stand) - stand)
        q, reached = angles(robot, feet)
        if np.all(reached) and ((q >= robot.q_min + SPARE) & (q <= robot.q_max - SPARE)).all():
            return q
    return angles(robot, robot.nominal_feet)[0]
