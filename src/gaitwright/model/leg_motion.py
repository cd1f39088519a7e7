"""Rates and accelerations of joints and feet, and back again (row J4; equations.md §1).

By the Jacobian of `model/leg.py`, as the controllers have it. Near a singular pose the answers stay bounded
and are not exact; a flag says so, and `model/reach.py` says in words which pose it is.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.model.kinematics import HINGES, all_angles, per_leg
from gaitwright.model.leg import (
    bias_motion,
    combined,
    foot_acceleration,
    foot_and_columns,
    is_regular,
    leg_turns,
    solve_columns,
)
from gaitwright.model.robot import Robot, unpacked
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, sub, times, times_t, vec
from gaitwright.numerics.matrices import rows

NO_MOTION = np.zeros(3)
"""No motion."""
NO_MOTION.flags.writeable = False
AT_REST = (0.0, 0.0, 0.0)


# --- one leg ---------------------------------------------------------------------------------------
@kernel
def columns_of(q, offset, sign):
    """The columns of the Jacobian, leg frame: three 3-vectors."""
    _, c1, c2, c3 = foot_and_columns(leg_turns(q, sign), offset, sign)
    return c1, c2, c3


@kernel
def centripetal(q, qd, offset, sign):
    """J̇ q̇: acceleration of the foot at steady joint rates, leg frame [m/s²]."""
    turns = leg_turns(q, sign)
    bias = bias_motion(turns, qd, offset, sign, AT_REST, AT_REST, AT_REST)
    return foot_acceleration(turns, bias, offset)


# --- all legs --------------------------------------------------------------------------------------
@kernel
def all_velocities(model, q, qd):
    """Velocities `(legs, 3)` of the feet relative to the base, base axes."""
    out = np.empty(q.shape)
    for leg in range(q.shape[0]):
        columns = columns_of(q[leg], rows(model.offset[leg]), model.sign[leg])
        v = combined(qd[leg], columns)
        out[leg, 0], out[leg, 1], out[leg, 2] = times(model.leg_frame[leg], v)
    return out


@kernel
def all_accelerations(model, q, qd, qdd):
    """Accelerations `(legs, 3)` of the feet relative to the base, base axes."""
    out = np.empty(q.shape)
    for leg in range(q.shape[0]):
        offset, sign = rows(model.offset[leg]), model.sign[leg]
        a = combined(qdd[leg], columns_of(q[leg], offset, sign))
        a = add(a, centripetal(q[leg], qd[leg], offset, sign))
        out[leg, 0], out[leg, 1], out[leg, 2] = times(model.leg_frame[leg], a)
    return out


@kernel
def all_joint_rates(model, q, velocity):
    """Joint rates `(legs, 3)` for velocities of the feet (base axes), and which poses are regular."""
    out, regular = np.empty(q.shape), np.empty(q.shape[0], dtype=np.bool_)
    for leg in range(q.shape[0]):
        v = times_t(model.leg_frame[leg], vec(velocity[leg]))
        c1, c2, c3 = columns_of(q[leg], rows(model.offset[leg]), model.sign[leg])
        out[leg, 0], out[leg, 1], out[leg, 2] = solve_columns(c1, c2, c3, v)
        regular[leg] = is_regular(c1, c2, c3)
    return out, regular


@kernel
def all_joint_accelerations(model, q, qd, acceleration):
    """Joint accelerations `(legs, 3)` for accelerations of the feet (base axes), and the flags."""
    out, regular = np.empty(q.shape), np.empty(q.shape[0], dtype=np.bool_)
    for leg in range(q.shape[0]):
        a = times_t(model.leg_frame[leg], vec(acceleration[leg]))
        offset, sign = rows(model.offset[leg]), model.sign[leg]
        c1, c2, c3 = columns_of(q[leg], offset, sign)
        short = sub(a, centripetal(q[leg], qd[leg], offset, sign))
        out[leg, 0], out[leg, 1], out[leg, 2] = solve_columns(c1, c2, c3, short)
        regular[leg] = is_regular(c1, c2, c3)
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
    acceleration_w: Float[np.ndarray, "3"] = NO_MOTION
    """Acceleration of the base origin [m/s²]."""
    angular_acceleration_b: Float[np.ndarray, "3"] = NO_MOTION
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
