"""Limbs of three hinges → those that are legs, and a sentence about each that is not (row R2).

A limb is kept as a leg unless something says that it is none: it starts above the hips and is of another
build or cannot reach the ground, or it has no counterpart and is unlike the others. What is like a leg is
never left out.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

from gaitwright.description.heading import Heading, Limb, as_written, heading
from gaitwright.model import nominal_pose as stance
from gaitwright.model.nominal_pose import LegShape

ABOVE = 0.1
"""A limb starts above the hips by more than this, per length of the stretched legs."""
NEARLY_DOWN = 0.05
"""A foot this close above the ground, per length of the stretched legs, reaches it."""
ALIKE = 1.3
"""Legs are at most so many times as long as one another."""
TRIED = 13
"""So many angles of each hinge tell how low a foot comes."""
LONE = "is unlike the others and has no counterpart"


class Usual(NamedTuple):
    """What most limbs are like: length, height of first hinge and foot [m] in the base frame, yaw or not."""

    length: float
    level: float
    ground: float
    yaws: bool


def sorted_out(limbs: list[Limb]) -> tuple[list[int], Heading, tuple[str, ...]]:
    """Indices of the limbs that are legs, the way they face (its order counts those), and sentences.

    Raises `BadFile` where the legs are not in pairs.
    """
    high = above_the_hips(limbs)
    arms, unlike = set(high), unlike_the_others(limbs)
    everyone = set(range(len(limbs)))
    straight = heading(limbs)
    if straight is not None and not straight.turn and not arms:
        return sorted(everyone), straight, ()
    for dropped in (arms, arms | unlike, unlike, set()):
        kept = sorted(everyone - dropped)
        way = heading([limbs[i] for i in kept])
        if way is not None:
            return kept, way, tuple(locked(limbs[i], high.get(i, LONE)) for i in sorted(dropped))
    return sorted(everyone), as_written(limbs), ()


def locked(limb: Limb, why: str) -> str:
    """The sentence about a limb that is no leg."""
    return f"the limb of three hinges from joint {limb.name!r} is no leg, for it {why}: its joints are locked"


def above_the_hips(limbs: list[Limb]) -> dict[int, str]:
    """Limbs that start above the hips of the others and are no legs, each with the reason."""
    most = usual(limbs)
    if most is None:
        return {}
    high = {i: limb.shape for i, limb in enumerate(limbs) if limb.hip[2] > most.level + ABOVE * most.length}
    reasons = {}
    for i, shape in high.items():
        if shape is None or shape.yaws != most.yaws:
            reasons[i] = "starts above the hips and is of another build than the legs"
        elif lowest_foot(shape) > most.ground + NEARLY_DOWN * most.length:
            reasons[i] = "starts above the hips and cannot reach the ground"
    return reasons


def unlike_the_others(limbs: list[Limb]) -> set[int]:
    """Limbs of another build, length or height than most."""
    most = usual(limbs)
    return set() if most is None else {i for i, limb in enumerate(limbs) if not is_like(limb, most)}


def is_like(limb: Limb, most: Usual) -> bool:
    """Whether a limb may be one of the legs by its build."""
    if limb.shape is None or limb.shape.yaws != most.yaws:
        return False
    as_long = most.length / ALIKE <= limb.shape.stretched <= most.length * ALIKE
    return as_long and bool(abs(limb.hip[2] - most.level) <= ABOVE * most.length)


def usual(limbs: list[Limb]) -> Usual | None:
    """What most of the limbs are like; `None` where fewer than four could be legs."""
    shapes = [limb.shape for limb in limbs if limb.shape is not None]
    if len(shapes) < 4:
        return None
    return Usual(
        length=float(np.median([shape.stretched for shape in shapes])),
        level=float(np.median([shape.hip[2] for shape in shapes])),
        ground=float(np.median([stance.nominal_foot(shape)[2] for shape in shapes])),
        yaws=2 * sum(shape.yaws for shape in shapes) > len(shapes),
    )


def lowest_foot(leg: LegShape) -> float:
    """The least height of the foot that the joint limits allow, base frame [m]."""
    low, high = np.maximum(leg.q_min, -np.pi), np.minimum(leg.q_max, np.pi)
    angles = product(*(np.linspace(a, b, TRIED) for a, b in zip(low, high, strict=True)))
    feet = [stance.foot_in_leg(np.array(q), leg.offset, leg.sign) for q in angles]
    return float(leg.hip[2] + (np.array(feet) @ leg.leg_frame[2]).min())
