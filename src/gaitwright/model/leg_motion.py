"""Rates and accelerations of joints and feet, and back again, in closed form (row J4; equations.md §1).

Seen in the axes of link 1 (the leg frame turned by hinge 1) the Jacobian falls apart. With thigh t, shank
s and foot f = (f_x, d, P) there, only hinge 1 moves the foot across the plane in which the knee bends,
by −P q̇₁; in that plane t turns with q̇₂ and s with q̇₂ ± q̇₃. So P = 0 (the foot under the first axis)
and t × s = 0 (the knee straight or folded) are all the singular poses there are. Near them the answers
stay bounded and are not exact; a flag says so, and `model/reach.py` says it in words.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.model.kinematics import HINGES, all_angles, feet, per_leg
from gaitwright.model.robot import Robot, unpacked
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, times, times_t, turn_x, turn_y, vec

AXIS_SHARE = 0.01
"""A foot less aside from under the first axis than this, per length of the stretched leg, is singular."""
KNEE_SINE = 0.01
"""A knee is singular where the angle between thigh and shank has a smaller sine than this."""

STILL = np.zeros(3)
"""No motion."""
STILL.flags.writeable = False


# --- one leg ---------------------------------------------------------------------------------------
@kernel
def bent_leg(q, offset, sign):
    """Thigh, shank, and the foot seen from hinge 1, in the axes of link 1 [m]: three 3-vectors."""
    b = q[1] + sign * q[2]
    thigh = turn_y(math.cos(q[1]), math.sin(q[1]), vec(offset[1]))
    shank = turn_y(math.cos(b), math.sin(b), vec(offset[2]))
    return thigh, shank, add(vec(offset[0]), add(thigh, shank))


@kernel
def bend_area(thigh, shank):
    """s × t along the second axis [m²]: product of the lengths and the sine of the angle between them."""
    return thigh[0] * shank[2] - thigh[2] * shank[0]


@kernel
def link_lengths(thigh, shank):
    """Lengths of thigh and shank in the plane in which the knee bends [m]."""
    return math.hypot(thigh[0], thigh[2]), math.hypot(shank[0], shank[2])


@kernel
def kept_off_zero(x, least):
    """`x`, or `least` with its sign where `x` is smaller than that."""
    return x if abs(x) >= least else math.copysign(least, x)


@kernel
def moved(thigh, shank, foot, sign, x):
    """J x: velocity of the foot for joint rates `x`, axes of link 1."""
    shank_rate = x[1] + sign * x[2]
    return (
        thigh[2] * x[1] + shank[2] * shank_rate,
        -foot[2] * x[0],
        foot[1] * x[0] - thigh[0] * x[1] - shank[0] * shank_rate,
    )


@kernel
def solved(thigh, shank, foot, sign, v):
    """x with J x = v (axes of link 1), and whether the pose is regular; if not, x is only bounded."""
    long, short = link_lengths(thigh, shank)
    aside, area = foot[2], bend_area(thigh, shank)
    least_aside, least_area = AXIS_SHARE * (long + short), KNEE_SINE * long * short
    hip1 = -v[1] / kept_off_zero(aside, least_aside)
    x, z, k = v[0], v[2] - foot[1] * hip1, 1.0 / kept_off_zero(area, least_area)
    hip2 = -k * (shank[0] * x + shank[2] * z)
    shank_rate = k * (thigh[0] * x + thigh[2] * z)
    regular = abs(aside) >= least_aside and abs(area) >= least_area
    return (hip1, hip2, sign * (shank_rate - hip2)), regular


@kernel
def centripetal(thigh, shank, foot, sign, qd):
    """J̇ q̇: acceleration of the foot at steady joint rates, axes of link 1."""
    w1, w2, w3 = qd[0] * qd[0], qd[1] * qd[1], (qd[1] + sign * qd[2]) * (qd[1] + sign * qd[2])
    falling = -thigh[0] * qd[1] - shank[0] * (qd[1] + sign * qd[2])
    return (
        -thigh[0] * w2 - shank[0] * w3,
        -foot[1] * w1 - 2.0 * qd[0] * falling,
        -thigh[2] * w2 - shank[2] * w3 - foot[2] * w1,
    )


@kernel
def leg_velocity(q, qd, offset, sign):
    """Velocity of the foot from joint rates, leg frame [m/s]."""
    thigh, shank, foot = bent_leg(q, offset, sign)
    return turn_x(math.cos(q[0]), math.sin(q[0]), moved(thigh, shank, foot, sign, qd))


@kernel
def leg_acceleration(q, qd, qdd, offset, sign):
    """Acceleration J q̈ + J̇ q̇ of the foot, leg frame [m/s²]."""
    thigh, shank, foot = bent_leg(q, offset, sign)
    a = add(moved(thigh, shank, foot, sign, qdd), centripetal(thigh, shank, foot, sign, qd))
    return turn_x(math.cos(q[0]), math.sin(q[0]), a)


@kernel
def leg_rates(q, offset, sign, velocity):
    """Joint rates that move the foot with `velocity` (leg frame), and whether the pose is regular."""
    thigh, shank, foot = bent_leg(q, offset, sign)
    v = turn_x(math.cos(q[0]), -math.sin(q[0]), velocity)
    return solved(thigh, shank, foot, sign, v)


@kernel
def leg_accelerations(q, qd, offset, sign, acceleration):
    """Joint accelerations that give the foot `acceleration` (leg frame) at joint rates `qd`, and the flag."""
    thigh, shank, foot = bent_leg(q, offset, sign)
    a = turn_x(math.cos(q[0]), -math.sin(q[0]), acceleration)
    c = centripetal(thigh, shank, foot, sign, qd)
    return solved(thigh, shank, foot, sign, (a[0] - c[0], a[1] - c[1], a[2] - c[2]))


# --- all legs --------------------------------------------------------------------------------------
@kernel
def all_velocities(model, q, qd):
    """Velocities `(legs, 3)` of the feet relative to the base, base axes."""
    out = np.empty(q.shape)
    for leg in range(q.shape[0]):
        v = leg_velocity(q[leg], qd[leg], model.offset[leg], model.sign[leg])
        out[leg, 0], out[leg, 1], out[leg, 2] = times(model.leg_frame[leg], v)
    return out


@kernel
def all_accelerations(model, q, qd, qdd):
    """Accelerations `(legs, 3)` of the feet relative to the base, base axes."""
    out = np.empty(q.shape)
    for leg in range(q.shape[0]):
        a = leg_acceleration(q[leg], qd[leg], qdd[leg], model.offset[leg], model.sign[leg])
        out[leg, 0], out[leg, 1], out[leg, 2] = times(model.leg_frame[leg], a)
    return out


@kernel
def all_joint_rates(model, q, velocity):
    """Joint rates `(legs, 3)` for velocities of the feet (base axes), and which poses are regular."""
    out, regular = np.empty(q.shape), np.empty(q.shape[0], dtype=np.bool_)
    for leg in range(q.shape[0]):
        v = times_t(model.leg_frame[leg], vec(velocity[leg]))
        rates, regular[leg] = leg_rates(q[leg], model.offset[leg], model.sign[leg], v)
        out[leg, 0], out[leg, 1], out[leg, 2] = rates
    return out, regular


@kernel
def all_joint_accelerations(model, q, qd, acceleration):
    """Joint accelerations `(legs, 3)` for accelerations of the feet (base axes), and the flags."""
    out, regular = np.empty(q.shape), np.empty(q.shape[0], dtype=np.bool_)
    for leg in range(q.shape[0]):
        a = times_t(model.leg_frame[leg], vec(acceleration[leg]))
        qdd, regular[leg] = leg_accelerations(q[leg], qd[leg], model.offset[leg], model.sign[leg], a)
        out[leg, 0], out[leg, 1], out[leg, 2] = qdd
    return out, regular


@kernel
def joints_of(packed, feet_b, velocity_b, acceleration_b):
    """Joint angles, rates, accelerations and reach codes for feet that move so relative to the base.

    Of many moments: `(moments, legs, 3)`, base axes; the codes `(moments, legs)`.
    """
    model = unpacked(packed)
    q, qd, qdd = np.empty(feet_b.shape), np.empty(feet_b.shape), np.empty(feet_b.shape)
    codes = np.empty(feet_b.shape[:2], dtype=np.int64)
    for i in range(feet_b.shape[0]):
        q[i], codes[i] = all_angles(
            model.hip, model.leg_frame, model.offset, model.sign, model.branch, feet_b[i]
        )
        qd[i], _ = all_joint_rates(model, q[i], velocity_b[i])
        qdd[i], _ = all_joint_accelerations(model, q[i], qd[i], acceleration_b[i])
    return q, qd, qdd, codes


# --- for people: feet and joints relative to the base ------------------------------------------------
Joints = Float[np.ndarray, "legs 3"]
"""Angles, rates or accelerations of the joints [rad, rad/s, rad/s²]."""
Feet = Float[np.ndarray, "legs 3"]
"""Places, velocities or accelerations of the centres of the feet [m, m/s, m/s²]."""
Points = Float[np.ndarray, "*moments legs 3"]
"""The same of one moment or many."""
Regular = Bool[np.ndarray, "legs"]
"""Which legs are in a regular pose: the answer is exact there, elsewhere only bounded."""


def feet_velocity(robot: Robot, q: Joints, qd: Joints) -> Feet:
    """Velocities of the feet relative to the base, base axes."""
    return all_velocities(robot.arrays, checked(robot, q), checked(robot, qd, RATE))


def feet_acceleration(robot: Robot, q: Joints, qd: Joints, qdd: Joints) -> Feet:
    """Accelerations of the feet relative to the base, base axes."""
    return all_accelerations(
        robot.arrays, checked(robot, q), checked(robot, qd, RATE), checked(robot, qdd, ACCELERATION)
    )


def joint_rates(robot: Robot, q: Joints, feet_velocity_b: Feet) -> tuple[Joints, Regular]:
    """Joint rates that move the feet so relative to the base (base axes); eq. 3-15 … 3-18."""
    v = per_leg(robot, feet_velocity_b, "the foot's velocity", "xyz")
    return all_joint_rates(robot.arrays, checked(robot, q), v)


def joint_accelerations(
    robot: Robot, q: Joints, qd: Joints, feet_acceleration_b: Feet
) -> tuple[Joints, Regular]:
    """Joint accelerations that accelerate the feet so relative to the base (base axes), at rates `qd`."""
    a = per_leg(robot, feet_acceleration_b, "the foot's acceleration", "xyz")
    return all_joint_accelerations(robot.arrays, checked(robot, q), checked(robot, qd, RATE), a)


ANGLE, RATE, ACCELERATION = "the angle", "the rate", "the acceleration"


def checked(robot: Robot, joints: Joints, what: str = ANGLE) -> Joints:
    """Numbers of the joints as kernels need them. Raises `WrongUse` where one is missing or not finite."""
    return per_leg(robot, joints, f"{what} of", HINGES)


# --- for people: over a base that moves --------------------------------------------------------------
class BaseMotion(NamedTuple):
    """How a base moves. `_w` is in world axes, `_b` in base axes, as in `Sensed`.

    Of many moments at once: matrices `(moments, 3, 3)`, vectors `(moments, 1, 3)`.
    """

    rotation_wb: Float[np.ndarray, "3 3"]
    velocity_w: Float[np.ndarray, "3"]
    """Velocity of the base origin [m/s]."""
    angular_velocity_b: Float[np.ndarray, "3"]
    """[rad/s]."""
    acceleration_w: Float[np.ndarray, "3"] = STILL
    """Acceleration of the base origin [m/s²]."""
    angular_acceleration_b: Float[np.ndarray, "3"] = STILL
    """[rad/s²]."""


def velocity_from_base(base: BaseMotion, feet_b: Points, feet_velocity_w: Points) -> Points:
    """Velocities of points relative to the base, base axes: ṗ = Rᵀ(v_foot − v_b) − ω × p."""
    return (feet_velocity_w - base.velocity_w) @ base.rotation_wb - np.cross(base.angular_velocity_b, feet_b)


def acceleration_from_base(
    base: BaseMotion,
    feet_b: Points,
    feet_velocity_b: Points,
    feet_acceleration_w: Points,
) -> Points:
    """Accelerations of points relative to the base: p̈ = Rᵀ(a_foot − a_b) − ω̇ × p − 2 ω × ṗ − ω × (ω × p).

    `feet_velocity_b` is ṗ, relative to the base.
    """
    w = base.angular_velocity_b
    relative = (feet_acceleration_w - base.acceleration_w) @ base.rotation_wb
    carried = np.cross(base.angular_acceleration_b, feet_b) + np.cross(w, np.cross(w, feet_b))
    return relative - carried - 2.0 * np.cross(w, feet_velocity_b)


def stance_rates(robot: Robot, q: Joints, base: BaseMotion) -> tuple[Joints, Regular]:
    """Joint rates with which the feet stand still in the world while the base moves."""
    places = feet(robot, q)
    return joint_rates(robot, q, velocity_from_base(base, places, np.zeros_like(places)))


def stance_accelerations(robot: Robot, q: Joints, base: BaseMotion) -> tuple[Joints, Regular]:
    """Joint accelerations with which standing feet stay where they are while the base accelerates."""
    places = feet(robot, q)
    still = np.zeros_like(places)
    relative = velocity_from_base(base, places, still)
    qd, _ = joint_rates(robot, q, relative)
    return joint_accelerations(robot, q, qd, acceleration_from_base(base, places, relative, still))
