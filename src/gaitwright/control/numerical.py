"""MotionTarget + Sensed → Torques by solving the dynamics at every tick: the NC (rows N1 … N4)."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from gaitwright.compiled import kernel
from gaitwright.control.active_set import SOLVED
from gaitwright.control.certificate import status_of
from gaitwright.control.demand import demand
from gaitwright.control.forces import LIMITS, contact_frame, distribute, to_world, torques, unmet
from gaitwright.control.moments import Moment
from gaitwright.model.robot import Robot, unpacked
from gaitwright.signals import MotionTarget, Sensed, Torques

Method = Literal["qp", "lp"]


class Effort(NamedTuple):
    """What a tick comes to; arrays for `legs` legs, views of one array."""

    told: np.ndarray
    """`(3,)` residual, code of the solver, culprit where it failed."""
    tau: np.ndarray
    forces_w: np.ndarray
    prices: np.ndarray


@kernel
def effort_of(numbers):
    """The `Effort` packed in one array, as views."""
    n = (numbers.size - 3) // (6 + LIMITS)
    return Effort(
        numbers[:3],
        numbers[3 : 3 + 3 * n].reshape(n, 3),
        numbers[3 + 3 * n : 3 + 6 * n].reshape(n, 3),
        numbers[3 + 6 * n :].reshape(n, LIMITS),
    )


@kernel
def tick(
    packed,
    previous,
    share,
    position,
    orientation,
    velocity,
    spin_b,
    q,
    qd,
    stance,
    normal,
    want_p,
    want_v,
    want_a,
    want_r,
    want_w,
    want_wd,
    feet_p,
    feet_v,
    feet_a,
):
    """One tick of the numerical controller by the quadratic program: a packed `Effort`."""
    moment = Moment(
        position, orientation, velocity, spin_b, normal, want_p, want_v, want_a, want_w, want_wd, want_r,
        stance, share, q, qd, feet_p, feet_v, feet_a,
    )  # fmt: skip
    return distributed(packed, demand(packed, moment), moment, previous)


@kernel
def distributed(packed, load, moment, previous):
    """The packed `Effort` for a packed `Load`, by the quadratic program."""
    model = unpacked(packed)
    stance, normal = moment.stance, moment.normal
    weight, height = model.measures[0], model.measures[1]
    x, prices, code, culprit = distribute(
        load, stance, moment.share, normal, previous, model.tau_max, weight, height
    )
    return conclude(load, stance, normal, x, prices, code, culprit, model.tau_max, weight, height)


@kernel
def conclude(load, stance, normal, x, prices, code, culprit, tau_max, weight, height):
    """The packed `Effort` of a distribution; where it failed, the feet that are down share the weight."""
    n = stance.size
    out = np.empty(3 + (6 + LIMITS) * n)
    effort = effort_of(out)
    if code != SOLVED:
        feet = x.size // 3
        for k in range(feet):
            x[3 * k], x[3 * k + 1], x[3 * k + 2] = 0.0, 0.0, 1.0 / feet
    forces = to_world(x, stance, contact_frame(normal), weight)
    effort.forces_w[:] = forces
    effort.tau[:] = torques(load, forces, tau_max)
    effort.prices[:] = prices
    effort.told[0], effort.told[1], effort.told[2] = (
        unmet(load, forces, stance, weight, height),
        code,
        culprit,
    )
    return out


@dataclass(frozen=True)
class NumericalController:
    """Feedback on body and feet, inverse dynamics, force distribution; torques within the limits."""

    robot: Robot
    method: Method = "qp"

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques:
        """Joint torques [N·m] for this tick; `previous` smooths the foot forces."""
        robot = self.robot
        numbers = tick(
            robot.packed,
            np.zeros((robot.n, 3)) if previous is None else previous.forces_w,
            target.share,
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
        n = robot.n
        return Torques(
            numbers[3 : 3 + 3 * n].reshape(n, 3),
            numbers[3 + 3 * n : 3 + 6 * n].reshape(n, 3),
            float(numbers[0]),
            status_of(robot, int(numbers[1]), int(numbers[2]), target.stance),
            numbers[3 + 6 * n :].reshape(n, LIMITS),
        )


def idle(robot: Robot) -> Torques:
    """Motors off."""
    return Torques(np.zeros((robot.n, 3)), np.zeros((robot.n, 3)), 0.0, "motors off")
