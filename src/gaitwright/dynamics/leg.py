"""One leg as tuples: what the recursions of dynamics read, turn by turn.

Rows and matrices out of arrays cost a kernel more than the arithmetic on them. So a leg's numbers are
read once, and from there on everything is a tuple: a matrix is the tuple of its rows, a hinge's turn is
the cosine and sine of its angle.
"""

import math
from typing import NamedTuple

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, scale, sub, turn_x, turn_y, vec
from gaitwright.numerics.matrices import rows, rows_at, vec_at


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
@kernel
def leg_at(packed, k):
    """The leg `k` of a packed robot (`Robot.packed`); its order is that of `model.robot.unpacked`."""
    n = int(packed[0])
    hip = 14
    frame = hip + 3 * n
    offset = frame + 9 * n
    sign = offset + 9 * n
    mass = sign + n
    com = mass + 3 * n
    inertia = com + 9 * n
    armature = inertia + 27 * n
    foot_radius = armature + (3 + 2 + 3) * n
    tensors = inertia + 27 * k
    return Leg(
        rows_at(packed, frame + 9 * k),
        vec_at(packed, hip + 3 * k),
        rows_at(packed, offset + 9 * k),
        packed[sign + k],
        vec_at(packed, mass + 3 * k),
        rows_at(packed, com + 9 * k),
        (rows_at(packed, tensors), rows_at(packed, tensors + 9), rows_at(packed, tensors + 18)),
        vec_at(packed, armature + 3 * k),
        packed[foot_radius + k],
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
    return packed[1], vec_at(packed, 2), rows_at(packed, 5)


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
