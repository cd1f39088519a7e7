"""The numerical controller: MotionTarget + Sensed → Torques by solving the dynamics at every tick (rows N1 … N4)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from gaitwright.compiled import kernel

from gaitwright.control.demand import demand
from gaitwright.control.forces import Load, Method, distribute
from gaitwright.model.robot import Robot
from gaitwright.signals import MotionTarget, Sensed, Torques


@kernel
def joint_torques(free, push, forces, tau_max):
    """τ = free − push @ f, kept within the limits."""
    out = np.empty(free.shape)
    for leg in range(free.shape[0]):
        for j in range(3):
            tau = free[leg, j]
            for i in range(3):
                tau -= push[leg, j, i] * forces[leg, i]
            out[leg, j] = min(max(tau, -tau_max[leg, j]), tau_max[leg, j])
    return out


@dataclass(frozen=True)
class NumericalController:
    """Feedback on body and feet, inverse dynamics, force distribution; torques within the limits."""

    robot: Robot
    method: Method = "qp"

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques:
        """Joint torques [N·m] for this tick; `previous` smooths the foot forces."""
        robot = self.robot
        load = Load(
            *demand(
                robot.arrays,
                robot.natural_frequency,
                robot.foot_radius,
                sensed.position_w,
                sensed.orientation_wb,
                sensed.velocity_w,
                sensed.angular_velocity_b,
                sensed.q,
                sensed.qd,
                target.stance,
                target.normal_w,
                target.position_w,
                target.velocity_w,
                target.acceleration_w,
                target.rotation_wb,
                target.angular_velocity_w,
                target.angular_acceleration_w,
                target.feet_w,
                target.feet_velocity_w,
                target.feet_acceleration_w,
            )
        )
        before = np.zeros((robot.n, 3)) if previous is None else previous.forces_w
        shared = distribute(
            load, target.stance, target.share, target.normal_w, before, robot.tau_max, robot.total_mass, robot.height
        )
        tau = joint_torques(load.free, load.push, shared.forces_w, robot.tau_max)
        return Torques(tau, shared.forces_w, shared.residual, shared.status)


def idle(robot: Robot) -> Torques:
    """Motors off."""
    zero: Float[np.ndarray, "legs 3"] = np.zeros((robot.n, 3))
    return Torques(zero, zero, 0.0, "motors off")
