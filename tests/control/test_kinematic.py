"""Joint servos: pulled to the posture asked for, within the limits, and walking in full physics."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.control.kinematic import KinematicController, wanted_rates
from gaitwright.control.programmed import ProgrammedController, played
from gaitwright.control.servo import NO_NUMBER, STIFF, servo
from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.desired_cycle import DesiredCycle, Manner, desired_cycle
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Controller
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.programmes import Programmed
from gaitwright.record.recording import Recording
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import LIBRARY, find_skill, gait_of, speed_scale
from oracles import robot_called

FLAT = load_scene("flat")
seeds = st.integers(0, 2**32 - 1)


def cycle_of(robot: Robot, skill: str) -> DesiredCycle:
    """The skill at the speed it is meant for, a little aside and turning."""
    speed = LIBRARY[skill].speed * speed_scale(robot)
    gait = gait_of(find_skill(skill, robot), robot)
    turn = 0.1 * speed / robot.height
    return desired_cycle(robot, gait, (speed, 0.1 * speed), turn, Manner(sways=True), steps=64)


def programme(cycle: DesiredCycle) -> ProgrammedController:
    return ProgrammedController(cycle.robot, cycle.q, cycle.qd, cycle.stance)


def hold(name: str, skill: str, driver: str, seconds: float, seed: int) -> Recording:
    robot = robot_called(name)
    turn = 0.8 if skill == "turn" else 0.0
    chooser = fixed_skill(robot, skill, None, 0.0, turn, driver)
    return walk(Brain.of(robot, FLAT, chooser), MujocoPlant(robot, FLAT), Mission(()), seconds, seed)


# --- the law of the servo --------------------------------------------------------------------------
@given(seeds)
def test_a_servo_is_a_spring_and_a_damper_within_the_limits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    want, rate, q, qd = rng.normal(size=(4, 4, 3))
    most = rng.uniform(0.1, 5.0, (4, 3))
    tau = servo(most, 3.0, 0.7, want, rate, q, qd)
    np.testing.assert_allclose(tau, np.clip(3.0 * (want - q) + 0.7 * (rate - qd), -most, most), atol=1e-12)


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_where_all_is_as_wanted_nothing_pulls(name: str) -> None:
    """The rates are those of the desired cycle, so a robot that moves as desired is left alone."""
    cycle = cycle_of(robot_called(name), "trot")
    for i in range(0, cycle.steps, 5):
        target, sensed = cycle.target(i), cycle.sensed(i)
        np.testing.assert_allclose(wanted_rates(cycle.robot, target), cycle.qd[i], atol=1e-9)
        torques = KinematicController(cycle.robot).command(target, sensed)[0]
        np.testing.assert_allclose(torques.tau / cycle.robot.tau_max, 0.0, atol=1e-9)
        assert torques.status.startswith("solved") and torques.residual == 0.0
        assert torques.posture is not None and torques.posture.q is target.q and not torques.forces_w.any()


@given(seeds, st.integers(0, 3), st.integers(0, 2))
@settings(max_examples=30)
def test_each_joint_is_pulled_towards_its_own_angle_and_no_limit_is_passed(seed, leg, joint) -> None:
    cycle = cycle_of(robot_called("go2"), "walk")
    robot, sensed = cycle.robot, cycle.sensed(3)
    off = np.zeros((4, 3))
    off[leg, joint] = np.random.default_rng(seed).uniform(-1.0, 1.0)
    tau = KinematicController(robot).command(cycle.target(3), replace(sensed, q=sensed.q + off))[0].tau
    stiffness = STIFF.stiffness * robot.total_mass * 9.81 * robot.height
    expected = np.clip(-stiffness * off, -robot.tau_max, robot.tau_max)
    np.testing.assert_allclose(tau, expected, atol=1e-6)


@pytest.mark.parametrize("field", ["position_w", "orientation_wb", "q", "qd", "load"])
def test_what_is_no_number_gives_no_numbers(field: str) -> None:
    cycle = cycle_of(robot_called("go2"), "walk")
    sensed = cycle.sensed(0)
    broken = getattr(sensed, field).copy()
    broken.flat[1] = np.nan
    for controller in (KinematicController(cycle.robot), programme(cycle)):
        torques = controller.command(cycle.target(0), replace(sensed, **{field: broken}))[0]
        assert np.isnan(torques.tau).all() and torques.status == NO_NUMBER


def test_a_target_that_is_no_number_gives_none() -> None:
    cycle = cycle_of(robot_called("go2"), "walk")
    target = replace(cycle.target(0), q=np.full((4, 3), np.nan))
    assert np.isnan(KinematicController(cycle.robot).command(target, cycle.sensed(0))[0].tau).all()


# --- programmes ------------------------------------------------------------------------------------
def test_a_programme_plays_its_table_whatever_is_sensed() -> None:
    cycle = cycle_of(robot_called("go2"), "trot")
    controller = programme(cycle)
    assert isinstance(controller, Controller)
    for i in (0, 17, 63):
        follows = controller.command(cycle.target(i), cycle.sensed((i + 9) % 64))[0].posture
        assert follows is not None
        np.testing.assert_allclose(follows.q, cycle.q[i], atol=1e-12)
        np.testing.assert_array_equal(follows.stance, cycle.stance[i])
        np.testing.assert_array_equal(follows.position_w, cycle.position_w[i])


@given(seeds, st.floats(0.0, 1.0, exclude_max=True))
def test_between_its_rows_a_table_is_straight_and_closes(seed: int, phase: float) -> None:
    table = np.random.default_rng(seed).normal(size=(7, 4, 3))
    closed = np.concatenate([table, table[:1]])
    expected = np.empty((4, 3))
    for leg, joint in np.ndindex(4, 3):
        expected[leg, joint] = np.interp(phase, np.arange(8) / 7, closed[:, leg, joint])
    np.testing.assert_allclose(played(table, phase), expected, atol=1e-9)


def test_a_programme_that_fits_no_robot_is_refused() -> None:
    cycle = cycle_of(robot_called("go2"), "walk")
    q, qd, stance = cycle.q, cycle.qd, cycle.stance
    with pytest.raises(WrongUse, match=r"expected \(phases, 6, 3\)"):
        ProgrammedController(robot_called("hexapod"), q, qd, stance)
    with pytest.raises(WrongUse, match="not finite"):
        ProgrammedController(cycle.robot, q, np.full_like(qd, np.nan), stance)
    far = q.copy()
    far[16, 2, 1] = 9.0
    with pytest.raises(WrongUse, match=r"leg RL, hip 2, to 9 rad at phase 0.250; its limits are"):
        ProgrammedController(cycle.robot, far, qd, stance)


def test_a_brain_makes_one_programme_for_each_call_and_knows_its_drivers() -> None:
    robot = robot_called("go2")
    chooser = fixed_skill(robot, "trot", 0.3, 0.0, 0.0, "programmed")
    brain, call = Brain.of(robot, FLAT, chooser), chooser.skill_call
    driver = brain.controller("programmed")
    assert isinstance(driver, Programmed)
    made = driver.programme(call.gait, call.velocity, call.turn)
    assert driver.programme(call.gait, call.velocity, call.turn) is made
    assert driver.programme(call.gait, (0.2, 0.0), call.turn) is not made
    assert brain.controller("kinematic") is brain.controllers["kinematic"]
    with pytest.raises(WrongUse, match=r"no driver 'numeric'.*did you mean 'numerical'"):
        brain.controller("numeric")


def test_a_leg_cycle_that_is_asked_for_is_followed_by_every_driver() -> None:
    robot = robot_called("go2")
    brain = Brain.of(robot, FLAT, fixed_skill(robot, "trot", 0.3, 0.0, 0.0, "programmed"))
    other = brain.with_cycle("trot", replace(load_cycle("climb"), name="trot"))
    gait = gait_of(LIBRARY["trot"], robot)
    lifts = []
    for one in (brain, other):
        driver = one.controller("programmed")
        assert isinstance(driver, Programmed)
        table = driver.programme(gait, (0.3, 0.0), 0.0).table
        swing = np.array([feet(robot, q)[:, 2].max() for q in table])
        assert isinstance(one.coordinator, Coordinator)
        lifts.append((float(np.ptp(swing)), float(one.coordinator.cycle(gait).legs[0, :, 3].max())))
    assert lifts[1][0] > 1.1 * lifts[0][0] and lifts[1][1] > 1.1 * lifts[0][1]


# --- in full physics -------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("name", "skill", "error"),
    [("go2", "stand", 0.02), ("go2", "walk", 0.02), ("go2", "trot", 0.05), ("hexapod", "trot", 0.02)],
)
def test_the_kinematic_driver_walks_at_modest_speeds(name: str, skill: str, error: float) -> None:
    robot = robot_called(name)
    record = hold(name, skill, "kinematic", 7.0 * gait_of(LIBRARY[skill], robot).period, seed=1)
    report = record.report()
    assert record.done and not record.fell, record.stopped_because
    assert report.velocity_error_mps < error * speed_scale(robot)
    assert np.abs(record["tau"] / robot.tau_max.ravel()).max() <= 1.0
    assert report.driver_share == {"kinematic": 1.0}
    # A body on springs hangs low, and no lower than its weight takes.
    low = robot.height - record["position_w"][-500:, 2].mean()
    assert -0.02 * robot.height < low < 0.1 * robot.height


@pytest.mark.parametrize("skill", ["stand", "walk", "trot"])
def test_a_programme_keeps_go2_up_and_drifts(skill: str) -> None:
    record = hold("go2", skill, "programmed", 4.0, seed=2)
    assert record.done and not record.fell, record.stopped_because
    moved = record["position_w"][-1, 0] - record["position_w"][0, 0]
    wanted = 4.0 * LIBRARY[skill].speed
    assert moved == pytest.approx(wanted, rel=0.4, abs=0.05)
    assert np.abs(record["tau"] / robot_called("go2").tau_max.ravel()).max() <= 1.0
