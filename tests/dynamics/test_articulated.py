"""Direct dynamics of hinge legs: two foreign engines accelerate alike, and inverse dynamics undoes it."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from forward_oracles import ALL, any_sensed, by_mujoco, by_pinocchio, robot_of, unlikeness
from gaitwright.dynamics.articulated import accelerations, contact_arms, direct_dynamics
from gaitwright.dynamics.newton_euler import inverse_dynamics
from gaitwright.numerics.geometry import GRAVITY, rotation
from oracles import NEEDS_PINOCCHIO

SEEDS = st.integers(0, 2**32 - 1)
UP = np.array([0.0, 0.0, 1.0])


def pushed(robot, rng):
    """Torques and wrenches of the size that the robot's weight asks for."""
    weight, arm = robot.total_mass * GRAVITY, robot.leg_length
    torques = weight * arm * rng.normal(size=(robot.n, 3))
    pushes = weight * rng.normal(size=(robot.n, 6)) * np.repeat([1.0, arm], 3)
    return torques, pushes, weight * rng.normal(size=6) * np.repeat([1.0, arm], 3)


@NEEDS_PINOCCHIO
@given(st.sampled_from(ALL), SEEDS)
@settings(max_examples=200)
def test_pinocchio_accelerates_alike(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    tau, push, wrench = pushed(robot, rng)
    arm = contact_arms(robot, s, UP)
    ours = accelerations(robot, s, tau, arm, push, wrench)
    assert unlikeness(ours, by_pinocchio(robot, s, tau, arm, push, wrench)) < 1e-10


@given(st.sampled_from(ALL), SEEDS)
@settings(max_examples=200)
def test_mujoco_accelerates_alike(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    tau, push, _ = pushed(robot, rng)
    push[:, 3:] = 0.0
    arm = contact_arms(robot, s, UP)
    ours = accelerations(robot, s, tau, arm, push)
    assert unlikeness(ours, by_mujoco(robot, s, tau, arm, push[:, :3])) < 1e-10


@given(st.sampled_from(ALL), SEEDS)
def test_inverse_dynamics_undoes_it(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, wanted = any_sensed(robot, rng)
    w, wd, a = (tuple(x) for x in (s.angular_velocity_b, wanted.angular_b, wanted.linear_w))
    force, moment, tau = inverse_dynamics(robot.arrays, w, wd, a, s.q, s.qd, wanted.qdd)
    no = np.zeros((robot.n, 6))
    got_wd, got_a, got = direct_dynamics(robot.packed, w, s.q, s.qd, tau, no[:, :3], no, (force, moment))
    for mine, asked in ((got_wd, wd), (got_a, a), (got, wanted.qdd)):
        np.testing.assert_allclose(mine, asked, rtol=0, atol=1e-10 * np.abs(asked).max())


@given(st.sampled_from(ALL), SEEDS)
def test_what_nothing_holds_falls(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    s.angular_velocity_b[:], s.qd[:] = 0.0, 0.0
    none = np.zeros((robot.n, 6))
    fall = accelerations(robot, s, none[:, :3], none[:, :3], none)
    np.testing.assert_array_equal(fall.linear_w, [0.0, 0.0, -GRAVITY])
    assert not fall.angular_b.any() and not fall.qdd.any()


@given(st.sampled_from(ALL), SEEDS)
def test_the_ground_touches_a_foot_on_its_sole(name: str, seed: int) -> None:
    """The contact point is a foot's radius below the centre, along the normal."""
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    at_sole = contact_arms(robot, s, normal)
    opposite = contact_arms(robot, s, -normal)
    np.testing.assert_allclose((opposite - at_sole) @ normal, 2 * robot.foot_radius, atol=1e-12)
    hips = robot.hip @ rotation(s.orientation_wb).T
    reach = np.linalg.norm(robot.offset, axis=2).sum(axis=1) + robot.foot_radius
    assert (np.linalg.norm(at_sole - hips, axis=1) <= reach * (1 + 1e-12)).all()
