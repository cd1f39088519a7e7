"""Time-warped torques: a motion played faster, slower or unevenly (rows L9, N1; equations.md §7).

Hollerbach's scaling, with gravity split off. A motion θ(r) is played as θ(r(t)); with ṙ, r̈ the rates of r

    τ̃(t) = g(θ) + ṙ² (τ(r) − g(θ)) + r̈ H(θ) θ′(r)

since inertia and centrifugal forces grow with ṙ², weight does not, and uneven playing asks for momentum.
`force` may hold the torques of legs on a base that rests or moves uniformly (`leg_profile`), or wrench on
the base and torques of a floating robot (`free_profile`).

What is *not* preserved: friction in joints and at feet, unilateral contacts, torque limits. A warped
profile that rests on foot forces must be checked against the friction cone and the limits again.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.articulated import Accelerations
from gaitwright.dynamics.newton_euler import dynamics_of, state_numbers
from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import Sensed


@dataclass(frozen=True, slots=True)
class Profile:
    """Generalised forces along a motion, sampled, with the two parts that a warp needs."""

    time: Float[np.ndarray, "samples"]
    """Increasing [s]."""
    force: Float[np.ndarray, "samples rows"]
    """Forces that the motion asks for [N, N·m]."""
    gravity: Float[np.ndarray, "samples rows"]
    """The part of them that holds the weight: the same pose at rest [N, N·m]."""
    momentum: Float[np.ndarray, "samples rows"]
    """H θ′: generalised momentum [N·s, N·m·s]."""


def warped_torques(
    tau: Float[np.ndarray, "*samples rows"],
    gravity: Float[np.ndarray, "*samples rows"],
    momentum: Float[np.ndarray, "*samples rows"],
    rate: Float[np.ndarray, "*samples"] | float,
    rate_change: Float[np.ndarray, "*samples"] | float = 0.0,
) -> Float[np.ndarray, "*samples rows"]:
    """Torques of the motion played at `rate` ṙ and `rate_change` r̈ [1/s], sample by sample."""
    r, rr = np.asarray(rate)[..., None], np.asarray(rate_change)[..., None]
    return gravity + r * r * (tau - gravity) + rr * momentum


def at_speed(profile: Profile, speed: float) -> Profile:
    """The profile of the motion played `speed` times as fast: r = speed · t, exact at every sample.

    Raises `WrongUse` for a speed that is not positive and finite.
    """
    if not 0.0 < speed < np.inf:
        raise WrongUse(f"a profile can be played at a positive speed, not at {speed:g}")
    force = warped_torques(profile.force, profile.gravity, profile.momentum, speed)
    return Profile(profile.time / speed, force, profile.gravity, speed * profile.momentum)


def warped(
    profile: Profile,
    time: Float[np.ndarray, "instants"],
    moment: Float[np.ndarray, "instants"],
    rate: Float[np.ndarray, "instants"],
    rate_change: Float[np.ndarray, "instants"],
) -> Profile:
    """The profile of the motion that at each `time` is at `moment` r(t) of this one.

    `rate` ṙ, `rate_change` r̈ [1/s]. The parts are interpolated linearly between the samples, so warp at
    the sampled moments for exact forces. Raises `WrongUse` for a moment outside the profile, and for a
    number that is not finite.
    """
    start, end = profile.time[0], profile.time[-1]
    for what, values in (("time", time), ("moment", moment), ("rate", rate), ("change of rate", rate_change)):
        if not np.isfinite(values).all():
            raise WrongUse(f"{what} {values[~np.isfinite(values)][0]} asked of a profile: it is not finite")
    outside = moment[(moment < start) | (moment > end)]
    if outside.size:
        raise WrongUse(f"moment {outside[0]:g} s asked of a profile from {start:g} s to {end:g} s")
    force, gravity, momentum = (
        sampled(profile.time, part, moment) for part in (profile.force, profile.gravity, profile.momentum)
    )
    force = warped_torques(force, gravity, momentum, rate, rate_change)
    return Profile(time, force, gravity, rate[:, None] * momentum)


def sampled(
    time: Float[np.ndarray, "samples"],
    values: Float[np.ndarray, "samples rows"],
    at: Float[np.ndarray, "instants"],
) -> Float[np.ndarray, "instants rows"]:
    """Values between samples, linearly, row by row."""
    return np.stack([np.interp(at, time, row) for row in values.T], axis=1)


# --- profiles of motions -------------------------------------------------------------------------
def generalised(robot: Robot, w, wd, a, q, qd, qdd) -> Float[np.ndarray, "rows"]:
    """Wrench on the base and torques, base axes, in one row; arguments as `state_numbers`."""
    return dynamics_of(robot.packed, state_numbers(w, wd, a, q, qd, qdd))[: 6 + 3 * robot.n]


def parts(robot: Robot, s: Sensed, wanted: Accelerations) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Force, gravity part and momentum of one moment of a motion, each wrench and torques."""
    R = rotation(s.orientation_wb)
    up, still, joints = R.T @ [0.0, 0.0, GRAVITY], np.zeros(3), np.zeros((robot.n, 3))
    a, w = R.T @ wanted.linear_w, s.angular_velocity_b
    force = generalised(robot, w, wanted.angular_b, a + up, s.q, s.qd, wanted.qdd)
    gravity = generalised(robot, still, still, up, s.q, joints, joints)
    # Momentum is what it takes to get from rest to these velocities in a second, without weight.
    momentum = generalised(robot, still, w, R.T @ s.velocity_w, s.q, joints, s.qd)
    return force, gravity, momentum


def free_profile(robot: Robot, sensed: Sequence[Sensed], wanted: Sequence[Accelerations]) -> Profile:
    """The profile of a floating robot's motion: rows are the wrench about the base origin (base axes), then
    the torques leg by leg. A warp takes base and joints along alike."""
    force, gravity, momentum = zip(
        *(parts(robot, s, a) for s, a in zip(sensed, wanted, strict=True)), strict=True
    )
    return Profile(np.array([s.time for s in sensed]), np.array(force), np.array(gravity), np.array(momentum))


def leg_profile(robot: Robot, sensed: Sequence[Sensed], qdd: Float[np.ndarray, "samples legs 3"]) -> Profile:
    """The profile of legs on a base that rests or moves uniformly: rows are the torques, leg by leg.

    A warp leaves the base as it is. Raises `WrongUse` for a base that turns or changes its velocity.
    """
    first, still = sensed[0], np.zeros(3)
    for s in sensed:
        if s.angular_velocity_b.any() or not np.allclose(s.velocity_w, first.velocity_w, rtol=1e-9):
            raise WrongUse(f"the base turns or changes its velocity at {s.time:g} s; use free_profile")
    resting = [resting_on(s) for s in sensed]
    whole = free_profile(robot, resting, [Accelerations(still, still, joints) for joints in qdd])
    return Profile(whole.time, whole.force[:, 6:], whole.gravity[:, 6:], whole.momentum[:, 6:])


def resting_on(s: Sensed) -> Sensed:
    """The same seen from a base that moves uniformly: mechanics does not know the difference."""
    still = np.zeros(3)
    return Sensed(s.time, s.position_w, s.orientation_wb, still, still, s.q, s.qd, s.load)
