"""Whether a leg gets its foot there, and how near a pose is to a singular one: values with a sentence."""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.kinematics import (
    HINGES,
    REACHED,
    TOO_FAR,
    TOO_NEAR_AXIS,
    TOO_NEAR_HIP,
    all_angles,
    per_leg,
    to_leg,
)
from gaitwright.model.leg import (
    SINGULAR,
    foot_and_columns,
    hinge_axes,
    is_regular,
    leg_turns,
    longest_square,
)
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import cross, dot, length, scale, sub

BEYOND_LIMIT = 4
"""Reach code beside those of `kinematics`: the leg is long enough, but a joint limit is in the way."""
LIMIT_TOLERANCE = 1e-9
"""An angle this little outside its limits [rad] is inside."""

SENTENCES = {
    REACHED: "leg {leg}: within reach, {measure:.3g} m from hip 2, the stretched leg is {limit:.3g} m",
    TOO_NEAR_AXIS: "leg {leg}: the foot is {measure:.3g} m from the first axis, the leg's lateral offset is "
    "{limit:.3g} m",
    TOO_FAR: "leg {leg}: the foot is {measure:.3g} m from hip 2, the stretched leg is {limit:.3g} m",
    TOO_NEAR_HIP: "leg {leg}: the foot is {measure:.3g} m from hip 2, the folded leg is {limit:.3g} m",
    BEYOND_LIMIT: "leg {leg}: {joint} would stand at {measure:.3g} rad, beyond its limit of {limit:.3g} rad",
}


class Reach(NamedTuple):
    """Whether one leg brings its foot to a place, in its own branch."""

    leg: str
    code: int
    """`REACHED`, `TOO_NEAR_AXIS`, `TOO_FAR`, `TOO_NEAR_HIP` or `BEYOND_LIMIT`."""
    measure: float
    """What was measured: a distance in the plane in which the knee bends [m], or an angle [rad]."""
    limit: float
    """What it would have to keep to, same unit."""
    sentence: str
    """All of it in words."""


def reach(robot: Robot, feet_b: Float[np.ndarray, "legs 3"]) -> tuple[Reach, ...]:
    """How far each leg is from bringing its foot to its place in `feet_b`, base frame [m]."""
    places = per_leg(robot, feet_b, "the foot's", "xyz")
    a = robot.arrays
    q, codes = all_angles(a.hip, a.leg_frame, a.offset, a.sign, a.branch, places)
    return tuple(reach_of(robot, i, places[i], q[i], int(codes[i])) for i in range(robot.n))


def reach_of(
    robot: Robot, i: int, place: Float[np.ndarray, "3"], q: Float[np.ndarray, "3"], code: int
) -> Reach:
    """The `Reach` of leg `i` with the answer `q`, `code` of the inverse kinematics."""
    leg, offset = robot.legs[i], robot.offset[i]
    over = np.maximum(robot.q_min[i] - q, q - robot.q_max[i])
    joint = int(np.argmax(over))
    if code == REACHED and over[joint] > LIMIT_TOLERANCE:
        low, high, angle = robot.q_min[i, joint], robot.q_max[i, joint], float(q[joint])
        return in_words(leg, BEYOND_LIMIT, angle, float(low if angle < low else high), HINGES[joint])
    x, y, z = to_leg(robot.leg_frame[i], robot.hip[i], place)
    aside = float(offset[:, 1].sum())
    if code == TOO_NEAR_AXIS:
        return in_words(leg, code, math.hypot(y, z), abs(aside))
    down = robot.branch[i, 0] * math.sqrt(max(0.0, y * y + z * z - aside * aside))
    distance = math.hypot(x - offset[0, 0], down - offset[0, 2])
    thigh, shank = np.hypot(offset[1:, 0], offset[1:, 2])
    return in_words(leg, code, distance, abs(thigh - shank) if code == TOO_NEAR_HIP else thigh + shank)


def in_words(leg: str, code: int, measure: float, limit: float, joint: str = "") -> Reach:
    """A `Reach` with its sentence."""
    sentence = SENTENCES[code].format(leg=leg, measure=measure, limit=limit, joint=joint)
    return Reach(leg, code, measure, limit, sentence)


# --- singular poses --------------------------------------------------------------------------------
UNDER_AXIS, KNEE_STRAIGHT, KNEE_FOLDED = 1, 2, 3
CAUSE = math.sqrt(SINGULAR)
"""The volume of the Jacobian is a product of two shares; where it is singular one is below this, and told."""


class Pose(NamedTuple):
    """How near one leg is to a pose in which its foot cannot move in all directions."""

    leg: str
    singular: tuple[int, ...]
    """Which of `UNDER_AXIS`, `KNEE_STRAIGHT`, `KNEE_FOLDED` it is in; none where it is regular."""
    axis_distance: float
    """Distance of the foot from under the first axis, in the plane in which the knee bends [m]."""
    knee_sine: float
    """Sine of the angle between thigh and shank."""
    sentence: str
    """All of it in words."""


def poses(robot: Robot, q: Float[np.ndarray, "legs 3"]) -> tuple[Pose, ...]:
    """How near each leg is to its singular poses at joint angles `q` [rad]."""
    angles = per_leg(robot, q, "the angle of", HINGES)
    return tuple(pose_of(robot, i, angles[i]) for i in range(robot.n))


def pose_of(robot: Robot, i: int, q: Float[np.ndarray, "3"]) -> Pose:
    """The `Pose` of leg `i` at joint angles `q`."""
    sign, offset = float(robot.sign[i]), tuple(map(tuple, robot.offset[i].tolist()))
    turns = leg_turns(tuple(q), sign)
    _, c1, c2, c3 = foot_and_columns(turns, offset, sign)
    axis2 = hinge_axes(turns, sign)[1]
    thigh, shank = sub(c2, scale(sign, c3)), scale(sign, c3)  # each a quarter turn on about the second axis
    long, short, r = length(thigh), length(shank), longest_square(c1, c2, c3)
    aside, area = abs(dot(c1, axis2)), abs(dot(cross(thigh, shank), axis2))
    sine, straight = area / (long * short), dot(thigh, shank) > 0.0
    regular = is_regular(c1, c2, c3)
    singular, words, here, bend = [], [], f"{round(aside, 9):.2g} m", f"{round(sine, 9):.2g}"
    if not regular and aside < CAUSE * math.sqrt(r):
        singular.append(UNDER_AXIS)
        words.append(f"the foot is under the first axis, {here} from it in the plane of the knee")
    if not regular and area < CAUSE * math.sqrt(r) * short:
        singular.append(KNEE_STRAIGHT if straight else KNEE_FOLDED)
        words.append(f"the knee is {'straight' if straight else 'folded'}, its sine is {bend}")
    fine = f"regular: the foot is {here} from under the first axis, the knee's sine is {bend}"
    sentence = f"leg {robot.legs[i]}: {' and '.join(words) or fine}"
    return Pose(robot.legs[i], tuple(singular), aside, sine, sentence)
