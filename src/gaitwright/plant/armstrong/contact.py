"""Feet on the ground: spring and damper along the normal, Coulomb friction that sticks (row N6).

For a control period the ground under a foot is three planes (`ground`): that of the surface, and those of
the two nearest boxes, such as a stair and the riser of the next. Each pair of foot and plane is a *slot*.

Friction is a bristle: a spring between the foot and the spot it stands on, so that a robot that stands
does not creep. Its stretch `u` is the slip summed up; beyond μ N the bristle lets go and slides along.
"""

from typing import NamedTuple

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, length, scale, sub
from gaitwright.numerics.matrices import add_row, apply, mat, put_row, row

SLOTS = 3
"""Planes per foot."""
NOWHERE = -1e6
"""Height of a plane that nothing reaches [m]."""


class Feet(NamedTuple):
    """Round feet; arrays `(feet,)` unless said."""

    link: np.ndarray
    """int64: the link that ends in it."""
    at: np.ndarray
    """`(feet, 3)` hinge of that link → centre of the foot, link axes [m]."""
    radius: np.ndarray
    stiffness: np.ndarray
    """Along the normal and along the ground [N/m]."""
    damping: np.ndarray
    """The same [N·s/m]."""
    friction: np.ndarray
    """μ [-]."""


@kernel
def foot_motion(feet, f, R, hinge_at, hinge_rate, w):
    """Centre of a foot [m] and its velocity [m/s], world; angular velocity of its link, world [rad/s]."""
    k = feet.link[f]
    arm = apply(mat(R, k), row(feet.at, f))
    w_w = apply(mat(R, k), row(w, k))
    centre = add(row(hinge_at, k), arm)
    return centre, add(row(hinge_rate, k), cross(w_w, arm)), w_w


@kernel
def touch(feet, f, point, normal, motion):
    """Depth in a plane [m], contact point from the foot's centre, its speed along the normal and its slip."""
    centre, velocity, w_w = motion
    depth = feet.radius[f] - dot(normal, sub(centre, point))
    arm = scale(-feet.radius[f], normal)
    rate = add(velocity, cross(w_w, arm))
    rising = dot(normal, rate)
    return depth, arm, rising, sub(rate, scale(rising, normal))


@kernel
def contact_forces(feet, planes, slip, R, hinge_at, hinge_rate, w, force, moment):
    """Adds the ground's forces and moments about the hinges to `(links, 3)` each, world axes.

    `planes (slots, 6)`: point and normal; `slip (slots, 3)`: stretch of the bristles [m]. Returns the
    normal force on each foot [N].
    """
    load = np.zeros(feet.link.size)
    for f in range(feet.link.size):
        motion = foot_motion(feet, f, R, hinge_at, hinge_rate, w)
        for i in range(SLOTS * f, SLOTS * f + SLOTS):
            normal = (planes[i, 3], planes[i, 4], planes[i, 5])
            depth, arm, rising, sliding = touch(feet, f, row(planes, i), normal, motion)
            if depth <= 0.0:
                continue
            push = max(0.0, feet.stiffness[f] * depth - feet.damping[f] * rising)
            grip = add(scale(-feet.stiffness[f], row(slip, i)), scale(-feet.damping[f], sliding))
            most, size = feet.friction[f] * push, length(grip)
            if size > most:
                grip = scale(most / size, grip)
            total = add(scale(push, normal), grip)
            k = feet.link[f]
            add_row(force, k, total)
            add_row(moment, k, cross(add(sub(motion[0], row(hinge_at, k)), arm), total))
            load[f] += push
    return load


@kernel
def slip_rates(feet, planes, R, hinge_at, hinge_rate, w, out):
    """Writes the rates `(slots, 3)` at which the bristles stretch [m/s]; nothing in the air."""
    for f in range(feet.link.size):
        motion = foot_motion(feet, f, R, hinge_at, hinge_rate, w)
        for i in range(SLOTS * f, SLOTS * f + SLOTS):
            normal = (planes[i, 3], planes[i, 4], planes[i, 5])
            depth, _, _, sliding = touch(feet, f, row(planes, i), normal, motion)
            put_row(out, i, sliding if depth > 0.0 else (0.0, 0.0, 0.0))


@kernel
def let_go(feet, planes, R, hinge_at, slip):
    """Shortens bristles to what friction holds, lays them along their plane, ends those in the air."""
    for f in range(feet.link.size):
        k = feet.link[f]
        centre = add(row(hinge_at, k), apply(mat(R, k), row(feet.at, f)))
        for i in range(SLOTS * f, SLOTS * f + SLOTS):
            normal = (planes[i, 3], planes[i, 4], planes[i, 5])
            depth = feet.radius[f] - dot(normal, sub(centre, row(planes, i)))
            u = sub(row(slip, i), scale(dot(row(slip, i), normal), normal))
            most, size = feet.friction[f] * max(0.0, depth), length(u)
            if size > most:
                u = scale(most / size, u)
            put_row(slip, i, u)
