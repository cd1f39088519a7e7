"""Warped profiles are those of the warped motion: inverse dynamics of it, computed anew, says so."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from forward_oracles import ALL, robot_of
from gaitwright.dynamics.articulated import Accelerations
from gaitwright.dynamics.time_warp import at_speed, free_profile, leg_profile, warped, warped_torques
from gaitwright.errors import WrongUse
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.signals import Sensed

SEEDS = st.integers(0, 2**32 - 1)
MOMENTS = np.linspace(0.1, 1.3, 9)

Jet = tuple[np.ndarray, np.ndarray, np.ndarray]
"""A value with its first and second derivative."""


def any_path(rng: np.random.Generator, size: int, most: float) -> Callable[[float], Jet]:
    """A smooth path of `size` numbers within about `most`."""
    high, pace, start = most * rng.uniform(-1, 1, size), rng.uniform(1, 4, size), rng.uniform(0, 6, size)

    def at(r: float) -> Jet:
        x = pace * r + start
        return high * np.sin(x), high * pace * np.cos(x), -high * pace**2 * np.sin(x)

    return at


def played(jet: Jet, rate: float, change: float) -> Jet:
    """The path with its moment running at `rate`, by the chain rule."""
    value, slope, bend = jet
    return value, rate * slope, rate**2 * bend + change * slope


def turning(jet: Jet) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rotation, angular velocity and acceleration (base axes) of moving roll, pitch, yaw (eq. 3-1, 3-2)."""
    angles, rates, changes = jet
    (cx, cy, cz), (sx, sy, sz) = np.cos(angles), np.sin(angles)
    R = np.array(
        [
            [cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz],
            [cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz],
            [-sy, sx * cy, cx * cy],
        ]
    )
    E = np.array([[1.0, 0.0, -sy], [0.0, cx, sx * cy], [0.0, -sx, cx * cy]])
    dx, dy, _ = rates
    Ed = np.array(
        [
            [0.0, 0.0, -cy * dy],
            [0.0, -sx * dx, cx * cy * dx - sx * sy * dy],
            [0.0, -cx * dx, -sx * cy * dx - cx * sy * dy],
        ]
    )
    return R, E @ rates, E @ changes + Ed @ rates


def moment_of(time: float, place: Jet, pose: Jet, joints: Jet, n: int) -> tuple[Sensed, Accelerations]:
    """The state and its accelerations."""
    R, w, wd = turning(pose)
    q, qd, qdd = (x.reshape(n, 3) for x in joints)
    s = Sensed(time, place[0], quaternion_of(R), place[1], w, q, qd, np.zeros(n))
    return s, Accelerations(place[2], wd, qdd)


def timing(rng: np.random.Generator) -> Callable[[np.ndarray], Jet]:
    """A moment r(t) that runs on unevenly, fast or slow."""
    pace, swing = rng.uniform(0.3, 3.0), rng.uniform(0.0, 0.9)
    return lambda t: (
        pace * (t + swing * np.sin(t)),
        pace * (1.0 + swing * np.cos(t)),
        -pace * swing * np.sin(t),
    )


def both(robot, rng, base_moves: bool, t: np.ndarray):
    """The moments of a motion and of the same motion played at r(t), and r(t)."""
    place, pose = any_path(rng, 3, 0.5 * base_moves), any_path(rng, 3, 1.0 * base_moves)
    joints, r = any_path(rng, 3 * robot.n, 1.5), timing(rng)(t)
    plain, fast = [], []
    for now, (moment, rate, change) in zip(t, zip(*r, strict=True), strict=True):
        jets = place(moment), pose(moment), joints(moment)
        plain.append(moment_of(moment, *jets, robot.n))
        fast.append(moment_of(now, *(played(jet, rate, change) for jet in jets), robot.n))
    return plain, fast, r


def assert_same(mine: np.ndarray, theirs: np.ndarray) -> None:
    """To 1e-10 of the largest."""
    np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-10 * np.abs(theirs).max())


@given(st.sampled_from(ALL), SEEDS)
def test_a_free_motion_warped(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    plain, fast, r = both(robot, rng, True, MOMENTS)
    profile = free_profile(robot, *zip(*plain, strict=True))
    anew = free_profile(robot, *zip(*fast, strict=True))
    got = warped(profile, MOMENTS, *r)
    for mine, theirs in ((got.force, anew.force), (got.gravity, anew.gravity), (got.momentum, anew.momentum)):
        assert_same(mine, theirs)


@given(st.sampled_from(ALL), SEEDS)
def test_legs_on_a_base_that_moves_uniformly(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    plain, fast, r = both(robot, rng, False, MOMENTS)
    drift = rng.normal(size=3)
    for s, _ in fast:
        s.velocity_w[:] = drift
    profile = leg_profile(robot, [s for s, _ in plain], np.stack([a.qdd for _, a in plain]))
    anew = leg_profile(robot, [s for s, _ in fast], np.stack([a.qdd for _, a in fast]))
    free = free_profile(robot, *zip(*fast, strict=True))
    assert_same(warped(profile, MOMENTS, *r).force, anew.force)
    assert_same(anew.force, free.force[:, 6:])  # and drifting costs no torque


@given(st.sampled_from(ALL), SEEDS, st.floats(0.2, 5.0))
def test_playing_twice_as_fast_and_half_as_fast_is_playing(name: str, seed: int, speed: float) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    plain, _, _ = both(robot, rng, True, MOMENTS)
    profile = free_profile(robot, *zip(*plain, strict=True))
    back = at_speed(at_speed(profile, speed), 1.0 / speed)
    scale = np.abs(profile.force).max() * max(speed, 1.0 / speed) ** 2
    np.testing.assert_allclose(back.force, profile.force, rtol=0, atol=1e-12 * scale)
    np.testing.assert_allclose(back.time, profile.time, rtol=1e-12)
    np.testing.assert_allclose(back.momentum, profile.momentum, rtol=1e-12)


@pytest.mark.parametrize("name", ALL)
def test_gravity_scaled_like_inertia_is_far_off(name: str, rng: np.random.Generator) -> None:
    """What the thesis's last formula does (5.3): it misses by more than half of the torques themselves."""
    robot = robot_of(name, rng)
    plain, _, _ = both(robot, rng, False, MOMENTS)
    profile = leg_profile(robot, [s for s, _ in plain], np.stack([a.qdd for _, a in plain]))
    slow = 0.3
    right = at_speed(profile, slow).force
    unsplit = warped_torques(profile.force, 0.0 * profile.gravity, profile.momentum, slow)
    assert np.abs(unsplit - right).max() > 0.5 * np.abs(right).max()


def test_between_samples_a_fine_profile_is_close(rng: np.random.Generator) -> None:
    robot = robot_of("go2", rng)
    place, pose, joints = any_path(rng, 3, 0.5), any_path(rng, 3, 1.0), any_path(rng, 12, 1.5)

    def at(moments: np.ndarray):
        made = [moment_of(float(m), place(m), pose(m), joints(m), 4) for m in moments]
        return free_profile(robot, *zip(*made, strict=True))

    wanted = np.linspace(0.11, 0.89, 13)
    anew = at(wanted).force
    one, none = np.ones(13), np.zeros(13)

    def error(samples: int) -> float:
        got = warped(at(np.linspace(0.0, 1.0, samples)), wanted, wanted, one, none)
        return float(np.abs(got.force - anew).max() / np.abs(anew).max())

    assert error(201) < 2e-3
    assert error(201) < 0.3 * error(51)  # quadratic in the step


def test_a_profile_says_what_it_cannot_do(rng: np.random.Generator) -> None:
    robot = robot_of("go2", rng)
    plain, _, _ = both(robot, rng, True, MOMENTS)
    profile = free_profile(robot, *zip(*plain, strict=True))
    one = np.ones(1)
    with pytest.raises(WrongUse, match="positive speed, not at -1"):
        at_speed(profile, -1.0)
    with pytest.raises(WrongUse, match="moment 99 s asked of a profile from"):
        warped(profile, one, 99.0 * one, one, one)
    with pytest.raises(WrongUse, match="moment nan asked of a profile: it is not finite"):
        warped(profile, one, np.nan * one, one, one)
    with pytest.raises(WrongUse, match="use free_profile"):
        leg_profile(robot, [s for s, _ in plain], np.stack([a.qdd for _, a in plain]))
