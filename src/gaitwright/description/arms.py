"""Limbs of three hinges → those that are legs, and a sentence about each that is not (row R2).

A limb is kept as a leg unless something says that it is none: it starts above the hips and cannot reach the
ground, or it has no counterpart and is unlike the others. What is like a leg is never left out.
"""

from itertools import product

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


def sorted_out(limbs: list[Limb]) -> tuple[list[int], Heading, tuple[str, ...]]:
    """Indices of the limbs that are legs, the way they face (its order counts those), and sentences.

    Raises `BadFile` where the legs are not in pairs.
    """
    high, unlike = above_the_hips(limbs), unlike_the_others(limbs)
    everyone = set(range(len(limbs)))
    straight = heading(limbs)
    if straight is not None and not straight.turn and not high:
        return sorted(everyone), straight, ()
    for dropped in (high, high | unlike, unlike, set()):
        kept = sorted(everyone - dropped)
        way = heading([limbs[i] for i in kept])
        if way is not None:
            return kept, way, tuple(locked(limbs[i], i in high) for i in sorted(dropped))
    return sorted(everyone), as_written(limbs), ()


def locked(limb: Limb, high: bool) -> str:
    """The sentence about a limb that is no leg."""
    lone = "it is unlike the others and has no counterpart"
    why = "it starts above the hips and cannot reach the ground" if high else lone
    return f"the limb of three hinges from joint {limb.name!r} is no leg, for {why}: its joints are locked"


def above_the_hips(limbs: list[Limb]) -> set[int]:
    """Limbs that start above the hips of the others and do not come down to the ground they stand on."""
    shapes = [limb.shape for limb in limbs if limb.shape is not None]
    if len(shapes) < 4:
        return set()
    length = float(np.median([shape.stretched for shape in shapes]))
    level = float(np.median([shape.hip[2] for shape in shapes]))
    ground = float(np.median([stance.nominal_foot(shape)[2] for shape in shapes]))
    return {
        i
        for i, limb in enumerate(limbs)
        if limb.hip[2] > level + ABOVE * length
        and (limb.shape is None or lowest_foot(limb.shape) > ground + NEARLY_DOWN * length)
    }


def unlike_the_others(limbs: list[Limb]) -> set[int]:
    """Limbs of another kind, length or height than most."""
    shapes = [limb.shape for limb in limbs if limb.shape is not None]
    if len(shapes) < 4:
        return set()
    length = float(np.median([shape.stretched for shape in shapes]))
    level = float(np.median([shape.hip[2] for shape in shapes]))
    yaws = 2 * sum(shape.yaws for shape in shapes) > len(shapes)

    def is_like(limb: Limb) -> bool:
        shape = limb.shape
        if shape is None or shape.yaws != yaws:
            return False
        as_long = length / ALIKE <= shape.stretched <= length * ALIKE
        return as_long and bool(abs(limb.hip[2] - level) <= ABOVE * length)

    return {i for i, limb in enumerate(limbs) if not is_like(limb)}


def lowest_foot(leg: LegShape) -> float:
    """The least height of the foot that the joint limits allow, base frame [m]."""
    low, high = np.maximum(leg.q_min, -np.pi), np.minimum(leg.q_max, np.pi)
    angles = product(*(np.linspace(a, b, TRIED) for a, b in zip(low, high, strict=True)))
    feet = [stance.foot_in_leg(np.array(q), leg.offset, leg.sign) for q in angles]
    return float(leg.hip[2] + (np.array(feet) @ leg.leg_frame[2]).min())
