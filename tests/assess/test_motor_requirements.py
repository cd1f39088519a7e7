"""What gaits need of motors and legs: laws of mechanics, oracles of reach and rate, and simulation."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gaitwright.assess.motor_requirements import (
    BRIEF,
    MotorRequirements,
    fastest_supported,
    lasting,
    motor_requirements,
    shortage,
    spare_length,
    too_wide,
)
from gaitwright.description.load import load_robot
from gaitwright.errors import WrongUse
from gaitwright.gait.desired_cycle import Manner, desired_cycle
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.model.reach import reach
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.plant.registry import make_plant
from gaitwright.record.recording import Recording
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import LIBRARY, find_skill, gait_of, skill_names, speed_scale

GO2 = load_robot("go2")


def gait(name: str, robot: Robot = GO2):
    return gait_of(find_skill(name, robot), robot)


def weakened(robot: Robot, share: float) -> Robot:
    return replace(robot, tau_max=robot.tau_max * share)


def of(name: str, speed: float, robot: Robot = GO2) -> MotorRequirements:
    return motor_requirements(robot, gait(name, robot), (speed, 0.0))


# --- laws ------------------------------------------------------------------------------------------
def test_standing_feet_carry_the_weight_and_nothing_turns():
    stand = of("stand", 0.0)
    assert stand.force.sum() == pytest.approx(GO2.total_mass * GRAVITY, rel=1e-3)
    assert stand.rate.max() == 0.0
    np.testing.assert_allclose(stand.lasting, stand.torque)


@given(factor=st.floats(0.3, 3.0))
@settings(max_examples=8)
def test_a_heavier_robot_needs_as_much_more(factor: float):
    """Its joints' friction too, which the motors make up for, grows with it here."""
    scaled = ("base_mass", "base_inertia", "mass", "inertia", "armature", "damping", "friction")
    heavier = replace(GO2, **{name: getattr(GO2, name) * factor for name in scaled})
    for name, speed in (("trot", 0.4), ("run", 1.5)):
        light, heavy = of(name, speed), of(name, speed, heavier)
        np.testing.assert_allclose(heavy.force, factor * light.force, rtol=1e-5)
        np.testing.assert_allclose(heavy.torque, factor * light.torque, rtol=1e-4, atol=1e-3)
        np.testing.assert_allclose(heavy.rate, light.rate)


def test_what_is_needed_does_not_depend_on_what_motors_give():
    strong, weak = of("trot", 0.6), of("trot", 0.6, weakened(GO2, 0.1))
    assert (strong.torque == weak.torque).all()
    assert weak.load == pytest.approx(10.0 * strong.load)


@given(
    tau=arrays(float, (20, 4, 3), elements=st.floats(0.0, 100.0)),
    when=arrays(bool, (20, 4)),
)
def test_a_lasting_torque_is_the_least_one_exceeded_only_briefly(tau: np.ndarray, when: np.ndarray):
    found = lasting(tau, when)
    for leg in range(4):
        chosen = tau[when[:, leg], leg]
        for joint in range(3):
            if not len(chosen):
                assert found[leg, joint] == 0.0
                continue
            assert (chosen[:, joint] > found[leg, joint]).mean() <= BRIEF + 1e-12
            lower = chosen[chosen[:, joint] < found[leg, joint], joint]
            if len(lower):
                assert (chosen[:, joint] > lower.max()).mean() > BRIEF


def test_a_foot_that_is_swung_higher_needs_faster_joints():
    """`climb` walks as `descend` does, but lifts its feet 0.28 in place of 0.2 body heights."""
    high, low = of("climb", 0.2), of("descend", 0.2)
    assert (high.rate[:, 2] > 1.1 * low.rate[:, 2]).all()
    given_one = motor_requirements(GO2, gait("descend"), (0.2, 0.0), cycle=load_cycle("climb"))
    np.testing.assert_array_equal(given_one.rate, high.rate)
    kick = LegCycle("kick", ((0.0, -0.5, 0.0), (0.3, -0.3, 0.5), (0.7, 0.3, 0.9), (1.0, 0.5, 0.0)))
    told = shortage(GO2, gait("walk"), (0.2, 0.0), cycle=kick)
    assert told is not None and "at the hip 2 of" in told


# --- oracles ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_spare_length_is_that_of_the_reach(name: str):
    robot = load_robot(name)
    cycle = desired_cycle(robot, gait("trot", robot), (0.5 * robot.height, 0.0), 0.1, Manner(sways=True), 16)
    found = spare_length(cycle)
    for i in range(cycle.steps):
        places = (cycle.feet_w[i] - cycle.position_w[i]) @ cycle.rotation_wb[i]
        told = reach(robot, places)
        np.testing.assert_allclose(found[i], [one.limit - one.measure for one in told], atol=1e-9)


def test_rates_and_room_are_those_of_the_angles():
    speed, fine = 0.8, 4000
    found = of("trot", speed)
    cycle = desired_cycle(GO2, gait("trot"), (speed, 0.0), 0.0, Manner(sways=True), fine)
    around = np.concatenate([cycle.q[-1:], cycle.q, cycle.q[:1]])
    rate = np.abs(around[2:] - around[:-2]).max(axis=0) * fine / cycle.gait.period / 2.0
    np.testing.assert_allclose(found.rate, rate, rtol=0.02, atol=0.02)
    room = np.minimum(cycle.q - GO2.q_min, GO2.q_max - cycle.q).min(axis=0)
    np.testing.assert_allclose(found.room, room, atol=0.02)


# --- what is refused -------------------------------------------------------------------------------
@pytest.mark.parametrize(("name", "speed"), [("walk", 0.25), ("trot", 0.4), ("run", 2.0), ("gallop", 1.7)])
def test_what_go2_does_in_simulation_is_not_refused(name: str, speed: float):
    assert shortage(GO2, gait(name), (speed, 0.0)) is None


def test_the_sentence_names_need_joint_leg_and_motor():
    assert shortage(GO2, gait("trot"), (3.0, 0.0)) is not None
    found = of("trot", 0.4)
    enough, short = (weakened(GO2, found.load * share) for share in (1.001, 0.98))
    assert shortage(enough, gait("trot"), (0.4, 0.0)) is None
    sentence = shortage(short, gait("trot"), (0.4, 0.0))
    leg, joint = np.unravel_index(np.argmax(found.lasting / GO2.tau_max), (4, 3))
    assert joint == 2
    need, gives = found.lasting[leg, joint], short.tau_max[leg, joint]
    leg_name = GO2.legs[leg]
    assert (
        sentence
        == f"trot at 0.4 m/s needs {need:.3g} N·m at the knee of {leg_name}; the motor gives {gives:.3g}"
    )
    assert shortage(short, gait("trot"), (0.4, 0.0), leeway=1.1) is None


def test_legs_that_are_too_short_are_told():
    sentence = shortage(GO2, gait("trot"), (9.0, 0.0))
    assert sentence is not None
    assert sentence.startswith("trot at 9 m/s is beyond the legs: ")
    assert "the stretched leg is 0.426 m" in sentence


def test_a_joint_beyond_its_limit_is_told():
    q_max = GO2.q_max.copy()
    q_max[1, 2] -= 1.0
    sentence = shortage(replace(GO2, q_max=q_max), gait("trot"), (0.4, 0.0))
    assert sentence is not None
    assert "turns the knee of FR" in sentence
    assert "beyond its limit" in sentence


def test_what_is_no_gait_of_the_robot_is_wrong_use():
    with pytest.raises(WrongUse, match="is for 4 legs"):
        shortage(load_robot("hexapod"), gait("trot"), (0.1, 0.0))
    with pytest.raises(WrongUse, match="must be finite"):
        shortage(GO2, gait("trot"), (np.nan, 0.0))


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_the_fastest_speed_is_where_something_is_missing(share: float):
    robot = weakened(GO2, share)
    skill = find_skill("trot", robot)
    most = fastest_supported(robot, skill)
    assert 0.2 < most.speed < 3.0
    assert shortage(robot, gait("trot"), (most.speed, 0.0)) is None
    assert shortage(robot, gait("trot"), (1.02 * most.speed, 0.0)) is not None
    assert most.limit.startswith("trot at ")
    assert np.isnan(fastest_supported(weakened(GO2, 0.05), skill).speed)


def test_every_skill_of_every_robot_has_requirements():
    for name in ("go2", "thesis", "hexapod"):
        robot = load_robot(name)
        for skill in skill_names(robot.n):
            found = motor_requirements(
                robot, gait(skill, robot), (0.3 * find_skill(skill, robot).speed * speed_scale(robot), 0.0)
            )
            assert np.isfinite([found.load, found.reach.min(), found.room.min(), found.rate.max()]).all()
            assert 0.1 < found.force.max() / (robot.total_mass * GRAVITY) < 2.0


# --- and in simulation -----------------------------------------------------------------------------
def simulated(robot: Robot, name: str, speed: float, seconds: float = 2.5) -> Recording:
    scene = load_scene("flat", 0)
    brain = Brain.of(robot, scene, fixed_skill(robot, name, speed, 0.0, 0.0, "numerical"))
    return walk(brain, make_plant("mujoco", robot, scene), Mission(()), seconds, 0)


@pytest.mark.parametrize(("share", "stands"), [(1.15, True), (0.85, False)])
def test_go2_stands_just_as_long_as_its_motors_are_said_to_suffice(share: float, stands: bool):
    robot = weakened(GO2, of("stand", 0.0).load * share)
    assert (shortage(robot, gait("stand"), (0.0, 0.0)) is None) == stands
    recording = simulated(robot, "stand", 0.0)
    assert (recording.done and not recording.fell) == stands


def test_go2_falls_at_a_trot_with_motors_that_are_far_too_weak():
    robot = weakened(GO2, of("trot", 0.4).load / 2.5)
    assert shortage(robot, gait("trot"), (0.4, 0.0), leeway=2.0) is not None
    assert not simulated(robot, "trot", 0.4, 4.0).done


@pytest.mark.parametrize("name", ["pace", "rack", "rotary-gallop"])
def test_a_wide_robot_is_not_carried_by_one_side_in_turn(name: str) -> None:
    wide, dog = load_robot("thesis"), load_robot("go2")
    told = too_wide(wide, gait_of(LIBRARY[name], wide))
    assert told is not None and "thesis" in told and "too wide" in told
    assert too_wide(dog, gait_of(LIBRARY[name], dog)) is None
    assert too_wide(wide, gait_of(LIBRARY["trot"], wide)) is None
