"""MotionTarget + Sensed → MotorCommand by solving the dynamics at every tick: the NC (rows N1 … N4)."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.control.certificate import linear_status_of, status_of
from gaitwright.control.forces import LIMITS, contact_frame, distribute, to_world, torques, unmet
from gaitwright.control.impedance import steering
from gaitwright.control.inverse_dynamics import AS_WANTED, demand, load_of
from gaitwright.control.linear import distribute_linear
from gaitwright.control.moments import moment_between
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.control.unmet_acceleration import unmet_acceleration
from gaitwright.errors import WrongUse, unknown
from gaitwright.model.robot import Robot, scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Layout, Row
from gaitwright.numerics.status import NOT_FINITE, SOLVED
from gaitwright.signals import MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now

Method = Literal["qp", "lp"]
METHODS: tuple[Method, ...] = ("qp", "lp")
PLAIN = LinearSettings()
"""The linear program as the closed loop uses it."""


class TickResult(NamedTuple):
    """What a tick comes to."""

    outcome: Float[np.ndarray, "2"]
    """Code of the solver, and the culprit where it failed."""
    tau: Float[np.ndarray, "legs 3"]
    forces_w: Float[np.ndarray, "legs 3"]
    residual: Float[np.ndarray, "1"]
    """These three are the row of a `MotorCommand`."""
    multipliers: Float[np.ndarray, "legs limits"]
    basis: Float[np.ndarray, "3*legs+1"]
    """Where the linear program may start at the next tick; -1: nowhere."""


LAYOUT = Layout.of(TickResult, limits=LIMITS)
result_of = LAYOUT.views(TickResult)
"""The `TickResult` in a row, as views; for kernels too."""


def blank_result(n: int) -> Row:
    """The row of a tick before the first one: no forces, no hints."""
    out = np.zeros(LAYOUT.size(n))
    result_of(out).basis[:] = -1.0
    return out


@kernel
def tick(packed, before, seen, asked, out):
    """One tick by the quadratic program: writes the row of a `TickResult`.

    `before`: that of the tick before; `seen`, `asked`: the rows of a `Sensed` and a `MotionTarget`.
    """
    moment = moment_between(seen, asked)
    distributed(packed, demand(packed, moment, AS_WANTED), moment, result_of(before).forces_w, out)


@kernel
def tick_linear(packed, before, seen, asked, settings, out):
    """One tick by the linear program of `settings`, which starts where the one before ended."""
    moment, last = moment_between(seen, asked), result_of(before)
    load = demand(packed, moment, AS_WANTED)
    distributed_linear(packed, load, moment, last.forces_w, settings, last.basis, out)


@kernel
def distributed(packed, load, moment, previous, out):
    """Writes the packed `TickResult` for a packed `Load`, by the quadratic program."""
    tau_max, weight, height = scales(packed)
    stance, normal = moment.stance, moment.normal
    steer = steering(packed, moment)
    load_of(load).free[:] += steer
    x, prices, code, culprit = distribute(
        load, stance, moment.load_scale, moment.friction, normal, previous, tau_max, weight, height
    )
    result = result_of(out)
    result.multipliers[:], result.basis[:] = prices, -1.0
    conclude(out, packed, load, moment, steer, x, code, culprit)


@kernel
def distributed_linear(packed, load, moment, previous, settings, hints, out):
    """Writes the packed `TickResult` for a packed `Load`, by the linear program (point feet)."""
    tau_max, weight, height = scales(packed)
    stance, normal = moment.stance, moment.normal
    steer = steering(packed, moment)
    load_of(load).free[:] += steer
    shared = distribute_linear(
        load,
        stance,
        moment.load_scale,
        moment.friction,
        normal,
        previous,
        tau_max,
        weight,
        height,
        moment.qd,
        settings,
        hints.astype(np.int64),
    )
    result = result_of(out)
    result.multipliers[:] = shared.multipliers
    result.basis[:] = shared.basis
    code, culprit = shared.code, shared.culprit
    conclude(out, packed, load, moment, steer, shared.x, code, culprit)


LACKING = 1e-3
"""From this share of the weight on, a wrench that the feet cannot give changes the torques."""


@kernel
def conclude(out, packed, load, moment, steer, x, code, culprit):
    """Writes torques, forces and residual; where it failed, the feet that are down share the weight.

    `steer`: the `steering`, which is part of the load already.

    What is not finite stays so in the torques, plainly: whoever watches stops the motors.
    """
    tau_max, weight, height = scales(packed)
    stance, result = moment.stance, result_of(out)
    if code != SOLVED:
        feet = x.size // 3
        for k in range(feet):
            x[3 * k], x[3 * k + 1], x[3 * k + 2] = 0.0, 0.0, 1.0 / feet
    forces = to_world(x, stance, contact_frame(moment.normal), weight)
    result.forces_w[:] = forces
    lacks = unmet(load, forces, stance, weight, height)
    if lacks > LACKING or not stance.any():
        load = demand(packed, moment, unmet_acceleration(packed, moment, load, forces))
        load_of(load).free[:] += steer
    result.tau[:] = torques(load, forces, tau_max)
    if code == NOT_FINITE:
        result.tau[:] = np.nan
    result.residual[0] = lacks
    result.outcome[0], result.outcome[1] = code, culprit


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

    def command(
        self,
        target: MotionTarget,
        sensed: Sensed,
        memory: Row | None = None,
        call: Now = None,
        ground: Map = None,
    ) -> tuple[MotorCommand, Row]:
        """Joint torques [N·m] for this tick, and its `TickResult`, whose forces the next one goes on from."""
        robot, n = self.robot, self.robot.n
        before = self.blank if memory is None else memory
        result = np.empty(before.size)
        if self.method == "qp":
            tick(robot.packed, before, sensed.row, target.row, result)
        else:
            tick_linear(robot.packed, before, sensed.row, target.row, self.settings, result)
        commanded, priced = self.where
        multipliers = result[priced].reshape(n, LIMITS)
        if result[0] == SOLVED:
            return MotorCommand.of_row(result[commanded], multipliers=multipliers), result
        why = self.reason(int(result[0]), int(result[1]), target.stance)
        return MotorCommand.of_row(result[commanded], status=why, multipliers=multipliers), result

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
    def blank(self) -> Row:
        """The result of no tick."""
        return blank_result(self.robot.n)

    @cached_property
    def where(self) -> tuple[slice, slice]:
        """Where the row of the command and the multipliers stand in a `TickResult`."""
        where = LAYOUT.slices(self.robot.n)
        return slice(where["tau"].start, where["residual"].stop), where["multipliers"]


def idle(robot: Robot) -> MotorCommand:
    """Motors off."""
    return MotorCommand(np.zeros((robot.n, 3)), np.zeros((robot.n, 3)), 0.0, "motors off")
