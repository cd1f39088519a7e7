"""What limits a distribution of forces, in words: which limit of which foot, and what it costs (row N3)."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool

from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot
from gaitwright.numerics.status import INFEASIBLE, SENTENCES
from gaitwright.signals import MotorCommand

SENSIBLE = 1e-9
"""Prices below this share of the largest one are those of a limit that is touched by chance."""
SIDES = ("+x", "-x", "+y", "-y")
"""Where the tangents of the ground point, in the world's axes; on a slope, along it."""
MOMENTS = (*SIDES, "+z", "-z")
"""The axes about which a foot with six components tips or twists."""


class Felt(NamedTuple):
    """A limit that holds a distribution back."""

    leg: str
    price: float
    """By how much the program's objective falls for each unit that the limit gives way: share of the weight
    for forces, share of the limit for torques."""
    sentence: str


def felt_limits(robot: Robot, command: MotorCommand) -> tuple[Felt, ...]:
    """The limits that the torques of a tick rest on, the dearest first."""
    if command.multipliers is None:
        return ()
    prices = np.abs(command.multipliers)
    order = sorted(zip(*np.nonzero(prices > SENSIBLE * (prices.max() + 1e-300)), strict=True))
    felt = [
        Felt(robot.legs[leg], float(prices[leg, limit]), limit_words(robot, command, int(leg), int(limit)))
        for leg, limit in order
    ]
    return tuple(sorted(felt, key=lambda one: -one.price))


def limit_words(robot: Robot, command: MotorCommand, leg: int, limit: int) -> str:
    """One limit of one foot, numbered as in `forces`, as a sentence with its number."""
    foot = f"foot {robot.legs[leg]}"
    force = float(np.linalg.norm(command.forces_w[leg]))
    if limit < 4:
        return f"{foot} at its friction limit towards {SIDES[limit]}: {force:.1f} N in all"
    if limit == 4:
        return f"{foot} at its contact limit: to give more it would have to pull on the ground"
    if limit == 5:
        return f"{foot} at its load limit: {force:.1f} N"
    return f"{foot} at its torque limit: {joint_words(robot, leg, limit - 6)}"


def joint_words(robot: Robot, leg: int, joint: int) -> str:
    """A joint and its torque limit."""
    return f"{HINGES[joint]}, {robot.tau_max[leg, joint]:.3g} N·m"


def explain(robot: Robot, command: MotorCommand) -> str:
    """The whole certificate of a tick: status, what is missing of the wanted wrench, and every limit felt."""
    lines = [f"{command.status}; {command.residual:.1%} of the weight is missing of the wanted wrench"]
    lines += [f"{felt.sentence} (price {felt.price:.3g})" for felt in felt_limits(robot, command)]
    return "\n".join(lines)


# --- why there is none -----------------------------------------------------------------------------
def status_of(robot: Robot, code: int, culprit: int, stance: Bool[np.ndarray, "legs"]) -> str:
    """How the quadratic program ended, as a sentence.

    `culprit`: the limit that the others leave no room for, in the order of `forces.limit_rows`: bounds of
    the forces (3 each foot), friction (4), torques (3); -1: none.
    """
    if code != INFEASIBLE or culprit < 0:
        return SENTENCES[code]
    down = np.flatnonzero(stance)
    m = len(down)
    if culprit < 7 * m:
        leg = down[culprit // 3 if culprit < 3 * m else (culprit - 3 * m) // 4]
        return f"{SENTENCES[code]}: no room is left for the force of foot {robot.legs[leg]}"
    k, joint = divmod(culprit - 7 * m, 3)
    return overloaded(robot, int(down[k]), joint)


def linear_status_of(robot: Robot, code: int, culprit: int, components: int = 3) -> str:
    """How the linear program ended, as a sentence; `culprit` as in `linear.Shared`."""
    if code != INFEASIBLE or culprit < 0:
        return SENTENCES[code]
    n, each = components * robot.n + 1, 2 * components + 2
    if culprit < n - 1:
        foot = robot.legs[culprit // components]
        return f"{SENTENCES[code]}: no room is left for the force of foot {foot}"
    leg, row = divmod(culprit - n, each)
    if culprit == n - 1 or leg >= robot.n or row == 7:
        return f"{SENTENCES[code]}: force and moment cannot be balanced"
    if 4 <= row < 7:
        return overloaded(robot, leg, row - 4)
    what = f"slipping towards {SIDES[row]}" if row < 4 else f"turning over about {MOMENTS[row - 8]}"
    return f"{SENTENCES[code]} without foot {robot.legs[leg]} {what}"


def overloaded(robot: Robot, leg: int, joint: int) -> str:
    """No forces keep a joint within its torque limit."""
    which = f"leg {robot.legs[leg]}, {joint_words(robot, leg, joint)}"
    return f"{SENTENCES[INFEASIBLE]} without overloading a joint: {which}"
