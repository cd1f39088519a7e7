"""The plant without mechanics: body and joints are where they are asked to be, and nowhere in the ground."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.control.numerical import idle
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.locomotion import Brain, think
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.plant.registry import SimulatedPlant, make_plant
from gaitwright.record.recording import Recording
from gaitwright.session import walk
from gaitwright.signals import Mission, Sensed, Torques
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import skill_names
from gaitwright.stages import Plant
from oracles import robot_called

FLAT = load_scene("flat")
DT = 0.004


def brain_of(robot: Robot, skill: str, driver: str, scene: Scene = FLAT) -> Brain:
    turn = 0.8 if skill == "turn" else 0.0
    return Brain.of(robot, scene, fixed_skill(robot, skill, None, 0.0, turn, driver), DT)


def hold(name: str, skill: str, driver: str, seconds: float, scene: Scene = FLAT, seed: int = 3) -> Recording:
    robot = robot_called(name)
    plant = KinematicPlant(robot, scene, DT)
    return walk(brain_of(robot, skill, driver, scene), plant, Mission(()), seconds, seed)


def feet_of(robot: Robot, sensed: Sensed) -> np.ndarray:
    return sensed.position_w + feet(robot, sensed.q) @ rotation(sensed.orientation_wb).T


def test_it_is_a_plant_by_name() -> None:
    plant = make_plant("kinematic", robot_called("go2"), FLAT)
    assert isinstance(plant, KinematicPlant) and isinstance(plant, SimulatedPlant)
    assert isinstance(plant, Plant)
    for asked in ({"timestep": 0.001}, {"integrator": "euler"}, {"refresh": 2}):
        with pytest.raises(WrongUse, match="no mechanics to step through"):
            make_plant("kinematic", robot_called("go2"), FLAT, **asked)


@pytest.mark.parametrize("skill", skill_names(4))
def test_the_kinematic_driver_holds_every_skill_exactly(skill: str) -> None:
    record = hold("go2", skill, "kinematic", 3.6)
    report = record.report()
    assert record.done and not record.fell, record.stopped_because
    assert report.velocity_error_mps < 0.01 and report.yaw_rate_error_radps < 0.02


@pytest.mark.parametrize("skill", ["stand", "walk", "trot", "turn", "pace", "gallop"])
def test_programmed_motions_play_on_it(skill: str) -> None:
    record = hold("go2", skill, "programmed", 3.0)
    assert record.done and not record.fell, record.stopped_because
    assert record.report().velocity_error_mps < 0.05, "the gait waits for feet that come down late"
    assert (record["load"].sum(axis=1) > 0.0).mean() > 0.5


@pytest.mark.parametrize("scene", ["flat", "rough:0.03", "slope:10", "stairs:0.06"])
def test_standing_feet_stay_no_foot_is_in_the_ground_and_no_joint_beyond_its_limit(scene: str) -> None:
    robot, ground = robot_called("go2"), load_scene(scene)
    brain, plant = brain_of(robot, "walk", "kinematic", ground), KinematicPlant(robot, ground, DT)
    sensed = plant.reset(5)
    mind = brain.begin(Mission(()), sensed)
    slid, stood = 0.0, 0
    for tick in range(700):
        lap, mind = think(brain, mind, sensed)
        after = plant.step(lap.command)
        before_w, after_w = feet_of(robot, sensed), feet_of(robot, after)
        assert (plant.gaps(after_w) > -1e-9).all()
        assert (robot.q_min - 1e-12 <= after.q).all() and (after.q <= robot.q_max + 1e-12).all()
        stay = lap.target.stance & (after.load > 0.0)
        if tick > 0 and stay.any():
            stood += 1
            slid = max(slid, float(np.abs(after_w - before_w)[stay].max()))
        sensed = after
    assert sensed.position_w[0] > 0.5
    assert stood > 600
    assert slid < 1e-6, f"a standing foot slid {slid} m in a tick"


def test_velocities_are_what_moved_and_the_weight_is_shared() -> None:
    robot = robot_called("thesis")
    record = hold("thesis", "trot", "kinematic", 2.0)
    np.testing.assert_allclose(
        np.diff(record["position_w"], axis=0) / DT, record["velocity_w"][1:], rtol=1e-9, atol=1e-9
    )
    np.testing.assert_allclose(np.diff(record["q"], axis=0) / DT, record["qd"][1:], rtol=1e-9, atol=1e-9)
    turned = np.array([rotation(q) for q in record["orientation_wb"]])
    half = 0.5 * DT * record["angular_velocity_b"][1:]
    step = np.einsum("nji,njk->nik", turned[:-1], turned[1:])
    skew = 0.5 * np.stack([step[:, 2, 1] - step[:, 1, 2], step[:, 0, 2] - step[:, 2, 0],
                           step[:, 1, 0] - step[:, 0, 1]], axis=1)  # fmt: skip
    np.testing.assert_allclose(skew, 2.0 * half, atol=1e-6)
    loaded = record["load"].sum(axis=1)
    assert (loaded > 0.0).mean() > 0.9
    np.testing.assert_allclose(loaded[loaded > 0.0], robot.total_mass * 9.81)


def test_the_body_is_set_down_on_the_feet_that_are_to_stand() -> None:
    robot = robot_called("go2")
    plant, brain = KinematicPlant(robot, FLAT, DT), brain_of(robot, "stand", "kinematic")
    sensed = plant.reset(0, vary=False)
    lap, _ = think(brain, brain.begin(Mission(()), sensed), sensed)
    asked = lap.command.posture
    assert asked is not None
    for off in (0.05, -0.05):
        moved = replace(asked, position_w=asked.position_w + np.array([0.0, 0.0, off]))
        after = plant.step(replace(lap.command, posture=moved))
        np.testing.assert_allclose(plant.gaps(feet_of(robot, after)), 0.0, atol=1e-9)
        assert (after.load > 0.0).all()


def test_torques_alone_move_nothing_and_say_so() -> None:
    robot = robot_called("go2")
    plant = KinematicPlant(robot, FLAT, DT)
    before = plant.reset(1)
    after = plant.step(idle(robot))
    np.testing.assert_array_equal(after.q, before.q)
    assert after.time == DT and not after.velocity_w.any()
    pulling = Torques(np.ones((4, 3)), np.zeros((4, 3)), 0.0)
    with pytest.raises(
        WrongUse, match="no mechanics that torques could move; drivers kinematic and programmed"
    ):
        plant.step(pulling)
    with pytest.raises(WrongUse, match="no mechanics that torques could move"):
        walk(brain_of(robot, "trot", "numerical"), plant, Mission(()), 0.1)


def test_a_push_moves_nothing_and_says_so() -> None:
    plant = KinematicPlant(robot_called("go2"), FLAT, DT)
    plant.push((0.0, 0.0, 0.0))
    with pytest.raises(WrongUse, match="a push moves nothing"):
        plant.push((1.0, 0.0, 0.0))


def test_equal_seeds_are_equal_to_the_bit() -> None:
    one, again, other = (hold("go2", "trot", "kinematic", 0.5, seed=seed) for seed in (7, 7, 8))
    assert one.report().state_hash == again.report().state_hash != other.report().state_hash
