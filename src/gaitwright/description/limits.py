"""What motors give: torque limits out of a model and velocity limits out of its file, placeholders told."""

import math
from collections.abc import Mapping

import mujoco
import numpy as np
from jaxtyping import Bool, Float

from gaitwright.model.nominal_pose import LegShape
from gaitwright.numerics.geometry import GRAVITY

NO_LIMIT = 10.0
"""A torque beyond this times the weight times the length of a leg limits nothing."""
NO_RATE = 20.0
"""A rate beyond this times √(g / length of a leg) limits nothing: 100 rad/s for a leg of 0.4 m."""


def torque_limit(m: mujoco.MjModel, joint: int) -> float:
    """Torque limit of one joint [N·m], by its actuators and by itself; NaN where neither says."""
    bounds = [
        joint_bound(m, joint),
        max(filter(None, (actuator_bound(m, a) for a in drives(m, joint))), default=0.0),
    ]
    given = [bound for bound in bounds if bound > 0.0]
    return min(given, default=math.nan)


def drives(m: mujoco.MjModel, joint: int) -> list[int]:
    """Actuators that pull at the joint."""
    on_joint = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    return [a for a in range(m.nu) if m.actuator_trntype[a] in on_joint and m.actuator_trnid[a, 0] == joint]


def joint_bound(m: mujoco.MjModel, joint: int) -> float:
    """The joint's own limit of actuator torque [N·m], as URDF's `effort`; 0 where there is none."""
    return both_ways(m.jnt_actfrcrange[joint]) if m.jnt_actfrclimited[joint] else 0.0


def actuator_bound(m: mujoco.MjModel, a: int) -> float:
    """What one actuator can do at its joint [N·m], by its force range and, if a motor, its control range."""
    gear = abs(float(m.actuator_gear[a, 0]))
    bounds = []
    if m.actuator_forcelimited[a]:
        bounds.append(gear * both_ways(m.actuator_forcerange[a]))
    is_motor = m.actuator_gaintype[a] == mujoco.mjtGain.mjGAIN_FIXED and not m.actuator_biastype[a]
    if m.actuator_ctrllimited[a] and is_motor:
        bounds.append(gear * abs(float(m.actuator_gainprm[a, 0])) * both_ways(m.actuator_ctrlrange[a]))
    return min((bound for bound in bounds if bound > 0.0), default=0.0)


def both_ways(limits: np.ndarray) -> float:
    """What a range allows in both directions."""
    return max(0.0, min(-float(limits[0]), float(limits[1])))


def with_torque_limits(
    names: tuple[str, ...], shapes: list[LegShape], tau_max: np.ndarray, total: float, resisting: np.ndarray
):
    """Torque limits without gaps and placeholders, and sentences where there were some.

    `total` is the robot's mass [kg], `resisting` what joints resist by themselves [N·m]. A joint without a
    limit gets that and the torque that carries the whole weight on two legs, with a lever of half a leg.
    """
    lengths = np.array([shape.stretched for shape in shapes])
    derived = np.tile(0.25 * total * GRAVITY * lengths[:, None], 3) + resisting
    bound = NO_LIMIT * total * GRAVITY * lengths[:, None]
    missing, beyond = np.isnan(tau_max), tau_max > bound
    notes = []
    if missing.any():
        what = f"no torque limit is given for {missing.sum()} joints (legs {where(names, missing)})"
        notes.append(f"{what}: {taken(derived[missing], resisting[missing])}")
    if beyond.any():
        what = (
            f"the torque limit of {tau_max[beyond].max():g} N·m at {beyond.sum()} joints "
            f"(legs {where(names, beyond)}) is beyond {NO_LIMIT:g} × weight × leg length, which is no limit"
        )
        notes.append(f"{what}: {taken(derived[beyond], resisting[beyond])}")
    return np.where(missing | beyond, derived, tau_max), tuple(notes)


def resisted(
    shapes: list[LegShape], damping: np.ndarray, friction: np.ndarray
) -> Float[np.ndarray, "legs 3"]:
    """What joints resist by friction and, at √(g / length of a leg), by damping [N·m]."""
    rate = np.sqrt(GRAVITY / np.array([shape.stretched for shape in shapes]))
    return friction + damping * rate[:, None]


def where(names: tuple[str, ...], joints: Bool[np.ndarray, "legs 3"]) -> str:
    """The legs that have one of these joints."""
    return ", ".join(name for name, row in zip(names, joints, strict=True) if row.any())


def taken(derived: np.ndarray, resisting: np.ndarray) -> str:
    """What stands for missing limits."""
    beside = " and moves the joints against what they resist" if resisting.any() else ""
    return (
        f"taken as {derived.max():.1f} N·m, which carries the weight on two legs with a lever of half a leg"
        f"{beside}"
    )


def rate_limits(
    m: mujoco.MjModel, joints: np.ndarray, shapes: list[LegShape], rates: Mapping[str, float]
) -> tuple[Float[np.ndarray, "legs 3"] | None, tuple[str, ...]]:
    """Velocity limits by leg and joint [rad/s], 0 where there is none, and a sentence about placeholders.

    `joints` `(legs, 3)`; `None` where no limit is given at all.
    """
    given = np.array([[rates.get(m.joint(int(j)).name, 0.0) for j in row] for row in joints])
    bound = NO_RATE * math.sqrt(GRAVITY / float(np.mean([shape.stretched for shape in shapes])))
    beyond = given > bound
    limits = np.where(beyond, 0.0, given)
    note = (
        f"the velocity limit of {given.max():g} rad/s at {beyond.sum()} joints is beyond {bound:.0f} rad/s, "
        f"{NO_RATE:g} × √(g / leg length): taken as none"
    )
    return limits if limits.any() else None, (note,) if beyond.any() else ()
