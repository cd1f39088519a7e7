"""The maps of closed chains: two ways agree, and torques from them produce the motion they were made for."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from forward_oracles import ALL, any_sensed, by_pinocchio, robot_of, unlikeness
from gaitwright.dynamics.articulated import accelerations, contact_arms
from gaitwright.dynamics.closed_chain import (
    about,
    closed_chain,
    imbalance,
    joint_torques,
    least_wrenches,
    planted_rates,
    reuse_error,
    reuse_errors,
)
from gaitwright.dynamics.newton_euler import joint_accelerations
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles, feet
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import Sensed
from oracles import NEEDS_PINOCCHIO, robot_called

SEEDS = st.integers(0, 2**32 - 1)
UP = np.array([0.0, 0.0, 1.0])


def any_case(name: str, seed: int):
    """A robot, its state, a wanted motion, some feet down (one at least) and a ground normal."""
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, wanted = any_sensed(robot, rng)
    stance = rng.random(robot.n) < 0.6
    stance[rng.integers(robot.n)] = True
    normal = rng.normal(size=3)
    return robot, s, wanted, stance, normal / np.linalg.norm(normal)


def standing(name: str) -> tuple:
    """A robot in its nominal stance, moving straight on, and its diagonal feet."""
    robot = robot_called(name)
    q, _ = angles(robot, robot.nominal_feet)
    joints, still = np.zeros((robot.n, 3)), np.zeros(3)
    velocity = np.array([0.3, 0.1, 0.0])
    s = Sensed(0.0, robot.height * UP, np.array([1.0, 0, 0, 0]), velocity, still, q, joints, np.ones(robot.n))
    return robot, s, np.arange(robot.n) % 3 < 2


@given(st.sampled_from(ALL), SEEDS)
def test_probing_and_jacobians_agree(name: str, seed: int) -> None:
    case = any_case(name, seed)
    probed, closed = closed_chain(*case, method="probing"), closed_chain(*case, method="jacobians")
    load = max(np.abs(closed.B).max(), np.abs(closed.D).max(), 1.0)  # probing subtracts numbers of this size
    for mine, theirs in zip(probed, closed, strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-12 * max(load, np.abs(theirs).max()))


@given(st.sampled_from(ALL), SEEDS)
def test_probing_agrees_where_nothing_is_subtracted(name: str, seed: int) -> None:
    """Without motion and weight a probe is the map itself: both ways agree to 1e-12 of each."""
    robot, s, wanted, stance, normal = any_case(name, seed)
    s = replace(s, angular_velocity_b=np.zeros(3), qd=0.0 * s.qd)
    fall = replace(wanted, linear_w=-GRAVITY * UP, angular_b=np.zeros(3), qdd=0.0 * s.qd)
    probed = closed_chain(robot, s, fall, stance, normal, "probing")
    closed = closed_chain(robot, s, fall, stance, normal, "jacobians")
    for mine, theirs in zip(probed, closed, strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max())


@NEEDS_PINOCCHIO
@given(st.sampled_from(ALL), SEEDS, st.sampled_from(["jacobians", "probing"]))
@settings(max_examples=60)
def test_torques_from_the_maps_produce_the_motion(name: str, seed: int, method) -> None:
    robot, s, wanted, stance, normal = any_case(name, seed)
    chain = closed_chain(robot, s, wanted, stance, normal, method)
    w = least_wrenches(chain)
    tau, arm = joint_torques(chain, w), contact_arms(robot, s, normal)
    assert unlikeness(accelerations(robot, s, tau, arm, w), wanted) < 1e-10
    assert unlikeness(by_pinocchio(robot, s, tau, arm, w, np.zeros(6)), wanted) < 1e-10


@given(st.sampled_from(ALL), SEEDS)
def test_least_wrenches_balance_the_base_and_spare_feet_in_the_air(name: str, seed: int) -> None:
    case = any_case(name, seed)
    chain, stance = closed_chain(*case), case[3]
    w = least_wrenches(chain)
    assert np.abs(imbalance(chain, w)).max() < 1e-10 * max(np.abs(chain.own).max(), np.abs(chain.B).max())
    np.testing.assert_allclose(w[~stance], 0.0, atol=1e-12 * np.abs(w).max())
    assert not chain.A[~stance].any() and not chain.C[~stance].any()


@given(st.sampled_from(ALL), SEEDS)
def test_the_thesis_counts_moments_about_the_centre_of_mass(name: str, seed: int) -> None:
    """About it, the base's own wrench is m(a − g) and I ω̇ + ω × I ω (eq. 4-23); the torques stay."""
    robot, s, wanted, stance, normal = any_case(name, seed)
    R, w, wd = rotation(s.orientation_wb), s.angular_velocity_b, wanted.angular_b
    chain = closed_chain(robot, s, wanted, stance, normal)
    centre = robot.base_com
    theirs = about(chain, R @ centre)
    a = wanted.linear_w + R @ (np.cross(wd, centre) + np.cross(w, np.cross(w, centre))) + GRAVITY * UP
    turning = R @ (robot.base_inertia @ wd + np.cross(w, robot.base_inertia @ w))
    own = np.concatenate([robot.base_mass * a, turning])
    np.testing.assert_allclose(theirs.own, own, rtol=0, atol=1e-11 * np.abs(chain.own).max())
    k = int(np.flatnonzero(stance)[0])
    x, y, z = contact_arms(robot, s, normal)[k] - R @ centre
    arm = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    np.testing.assert_allclose(theirs.A[k, 3:, :3], arm, atol=1e-12)
    w = least_wrenches(chain)
    size = max(np.abs(chain.own).max(), np.abs(chain.B).max())
    np.testing.assert_allclose(imbalance(theirs, w), 0.0, atol=1e-9 * size)


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_planted_feet_stay_where_they_are(name: str, rng: np.random.Generator) -> None:
    """Their paths below a moving base, by finite differences of the feet."""
    robot, s, _ = standing(name)
    v, a, dt = rng.normal(0.0, 0.3, 3), rng.normal(0.0, 1.0, 3), 1e-4
    none = (0.0, 0.0, 0.0)
    qd = planted_rates(robot.packed, s.q, tuple(v))
    qdd = joint_accelerations(robot.packed, none, none, tuple(a), s.q, qd, np.zeros_like(qd))

    def in_world(t: float) -> np.ndarray:
        return feet(robot, s.q + t * qd + 0.5 * t * t * qdd) + t * v + 0.5 * t * t * a

    ahead, here, behind = in_world(dt), in_world(0.0), in_world(-dt)
    np.testing.assert_allclose((ahead - behind) / (2 * dt), 0.0, atol=1e-6)
    np.testing.assert_allclose((ahead - 2 * here + behind) / dt**2, 0.0, atol=1e-4)


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_reused_maps_get_worse_with_the_distance(name: str) -> None:
    robot, s, stance = standing(name)
    distances = robot.height * np.array([0.0, 1e-4, 1e-3, 1e-2, 0.1])
    errors = reuse_errors(robot, s, stance, distances)
    assert errors[0] == 0.0
    assert (np.diff(errors) > 0.0).all()
    assert errors[1] < 2e-3 and errors[3] == pytest.approx(10 * errors[2], rel=0.3)


def test_reuse_is_free_where_nothing_changed(rng: np.random.Generator) -> None:
    robot, s, stance = standing("go2")
    _, wanted = any_sensed(robot, rng)
    one = closed_chain(robot, s, wanted, stance, UP)
    further = closed_chain(robot, replace(s, position_w=s.position_w + 1.0), wanted, stance, UP)
    assert reuse_error(one, further) == 0.0


def test_straight_motion_says_why_it_cannot_go_on() -> None:
    robot, s, stance = standing("go2")
    with pytest.raises(WrongUse, match="FL does not reach its foothold after 3 m"):
        reuse_errors(robot, s, stance, np.array([3.0]))
    with pytest.raises(WrongUse, match="no direction"):
        reuse_errors(robot, replace(s, velocity_w=np.zeros(3)), stance, np.array([0.1]))
