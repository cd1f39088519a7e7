"""What is wrong with an edit: the number of the point, and a sentence."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.profile import BINS
from gaitwright.gait.leg_cycles.check import Fault, check_cycle
from gaitwright.gait.leg_cycles.leg_cycle import (
    FEWEST,
    LIFT_OFF,
    MOST,
    TOUCH_DOWN,
    LegCycle,
    Point,
    fault_of_point,
    written,
)
from gaitwright.learning.profile_csv import LEAP, ROWS
from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot
from gaitwright.studio.curve_walk import Walk

WORSE = 1.01
"""A fault that a cycle had before an edit is held against it only where it grew by this factor."""
Rows = Sequence[Sequence[float]]


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an edit is not taken."""

    because: str
    point: int | None = None
    """Which point it is about, counted from 1; `None`: none of them alone."""


def numbers_in(points: Rows, width: int, fewest: int, most: int) -> np.ndarray | Refusal:
    """The points as `(points, width)` numbers, where they are so many finite ones."""
    if not fewest <= len(points) <= most:
        return Refusal(f"there are {len(points)} points; this curve has {fewest} to {most}")
    for number, point in enumerate(points, start=1):
        if not (is_row(point) and len(point) == width):
            return Refusal(f"point {number} has not {width} finite numbers", number)
    return np.array(points, dtype=float)


def is_row(point: Sequence[float]) -> bool:
    """Whether it is a row of finite numbers, whoever sent it."""
    return isinstance(point, list | tuple) and all(isinstance(x, int | float) and isfinite(x) for x in point)


# --- leg cycles --------------------------------------------------------------------------------------
def fault_in_path(points: Rows, name: str) -> Refusal | None:
    """The first point that can be none of a leg cycle."""
    found = numbers_in(points, 3, FEWEST, MOST)
    if isinstance(found, Refusal):
        return found
    rows: list[Point] = [(s, forward, height) for s, forward, height in found.tolist()]
    for i, row in enumerate(rows):
        fault = fault_of_point(row, rows[i - 1] if i else None)
        if fault:
            return Refusal(f"point {i + 1} of {name} {fault}", i + 1)
    for i, end, what in ((0, LIFT_OFF, "lift-off"), (len(rows) - 1, TOUCH_DOWN, "touch-down")):
        if rows[i] != end:
            because = f"point {i + 1} of {name} is {written(rows[i])}; {what} is always {written(end)}"
            return Refusal(because, i + 1)
    return None


def cannot_walk(walk: Walk, cycle: LegCycle, before: LegCycle) -> Refusal | None:
    """What a robot cannot do of a new cycle and could of the one before: reach, ground, speed, torque."""
    robot, gait, speed = walk.robot, walk.gait, walk.fastest
    old = {fault.kind: excess(fault) for fault in check_cycle(before, robot, gait, speed)}
    for fault in check_cycle(cycle, robot, gait, speed):
        if fault.kind not in old or excess(fault) > WORSE * old[fault.kind]:
            return Refusal(fault.sentence, fault.point)
    return None


def excess(fault: Fault) -> float:
    """How far a measure is beyond its limit."""
    return abs(fault.measure - fault.limit)


# --- torques -----------------------------------------------------------------------------------------
def fault_in_phases(phases: Float[np.ndarray, " points"], nearest: float) -> Refusal | None:
    """The first point that is not behind the one before it in the cycle, by `nearest` or more."""
    for i, phase in enumerate(phases.tolist()):
        if not 0.0 <= phase < 1.0:
            return Refusal(f"point {i + 1} is at phase {phase:g}; a phase is 0 or more and below 1", i + 1)
        before = phases[i - 1] - (0.0 if i else 1.0)
        if phase - before < nearest - 1e-9:
            where = f"point {i + 1} is at phase {phase:.3f}, the one before it at {before % 1.0:.3f}"
            return Refusal(f"{where}; phases ascend by {nearest:g} or more", i + 1)
    return None


def beyond_motors(robot: Robot, leg: int, rows: np.ndarray) -> Refusal | None:
    """The point `(phase, three torques)` that asks a motor for most, where that is more than it has."""
    over = np.abs(rows[:, 1:]) - robot.tau_max[leg]
    if over.max() <= 1e-9:
        return None
    i, joint = np.unravel_index(int(over.argmax()), over.shape)
    return too_much(robot, leg, int(i) + 1, int(joint), abs(float(rows[i, 1 + joint])))


def too_much(robot: Robot, leg: int, number: int, joint: int, torque: float) -> Refusal:
    """A torque [N·m] that a motor has not."""
    what = f"{HINGES[joint]} would need {torque:.3g} N·m; its limit is {robot.tau_max[leg, joint]:.3g} N·m"
    return Refusal(f"at point {number}, leg {robot.legs[leg]}: {what}", number)


def fault_in_change(
    robot: Robot, leg: int, phases: np.ndarray, change: np.ndarray, taught: Sequence[np.ndarray]
) -> Refusal | None:
    """Where a change of a leg's torques leaps, or brings what was `taught` beyond a motor's limit.

    `phases`: of the points; `change` and each of `taught`: torques at the phases of a profile's rows as the
    leg counts them `(bins, 3)` [N·m].
    """
    limit, step = robot.tau_max[leg], BINS // ROWS
    leap = np.abs(change - np.roll(change, step, axis=0)) - LEAP * limit
    if leap.max() > 0.0:
        row, joint = np.unravel_index(int(leap.argmax()), leap.shape)
        farther = max(int(row), int(row) - step, key=lambda k: abs(float(change[k, joint])))
        number = nearest_to(phases, farther / BINS)
        most = f"{LEAP:.0%} of its {limit[joint]:.3g} N·m from one 32nd of the cycle to the next"
        what = f"the torque of {HINGES[joint]} leaps; a change of up to {most} is taken"
        return Refusal(f"at point {number}, leg {robot.legs[leg]}: {what}", number)
    for torques in taught:
        whole = np.where(change == 0.0, 0.0, np.abs(torques + change))
        over = np.where(whole > np.abs(torques), whole - limit, -np.inf)
        if over.max() > 1e-9:
            row, joint = np.unravel_index(int(over.argmax()), over.shape)
            number = nearest_to(phases, row / BINS)
            return too_much(robot, leg, number, int(joint), float(whole[row, joint]))
    return None


def nearest_to(phases: np.ndarray, phase: float) -> int:
    """The number of the point nearest to a phase, around the cycle."""
    off = np.abs((phases - phase + 0.5) % 1.0 - 0.5)
    return int(off.argmin()) + 1
