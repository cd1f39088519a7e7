"""What a single joint has to set going: the inertia about its hinge of all that hangs on it.

The diagonal of a leg's mass matrix with the base held: how stiff a joint may be follows from it.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.model.leg import leg_at, leg_turns
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, dot, turn_y
from gaitwright.numerics.matrices import apply


@kernel
def about_x(mass, at, inertia, axis):
    """Inertia about the x axis of a link whose centre of mass is `at`; `axis`: that axis in its own axes."""
    return mass * (at[1] * at[1] + at[2] * at[2]) + dot(axis, apply(inertia, axis))


@kernel
def about_y(mass, at, inertia):
    """Inertia about the y axis, which all links of a leg have in common."""
    return mass * (at[0] * at[0] + at[2] * at[2]) + inertia[1][1]


@kernel
def joint_inertias(leg, turns):
    """Inertia at each of a leg's three joints, the others and the base held, armature included [kg·m²]."""
    _, (c2, s2), (c3, s3) = turns
    mass, com, inertia = leg.mass, leg.com, leg.inertia
    third = add(leg.offset[1], turn_y(c3, s3, com[2]))
    x2 = turn_y(c2, -s2, (1.0, 0.0, 0.0))
    x3 = turn_y(c3, -s3, x2)
    first = about_x(mass[0], com[0], inertia[0], (1.0, 0.0, 0.0))
    first += about_x(mass[1], add(leg.offset[0], turn_y(c2, s2, com[1])), inertia[1], x2)
    first += about_x(mass[2], add(leg.offset[0], turn_y(c2, s2, third)), inertia[2], x3)
    second = about_y(mass[1], com[1], inertia[1]) + about_y(mass[2], third, inertia[2])
    last = about_y(mass[2], com[2], inertia[2])
    return first + leg.armature[0], second + leg.armature[1], last + leg.armature[2]


def all_joint_inertias(robot: Robot, q: Float[np.ndarray, "legs 3"]) -> Float[np.ndarray, "legs 3"]:
    """`joint_inertias` of every leg at joint angles `q` [kg·m²]."""
    legs = [leg_at(robot.packed, k) for k in range(robot.n)]
    return np.array([joint_inertias(leg, leg_turns(q[k], leg.sign)) for k, leg in enumerate(legs)])
