"""Closed-form kinematics of a leg, for both leg types (row J4; equations.md §1).

Everything is in the leg frame: hinge 1 turns about x, hinge 2 about y, hinge 3 about ±y. In that frame
the component of the foot along x does not change with hinge 1, and the foot keeps the lateral distance
`d` from the plane of the two-link chain: two right triangles give all four branches.
"""

import math
from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, sub, turn_x, turn_y, vec, wrap

REACHED, TOO_NEAR_AXIS, TOO_FAR, TOO_NEAR_HIP = 0, 1, 2, 3
"""Reach codes; `model/reach.py` makes sentences of them."""

ROUNDING = 1e-12
"""A foot this little beyond the leg's reach, as a share, is there by rounding and counts as reached."""

BRANCHES: tuple[tuple[int, int], ...] = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""The four branches (sg, kn) of the inverse kinematics: side of the foot, bend of the knee."""

HINGES = ("hip 1", "hip 2", "knee")
"""The three hinges of a leg, as sentences name them."""


@kernel
def foot_in_leg(q, offset, sign):
    """Foot centre [m] in the leg frame for angles `q` of one leg.

    Of any other point of the leg, too: it is the foot of a leg whose offsets end there. The two turns in the
    plane of the knee are added up, which saves a turn of what `leg.foot_and_columns` does, who needs each.
    """
    c1, s1 = math.cos(q[0]), math.sin(q[0])
    c2, s2 = math.cos(q[1]), math.sin(q[1])
    b = q[1] + sign * q[2]
    shank = turn_y(math.cos(b), math.sin(b), vec(offset[2]))
    return turn_x(c1, s1, add(vec(offset[0]), add(turn_y(c2, s2, vec(offset[1])), shank)))


@kernel
def leg_angles(foot, offset, sign, side, bend):
    """Angles of one leg that bring its foot to `foot` (leg frame), and a reach code.

    `side`, `bend` (±1) choose the branch. Out of reach, the angles are those of the nearest reachable
    direction and the code says why.
    """
    code = REACHED
    lateral = offset[0, 1] + offset[1, 1] + offset[2, 1]
    square = foot[1] * foot[1] + foot[2] * foot[2] - lateral * lateral
    if square < 0.0:
        code = TOO_NEAR_AXIS if square < -ROUNDING * lateral * lateral else REACHED
        square = 0.0
    down = side * math.sqrt(square)
    q1 = wrap(math.atan2(foot[2], foot[1]) - math.atan2(down, lateral))

    thigh = math.hypot(offset[1, 0], offset[1, 2])
    shank = math.hypot(offset[2, 0], offset[2, 2])
    thigh_angle = math.atan2(-offset[1, 0], -offset[1, 2])
    shank_angle = math.atan2(-offset[2, 0], -offset[2, 2])
    x, z = foot[0] - offset[0, 0], down - offset[0, 2]
    cosine = (x * x + z * z - thigh * thigh - shank * shank) / (2.0 * thigh * shank)
    if cosine > 1.0:
        code = TOO_FAR if cosine > 1.0 + ROUNDING else code
        cosine = 1.0
    elif cosine < -1.0:
        code = TOO_NEAR_HIP if cosine < -1.0 - ROUNDING else code
        cosine = -1.0
    sine = bend * math.sqrt((1.0 - cosine) * (1.0 + cosine))
    knee = math.atan2(sine, cosine)
    hip = math.atan2(-x, -z) - math.atan2(shank * sine, thigh + shank * cosine)
    return (q1, wrap(hip - thigh_angle), sign * wrap(knee - shank_angle + thigh_angle)), code


@kernel
def to_base(leg_frame, hip, point):
    """A point of the leg frame in the base frame."""
    x = hip[0] + leg_frame[0, 0] * point[0] + leg_frame[0, 1] * point[1] + leg_frame[0, 2] * point[2]
    y = hip[1] + leg_frame[1, 0] * point[0] + leg_frame[1, 1] * point[1] + leg_frame[1, 2] * point[2]
    z = hip[2] + leg_frame[2, 0] * point[0] + leg_frame[2, 1] * point[1] + leg_frame[2, 2] * point[2]
    return (x, y, z)


@kernel
def to_leg(leg_frame, hip, point):
    """A point of the base frame in the leg frame."""
    d = sub(point, vec(hip))
    return (
        leg_frame[0, 0] * d[0] + leg_frame[1, 0] * d[1] + leg_frame[2, 0] * d[2],
        leg_frame[0, 1] * d[0] + leg_frame[1, 1] * d[1] + leg_frame[2, 1] * d[2],
        leg_frame[0, 2] * d[0] + leg_frame[1, 2] * d[1] + leg_frame[2, 2] * d[2],
    )


@kernel
def all_feet(hip, leg_frame, offset, sign, q):
    """Foot centres `(legs, 3)` in the base frame [m]."""
    out = np.empty(hip.shape)
    for leg in range(hip.shape[0]):
        p = to_base(leg_frame[leg], hip[leg], foot_in_leg(q[leg], offset[leg], sign[leg]))
        out[leg, 0], out[leg, 1], out[leg, 2] = p
    return out


@kernel
def feet_over_time(hip, leg_frame, offset, sign, q):
    """`all_feet` for many moments: angles `(moments, legs, 3)`."""
    out = np.empty(q.shape)
    for i in range(q.shape[0]):
        out[i] = all_feet(hip, leg_frame, offset, sign, q[i])
    return out


@kernel
def all_angles(hip, leg_frame, offset, sign, branch, feet):
    """Angles `(legs, 3)` and reach codes `(legs,)` for foot centres `feet` in the base frame."""
    n = hip.shape[0]
    q, codes = np.empty((n, 3)), np.empty(n, dtype=np.int64)
    for leg in range(n):
        point = to_leg(leg_frame[leg], hip[leg], vec(feet[leg]))
        angles, codes[leg] = leg_angles(point, offset[leg], sign[leg], branch[leg, 0], branch[leg, 1])
        q[leg, 0], q[leg, 1], q[leg, 2] = angles
    return q, codes


# --- whole robots ----------------------------------------------------------------------------------
def feet(robot: Robot, q: Float[np.ndarray, "legs 3"]) -> Float[np.ndarray, "legs 3"]:
    """Centres of the feet in the base frame [m] for joint angles `q` [rad]."""
    a = robot.arrays
    return all_feet(a.hip, a.leg_frame, a.offset, a.sign, per_leg(robot, q, "the angle of", HINGES))


def knees(robot: Robot, q: Float[np.ndarray, "legs 3"]) -> Float[np.ndarray, "legs 3"]:
    """Third hinges in the base frame [m] for joint angles `q` [rad]."""
    a = robot.arrays
    thighs = a.offset.copy()
    thighs[:, 2] = 0.0
    return all_feet(a.hip, a.leg_frame, thighs, a.sign, q)


def angles(
    robot: Robot, feet_b: Float[np.ndarray, "legs 3"]
) -> tuple[Float[np.ndarray, "legs 3"], Bool[np.ndarray, "legs"]]:
    """Joint angles [rad] for foot centres in the base frame [m], and which legs reach theirs.

    Each leg stays in its own branch (`Robot.branch`); `reach.reach` says how far the others are off.
    """
    a = robot.arrays
    places = per_leg(robot, feet_b, "the foot's", "xyz")
    q, codes = all_angles(a.hip, a.leg_frame, a.offset, a.sign, a.branch, places)
    return q, codes == REACHED


def reached_branches(
    point: tuple[float, float, float], offset: Float[np.ndarray, "3 3"], sign: float
) -> dict[tuple[int, int], Float[np.ndarray, "3"]]:
    """Joint angles [rad] of each branch that brings the foot of one leg to `point` (leg frame, [m])."""
    solved = {branch: leg_angles(point, offset, sign, *branch) for branch in BRANCHES}
    return {branch: np.array(q) for branch, (q, code) in solved.items() if code == REACHED}


def per_leg(robot: Robot, values, what: str, parts: Sequence[str]) -> Float[np.ndarray, "legs 3"]:
    """`values` as the kernels need them: contiguous, finite, a row per leg.

    Raises `WrongUse` with the leg and the number; `what` and `parts` name the three columns.
    """
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape != (robot.n, 3):
        raise WrongUse(
            f"{what} {', '.join(parts)} of each leg: got an array of shape {array.shape}; {robot.name} has "
            f"{robot.n} legs ({', '.join(robot.legs)}), expected ({robot.n}, 3)"
        )
    if not np.isfinite(array).all():
        leg, part = np.argwhere(~np.isfinite(array))[0]
        raise WrongUse(f"leg {robot.legs[leg]}: {what} {parts[part]} is {array[leg, part]}, not finite")
    return array
