"""Joints are pulled to where their feet should be, kept off their stops, helped against their friction."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_numerical import anything, hold, moving, standing

from gaitwright.control.impedance import CREEP, FAST, MOST, STANCE, SWING, steering
from gaitwright.control.joint_stops import BRAKING, FIRM, MARGIN, braking, fastest, room
from gaitwright.control.moments import moment_of, row
from gaitwright.control.numerical import NumericalController
from gaitwright.dynamics.checks import mass_matrix
from gaitwright.dynamics.joint_inertia import joint_inertias
from gaitwright.model.kinematics import feet
from gaitwright.model.leg import leg_at, leg_turns
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import MotionTarget, Sensed
from oracles import robot_called

NAMES = ["go2", "thesis", "hexapod", "dog"]
SEEDS = st.integers(0, 10_000)


def at_its_target(robot: Robot, s: Sensed, stance: np.ndarray) -> MotionTarget:
    """A target that asks for what is: the body as it is and moves, the feet in the air as they go."""
    R, joints = rotation(s.orientation_wb), feet(robot, s.q)
    tiny = 1e-6
    rates = (feet(robot, s.q + tiny * s.qd) - feet(robot, s.q - tiny * s.qd)) / (2.0 * tiny)
    omega = R @ s.angular_velocity_b
    arm = joints @ R.T
    return replace(
        hold(robot, s, stance),
        velocity_w=s.velocity_w,
        angular_velocity_w=omega,
        feet_w=s.position_w + arm,
        feet_velocity_w=s.velocity_w + np.cross(omega, arm) + rates @ R.T,
    )


def torques_of(robot: Robot, s: Sensed, target: MotionTarget) -> np.ndarray:
    return steering(robot.packed, moment_of(row(s, target)))


def free(robot: Robot) -> Robot:
    """The same robot without friction in its joints, and with stops that it never comes near."""
    none = np.zeros((robot.n, 3))
    return replace(robot, damping=none, friction=none, q_min=none - 1e6, q_max=none + 1e6)


@pytest.mark.parametrize("name", NAMES)
@given(SEEDS)
def test_inertias_are_the_diagonal_of_the_mass_matrix(name: str, seed: int) -> None:
    robot = robot_called(name)
    q = moving(robot, np.random.default_rng(seed)).q
    mine = [joint_inertias(leg_at(robot.packed, k), leg_turns(q[k], robot.sign[k])) for k in range(robot.n)]
    expected = np.diag(mass_matrix(robot, q))[6:].reshape(-1, 3)
    np.testing.assert_allclose(np.array(mine), expected, rtol=1e-9)


@pytest.mark.parametrize("name", NAMES)
@given(SEEDS)
def test_in_the_air_on_its_way_nothing_is_pulled(name: str, seed: int) -> None:
    robot = free(robot_called(name))
    s = moving(robot, np.random.default_rng(seed))
    nobody = np.zeros(robot.n, dtype=bool)
    pull = torques_of(robot, s, at_its_target(robot, s, nobody))
    assert np.abs(pull).max() < 1e-6 * robot.total_mass * GRAVITY * robot.height


@given(SEEDS, st.integers(0, 3), st.integers(0, 2))
def test_a_joint_in_the_air_is_pulled_by_its_own_inertia(seed: int, leg: int, joint: int) -> None:
    """A foot asked for where one joint, turned by a little, would take it: that joint alone is pulled."""
    robot = free(robot_called("dog"))
    s = moving(robot, np.random.default_rng(seed))
    target = at_its_target(robot, s, np.zeros(4, dtype=bool))
    turned, little = s.q.copy(), 1e-5
    turned[leg, joint] += little
    place = s.position_w + feet(robot, turned) @ rotation(s.orientation_wb).T
    pull = torques_of(robot, s, replace(target, feet_w=place)) / little
    inertia = np.diag(mass_matrix(robot, s.q))[6:].reshape(-1, 3)[leg, joint]
    expected = np.zeros((4, 3))
    expected[leg, joint] = SWING[0] * robot.natural_frequency**2 * inertia
    np.testing.assert_allclose(pull, expected, atol=0.02 * expected.max())


def test_a_leg_that_is_down_pushes_a_body_that_sank_up() -> None:
    """A body a little low, its feet where they are: the work of the pull lifts it, as `STANCE` says."""
    robot = robot_called("dog")
    s, low = standing(robot), 1e-4
    target = replace(hold(robot, s), position_w=s.position_w + np.array([0.0, 0.0, low]))
    pull = torques_of(robot, s, target)
    deeper = feet(robot, s.q + 1e-6 * pull) - feet(robot, s.q)
    assert (deeper[:, 2] < 0.0).all()
    stiffness = STANCE[0] * robot.total_mass * GRAVITY * robot.height
    assert np.abs(pull).max() < stiffness * MOST and np.abs(pull).max() > 0.1 * stiffness * low / robot.height


@given(SEEDS)
def test_far_off_it_pulls_no_harder_than_for_the_most(seed: int) -> None:
    robot, rng = free(robot_called("dog")), np.random.default_rng(seed)
    s = moving(robot, rng)
    s = replace(
        s, velocity_w=0.0 * s.velocity_w, angular_velocity_b=0.0 * s.angular_velocity_b, qd=0.0 * s.qd
    )
    target = anything(robot, s, np.zeros(4, dtype=bool), rng, much=2.0)
    target = replace(target, feet_velocity_w=0.0 * target.feet_velocity_w)
    inertia = np.diag(mass_matrix(robot, s.q))[6:].reshape(-1, 3)
    most = SWING[0] * robot.natural_frequency**2 * inertia * MOST
    assert (np.abs(torques_of(robot, s, target)) <= most * (1.0 + 1e-9)).all()


@given(SEEDS)
def test_what_joints_resist_is_given_at_the_rates_asked_for(seed: int) -> None:
    """Damping in full; dry friction from `CREEP` on, and less of it below."""
    robot = free(robot_called("dog"))
    tough = replace(robot, damping=np.full((4, 3), 0.5), friction=np.full((4, 3), 0.2))
    rng = np.random.default_rng(seed)
    s = moving(robot, rng)
    nobody = np.zeros(4, dtype=bool)
    more = torques_of(tough, s, at_its_target(robot, s, nobody)) - torques_of(
        robot, s, at_its_target(robot, s, nobody)
    )
    asked = np.clip(s.qd, -FAST, FAST)
    np.testing.assert_allclose(more, 0.5 * asked + 0.2 * np.clip(asked / CREEP, -1.0, 1.0), atol=1e-5)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_joint_is_not_pulled_over_its_stop(side: float) -> None:
    """Near a stop, asked for what lies beyond it, a joint at rest is pulled no farther than the margin."""
    robot = free(robot_called("dog"))
    s = standing(robot)
    beyond = s.q.copy()
    beyond[:, 2] += side * 0.5
    feet_w = s.position_w + feet(robot, beyond) @ rotation(s.orientation_wb).T
    target = replace(hold(robot, s, np.zeros(4, dtype=bool)), feet_w=feet_w)
    ends = {"q_max": s.q + MARGIN} if side > 0.0 else {"q_min": s.q - MARGIN}
    pulled = side * torques_of(robot, s, target)[:, 2]
    held = side * torques_of(replace(robot, **ends), s, target)[:, 2]
    assert (pulled > 1.0).all() and (np.abs(held) < 1e-9).all()


@given(SEEDS, st.floats(0.0, 0.3), st.sampled_from([1.0, -1.0]))
def test_what_is_too_fast_for_its_stop_is_braked(seed: int, way: float, side: float) -> None:
    """From the fastest rate allowed, part of the joint's torque stops it within what is left of the way."""
    robot = robot_called("dog")
    inertia, torque = 0.02, float(robot.tau_max[0, 2])
    rate = fastest(way, torque, inertia)
    assert rate**2 / (2.0 * BRAKING * torque / inertia) == pytest.approx(way, abs=1e-12)
    w0 = robot.natural_frequency
    assert braking(side * 0.99 * rate, rate, rate, inertia, w0) == 0.0
    against = braking(side * (rate + 1.0), rate, rate, inertia, w0)
    assert against == pytest.approx(-side * FIRM * w0 * inertia)
    low, high = room(-1.0, 1.0 + seed / 10_000)
    assert low == pytest.approx(-1.0 + MARGIN) and high == pytest.approx(1.0 + seed / 10_000 - MARGIN)
    assert room(0.0, 0.1) == pytest.approx((0.025, 0.075))


def test_torques_stay_within_the_limits_whatever_is_pulled() -> None:
    robot = robot_called("dog")
    for seed in range(20):
        rng = np.random.default_rng(seed)
        s = moving(robot, rng)
        stance = rng.random(4) < 0.5
        command, _ = NumericalController(robot).command(anything(robot, s, stance, rng, much=1.0), s)
        assert (np.abs(command.tau) <= robot.tau_max + 1e-9).all()
