"""What limits a distribution of forces, in words: which limit of which foot, and what it costs (row N3)."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool

from gaitwright.control.active_set import INFEASIBLE, SOLVED
from gaitwright.control.forces import FRICTION
from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot
from gaitwright.signals import Torques

SENSIBLE = 1e-9
"""Prices below this share of the largest one are those of a limit that is touched by chance."""


class Felt(NamedTuple):
    """A limit that holds a distribution back."""

    leg: str
    price: float
    """By how much the program's objective falls for each unit that the limit gives way: share of the weight
    for forces, share of the limit for torques."""
    sentence: str


def felt_limits(robot: Robot, torques: Torques) -> tuple[Felt, ...]:
    """The limits that the torques of a tick rest on, the dearest first."""
    if torques.prices is None:
        return ()
    prices = np.abs(torques.prices)
    order = sorted(zip(*np.nonzero(prices > SENSIBLE * (prices.max() + 1e-300)), strict=True))
    felt = [
        Felt(robot.legs[leg], float(prices[leg, limit]), limit_words(robot, torques, int(leg), int(limit)))
        for leg, limit in order
    ]
    return tuple(sorted(felt, key=lambda one: -one.price))


def limit_words(robot: Robot, torques: Torques, leg: int, limit: int) -> str:
    """One limit of one foot as a sentence with its number."""
    foot = f"foot {robot.legs[leg]}"
    force = float(np.linalg.norm(torques.forces_w[leg]))
    if limit < 4:
        return (
            f"{foot} at its friction limit: {FRICTION:g} of its normal force sideways, {force:.1f} N in all"
        )
    if limit == 4:
        return f"{foot} at its contact limit: to give more it would have to pull on the ground"
    if limit == 5:
        return f"{foot} at its load limit: {force:.1f} N"
    return f"{foot} at its torque limit: {joint_words(robot, leg, limit - 6)}"


def joint_words(robot: Robot, leg: int, joint: int) -> str:
    """A joint and its torque limit."""
    return f"{HINGES[joint]}, {robot.tau_max[leg, joint]:.3g} N·m"


def status_of(robot: Robot, code: int, culprit: int, stance: Bool[np.ndarray, "legs"]) -> str:
    """`solved`, or why there is no distribution, as a sentence.

    `culprit`: the limit that the others leave no room for, in the order of `forces.limit_rows`: bounds of
    the forces (3 each foot), friction (4), torques (3).
    """
    if code == SOLVED:
        return "solved"
    if code != INFEASIBLE:
        return "the force distribution took too many steps"
    down = np.flatnonzero(stance)
    m = len(down)
    if culprit < 7 * m:
        leg = down[culprit // 3 if culprit < 3 * m else (culprit - 3 * m) // 4]
        return f"these feet cannot carry this load: no room is left for the force of foot {robot.legs[leg]}"
    k, joint = divmod(culprit - 7 * m, 3)
    return (
        "these feet cannot carry this load without overloading a joint: "
        f"leg {robot.legs[down[k]]}, {joint_words(robot, int(down[k]), joint)}"
    )


def explain(robot: Robot, torques: Torques) -> str:
    """The whole certificate of a tick: status, what is missing of the wanted wrench, and every limit felt."""
    lines = [f"{torques.status}; {torques.residual:.1%} of the weight is missing of the wanted wrench"]
    lines += [f"{felt.sentence} (price {felt.price:.3g})" for felt in felt_limits(robot, torques)]
    return "\n".join(lines)
