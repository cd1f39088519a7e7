"""How a robot stands when nobody tells it: nominal footholds and the bend of its legs (row R2).

Numbers only: both follow from the lengths, axes and limits of a leg, so that a robot nobody has seen
before stands without one hand-set value. The ratios fit the published heights of Go2, Go1,
Mini Cheetah, Aliengo and B2, and the thesis's robot (reach 2.0 m, depth 2.25 m for legs of 5 m).
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.kinematics import BRANCHES, foot_in_leg, reached_branches, to_leg
from gaitwright.numerics.geometry import turn_x, turn_y, wrapped

DEPTH_BELOW_ABDUCTION = 0.65
"""Abduction leg: depth of the foot below hinge 2, per length of the stretched leg."""
DEPTH_BELOW_YAW, REACH_FROM_YAW = 0.45, 0.40
"""Yaw leg: depth of the foot below hinge 2 and its distance sideways, per length of the stretched leg."""
SIDEWAYS = 0.1
"""A leg sticks out at zero angles where the cosine of hinge 2 and the level line across is smaller."""
STRIDE = 0.35
"""A leg that yaws stands so far from the limits of its first hinge that it can take a step [rad]."""
COMFORT = 0.2
"""Distance from a joint limit [rad] beyond which more of it does not make a branch better."""
STANDING = 0.2
"""A pose whose foot is less below the hip than this, per length of the stretched leg, does not stand."""
BENT = 0.1
"""A pose shows a branch where the next one is farther than this [rad]: bent knees, foot off the axis."""
LEANING = 0.1
"""Thighs or shanks whose ends are farther apart than this, per length of the stretched leg, lean two ways."""

UP, BACK, NONE = np.array([0.0, 0.0, 1.0]), np.array([-1.0, 0.0, 0.0]), np.zeros(3)


class LegShape(NamedTuple):
    """One leg of a `Robot`, as far as standing goes; fields and frames as there."""

    hip: Float[np.ndarray, "3"]
    leg_frame: Float[np.ndarray, "3 3"]
    offset: Float[np.ndarray, "3 3"]
    sign: float
    q_min: Float[np.ndarray, "3"]
    q_max: Float[np.ndarray, "3"]

    @property
    def yaws(self) -> bool:
        """Whether the first hinge turns about the vertical rather than about a horizontal axis."""
        return bool(abs(self.leg_frame[2, 0]) > math.sqrt(0.5))

    @property
    def stretched(self) -> float:
        """Length [m] of thigh and shank together, in the plane in which the knee bends."""
        return float(np.hypot(self.offset[1:, 0], self.offset[1:, 2]).sum())

    @property
    def shortest(self) -> float:
        """Length [m] of the shorter one of thigh and shank, in that plane."""
        return float(np.hypot(self.offset[1:, 0], self.offset[1:, 2]).min())

    def margin(self, q: Float[np.ndarray, "3"]) -> float:
        """Distance [rad] of joint angles from the nearest limit; negative outside."""
        return float(np.min(np.minimum(q - self.q_min, self.q_max - q)))


def nominal_foot(leg: LegShape) -> Float[np.ndarray, "3"]:
    """Centre of the foot of one leg in the nominal stance, base frame [m]."""
    return below_yaw(leg) if leg.yaws else below_abduction(leg)


def below_abduction(leg: LegShape) -> Float[np.ndarray, "3"]:
    """Straight below hinge 2, the plane of the leg vertical: only its offset loads the first hinge.

    A leg that sticks out sideways at zero angles may be turned down either way: within its limits, and so
    that hinge 2 is below hinge 1.
    """
    axis = leg.leg_frame[:, 0]
    lateral = np.cross(UP, axis)
    lateral /= np.linalg.norm(lateral)
    straight = float(lateral @ leg.leg_frame[:, 1])
    if abs(straight) > SIDEWAYS:
        return below_hinge2(leg, lateral if straight >= 0.0 else -lateral)

    def merit(foot: Float[np.ndarray, "3"]) -> tuple[float, float]:
        room = max((leg.margin(q) for q in branch_angles(leg, foot).values()), default=-math.inf)
        return round(min(room, COMFORT), 6), -round(float(foot[2]), 6)

    return max((below_hinge2(leg, lateral), below_hinge2(leg, -lateral)), key=merit)


def below_hinge2(leg: LegShape, lateral: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3"]:
    """The foot straight below hinge 2, whose axis points along `lateral`."""
    axis = leg.leg_frame[:, 0]
    hinge2 = leg.hip + np.column_stack([axis, lateral, np.cross(axis, lateral)]) @ leg.offset[0]
    aside = leg.offset[1:, 1].sum() * lateral
    return hinge2 + aside - DEPTH_BELOW_ABDUCTION * leg.stretched * UP


def below_yaw(leg: LegShape) -> Float[np.ndarray, "3"]:
    """Straight sideways from the yaw axis, away from the body; less so where hinge 1 does not turn so far."""
    outward = math.copysign(1.0, leg.hip[1])
    reach = REACH_FROM_YAW * leg.stretched + math.hypot(leg.offset[0, 1], leg.offset[0, 2])
    depth = DEPTH_BELOW_YAW * leg.stretched - leg.leg_frame[2, 0] * leg.offset[0, 0]
    aside = np.array([0.0, outward * reach, -depth])
    turn = short_of_limits(leg, leg.hip + aside) * math.copysign(1.0, leg.leg_frame[2, 0])
    if turn == 0.0:
        return leg.hip + aside
    return leg.hip + np.array([-math.sin(turn) * aside[1], math.cos(turn) * aside[1], -depth])


def short_of_limits(leg: LegShape, foot: Float[np.ndarray, "3"]) -> float:
    """How far hinge 1 would have to turn to be `STRIDE` from its limits with the foot there [rad]."""
    room = min(STRIDE, 0.5 * float(leg.q_max[0] - leg.q_min[0]))
    wanted = []
    for q in branch_angles(leg, foot).values():
        turn = float(np.clip(q[0], leg.q_min[0] + room, leg.q_max[0] - room) - q[0])
        others = max(0.0, -leg.margin(np.array([q[0] + turn, q[1], q[2]])))
        wanted.append((round(others, 6), abs(turn), turn))
    return min(wanted, default=(0.0, 0.0, 0.0))[2]


def branch_angles(leg: LegShape, foot: Float[np.ndarray, "3"]) -> dict[tuple[int, int], np.ndarray]:
    """Joint angles `(3,)` [rad] of each branch that brings the foot of one leg to `foot` (base frame)."""
    return reached_branches(to_leg(leg.leg_frame, leg.hip, foot), leg.offset, leg.sign)


def nominal_branch(
    leg: LegShape, foot: Float[np.ndarray, "3"], q_home: Float[np.ndarray, "3"] | None = None
) -> tuple[int, int] | None:
    """Branch (sg, kn) in which one leg stands at `foot`; `None` where no branch reaches it.

    The pose `q_home` decides where it stands inside the limits, else `best_branch`.
    """
    choices = branch_angles(leg, foot)
    shown = None if q_home is None else branch_of(leg, q_home)
    return shown if shown in choices else best_branch(leg, choices)


def nominal_branches(
    legs: list[LegShape], feet: list[np.ndarray], homes: list[np.ndarray | None]
) -> list[tuple[int, int] | None]:
    """The branch of each leg of a robot as `nominal_branch` has it, legs in pairs from front to rear.

    Where a rear leg is the mirror image of the front one, and no pose shows how they stand, its knee is too.
    """
    chosen = [nominal_branch(leg, foot, q) for leg, foot, q in zip(legs, feet, homes, strict=True)]
    shown = [q is not None and branch_of(leg, q) is not None for leg, q in zip(legs, homes, strict=True)]
    for front, rear in ((0, len(legs) - 2), (1, len(legs) - 1)):
        if mirrored(legs[front], legs[rear]) and not shown[front] and not shown[rear]:
            both = mirrored_branches((legs[front], legs[rear]), (feet[front], feet[rear]))
            chosen[front], chosen[rear] = both or (chosen[front], chosen[rear])
    return chosen


def mirrored(front: LegShape, rear: LegShape) -> bool:
    """Whether a rear leg that abducts is the front one in a mirror across, rather than the same further back.

    Told by where thigh and shank lead at zero angles; a straight or vertical leg is no sign of it.
    """
    if front.yaws or rear.yaws:
        return False
    size = 0.5 * (front.stretched + rear.stretched)
    ahead, behind = ((leg.offset[1:] @ leg.leg_frame.T)[:, 0] / size for leg in (front, rear))
    apart = float(np.abs(ahead - behind).max())
    return apart > LEANING and float(np.abs(ahead + behind).max()) < 0.5 * apart


def mirrored_branches(
    legs: tuple[LegShape, LegShape], feet: tuple[np.ndarray, np.ndarray]
) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Branches of a front and a rear leg whose knees are images of each other: the better leg's own and its
    image. `None` where both would be nearer to their limits than each leg for itself.
    """
    angles = [branch_angles(leg, foot) for leg, foot in zip(legs, feet, strict=True)]
    best = [best_branch(leg, choices) for leg, choices in zip(legs, angles, strict=True)]
    if best[0] is None or best[1] is None:
        return None
    ways = [
        (best[0], image(knee_at(legs[0], angles[0][best[0]]), legs[1], angles[1])),
        (image(knee_at(legs[1], angles[1][best[1]]), legs[0], angles[0]), best[1]),
    ]

    def merit(way) -> tuple[float, float]:
        q = [choices[branch] for choices, branch in zip(angles, way, strict=True)]
        comfort = min(min(leg.margin(x), COMFORT) for leg, x in zip(legs, q, strict=True))
        return round(comfort, 6), -round(float(sum(x @ x for x in q)), 6)

    chosen = max(ways, key=merit)
    return chosen if merit(chosen)[0] >= merit(best)[0] else None


def image(knee: Float[np.ndarray, "3"], leg: LegShape, choices: dict[tuple[int, int], np.ndarray]):
    """The branch whose knee is nearest to the image of another leg's in a mirror across."""
    place = knee * (-1.0, 1.0, 1.0)

    def distance(branch: tuple[int, int]) -> tuple[float, float]:
        q = choices[branch]
        return round(float(np.linalg.norm(knee_at(leg, q) - place)), 6), float(q @ q)

    return min(choices, key=distance)


def knee_at(leg: LegShape, q: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3"]:
    """The knee from the first hinge, base axes [m]."""
    return leg.leg_frame @ np.array(foot_in_leg(q, np.vstack([leg.offset[:2], NONE]), leg.sign))


def best_branch(leg: LegShape, choices: dict[tuple[int, int], np.ndarray]) -> tuple[int, int] | None:
    """The best of some branches and their angles.

    First come the joint limits, then the knee bent as animals of that kind bend it, then small angles.
    """

    def merit(branch: tuple[int, int]) -> tuple[float, bool, float]:
        q = choices[branch]
        comfort = min(leg.margin(q), COMFORT)
        return round(comfort, 6), knee_bends_well(leg, q), -round(float(q @ q), 6)

    return max(choices, key=merit, default=None)


def knee_bends_well(leg: LegShape, q: Float[np.ndarray, "3"]) -> bool:
    """Whether the knee is behind (abduction leg) or above (yaw leg) the line from hinge 2 to the foot."""
    good = UP if leg.yaws else BACK
    to_foot = leg.leg_frame @ np.array(foot_in_leg(q, np.vstack([NONE, leg.offset[1:]]), leg.sign))
    to_knee = leg.leg_frame @ np.array(foot_in_leg(q, np.vstack([NONE, leg.offset[1], NONE]), leg.sign))
    beside = to_knee - to_foot * (to_knee @ to_foot) / (to_foot @ to_foot)
    return bool(beside @ good > 0.0)


def branch_of(leg: LegShape, q: Float[np.ndarray, "3"]) -> tuple[int, int] | None:
    """Branch (sg, kn) that a pose of one leg shows.

    `None` where the pose is out of limits, hardly bent, or does not stand: foot not well below the hip.
    """
    foot = leg.hip + leg.leg_frame @ np.array(foot_in_leg(q, leg.offset, leg.sign))
    stands = leg.hip[2] - foot[2] > STANDING * leg.stretched
    choices = branch_angles(leg, foot)
    if leg.margin(q) < -1e-6 or not stands or len(choices) < len(BRANCHES):
        return None
    gap = {branch: float(np.abs(wrapped(q - other)).max()) for branch, other in choices.items()}
    nearest, second = sorted(gap, key=gap.__getitem__)[:2]
    return nearest if gap[second] > BENT else None


def down_in_shank(leg: LegShape, q: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3"]:
    """Direction of the ground in the axes of link 3, body level."""
    turn2 = q[1] + leg.sign * q[2]
    down = turn_x(math.cos(q[0]), -math.sin(q[0]), tuple(leg.leg_frame.T @ -UP))
    return np.array(turn_y(math.cos(turn2), -math.sin(turn2), down))
