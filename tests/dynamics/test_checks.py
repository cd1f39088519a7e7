"""The checks: they pass where things are right, and say where they are wrong."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from forward_oracles import ALL, any_sensed, robot_of, unlikeness
from gaitwright.control.impedance import steering
from gaitwright.control.inverse_dynamics import base_acceleration
from gaitwright.control.moments import moment_of, row
from gaitwright.control.numerical import NumericalController
from gaitwright.dynamics.articulated import Accelerations, accelerations, contact_arms
from gaitwright.dynamics.checks import Check, bias_forces, mass_matrix, recursion_check, worst_of
from gaitwright.dynamics.closed_chain import closed_chain, imbalance
from gaitwright.dynamics.newton_euler import joint_accelerations
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import GRIP, MotionTarget, Sensed
from oracles import bare_world, put, robot_called

SEEDS = st.integers(0, 2**32 - 1)
UP = np.array([0.0, 0.0, 1.0])


@given(st.sampled_from(ALL), SEEDS)
def test_recursion_and_closed_form_agree(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    check = recursion_check(robot, *any_sensed(robot, rng))
    assert check.worst < 1e-11, check.sentence


@pytest.mark.parametrize("name", ALL)
def test_the_closed_form_is_that_of_another_engine(name: str, rng: np.random.Generator) -> None:
    """MuJoCo's mass matrix, its rows and columns of the base's origin turned into base axes."""
    import mujoco

    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    model, data = bare_world(robot)
    put(data, s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, s.q, s.qd)
    mujoco.mj_forward(model, data)
    full = np.empty((model.nv, model.nv))
    for column, unit in zip(full, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, column, unit)
    R = rotation(s.orientation_wb)
    turn = np.eye(model.nv)
    turn[:3, :3] = R
    M = mass_matrix(robot, s.q)
    np.testing.assert_allclose(turn @ M @ turn.T, full, atol=1e-9 * np.abs(full).max())
    h = bias_forces(robot, R.T @ (GRAVITY * UP), s.angular_velocity_b, s.q, s.qd)
    np.testing.assert_allclose(turn @ h, data.qfrc_bias, atol=1e-9 * np.abs(h).max())


# --- produced and wanted motion ------------------------------------------------------------------
def closure(
    robot: Robot,
    sensed: Sensed,
    tau: np.ndarray,
    forces_w: np.ndarray,
    wanted: Accelerations,
    normal_w: np.ndarray = UP,
) -> Check:
    """Wanted accelerations against those that torques and foot forces produce, by direct dynamics.

    The forces act where feet of that radius touch ground of unit normal `normal_w`. Differences count as
    shares of the wanted acceleration of their kind, or of g and g / height where that is larger.
    """
    push = np.concatenate([forces_w, np.zeros_like(forces_w)], axis=1)
    got = accelerations(robot, sensed, tau, contact_arms(robot, sensed, normal_w), push)
    kinds = ((got.linear_w, wanted.linear_w), (got.angular_b, wanted.angular_b), (got.qdd, wanted.qdd))
    natural = GRAVITY / robot.height
    least = (GRAVITY, natural, natural)
    sizes = [max(float(np.abs(b).max()), floor) for (_, b), floor in zip(kinds, least, strict=True)]
    difference = np.concatenate([np.ravel(a - b) for a, b in kinds])
    return worst_of("produced and wanted motion", robot, difference, np.array(sizes))


def with_feet(
    robot: Robot,
    sensed: Sensed,
    linear_w: np.ndarray,
    angular_b: np.ndarray,
    feet_w: np.ndarray,
) -> Accelerations:
    """The motion in which base and foot centres accelerate as given [m/s², rad/s²]: `closure`'s `wanted`.

    Planted feet have zero acceleration. Near a singular pose a leg falls short (`leg.solve_columns`).
    """
    R = rotation(sensed.orientation_wb)
    w, wd, a = tuple(sensed.angular_velocity_b), tuple(angular_b), tuple(R.T @ linear_w)
    qdd = joint_accelerations(robot.packed, w, wd, a, sensed.q, sensed.qd, feet_w @ R)
    return Accelerations(linear_w, angular_b, qdd)


def standing(name: str, rng: np.random.Generator):
    """A robot near its nominal stance, on the move, and the demand to stay as it is."""
    robot = robot_called(name)
    q, _ = angles(robot, robot.nominal_feet)
    still, joints, rate = np.zeros(3), np.zeros((robot.n, 3)), robot.natural_frequency
    s = Sensed(
        0.0, robot.height * UP, np.array([1.0, 0, 0, 0]), 0.05 * robot.height * rate * rng.uniform(-1, 1, 3),
        0.05 * rate * rng.uniform(-1, 1, 3), q, 0.05 * rate * rng.uniform(-1, 1, (robot.n, 3)),
        np.ones(robot.n),
    )  # fmt: skip
    down = np.ones(robot.n, dtype=bool)
    target = MotionTarget(
        0.0, down, down.astype(float), np.full(robot.n, GRIP), UP, s.position_w, still, still,
        np.eye(3), still, still, joints, joints, joints, q, still,
        np.zeros(robot.n), np.zeros(robot.n), joints,
    )  # fmt: skip
    return robot, s, target


def wanted_by(robot, s: Sensed, target: MotionTarget) -> Accelerations:
    """What the controller's feedback asks for, with planted feet."""
    linear, angular = base_acceleration(
        robot.natural_frequency, np.eye(3), tuple(s.angular_velocity_b), moment_of(row(s, target))
    )
    return with_feet(robot, s, np.array(linear), np.array(angular), np.zeros((robot.n, 3)))


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_the_controllers_torques_close(name: str, rng: np.random.Generator) -> None:
    """Standing on all feet, the numerical controller gets what it wants but for the wrench it leaves unmet.

    It trades a little of that for small forces; with it added on the base the loop closes, but for what the
    joints' impedance and friction add.
    """
    for _ in range(5):
        robot, s, target = standing(name, rng)
        torques, wanted = NumericalController(robot).command(target, s)[0], wanted_by(robot, s, target)
        tau = torques.tau - steering(robot.packed, moment_of(row(s, target)))
        check = closure(robot, s, tau, torques.forces_w, wanted)
        assert check.worst < 10.0 * torques.residual, f"{check.sentence}; unmet {torques.residual}"
        push = np.concatenate([torques.forces_w, 0.0 * torques.forces_w], axis=1)
        unmet = imbalance(closed_chain(robot, s, wanted, target.stance, UP), push)
        assert np.abs(unmet).max() < 0.01 * robot.total_mass * GRAVITY
        made = accelerations(robot, s, tau, contact_arms(robot, s, UP), push, unmet)
        assert unlikeness(made, wanted) < 1e-9


@given(st.sampled_from(ALL), SEEDS)
def test_closure_measures_what_is_amiss(name: str, seed: int) -> None:
    """Torques a little off by direct dynamics' own answer move the joint by just that much."""
    rng = np.random.default_rng(seed)
    robot = robot_of(name, rng)
    s, _ = any_sensed(robot, rng)
    tau, forces = rng.normal(size=(robot.n, 3)), rng.normal(size=(robot.n, 3))
    push = np.concatenate([forces, 0.0 * forces], axis=1)
    right = accelerations(robot, s, tau, contact_arms(robot, s, UP), push)
    assert closure(robot, s, tau, forces, right).worst == 0.0
    leg, joint = rng.integers(robot.n), rng.integers(3)
    size = max(np.abs(right.qdd).max(), GRAVITY / robot.height)
    off = right.qdd.copy()
    off[leg, joint] -= 0.25 * size * np.sign(off[leg, joint])  # towards zero: the size stays the same
    check = closure(robot, s, tau, forces, replace(right, qdd=off))
    assert check.where == f"{robot.legs[leg]} {('hip 1', 'hip 2', 'knee')[joint]}"
    assert 0.24 < check.worst < 0.35
    assert check.where in check.sentence


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_with_feet_the_feet_accelerate_as_asked(name: str, rng: np.random.Generator) -> None:
    """In MuJoCo, at a pose that is not singular."""
    import mujoco

    from oracles import mujoco_foot_accelerations

    robot, s, _ = standing(name, rng)
    wish = rng.normal(size=(robot.n, 3))
    asked = with_feet(robot, s, rng.normal(size=3), rng.normal(size=3), wish)
    model, data = bare_world(robot)
    put(data, s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, s.q, s.qd)
    mujoco.mj_forward(model, data)
    data.qacc[:] = np.concatenate([asked.linear_w, asked.angular_b, asked.qdd.ravel()])
    np.testing.assert_allclose(mujoco_foot_accelerations(robot, model, data), wish, atol=1e-9)
