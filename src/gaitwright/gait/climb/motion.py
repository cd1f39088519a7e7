"""A climb as steps, one foot at a time, and the motion they make: body, feet and joints over time.

A step has two parts. First all feet stand and the body shifts; then it keeps still and one foot swings: up,
over, down. Body and foot move along `eased`, so that they rest at either end.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.model.leg_motion import joints_of
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import from_roll_pitch_yaw

SHIFT = 0.4
"""Share of a step in which the body shifts."""
RISE, CROSS = (0.0, 0.45), (0.25, 0.75)
"""Parts of the swing in which the foot goes up and across; it comes down in the mirrored part of `RISE`."""

BodyPose = Float[np.ndarray, "5"]
"""x, y, z [m] of the base origin, roll and pitch [rad]; yaw is 0."""


@dataclass(frozen=True)
class ClimbStep:
    """One foot from a foothold to the next, and where the body is for it."""

    leg: int
    feet_w: Float[np.ndarray, "legs 3"]
    """Foot centres before the step, world [m]."""
    landing_w: Float[np.ndarray, "3"]
    """Where the centre of the foot comes down."""
    apex: float
    """Height over which the foot is carried across [m]."""
    before: BodyPose
    body: BodyPose
    """The body before the step and while the foot swings."""


@dataclass(frozen=True)
class Motion:
    """Body, feet and joints at some moments."""

    time: Float[np.ndarray, "n"]
    position_w: Float[np.ndarray, "n 3"]
    rotation_wb: Float[np.ndarray, "n 3 3"]
    feet_w: Float[np.ndarray, "n legs 3"]
    q: Float[np.ndarray, "n legs 3"]
    stance: Bool[np.ndarray, "n legs"]
    codes: Int[np.ndarray, "n legs"]
    """Reach codes of `model.kinematics`."""


def motion(
    robot: Robot, steps: tuple[ClimbStep, ...], seconds: float, time: Float[np.ndarray, "n"]
) -> Motion:
    """The motion that steps of `seconds` each make, at times from the start [s]; after the last it stands."""
    number = np.clip((time / seconds).astype(int), 0, len(steps) - 1)
    share = np.clip(time / seconds - number, 0.0, 1.0)
    first = int(number.min())
    steps, number = steps[first : int(number.max()) + 1], number - first
    shift = eased(share, 0.0, SHIFT)[:, None]
    before, after = (np.array([getattr(step, name) for step in steps])[number] for name in ("before", "body"))
    pose = before + (after - before) * shift
    feet, stance = feet_motion(steps, number, share)
    R = from_roll_pitch_yaw(np.pad(pose[:, 3:], ((0, 0), (0, 1))))
    feet_b = (feet - pose[:, None, :3]) @ R
    still = np.zeros_like(feet_b)
    q, _, _, codes = joints_of(robot.packed, feet_b, still, still)
    return Motion(time, pose[:, :3], R, feet, q, stance, codes)


def feet_motion(
    steps: tuple[ClimbStep, ...], number: Int[np.ndarray, "n"], share: Float[np.ndarray, "n"]
) -> tuple[Float[np.ndarray, "n legs 3"], Bool[np.ndarray, "n legs"]]:
    """Foot centres, and which feet stand, at a `share` of step `number`."""
    feet = np.array([step.feet_w for step in steps])[number]
    leg = np.array([step.leg for step in steps])[number]
    landing = np.array([step.landing_w for step in steps])[number]
    apex = np.array([step.apex for step in steps])[number]
    rows = np.arange(len(number))
    origin = feet[rows, leg]
    s = np.clip((share - SHIFT) / (1.0 - SHIFT), 0.0, 1.0)
    place = origin + (landing - origin) * eased(s, *CROSS)[:, None]
    up, down = eased(s, *RISE), eased(s, 1.0 - RISE[1], 1.0 - RISE[0])
    place[:, 2] = origin[:, 2] + (apex - origin[:, 2]) * up + (landing[:, 2] - apex) * down
    feet[rows, leg] = place
    stance = np.ones(feet.shape[:2], dtype=bool)
    stance[rows, leg] = (s <= 0.0) | (s >= 1.0)
    return feet, stance


def eased(x: Float[np.ndarray, "n"], start: float, end: float) -> Float[np.ndarray, "n"]:
    """10s³ − 15s⁴ + 6s⁵ from 0 at `start` to 1 at `end`, constant outside: at rest at both."""
    s = np.clip((x - start) / (end - start), 0.0, 1.0)
    return s**3 * (10.0 + s * (6.0 * s - 15.0))
