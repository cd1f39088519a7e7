"""Our inverse dynamics is Newton's: two foreign engines compute the same wrench and torques."""

import numpy as np
import pytest

from gaitwright.dynamics.newton_euler import (
    bias_motion,
    dynamics_in,
    dynamics_of,
    foot_acceleration,
    inverse_dynamics,
    joint_accelerations,
    links_motion,
    motion_at_hip,
    solve_columns,
    state_numbers,
    with_accelerations,
)
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.leg import leg_at, leg_of, leg_turns
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from oracles import NEEDS_PINOCCHIO, State, any_state, mujoco_inverse, pinocchio_inverse, robot_called, unlike

NAMES = pytest.mark.parametrize("name", ["go2", "thesis", "hexapod", "insect"])


def ours(robot: Robot, s: State) -> tuple[np.ndarray, np.ndarray]:
    """Wrench at the base origin in base axes `(6,)` and joint torques `(legs, 3)`."""
    R = rotation(s.orientation_wb)
    a = R.T @ (s.acceleration_w + np.array([0.0, 0.0, GRAVITY]))
    w, wd = tuple(s.angular_velocity_b), tuple(s.angular_acceleration_b)
    force, moment, tau = inverse_dynamics(robot.arrays, w, wd, tuple(a), s.q, s.qd, s.qdd)
    return np.array([*force, *moment]), tau


def assert_same(robot: Robot, s: State, oracle) -> None:
    """Both give the same numbers to 1e-9 of the largest one."""
    for mine, theirs in zip(ours(robot, s), oracle(robot, s), strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())


@NAMES
@pytest.mark.parametrize("oracle", ["mujoco", pytest.param("pinocchio", marks=NEEDS_PINOCCHIO)])
def test_wrench_and_torques_are_those_of_another_engine(
    name: str, oracle: str, rng: np.random.Generator
) -> None:
    other = mujoco_inverse if oracle == "mujoco" else pinocchio_inverse
    robot = robot_called(name)
    for _ in range(10):
        assert_same(robot, any_state(robot, rng), other)
    for _ in range(10):
        stranger = unlike(robot, rng)
        assert_same(stranger, any_state(stranger, rng), other)


def at_rest(robot: Robot, rng: np.random.Generator) -> State:
    """A pose without motion."""
    s = any_state(robot, rng)
    still, joints = np.zeros(3), np.zeros((robot.n, 3))
    return State(s.position_w, s.orientation_wb, still, still, s.q, joints, still, still, joints)


@NAMES
def test_at_rest_the_base_carries_the_weight(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    s = at_rest(robot, rng)
    wrench, _ = ours(robot, s)
    weight = np.array([0.0, 0.0, robot.total_mass * GRAVITY])
    np.testing.assert_allclose(rotation(s.orientation_wb) @ wrench[:3], weight, atol=1e-12 * weight[2])


@NAMES
def test_a_free_fall_needs_no_force(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    zero, joints = (0.0, 0.0, 0.0), np.zeros((robot.n, 3))
    q = rng.uniform(-2, 2, (robot.n, 3))
    force, moment, tau = inverse_dynamics(robot.arrays, zero, zero, zero, q, joints, joints)
    assert force == zero and moment == zero
    np.testing.assert_array_equal(tau, 0.0)


@NAMES
def test_the_mass_matrix_behind_it_is_symmetric_and_positive(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    q, still = rng.uniform(-2, 2, (robot.n, 3)), np.zeros((robot.n, 3))
    size = 6 + 3 * robot.n

    def column(unit: np.ndarray) -> np.ndarray:
        a, wd, qdd = tuple(unit[:3]), tuple(unit[3:6]), unit[6:].reshape(robot.n, 3)
        force, moment, tau = inverse_dynamics(robot.arrays, (0.0, 0.0, 0.0), wd, a, q, still, qdd)
        return np.array([*force, *moment, *tau.ravel()])

    M = np.stack([column(unit) for unit in np.eye(size)], axis=1)
    np.testing.assert_allclose(M, M.T, atol=1e-12 * np.abs(M).max())
    assert np.linalg.eigvalsh(M).min() > 0.0


@NAMES
def test_power_in_is_energy_gained(name: str, rng: np.random.Generator) -> None:
    """Without gravity F·v + M·ω + τ·q̇ = dT/dt, the rate taken by finite differences along the motion."""
    robot = robot_called(name)
    s = any_state(robot, rng)
    v, a, w, wd = (
        s.velocity_w,
        s.acceleration_w,
        s.angular_velocity_b,
        s.angular_acceleration_b,
    )  # in base axes
    force, moment, tau = inverse_dynamics(robot.arrays, tuple(w), tuple(wd), tuple(a), s.q, s.qd, s.qdd)
    power = v @ force + w @ moment + (tau * s.qd).sum()

    def energy(t: float) -> float:
        turning = v + t * (a - np.cross(w, v))
        q = s.q + t * s.qd + 0.5 * t * t * s.qdd
        return kinetic_energy(robot, turning, w + t * wd, q, s.qd + t * s.qdd)

    step = 1e-5
    assert power == pytest.approx((energy(step) - energy(-step)) / (2 * step), rel=1e-6)


def kinetic_energy(robot: Robot, v, w, q, qd) -> float:
    """½ q̇ᵀ M q̇: what it takes to reach these rates from rest in a second, times the rates."""
    force, moment, tau = inverse_dynamics(
        robot.arrays, (0.0, 0.0, 0.0), tuple(w), tuple(v), q, np.zeros_like(q), qd
    )
    return 0.5 * float(v @ force + w @ moment + (tau * qd).sum())


@NAMES
def test_a_leg_read_from_the_packed_robot_is_that_of_its_arrays(name: str, rng: np.random.Generator) -> None:
    robot = unlike(robot_called(name), rng)
    for k in range(robot.n):
        assert leg_at(robot.packed, k) == leg_of(robot.arrays, k)


@NAMES
def test_one_call_gives_dynamics_feet_and_jacobians(name: str, rng: np.random.Generator) -> None:
    """The dynamics are those of `inverse_dynamics` to the bit, the feet those of the kinematics."""
    robot = unlike(robot_called(name), rng)
    s = any_state(robot, rng)
    w, wd, a = s.angular_velocity_b, s.angular_acceleration_b, s.acceleration_w
    got = dynamics_in(dynamics_of(robot.packed, state_numbers(w, wd, a, s.q, s.qd, s.qdd)))
    force, moment, tau = inverse_dynamics(robot.arrays, tuple(w), tuple(wd), tuple(a), s.q, s.qd, s.qdd)
    np.testing.assert_array_equal(got.wrench, [*force, *moment])
    np.testing.assert_array_equal(got.tau, tau)
    np.testing.assert_allclose(got.feet, feet(robot, s.q), atol=1e-12)
    step = 1e-6
    for j, unit in enumerate(np.eye(3)):
        slope = (feet(robot, s.q + step * unit) - feet(robot, s.q - step * unit)) / (2 * step)
        np.testing.assert_allclose(got.columns[:, j], slope, atol=1e-8)


@NAMES
def test_accelerations_add_to_the_bias_and_leave_it_where_they_are_zero(
    name: str, rng: np.random.Generator
) -> None:
    """q̈ in two parts is q̈ in one: the outward pass splits."""
    robot = unlike(robot_called(name), rng)
    s = any_state(robot, rng)
    w, wd, a = map(tuple, (s.angular_velocity_b, s.angular_acceleration_b, s.acceleration_w))
    leg = leg_at(robot.packed, robot.n - 1)
    turns, qd, qdd = leg_turns(s.q[-1], leg.sign), tuple(s.qd[-1]), s.qdd[-1]
    bias = bias_motion(turns, qd, leg.offset, leg.sign, *motion_at_hip(leg, w, wd, a))
    assert with_accelerations(turns, bias, (0.0, 0.0, 0.0), leg.offset, leg.sign) == bias
    part = with_accelerations(turns, bias, tuple(0.3 * qdd), leg.offset, leg.sign)
    both = with_accelerations(turns, part, tuple(0.7 * qdd), leg.offset, leg.sign)
    once = links_motion(leg, turns, w, wd, a, qd, tuple(qdd))
    np.testing.assert_allclose(both, once, atol=1e-12 * np.abs(once).max())


@NAMES
def test_joint_accelerations_give_the_feet_theirs(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    s = any_state(robot, rng)
    q = robot_stance(robot) + rng.uniform(-0.1, 0.1, (robot.n, 3))
    w, wd, a = map(tuple, (s.angular_velocity_b, s.angular_acceleration_b, s.acceleration_w))
    asked = rng.normal(0.0, 10.0, (robot.n, 3))
    qdd = joint_accelerations(robot.packed, w, wd, a, q, s.qd, asked)
    for k in range(robot.n):
        leg = leg_at(robot.packed, k)
        turns = leg_turns(q[k], leg.sign)
        links = links_motion(leg, turns, w, wd, a, tuple(s.qd[k]), tuple(qdd[k]))
        got = robot.leg_frame[k] @ foot_acceleration(turns, links, leg.offset)
        np.testing.assert_allclose(got, asked[k], atol=1e-10 * np.abs(qdd).max())


def robot_stance(robot: Robot) -> np.ndarray:
    """Angles of the nominal stance."""
    return angles(robot, robot.nominal_feet)[0]


def test_three_columns_are_solved_exactly(rng: np.random.Generator) -> None:
    for columns in rng.normal(size=(50, 3, 3)) + 3.0 * np.eye(3):
        wanted = rng.normal(size=3)
        x = solve_columns(*map(tuple, columns), tuple(columns.T @ wanted))
        np.testing.assert_allclose(x, wanted, atol=1e-12)


def test_a_singular_pose_gets_a_bounded_answer(rng: np.random.Generator) -> None:
    for tiny in (0.0, 1e-14, 1e-9, 1e-4):
        one, two = rng.normal(size=3), rng.normal(size=3)
        columns = (one, two, one + two + tiny * rng.normal(size=3))
        x = solve_columns(*map(tuple, columns), (1.0, 2.0, 3.0))
        lengths = [np.linalg.norm(c) for c in columns]
        assert np.linalg.norm(x) <= 100.0 * np.sqrt(3.0 * 14.0) / min(lengths)
