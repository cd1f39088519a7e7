"""The motion that a gait asks for over one cycle, without any feedback (rows J1, J3, J4; equations.md §1).

Level ground, constant velocity and yaw rate, every foot straight below or beside its hip in the middle of
its stance: what body, feet and joints do when everything goes as wished. The numerical controller fed
with `sensed(i)` and `target(i)` gives the torques of the undisturbed gait.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.errors import WrongUse
from gaitwright.gait.command import path, sample
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, tabulated_legs
from gaitwright.gait.reference import periodic_reference
from gaitwright.gait.swing import swings
from gaitwright.model.kinematics import REACHED
from gaitwright.model.leg_motion import BaseMotion, acceleration_from_base, joints_of, velocity_from_base
from gaitwright.model.reach import LIMIT_TOLERANCE, reach
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of
from gaitwright.signals import GRIP, Gait, MotionTarget, Sensed

UP = np.array([0.0, 0.0, 1.0])
Array = np.ndarray


@dataclass(frozen=True, slots=True)
class Manner:
    """How a gait is walked, beyond its rhythm."""

    height: float | None = None
    """Base origin over the centres of the feet [m]; `None`: as in the nominal stance."""
    lift: float | None = None
    """How high every foot is swung [m]; `None`: as high as its leg cycle says."""
    cycle: LegCycle | None = None
    """The leg cycle that the feet follow; `None`: the one that comes along for the gait."""
    sways: bool = False
    """Whether the body sways, bobs and pitches with its periodic reference; else it stays level."""


@dataclass(frozen=True)
class DesiredCycle:
    """One cycle of desired motion: `steps` samples, evenly spaced, the first one at phase 0.

    The sample after the last would be the first, one stride and one yaw angle further on. World axes
    and units as in `MotionTarget`; the ground is at z = 0.
    """

    robot: Robot
    gait: Gait
    command: Float[np.ndarray, "3"]
    """Velocity forward and left [m/s], yaw rate [rad/s]."""
    time: Float[np.ndarray, "steps"]
    stance: Bool[np.ndarray, "steps legs"]
    position_w: Float[np.ndarray, "steps 3"]
    velocity_w: Float[np.ndarray, "steps 3"]
    acceleration_w: Float[np.ndarray, "steps 3"]
    rotation_wb: Float[np.ndarray, "steps 3 3"]
    angular_velocity_w: Float[np.ndarray, "steps 3"]
    angular_acceleration_w: Float[np.ndarray, "steps 3"]
    feet_w: Float[np.ndarray, "steps legs 3"]
    feet_velocity_w: Float[np.ndarray, "steps legs 3"]
    feet_acceleration_w: Float[np.ndarray, "steps legs 3"]
    q: Float[np.ndarray, "steps legs 3"]
    qd: Float[np.ndarray, "steps legs 3"]
    qdd: Float[np.ndarray, "steps legs 3"]
    """Joint angles, rates and accelerations [rad, s]."""

    @property
    def steps(self) -> int:
        """Number of samples."""
        return len(self.time)

    @property
    def phase(self) -> Float[np.ndarray, "steps"]:
        """Phase φ of the gait at every sample, in [0, 1)."""
        return self.time / self.gait.period

    @property
    def stride_w(self) -> Float[np.ndarray, "3"]:
        """How far one cycle takes the base origin [m]."""
        return np.append(path(self.command, np.array([self.gait.period]))[0][0], 0.0)

    def sensed(self, i: int) -> Sensed:
        """Sample `i` as a robot would sense it; the feet that are down carry even shares of the weight."""
        down = self.stance[i].astype(float)
        return Sensed(
            time=float(self.time[i]),
            position_w=self.position_w[i].copy(),
            orientation_wb=quaternion_of(self.rotation_wb[i]),
            velocity_w=self.velocity_w[i].copy(),
            angular_velocity_b=self.rotation_wb[i].T @ self.angular_velocity_w[i],
            q=self.q[i].copy(),
            qd=self.qd[i].copy(),
            load=self.robot.total_mass * GRAVITY * down / max(down.sum(), 1.0),
        )

    def target(self, i: int) -> MotionTarget:
        """Sample `i` as the coordinator would ask for it; feet that are down may carry all they can."""
        return MotionTarget(
            phase=float(self.phase[i]),
            stance=self.stance[i].copy(),
            load_scale=self.stance[i].astype(float),
            friction=np.full(self.robot.n, GRIP),
            normal_w=UP.copy(),
            position_w=self.position_w[i].copy(),
            velocity_w=self.velocity_w[i].copy(),
            acceleration_w=self.acceleration_w[i].copy(),
            rotation_wb=self.rotation_wb[i].copy(),
            angular_velocity_w=self.angular_velocity_w[i].copy(),
            angular_acceleration_w=self.angular_acceleration_w[i].copy(),
            feet_w=self.feet_w[i].copy(),
            feet_velocity_w=self.feet_velocity_w[i].copy(),
            feet_acceleration_w=self.feet_acceleration_w[i].copy(),
            q=self.q[i].copy(),
            command=self.command.copy(),
            operator=np.zeros(self.robot.n),
            reach=np.zeros(self.robot.n),
            extra_force_w=np.zeros((self.robot.n, 3)),
        )


def desired_cycle(
    robot: Robot,
    gait: Gait,
    velocity: tuple[float, float],
    turn: float = 0.0,
    manner: Manner | None = None,
    steps: int = 256,
) -> DesiredCycle:
    """The desired motion of a robot over one cycle of a gait.

    `velocity`: forward and left, heading frame [m/s]; `turn`: yaw rate [rad/s]. Raises `WrongUse` where
    the gait does not fit the robot, where a number is not finite, and where a foot cannot be reached or a
    joint would stand beyond its limit (leg, phase and distance or angle).
    """
    manner = manner or Manner()
    command = np.array([velocity[0], velocity[1], turn], dtype=float)
    check(robot, gait, command, manner, steps)
    time = gait.period * np.arange(steps) / steps
    body = body_motion(robot, gait, command, manner, time)
    stance, feet, feet_v, feet_a = feet_motion(robot, gait, command, manner, time)
    q, qd, qdd, codes = joint_motion(robot, body, feet, feet_v, feet_a)
    if (codes != REACHED).any():
        raise out_of_reach(robot, gait, body, feet, distances(robot, body, feet, codes))
    beyond = np.maximum(robot.q_min - q, q - robot.q_max).max(axis=2)
    if (beyond > LIMIT_TOLERANCE).any():
        raise out_of_reach(robot, gait, body, feet, beyond)
    return DesiredCycle(robot, gait, command, time, stance, *body, feet, feet_v, feet_a, q, qd, qdd)


# --- what is refused -------------------------------------------------------------------------------
def check(robot: Robot, gait: Gait, command: Float[np.ndarray, "3"], manner: Manner, steps: int) -> None:
    """`WrongUse` for what is no gait of this robot, and for a number that is none."""
    if len(gait.offsets) != robot.n:
        raise WrongUse(
            f"gait {gait.name!r} is for {len(gait.offsets)} legs; {robot.name} has {robot.n}: "
            f"{', '.join(robot.legs)}"
        )
    if steps < 1:
        raise WrongUse(f"a cycle of {steps} samples is none; ask for 1 or more")
    if gait.duty >= 1.0 and command.any():
        raise WrongUse(f"gait {gait.name!r} lifts no foot (duty factor {gait.duty:g}): it cannot move")
    check_numbers(gait, command)
    for what, value in (("height", manner.height), ("lift", manner.lift)):
        if value is not None and not np.isfinite(value):
            raise WrongUse(f"a {what} of {value:g} m was asked for; it must be finite")


def check_numbers(gait: Gait, command: Float[np.ndarray, "3"]) -> None:
    """`WrongUse` for a velocity that is none, and for numbers that no gait can have."""
    if not np.isfinite(command).all():
        raise WrongUse(
            f"velocity {command[0]:g}, {command[1]:g} m/s and yaw rate {command[2]:g} rad/s: "
            "every number must be finite"
        )
    if not 0.0 < gait.period < np.inf:
        raise WrongUse(f"gait {gait.name!r} has a period of {gait.period:g} s; it must be above 0 and finite")
    if not 0.0 < gait.duty <= 1.0:
        raise WrongUse(
            f"gait {gait.name!r} has a duty factor of {gait.duty:g}; it must be above 0, at most 1"
        )
    if not np.isfinite(gait.offsets).all():
        raise WrongUse(f"gait {gait.name!r} has offsets {gait.offsets}; every one must be finite")


# --- the body --------------------------------------------------------------------------------------
def body_motion(
    robot: Robot, gait: Gait, command: Float[np.ndarray, "3"], manner: Manner, time: Float[np.ndarray, "n"]
) -> tuple[Array, Array, Array, Array, Array, Array]:
    """The base over time: position, velocity, acceleration, rotation, angular velocity and acceleration."""
    table = periodic_reference(robot, gait)
    rows = np.array([sample(table, phase) for phase in time / gait.period]) * manner.sways
    y, yd, ydd, z, zd, zdd, pitch, pitch_d, pitch_dd = rows.T
    height = robot.stand if manner.height is None else manner.height
    nothing = np.zeros_like(time)
    w = command[2]
    omega = w * UP
    offset = np.stack([nothing, y, z + height + robot.foot_radius.mean()], axis=1)
    offset_d, offset_dd = np.stack([nothing, yd, zd], axis=1), np.stack([nothing, ydd, zdd], axis=1)
    v = np.array([command[0], command[1], 0.0])

    place, yaw = path(command, time)
    forward = np.stack([np.cos(yaw), np.sin(yaw), nothing], axis=1)
    lateral, up = np.cross(UP, forward), np.broadcast_to(UP, forward.shape)
    heading = np.stack([forward, lateral, up], axis=2)
    c, s = np.cos(pitch)[:, None], np.sin(pitch)[:, None]
    acceleration = np.cross(omega, v) + offset_dd + 2.0 * np.cross(omega, offset_d)
    return (
        np.pad(place, ((0, 0), (0, 1))) + apply(heading, offset),
        apply(heading, v + offset_d + np.cross(omega, offset)),
        apply(heading, acceleration + np.cross(omega, np.cross(omega, offset))),
        np.stack([c * forward - s * up, lateral, s * forward + c * up], axis=2),
        omega + pitch_d[:, None] * lateral,
        pitch_dd[:, None] * lateral + pitch_d[:, None] * np.cross(omega, lateral),
    )


def apply(
    matrices: Float[np.ndarray, "n 3 3"], vectors: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Each matrix times its vector."""
    return np.einsum("nij,nj->ni", matrices, vectors)


# --- the feet --------------------------------------------------------------------------------------
def feet_motion(
    robot: Robot, gait: Gait, command: Float[np.ndarray, "3"], manner: Manner, time: Float[np.ndarray, "n"]
) -> tuple[Array, Array, Array, Array]:
    """The feet over time, `(n, legs …)`: whether they are down, and position, velocity, acceleration.

    A foot swings as it does under the coordinator (`gait/swing.py`), and is aimed at the ground, not below
    it: it leaves and meets it without velocity and acceleration against it.
    """
    along = time[:, None] / gait.period + np.asarray(gait.offsets)
    cycle = np.floor(along)
    stance = along - cycle < gait.duty
    start, end = (stance_places(robot, gait, command, cycle + k) for k in (0, 1))
    air = max(1.0 - gait.duty, 1e-9)
    s = np.where(stance, 0.0, (along - cycle - gait.duty) / air)
    tables, rise = swing_of(robot, gait, manner)
    return stance, *swings(start, end, s, stance, air * gait.period, rise, tables)


def swing_of(
    robot: Robot, gait: Gait, manner: Manner
) -> tuple[Float[np.ndarray, "legs samples 6"], Float[np.ndarray, "legs"]]:
    """The leg cycle of each leg as a table, and what its heights are multiplied by [m]."""
    cycle = manner.cycle or cycle_of(gait.name)
    tables = tabulated_legs(cycle, robot.n)
    if manner.lift is None:
        return tables, np.full(robot.n, robot.height)
    peaks = tables[..., 3].max(axis=1)
    if not peaks.all():
        raise WrongUse(f"leg cycle {cycle.name!r} lifts no foot: it cannot be swung {manner.lift:g} m high")
    return tables, manner.lift / peaks


def stance_places(
    robot: Robot, gait: Gait, command: Float[np.ndarray, "3"], cycle: Float[np.ndarray, "n legs"]
) -> Float[np.ndarray, "n legs 3"]:
    """Where each foot stands in a cycle of its own [m]: at its nominal place in the middle of stance."""
    middle = (cycle - np.asarray(gait.offsets) + 0.5 * gait.duty) * gait.period
    place, yaw = path(command, middle)
    c, s = np.cos(yaw), np.sin(yaw)
    x, y = robot.nominal_feet[:, 0], robot.nominal_feet[:, 1]
    ground = np.broadcast_to(robot.foot_radius, yaw.shape)
    return np.stack([place[..., 0] + c * x - s * y, place[..., 1] + s * x + c * y, ground], axis=-1)


# --- the joints ------------------------------------------------------------------------------------
def joint_motion(
    robot: Robot, body: tuple[Array, ...], feet: Array, feet_v: Array, feet_a: Array
) -> tuple[Array, Array, Array, Array]:
    """Joint angles, rates, accelerations `(steps, legs, 3)` of a motion, and reach codes `(steps, legs)`."""
    position, velocity, acceleration, R, omega, omega_rate = body
    omega_b, omega_rate_b = (np.einsum("ij,ijk->ik", vectors, R)[:, None] for vectors in (omega, omega_rate))
    base = BaseMotion(R, velocity[:, None], omega_b, acceleration[:, None], omega_rate_b)
    feet_b = (feet - position[:, None]) @ R
    relative = velocity_from_base(base, feet_b, feet_v)
    return joints_of(robot.packed, feet_b, relative, acceleration_from_base(base, feet_b, relative, feet_a))


def distances(robot: Robot, body: tuple[Array, ...], feet: Array, codes: Array) -> Array:
    """How far from its hip each foot is that cannot be reached [m]; −∞ for the others."""
    position, rotation = body[0], body[3]
    hips = position[:, None] + np.einsum("nij,lj->nli", rotation, robot.hip)
    return np.where(codes == REACHED, -np.inf, np.linalg.norm(feet - hips, axis=2))


def out_of_reach(robot: Robot, gait: Gait, body: tuple[Array, ...], feet: Array, badness: Array) -> WrongUse:
    """Which leg cannot do it, when, and by how much: the one with the largest `badness` `(steps, legs)`."""
    position, rotation = body[0], body[3]
    i, leg = np.unravel_index(np.argmax(badness), badness.shape)
    told = reach(robot, (feet[i] - position[i]) @ rotation[i])[leg]
    return WrongUse(
        f"{robot.name} cannot walk {gait.name!r} this way: at phase {i / len(feet):.3f}, {told.sentence}"
    )
