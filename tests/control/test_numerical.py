"""The numerical controller's torques do what was wanted: MuJoCo, given them, accelerates as asked."""

import re
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.control.impedance import steering
from gaitwright.control.inverse_dynamics import (
    ATTITUDE,
    HORIZONTAL,
    MOST_ACCELERATION,
    MOST_SPIN,
    SWING_FOOT,
    VERTICAL,
    Load,
    base_acceleration,
    load_of,
    packed_load,
)
from gaitwright.control.moments import moment_of, row
from gaitwright.control.numerical import LACKING, NumericalController, idle
from gaitwright.ground.scene import load_scene
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation, rotation_vector
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import GRIP, MotionTarget, Sensed
from oracles import mujoco_foot_accelerations, mujoco_forward, robot_called

NAMES = pytest.mark.parametrize("name", ["go2", "thesis", "hexapod", "dog"])
UP = np.array([0.0, 0.0, 1.0])


def standing(robot: Robot) -> Sensed:
    """The robot at rest in its nominal stance."""
    still, joints = np.zeros(3), np.zeros((robot.n, 3))
    q, _ = angles(robot, robot.nominal_feet)
    load = np.full(robot.n, robot.total_mass * GRAVITY / robot.n)
    return Sensed(0.0, robot.height * UP, np.array([1.0, 0, 0, 0]), still, still.copy(), q, joints, load)


def moving(robot: Robot, rng: np.random.Generator) -> Sensed:
    """The robot near its nominal stance, tilted and on the move."""
    at = standing(robot)
    quaternion = np.array([1.0, *rng.uniform(-0.15, 0.15, 3)])
    pace = np.sqrt(GRAVITY * robot.height)
    rate = robot.natural_frequency
    return replace(
        at,
        position_w=at.position_w + rng.uniform(-5.0, 5.0, 3),
        orientation_wb=quaternion / np.linalg.norm(quaternion),
        velocity_w=rng.uniform(-0.3, 0.3, 3) * pace,
        angular_velocity_b=rng.uniform(-0.3, 0.3, 3) * rate,
        q=at.q + rng.uniform(-0.2, 0.2, (robot.n, 3)),
        qd=rng.uniform(-0.5, 0.5, (robot.n, 3)) * rate,
    )


def hold(robot: Robot, sensed: Sensed, stance: np.ndarray | None = None) -> MotionTarget:
    """Stay as you are, on the feet in `stance` (all, where not given)."""
    still, legs = np.zeros(3), np.zeros((robot.n, 3))
    down = np.ones(robot.n, dtype=bool) if stance is None else stance
    return MotionTarget(
        phase=0.0,
        stance=down,
        load_scale=down.astype(float),
        friction=np.full(robot.n, GRIP),
        normal_w=UP,
        position_w=sensed.position_w,
        velocity_w=still,
        acceleration_w=still,
        rotation_wb=rotation(sensed.orientation_wb),
        angular_velocity_w=still,
        angular_acceleration_w=still,
        feet_w=legs,
        feet_velocity_w=legs,
        feet_acceleration_w=legs,
        q=sensed.q,
        command=still,
        operator=np.zeros(robot.n),
        reach=np.zeros(robot.n),
        extra_force_w=legs,
    )


def anything(
    robot: Robot, sensed: Sensed, stance: np.ndarray, rng: np.random.Generator, much: float
) -> MotionTarget:
    """A target away from where the robot is, by about `much` in its own units."""
    size, pace = robot.height, np.sqrt(GRAVITY * robot.height)

    def off(*shape: int) -> np.ndarray:
        return much * rng.normal(size=shape)

    return replace(
        hold(robot, sensed, stance),
        position_w=sensed.position_w + size * off(3),
        velocity_w=pace * off(3),
        acceleration_w=GRAVITY * off(3),
        rotation_wb=rotation(np.array([1.0, *np.clip(off(3), -5, 5)])),
        angular_velocity_w=robot.natural_frequency * off(3),
        angular_acceleration_w=robot.natural_frequency**2 * off(3),
        feet_w=sensed.position_w + robot.nominal_feet + size * off(robot.n, 3),
        feet_velocity_w=pace * off(robot.n, 3),
        feet_acceleration_w=GRAVITY * off(robot.n, 3),
    )


def wanted(robot: Robot, target: MotionTarget, s: Sensed) -> tuple[np.ndarray, np.ndarray]:
    """Linear and angular acceleration of the base that the feedback asks for, world axes."""
    R = rotation(s.orientation_wb)
    linear, angular = base_acceleration(
        robot.natural_frequency, R, tuple(R @ s.angular_velocity_b), moment_of(row(s, target))
    )
    return np.array(linear), np.array(angular)


def demanded(robot: Robot, target: MotionTarget, s: Sensed) -> Load:
    """What the motion asks of feet and motors."""
    return load_of(packed_load(robot, target, s))


def steered(robot: Robot, target: MotionTarget, s: Sensed) -> np.ndarray:
    """The torques beside the inverse dynamics `(legs, 3)`."""
    return steering(robot.packed, moment_of(row(s, target)))


def exact_forces(load: Load, stance: np.ndarray) -> np.ndarray:
    """The smallest forces `(legs, 3)` that give the whole wrench, no limit kept."""
    rows = np.zeros((6, stance.size, 3))
    for leg in np.flatnonzero(stance):
        x, y, z = load.arm[leg]
        rows[:, leg] = np.vstack([np.eye(3), [[0, -z, y], [z, 0, -x], [-y, x, 0]]])
    forces = np.linalg.lstsq(rows.reshape(6, -1), load.wrench, rcond=None)[0]
    return forces.reshape(-1, 3)


# --- the demand ----------------------------------------------------------------------------------
@NAMES
@pytest.mark.parametrize("lifted", [0, 1], ids=["all-down", "one-lifted"])
def test_what_is_demanded_happens_in_mujoco(name: str, lifted: int, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    for _ in range(5):
        s = moving(robot, rng)
        stance = np.ones(robot.n, dtype=bool)
        stance[rng.permutation(robot.n)[:lifted]] = False
        target = anything(robot, s, stance, rng, much=0.05)
        load = demanded(robot, target, s)
        forces = exact_forces(load, stance)
        tau = load.free - np.einsum("lji,li->lj", load.push, forces)
        model, data = mujoco_forward(robot, s, tau, load.arm, forces)
        linear, angular = wanted(robot, target, s)
        R = rotation(s.orientation_wb)
        np.testing.assert_allclose(data.qacc[:3], linear, rtol=0, atol=1e-8)
        np.testing.assert_allclose(R @ data.qacc[3:6], angular, rtol=0, atol=1e-8)
        accelerations = mujoco_foot_accelerations(robot, model, data)
        np.testing.assert_allclose(accelerations[stance], 0.0, atol=1e-8)
        asked = swing_accelerations(robot, target, s, model, data)
        np.testing.assert_allclose(accelerations[~stance], asked[~stance], rtol=1e-9, atol=1e-8)


def swing_accelerations(robot: Robot, target: MotionTarget, s: Sensed, model, data) -> np.ndarray:
    """Feedback on the feet in the air, their places and speeds taken from MuJoCo."""
    w0, rates = robot.natural_frequency, np.empty((robot.n, 3))
    jacobian = np.empty((3, model.nv))
    for leg in range(robot.n):
        mujoco.mj_jacSite(model, data, jacobian, None, leg)
        rates[leg] = jacobian @ data.qvel
    back = SWING_FOOT[0] * w0**2 * (target.feet_w - data.site_xpos) + SWING_FOOT[1] * w0 * (
        target.feet_velocity_w - rates
    )
    return target.feet_acceleration_w + back


@NAMES
def test_feet_touch_the_ground_a_radius_below_their_centres(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    s, slope = moving(robot, rng), rng.uniform(-0.3, 0.3, 2)
    normal = np.array([*slope, 1.0]) / np.sqrt(1.0 + slope @ slope)
    load = demanded(robot, replace(hold(robot, s), normal_w=normal), s)
    centres = feet(robot, s.q) @ rotation(s.orientation_wb).T
    np.testing.assert_allclose(load.arm, centres - robot.foot_radius[:, None] * normal, atol=1e-12)


@NAMES
def test_pushes_act_as_torques_by_virtual_work(name: str, rng: np.random.Generator) -> None:
    """What ground forces do to the joints, torques `-push @ f` undo: only the base feels them."""
    robot = robot_called(name)
    s = moving(robot, rng)
    stance = np.ones(robot.n, dtype=bool)
    load = demanded(robot, hold(robot, s, stance), s)
    forces = rng.normal(size=(robot.n, 3))
    zero = np.zeros((robot.n, 3))
    _, without = mujoco_forward(robot, s, zero, load.arm, 0.0 * forces)
    _, held = mujoco_forward(robot, s, -np.einsum("lji,li->lj", load.push, forces), load.arm, forces)
    work = held.qfrc_applied + held.qfrc_actuator - without.qfrc_applied - without.qfrc_actuator
    np.testing.assert_allclose(work[6:], 0.0, atol=1e-11 * robot.leg_length)
    np.testing.assert_allclose(work[:3], forces.sum(axis=0), atol=1e-12)


@NAMES
def test_without_a_foot_down_the_body_is_left_to_fall(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    s = standing(robot)
    nobody = np.zeros(robot.n, dtype=bool)
    falling = replace(
        anything(robot, s, nobody, rng, much=0.5),
        feet_w=s.position_w + robot.nominal_feet,
        feet_velocity_w=np.zeros((robot.n, 3)),
        feet_acceleration_w=np.tile(-GRAVITY * UP, (robot.n, 1)),
    )
    load = demanded(robot, falling, s)
    np.testing.assert_allclose(load.wrench, 0.0, atol=1e-9 * robot.total_mass * GRAVITY)
    np.testing.assert_allclose(load.free, 0.0, atol=1e-9 * robot.total_mass * GRAVITY)


# --- the feedback --------------------------------------------------------------------------------
def test_at_the_reference_only_the_feed_forward_is_left(rng: np.random.Generator) -> None:
    robot = robot_called("dog")
    s = moving(robot, rng)
    R = rotation(s.orientation_wb)
    there = replace(
        hold(robot, s),
        velocity_w=s.velocity_w,
        angular_velocity_w=R @ s.angular_velocity_b,
        acceleration_w=np.array([1.0, -2.0, 3.0]),
        angular_acceleration_w=np.array([4.0, 5.0, -6.0]),
    )
    linear, angular = wanted(robot, there, s)
    np.testing.assert_allclose(linear, [1.0, -2.0, 3.0], atol=1e-12)
    np.testing.assert_allclose(angular, [4.0, 5.0, -6.0], atol=1e-12)


def test_an_error_is_answered_in_proportion(rng: np.random.Generator) -> None:
    robot = robot_called("dog")
    w0 = robot.natural_frequency
    s = moving(robot, rng)
    R = rotation(s.orientation_wb)
    near = anything(robot, s, np.ones(4, dtype=bool), rng, much=0.003)
    near = replace(near, velocity_w=s.velocity_w + near.velocity_w, rotation_wb=near.rotation_wb @ R,
                   angular_velocity_w=R @ s.angular_velocity_b + near.angular_velocity_w)  # fmt: skip
    linear, angular = wanted(robot, near, s)
    position, velocity = near.position_w - s.position_w, near.velocity_w - s.velocity_w
    spring = w0**2 * np.array([HORIZONTAL[0], HORIZONTAL[0], VERTICAL[0]])
    damper = w0 * np.array([HORIZONTAL[1], HORIZONTAL[1], VERTICAL[1]])
    np.testing.assert_allclose(linear, spring * position + damper * velocity + near.acceleration_w)
    turn = np.array(rotation_vector(near.rotation_wb @ R.T))
    omega = near.angular_velocity_w - R @ s.angular_velocity_b
    np.testing.assert_allclose(
        angular, ATTITUDE[0] * w0**2 * turn + ATTITUDE[1] * w0 * omega + near.angular_acceleration_w
    )


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 100.0))
@settings(max_examples=30)
def test_however_far_off_accelerations_stay_bounded(seed: int, much: float) -> None:
    robot, rng = robot_called("dog"), np.random.default_rng(seed)
    s = moving(robot, rng)
    linear, angular = wanted(robot, anything(robot, s, np.ones(4, dtype=bool), rng, much), s)
    assert np.linalg.norm(linear) <= MOST_ACCELERATION * (1 + 1e-12)
    assert np.linalg.norm(angular) <= MOST_SPIN * robot.natural_frequency * (1 + 1e-12)


# --- the controller ------------------------------------------------------------------------------
METHODS = pytest.mark.parametrize("method", ["qp", "lp"])


@METHODS
@given(st.integers(0, 2**32 - 1), st.floats(-2.0, 4.0))
@settings(max_examples=40)
def test_torque_limits_hold_for_absurd_targets(method: str, seed: int, magnitude: float) -> None:
    robot, rng = robot_called("dog"), np.random.default_rng(seed)
    s = moving(robot, rng)
    stance = rng.random(4) < 0.6
    target = anything(robot, s, stance, rng, 10.0**magnitude)
    torques = NumericalController(robot, method).command(target, s)[0]
    assert (np.abs(torques.tau) <= robot.tau_max).all()
    assert (torques.forces_w[~stance] == 0.0).all()
    assert np.isfinite(torques.forces_w).all() and np.isfinite(torques.residual)


@METHODS
def test_torques_belong_to_their_forces(method: str, rng: np.random.Generator) -> None:
    robot = robot_called("dog")
    s = moving(robot, rng)
    s = replace(s, velocity_w=np.zeros(3), angular_velocity_b=np.zeros(3), qd=np.zeros((4, 3)))
    target = replace(
        anything(robot, s, np.ones(4, dtype=bool), rng, much=0.002), rotation_wb=hold(robot, s).rotation_wb
    )
    torques = NumericalController(robot, method).command(target, s)[0]
    assert torques.residual < LACKING, "the feet give all that is wanted"
    load = demanded(robot, target, s)
    assert (np.abs(torques.tau) < robot.tau_max).all(), "no limit in play: the law is τ = free - push f"
    free = load.free + steered(robot, target, s)
    np.testing.assert_allclose(torques.tau, free - np.einsum("lji,li->lj", load.push, torques.forces_w))


@pytest.mark.parametrize("name", ["go2", "thesis", "dog"])
def test_a_swinging_foot_goes_its_way_where_the_base_cannot(name: str, rng: np.random.Generator) -> None:
    """One foot cannot hold a body: torques for the wanted motion throw the others off, ours much less."""
    robot, better = robot_called(name), []
    for _ in range(20):
        s = standing(robot)
        down = np.arange(robot.n) == rng.integers(robot.n)
        target = anything(robot, s, down, rng, much=0.02)
        torques = NumericalController(robot).command(target, s)[0]
        load = demanded(robot, target, s)
        plain = load.free - np.einsum("lji,li->lj", load.push, torques.forces_w)
        assert torques.residual > 0.1
        errors = []
        led = torques.tau - steered(robot, target, s)
        for tau in (led, np.clip(plain, -robot.tau_max, robot.tau_max)):
            made = mujoco_foot_accelerations(
                robot, *mujoco_forward(robot, s, tau, load.arm, torques.forces_w)
            )
            errors.append(np.linalg.norm((made - wanted_feet(robot, target, s))[~down]))
        better.append(errors[0] / errors[1])
    assert np.median(better) < 0.7


def wanted_feet(robot: Robot, target: MotionTarget, s: Sensed) -> np.ndarray:
    """Accelerations of feet in the air that the feedback asks for, of a robot at rest `(legs, 3)`."""
    w0 = robot.natural_frequency
    places = s.position_w + feet(robot, s.q) @ rotation(s.orientation_wb).T
    off, late = target.feet_w - places, target.feet_velocity_w
    return target.feet_acceleration_w + SWING_FOOT[0] * w0**2 * off + SWING_FOOT[1] * w0 * late


@METHODS
@NAMES
def test_standing_torques_balance_gravity(name: str, method: str) -> None:
    robot = robot_called(name)
    s = standing(robot)
    controller, target = NumericalController(robot, method), hold(robot, s)
    torques, memory = controller.command(target, s)
    torques, memory = controller.command(target, s, memory)
    assert torques.status == "solved" and torques.residual < 1e-3
    arm = robot.nominal_feet - robot.foot_radius[:, None] * UP
    _, data = mujoco_forward(robot, s, torques.tau, arm, torques.forces_w)
    assert np.abs(data.qacc[:3]).max() < 2e-3 * GRAVITY
    assert np.abs(data.qacc[3:6]).max() < 1e-2 * robot.natural_frequency**2


@METHODS
@NAMES
def test_a_robot_stands_still_on_real_ground(name: str, method: str) -> None:
    robot = robot_called(name)
    plant = MujocoPlant(robot, load_scene("flat"))
    first = s = plant.reset(vary=False)
    controller, target, memory = NumericalController(robot, method), hold(robot, s), None
    for _ in range(300):
        torques, memory = controller.command(target, s, memory)
        s = plant.step(torques)
    assert np.abs(s.position_w - first.position_w).max() < 0.01 * robot.height
    assert np.linalg.norm(s.velocity_w) < 0.005 * np.sqrt(GRAVITY * robot.height)
    assert s.load.sum() == pytest.approx(robot.total_mass * GRAVITY, rel=0.01)


@METHODS
def test_where_the_feet_cannot_carry_the_load_it_says_so_and_shares_evenly(method: str) -> None:
    robot = robot_called("dog")
    lame = replace(robot, tau_max=1e-3 * robot.tau_max)
    s = standing(lame)
    s = replace(s, qd=s.qd + 10.0, angular_velocity_b=np.array([1.0, 2.0, 3.0]))
    torques = NumericalController(lame, method).command(hold(lame, s), s)[0]
    assert torques.status.startswith("these feet cannot carry this load")
    assert re.search(r"(FL|FR|RL|RR), (hip 1|hip 2|knee), 0\.0\d+ N·m$|of (FL|FR|RL|RR)$", torques.status)
    np.testing.assert_allclose(
        torques.forces_w, np.tile(robot.total_mass * GRAVITY / 4 * UP, (4, 1)), atol=1e-9
    )
    np.testing.assert_array_equal(np.abs(torques.tau) <= lame.tau_max, True)


@METHODS
def test_with_no_foot_down_nothing_is_pushed(method: str) -> None:
    robot = robot_called("dog")
    s = standing(robot)
    torques = NumericalController(robot, method).command(hold(robot, s, np.zeros(4, dtype=bool)), s)[0]
    assert not torques.forces_w.any() and torques.residual == 0.0 and torques.status == "solved"


def test_motors_off_is_no_torque_and_no_force() -> None:
    off = idle(robot_called("dog"))
    assert not off.tau.any() and not off.forces_w.any() and off.status == "motors off"
