"""After a trip the robot comes to a stand and is let down, and the trip's figures say nothing of it."""

import numpy as np
import pytest

from gaitwright.control.lowering import Lowering, crouch
from gaitwright.descent import SKILL
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import feet
from gaitwright.plant.faults import FaultyPlant, breakdown
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.recording import load
from gaitwright.session import Session, record, walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2, FLAT = robot_called("go2"), load_scene("flat")


def session_of(
    skill: str = "trot", seconds: float = 1.0, lowers: bool = True, robot=GO2, plant=None
) -> Session:
    brain = Brain.of(robot, FLAT, fixed_skill(robot, skill, None, 0.0, None, "numerical"))
    return Session(brain, plant or MujocoPlant(robot, FLAT), Mission(()), seconds, 3, lowers=lowers)


@pytest.mark.parametrize("skill", ["stand", "trot", "gallop"])
def test_a_robot_is_let_down_softly(skill: str) -> None:
    session = session_of(skill)
    recording = record(session)
    assert recording.trip and len(recording) > recording.trip
    height, speed = recording["position_w"][:, 2], recording["velocity_w"][recording.trip :, 2]
    assert height[-1] < 0.5 * GO2.height and speed.min() > -0.6
    assert np.abs(recording["velocity_w"][-1]).max() < 0.1
    assert (np.abs(recording["tau"].reshape(-1, 4, 3)) <= GO2.tau_max + 1e-9).all()
    assert session.closed and not session.plant.data.ctrl.any()
    assert recording.skills[-1] == SKILL


def test_a_hexapod_is_let_down_too() -> None:
    hexapod = robot_called("hexapod")
    recording = record(session_of("tripod", robot=hexapod))
    assert recording["position_w"][-1, 2] < 0.5 * hexapod.height


def test_the_figures_are_those_of_the_trip() -> None:
    shown, plain = (record(session_of(lowers=lowers)).report() for lowers in (True, False))
    for report in (shown, plain):
        report.tick_us.clear()
    assert shown == plain


def test_a_trip_and_what_follows_go_through_a_file(tmp_path) -> None:
    plant = FaultyPlant(MujocoPlant(GO2, FLAT), GO2, [breakdown(GO2, "foot-off", "FR", at=0.4)])
    recording = record(session_of(plant=plant))
    again = load(recording.save(tmp_path / "trip.npz"))
    assert again.trip == recording.trip and again.faults == recording.faults and again.faults
    assert again.report() == recording.report()
    assert again.report().faults[0]["leg"] == "FR"


def test_what_is_broken_is_let_down_on_dampers() -> None:
    plant = FaultyPlant(MujocoPlant(GO2, FLAT), GO2, [breakdown(GO2, "leg-dead", "FL", at=0.5)])
    recording = record(session_of(plant=plant, seconds=3.0))
    assert recording.trip and not recording.done and not recording.fell
    assert recording.stopped_because == recording.faults[0].sentence
    tau, qd = (recording[name][recording.trip :].reshape(-1, 4, 3) for name in ("tau", "qd"))
    assert (tau * qd <= 1e-9).all(), "a damper only takes"
    assert plant.truth.velocity_w[2] > -1.0 and plant.truth.position_w[2] < 0.6 * GO2.height


def test_nobody_is_let_down_unless_asked_or_after_a_fall() -> None:
    assert walk(session_of().brain, MujocoPlant(GO2, FLAT), Mission(()), 0.2).trip is None
    session = session_of(seconds=3.0)
    session.step()
    session.plant.data.qpos[3:7] = (0.5, 0.87, 0.0, 0.0)
    session.measured = session.plant.sense()
    recording = record(session)
    assert recording.fell and recording.trip is None and session.closed


def test_what_is_no_number_stops_the_motors_at_once() -> None:
    session = session_of()
    session.step()
    session.plant.data.qvel[:] = np.nan
    session.measured = session.plant.sense()
    recording = record(session)
    assert "not a number" in recording.stopped_because and recording.trip is None
    assert not session.plant.data.ctrl.any()


def test_a_crouch_is_low_and_within_the_limits() -> None:
    for name in ("go2", "hexapod", "thesis"):
        robot = robot_called(name)
        q = crouch(robot)
        assert (q >= robot.q_min).all() and (q <= robot.q_max).all()
        low, high = -feet(robot, q)[:, 2].mean(), robot.stand
        assert low < 0.5 * high


def test_letting_down_ends_without_torque() -> None:
    session = session_of()
    lap = session.step()
    assert lap
    for limp in (True, False):
        way = Lowering(GO2, 0.002, lap.sensed, lap.command, limp)
        told = way.command(way.lasts)
        assert told.kp is None or told.kp.max() < 1e-9
        assert not told.tau.any()
        assert way.lasts < 3.0
