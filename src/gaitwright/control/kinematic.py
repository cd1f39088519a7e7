"""MotionTarget + Sensed → MotorCommand by joint angles alone: coordination without forces (row S1)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.control.servo import STIFF, Gains, posture_of, servo_command
from gaitwright.model.kinematics import all_feet
from gaitwright.model.leg_motion import BaseMotion, all_joint_rates, velocity_from_base
from gaitwright.model.robot import Robot
from gaitwright.signals import MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now


@dataclass(frozen=True)
class KinematicController:
    """Servos that take the joints to `target.q`, the posture in which body and feet are where they should be.

    The coordinator works that posture out from where the feet stand, so the servos also push a body that
    has sunk, tilted or lagged back to its place, as far as springs do. They share no load and foresee
    nothing: the body hangs low by what its weight takes, and a gait that needs its forces timed falls.
    """

    robot: Robot
    gains: Gains = STIFF

    def command(
        self, target: MotionTarget, sensed: Sensed, memory: None = None, call: Now = None, ground: Map = None
    ) -> tuple[MotorCommand, None]:
        """Joint torques [N·m] for this tick, within the limits; nothing is remembered."""
        qd = wanted_rates(self.robot, target)
        return servo_command(self.robot, self.gains, target.q, qd, sensed, posture_of(target)), None


def wanted_rates(robot: Robot, target: MotionTarget) -> Float[np.ndarray, "legs 3"]:
    """Joint rates [rad/s] with which body and feet move as the target says, at its posture (eq. 3-15 …)."""
    a, R = robot.arrays, target.rotation_wb
    feet_b = all_feet(a.hip, a.leg_frame, a.offset, a.sign, target.q)
    base = BaseMotion(R, target.velocity_w, R.T @ target.angular_velocity_w)
    rates, _ = all_joint_rates(a, target.q, velocity_from_base(base, feet_b, target.feet_velocity_w))
    return rates
