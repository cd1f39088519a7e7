"""MotionTarget + Sensed → Torques by solving the dynamics at every tick: the NC (rows N1 … N4)."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from gaitwright.control.demand import demand
from gaitwright.control.forces import conclude, quadratic_program
from gaitwright.control.linear import linear_program
from gaitwright.control.solvers import solve_lp, solve_qp
from gaitwright.geometry import GRAVITY
from gaitwright.model.robot import Robot
from gaitwright.signals import MotionTarget, Sensed, Torques

Method = Literal["qp", "lp"]


@dataclass(frozen=True)
class NumericalController:
    """Feedback on body and feet, inverse dynamics, force distribution; torques within the limits."""

    robot: Robot
    method: Method = "qp"

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques:
        """Joint torques [N·m] for this tick; `previous` smooths the foot forces."""
        robot, stance, normal = self.robot, target.stance, target.normal_w
        weight, height, limits = robot.total_mass * GRAVITY, robot.height, robot.tau_max
        before = np.zeros((robot.n, 3)) if previous is None else previous.forces_w
        load = self.load(target, sensed)
        task = (load, stance, target.share, normal, before, limits, weight, height)
        if self.method == "qp":
            x, status = solve_qp(*quadratic_program(*task))
        else:
            x, status = solve_lp(*linear_program(*task, sensed.qd))
        if not status.startswith("solved"):
            # Better than nothing: the feet that are down share the weight evenly.
            feet = int(np.count_nonzero(stance))
            x = np.tile((0.0, 0.0, 1.0 / feet), feet)
        tau, forces, unmet = conclude(load, stance, normal, x, limits, weight, height)
        return Torques(tau, forces, unmet, status)

    def load(self, target: MotionTarget, sensed: Sensed) -> Float[np.ndarray, "numbers"]:
        """What the target asks of feet and motors: a packed `control.demand.Load`."""
        return demand(
            self.robot.packed,
            self.robot.natural_frequency,
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


def idle(robot: Robot) -> Torques:
    """Motors off."""
    return Torques(np.zeros((robot.n, 3)), np.zeros((robot.n, 3)), 0.0, "motors off")
