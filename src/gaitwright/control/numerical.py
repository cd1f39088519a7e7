"""MotionTarget + Sensed → Torques by solving the dynamics at every tick: the NC (rows N1 … N4)."""

from dataclasses import dataclass
from functools import cache, cached_property
from typing import Literal, NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.control.certificate import linear_status_of, status_of
from gaitwright.control.forces import LIMITS, contact_frame, distribute, to_world, torques, unmet
from gaitwright.control.inverse_dynamics import AS_WANTED, demand
from gaitwright.control.linear import distribute_linear
from gaitwright.control.moments import Moment
from gaitwright.control.shortfall import shortfall
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.errors import WrongUse, unknown
from gaitwright.model.robot import Robot, scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.status import NOT_FINITE, SOLVED
from gaitwright.signals import MotionTarget, Sensed, Torques

Method = Literal["qp", "lp"]
METHODS: tuple[Method, ...] = ("qp", "lp")
PLAIN = LinearSettings()
"""The linear program as the closed loop uses it."""


class Effort(NamedTuple):
    """What a tick comes to; arrays for `legs` legs, views of one array."""

    told: np.ndarray
    """`(3,)` residual, code of the solver, culprit where it failed."""
    tau: np.ndarray
    forces_w: np.ndarray
    prices: np.ndarray
    basis: np.ndarray
    """`(3 legs + 1,)` where the linear program may start at the next tick; -1: nowhere."""


@kernel
def effort_of(numbers):
    """The `Effort` packed in one array, as views."""
    n = (numbers.size - 4) // (9 + LIMITS)
    basis = 3 + (6 + LIMITS) * n
    return Effort(
        numbers[:3],
        numbers[3 : 3 + 3 * n].reshape(n, 3),
        numbers[3 + 3 * n : 3 + 6 * n].reshape(n, 3),
        numbers[3 + 6 * n : basis].reshape(n, LIMITS),
        numbers[basis:],
    )


@cache
def effort_columns(n: int) -> tuple[slice, slice, slice, slice]:
    """Where torques, forces, prices and basis of `n` legs stand in a packed effort, for people."""
    forces, prices, basis = 3 + 3 * n, 3 + 6 * n, 3 + (6 + LIMITS) * n
    return slice(3, forces), slice(forces, prices), slice(prices, basis), slice(basis, None)


@kernel
def blank_effort(n):
    """Room for the effort of `n` legs, without hints."""
    out = np.empty(4 + (9 + LIMITS) * n)
    out[3 + (6 + LIMITS) * n :] = -1.0
    return out


# fmt: off
@kernel
def tick(
    packed, previous, share, position, orientation, velocity, spin_b, q, qd, stance, normal, want_p, want_v,
    want_a, want_r, want_w, want_wd, feet_p, feet_v, feet_a,
):
    """One tick by the quadratic program: a packed `Effort`. Flat arguments cost a call from Python least."""
    moment = Moment(
        position, orientation, velocity, spin_b, normal, want_p, want_v, want_a, want_w, want_wd, want_r,
        stance, share, q, qd, feet_p, feet_v, feet_a,
    )
    return distributed(packed, demand(packed, moment, AS_WANTED), moment, previous)


@kernel
def tick_linear(
    packed, settings, hints, previous, share, position, orientation, velocity, spin_b, q, qd, stance, normal,
    want_p, want_v, want_a, want_r, want_w, want_wd, feet_p, feet_v, feet_a,
):
    """One tick by the linear program of `settings`, which starts from `hints`."""
    moment = Moment(
        position, orientation, velocity, spin_b, normal, want_p, want_v, want_a, want_w, want_wd, want_r,
        stance, share, q, qd, feet_p, feet_v, feet_a,
    )
    return distributed_linear(packed, demand(packed, moment, AS_WANTED), moment, previous, settings, hints)
# fmt: on


@kernel
def distributed(packed, load, moment, previous):
    """The packed `Effort` for a packed `Load`, by the quadratic program."""
    tau_max, weight, height = scales(packed)
    stance, normal = moment.stance, moment.normal
    x, prices, code, culprit = distribute(
        load, stance, moment.share, normal, previous, tau_max, weight, height
    )
    out = blank_effort(stance.size)
    effort_of(out).prices[:] = prices
    conclude(out, packed, load, moment, x, code, culprit)
    return out


@kernel
def distributed_linear(packed, load, moment, previous, settings, hints):
    """The packed `Effort` for a packed `Load`, by the linear program (point feet)."""
    tau_max, weight, height = scales(packed)
    stance, normal = moment.stance, moment.normal
    shared = distribute_linear(
        load,
        stance,
        moment.share,
        normal,
        previous,
        tau_max,
        weight,
        height,
        moment.qd,
        settings,
        hints.astype(np.int64),
    )
    out = blank_effort(stance.size)
    effort = effort_of(out)
    effort.prices[:] = shared.prices
    effort.basis[:] = shared.basis
    code, culprit = shared.code, shared.culprit
    conclude(out, packed, load, moment, shared.x, code, culprit)
    return out


LACKING = 1e-3
"""From this share of the weight on, a wrench that the feet cannot give changes the torques."""


@kernel
def conclude(out, packed, load, moment, x, code, culprit):
    """Writes torques, forces and residual; where it failed, the feet that are down share the weight.

    What is not finite stays so in the torques, plainly: whoever watches stops the motors.
    """
    tau_max, weight, height = scales(packed)
    stance, effort = moment.stance, effort_of(out)
    if code != SOLVED:
        feet = x.size // 3
        for k in range(feet):
            x[3 * k], x[3 * k + 1], x[3 * k + 2] = 0.0, 0.0, 1.0 / feet
    forces = to_world(x, stance, contact_frame(moment.normal), weight)
    effort.forces_w[:] = forces
    lacks = unmet(load, forces, stance, weight, height)
    if lacks > LACKING or not stance.any():
        load = demand(packed, moment, shortfall(packed, moment, load, forces))
    effort.tau[:] = torques(load, forces, tau_max)
    if code == NOT_FINITE:
        effort.tau[:] = np.nan
    effort.told[0] = lacks
    effort.told[1], effort.told[2] = code, culprit


@dataclass(frozen=True)
class NumericalController:
    """Feedback on body and feet, inverse dynamics, force distribution; torques within the limits."""

    robot: Robot
    method: Method = "qp"
    linear: LinearSettings = PLAIN
    """What counts where the method is `lp`."""

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            raise unknown("distribution", self.method, METHODS)
        if self.linear.components != 3.0:
            raise WrongUse(
                f"the feet of a robot that walks are points: 3 components of a foot's load, not "
                f"{self.linear.components:g}"
            )

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques:
        """Joint torques [N·m] for this tick; `previous` smooths the foot forces."""
        robot, n = self.robot, self.robot.n
        moment = (
            np.zeros((n, 3)) if previous is None else previous.forces_w,
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
        if self.method == "qp":
            numbers = tick(robot.packed, *moment)
        else:
            hints = self.no_hints if previous is None or previous.basis is None else previous.basis
            numbers = tick_linear(robot.packed, self.settings, hints, *moment)
        tau, forces, prices, basis = effort_columns(n)
        code = int(numbers[1])
        return Torques(
            numbers[tau].reshape(n, 3),
            numbers[forces].reshape(n, 3),
            float(numbers[0]),
            "solved" if code == SOLVED else self.reason(code, int(numbers[2]), target.stance),
            numbers[prices].reshape(n, LIMITS),
            numbers[basis],
        )

    def reason(self, code: int, culprit: int, stance: Bool[np.ndarray, "legs"]) -> str:
        """How a distribution ended, as a sentence."""
        if self.method == "qp":
            return status_of(self.robot, code, culprit, stance)
        return linear_status_of(self.robot, code, culprit)

    @cached_property
    def settings(self) -> Float[np.ndarray, "settings"]:
        """The settings of the linear program as kernels read them."""
        return np.array(self.linear)

    @cached_property
    def no_hints(self) -> Float[np.ndarray, "hints"]:
        return np.full(3 * self.robot.n + 1, -1.0)


def idle(robot: Robot) -> Torques:
    """Motors off."""
    return Torques(np.zeros((robot.n, 3)), np.zeros((robot.n, 3)), 0.0, "motors off")
