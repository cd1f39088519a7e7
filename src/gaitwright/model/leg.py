"""One leg as tuples: its kinematics turn by turn, and the numbers that the recursions of dynamics read.

Rows and matrices out of arrays cost a kernel more than the arithmetic on them. So a leg's numbers are
read once, and from there on everything is a tuple: a matrix is the tuple of its rows, a hinge's turn is
the cosine and sine of its angle.

Whoever asks how a leg moves asks here: `foot_and_columns` (the foot and its Jacobian J), `bias_motion` (what
rates alone do, J̇ q̇ among it), `solve_columns` (J x = b, and what is done where J is singular).
"""

import math
from typing import NamedTuple

from gaitwright.model.robot import LAYOUT
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, length, scale, sub, turn_x, turn_y, vec
from gaitwright.numerics.matrices import rows, rows_at, vec_at

SINGULAR = 0.01
"""A pose is singular where the columns of J span a smaller volume than this share of what they could."""


class Leg(NamedTuple):
    """The numbers of one leg; the fields are those of `Robot`, matrices as tuples of rows."""

    frame: tuple
    hip: tuple
    offset: tuple
    sign: float
    mass: tuple
    com: tuple
    inertia: tuple
    armature: tuple
    foot_radius: float


# --- reading -------------------------------------------------------------------------------------
hip, frame, offset, sign, mass, com, inertia, armature, foot_radius = (
    LAYOUT.start(name)
    for name in ("hip", "leg_frame", "offset", "sign", "mass", "com", "inertia", "armature", "foot_radius")
)
base_mass, base_com, base_inertia = (LAYOUT.start(name) for name in ("base_mass", "base_com", "base_inertia"))


@kernel
def leg_at(packed, k):
    """The leg `k` of a packed robot (`Robot.packed`)."""
    tensors = inertia(packed) + 27 * k
    return Leg(
        rows_at(packed, frame(packed) + 9 * k),
        vec_at(packed, hip(packed) + 3 * k),
        rows_at(packed, offset(packed) + 9 * k),
        packed[sign(packed) + k],
        vec_at(packed, mass(packed) + 3 * k),
        rows_at(packed, com(packed) + 9 * k),
        (rows_at(packed, tensors), rows_at(packed, tensors + 9), rows_at(packed, tensors + 18)),
        vec_at(packed, armature(packed) + 3 * k),
        packed[foot_radius(packed) + k],
    )


@kernel
def leg_of(model, k):
    """The leg `k` of `Robot.arrays`."""
    tensors = model.inertia[k]
    return Leg(
        rows(model.leg_frame[k]),
        vec(model.hip[k]),
        rows(model.offset[k]),
        model.sign[k],
        vec(model.mass[k]),
        rows(model.com[k]),
        (rows(tensors[0]), rows(tensors[1]), rows(tensors[2])),
        vec(model.armature[k]),
        model.foot_radius[k],
    )


@kernel
def base_at(packed):
    """Mass, centre of mass and inertia of the base of a packed robot."""
    at = base_mass(packed)
    return packed[at], vec_at(packed, base_com(packed)), rows_at(packed, base_inertia(packed))


# --- turning -------------------------------------------------------------------------------------
@kernel
def leg_turns(q, sign):
    """Cosine and sine of the three hinges; the third about +y, whichever way its axis points."""
    return (
        (math.cos(q[0]), math.sin(q[0])),
        (math.cos(q[1]), math.sin(q[1])),
        (math.cos(q[2]), sign * math.sin(q[2])),
    )


@kernel
def to_leg_frame(turns, a):
    """A vector of the last link's axes in the leg frame."""
    (c1, s1), (c2, s2), (c3, s3) = turns
    return turn_x(c1, s1, turn_y(c2, s2, turn_y(c3, s3, a)))


@kernel
def to_last_link(turns, a):
    """A vector of the leg frame in the last link's axes."""
    (c1, s1), (c2, s2), (c3, s3) = turns
    return turn_y(c3, -s3, turn_y(c2, -s2, turn_x(c1, -s1, a)))


@kernel
def from_last_hinge(turns, offset, point):
    """Third hinge → `point`, in the last link's axes; `point` is first hinge → point, in the leg frame."""
    (c1, s1), (c2, s2), (c3, s3) = turns
    below = sub(turn_x(c1, -s1, point), offset[0])
    return turn_y(c3, -s3, sub(turn_y(c2, -s2, below), offset[1]))


@kernel
def foot_and_columns(turns, offset, sign):
    """Foot centre and the three columns of its Jacobian, leg frame: four 3-vectors."""
    (c1, s1), (c2, s2), (c3, s3) = turns
    shank = turn_x(c1, s1, turn_y(c2, s2, turn_y(c3, s3, offset[2])))
    below_hip = add(turn_x(c1, s1, turn_y(c2, s2, offset[1])), shank)
    foot = add(turn_x(c1, s1, offset[0]), below_hip)
    axis2 = (0.0, c1, s1)
    return foot, cross((1.0, 0.0, 0.0), foot), cross(axis2, below_hip), scale(sign, cross(axis2, shank))


@kernel
def hinge_axes(turns, sign):
    """The axes of the three hinges, leg frame."""
    c1, s1 = turns[0]
    return (1.0, 0.0, 0.0), (0.0, c1, s1), (0.0, sign * c1, sign * s1)


class Posed(NamedTuple):
    """A leg where its joints are: worked out once, read by all who ask."""

    leg: Leg
    turns: tuple
    """`leg_turns`."""
    foot: tuple
    """Foot centre, leg frame [m]."""
    columns: tuple
    """The three columns of its Jacobian, leg frame."""


@kernel
def posed(packed, q, k):
    """The `Posed` of leg k of a packed robot, at its joint angles `q`."""
    leg = leg_at(packed, k)
    turns = leg_turns(q, leg.sign)
    foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
    return Posed(leg, turns, foot, (c1, c2, c3))


# --- rates and accelerations -----------------------------------------------------------------------
@kernel
def combined(rates, columns):
    """J x: the Jacobian's columns times the joint rates."""
    return add(add(scale(rates[0], columns[0]), scale(rates[1], columns[1])), scale(rates[2], columns[2]))


@kernel
def point_acceleration(a, w, wd, r):
    """Acceleration of a point at `r` on a body whose origin accelerates with `a` (eq. 4-12)."""
    return add(a, add(cross(wd, r), cross(w, cross(w, r))))


@kernel
def hinge_motion(w, wd, axis_rate):
    """Angular velocity and acceleration past a hinge that keeps its rate; child's axes (eq. 4-10, 4-11)."""
    return add(w, axis_rate), add(wd, cross(w, axis_rate))


@kernel
def bias_motion(turns, qd, offset, sign, w, wd, a):
    """Angular velocity, angular and linear acceleration of the three links with q̈ = 0, each in its axes.

    `turns`: `leg_turns` of the angles; `w`, `wd`, `a`: those of the base at the first hinge, leg frame.
    """
    (c1, s1), (c2, s2), (c3, s3) = turns
    w1, wd1 = hinge_motion(turn_x(c1, -s1, w), turn_x(c1, -s1, wd), (qd[0], 0.0, 0.0))
    a1 = turn_x(c1, -s1, a)
    a2 = turn_y(c2, -s2, point_acceleration(a1, w1, wd1, offset[0]))
    w2, wd2 = hinge_motion(turn_y(c2, -s2, w1), turn_y(c2, -s2, wd1), (0.0, qd[1], 0.0))
    a3 = turn_y(c3, -s3, point_acceleration(a2, w2, wd2, offset[1]))
    w3, wd3 = hinge_motion(turn_y(c3, -s3, w2), turn_y(c3, -s3, wd2), (0.0, sign * qd[2], 0.0))
    return (w1, wd1, a1), (w2, wd2, a2), (w3, wd3, a3)


@kernel
def foot_acceleration(turns, motion, offset):
    """Acceleration of the foot centre, leg frame, from the motion of the links."""
    w, wd, a = motion[2]
    return to_leg_frame(turns, point_acceleration(a, w, wd, offset[2]))


# --- and back --------------------------------------------------------------------------------------
@kernel
def longest_square(c1, c2, c3):
    """Square of the longest column of J [m²]."""
    return max(dot(c1, c1), dot(c2, c2), dot(c3, c3))


@kernel
def least_volume(c1, c2, c3):
    """The volume of the columns of J below which a pose is singular [m³].

    It is P A, with P the foot's distance from under the first axis in the plane in which the knee bends, and
    A the area of thigh and shank there. With r the longest column (as far as the foot is from a hinge) and s
    the shank, no pose of the leg has more than r · r s.
    """
    return SINGULAR * longest_square(c1, c2, c3) * length(c3)


@kernel
def is_regular(c1, c2, c3):
    """Whether joint rates follow exactly from the velocity of the foot."""
    return abs(dot(c1, cross(c2, c3))) >= least_volume(c1, c2, c3)


@kernel
def bounded_volume(c1, c2, c3, n23):
    """The volume of the columns of J, no smaller than `least_volume`; `n23`: c2 × c3 [m³]."""
    volume, least = dot(c1, n23), least_volume(c1, c2, c3)
    return math.copysign(least, volume) if abs(volume) < least else volume


@kernel
def solve_columns(c1, c2, c3, b):
    """x with J x = b, by cofactors; near a singular pose it is not exact, and bounded.

    Then |x₁|, |x₂| ≤ |b| / (`SINGULAR` r) and |x₃| ≤ |b| / (`SINGULAR` s), as in `least_volume`.
    """
    n23 = cross(c2, c3)
    k = 1.0 / bounded_volume(c1, c2, c3, n23)
    return scale(k, (dot(b, n23), dot(b, cross(c3, c1)), dot(b, cross(c1, c2))))
