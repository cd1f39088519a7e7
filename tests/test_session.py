"""A run can be stepped, paused and steered: every change takes effect, and none that is not made."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain, Lap
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session, record, scene_for, walk
from gaitwright.signals import Measured, Mission, MotorCommand
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")
FLAT = load_scene("flat")


def trotting(seconds: float = 2.0, seed: int = 3, speed: float = 0.4) -> Session:
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", speed, 0.0, 0.0, ""))
    return Session(brain, MujocoPlant(GO2, FLAT), Mission(()), seconds, seed)


def going(scene: Scene, goal: tuple[float, float], seconds: float = 30.0) -> Session:
    return Session(Brain.of(GO2, scene), MujocoPlant(GO2, scene), Mission((goal,)), seconds, 1)


def places(session: Session, ticks: int) -> np.ndarray:
    """Where the base was, for so many ticks."""
    laps = [session.step() for _ in range(ticks)]
    return np.array([lap.sensed.position_w for lap in laps if lap])


def test_stepping_and_walking_are_the_same_run() -> None:
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical"))
    walked = walk(brain, MujocoPlant(GO2, FLAT), Mission(()), 1.0, seed=3)
    stepped = trotting(1.0)
    places_seen = places(stepped, len(walked))
    np.testing.assert_array_equal(places_seen, walked["position_w"])
    assert stepped.is_over and stepped.step() is None


def test_a_pause_changes_nothing_but_the_wall_clock() -> None:
    straight, halting = trotting(), trotting()
    halting.step()
    halting.paused = True
    before = halting.lap
    assert halting.step() is None and halting.lap is before and list(halting) == []
    assert halting.plant.data.ctrl.any(), "a pause is no end: the motors keep what they were told"
    halting.paused = False
    np.testing.assert_array_equal(places(straight, 300)[1:], places(halting, 299))


def test_a_new_mission_is_gone_on_with_from_where_the_robot_is() -> None:
    session = going(FLAT, (6.0, 0.0))
    there = places(session, 700)[-1]
    session.give(Mission(((float(there[0]), 1.2),)))
    assert session.mind.route.path == ((float(there[0]), 1.2),)
    recording = record(session)
    assert recording.arrived, recording.stopped_because
    assert math.dist(recording["position_w"][-1, :2], (there[0], 1.2)) < 0.15 * GO2.body_length


def test_another_driver_computes_the_torques_from_the_next_step_on() -> None:
    session = trotting()
    places(session, 100)
    session.drive("kinematic")
    lap = session.step()
    assert lap is not None and lap.call.driver == "kinematic" and "servo" in lap.command.status
    session.drive("numerical")
    lap = session.step()
    assert lap is not None and lap.command.status == "solved" and lap.command.forces_w.any()
    with pytest.raises(WrongUse, match=r"no driver 'numeric'.*did you mean 'numerical'"):
        session.drive("numeric")


def test_a_push_is_its_impulse_in_its_direction_at_its_time() -> None:
    calm, pushed = trotting(), trotting()
    pushed.push(Push(0.4, 90.0, at=0.6))
    forces = []
    for _ in range(500):
        calm.step()
        lap = pushed.step()
        assert lap is not None
        forces.append((lap.sensed.time, *pushed.plant.data.xfrc_applied[1, :3]))
    table = np.array(forces)
    size = np.linalg.norm(table[:, 1:], axis=1)
    assert size.sum() * DT == pytest.approx(0.4 * GO2.total_mass, rel=0.02)
    assert table[np.flatnonzero(size)[0], 0] == pytest.approx(0.6, abs=DT)
    yaw = heading(rotation(pushed.measured.orientation_wb))
    left = np.array([-math.sin(yaw), math.cos(yaw)])
    gained = pushed.measured.position_w[:2] - calm.measured.position_w[:2]
    assert left @ gained > 0.02, "it was pushed to the left, and the calm one was not"
    with pytest.raises(WrongUse, match="not negative"):
        Push(-1.0, 0.0, at=0.0)


def test_an_obstacle_moved_into_the_way_is_walked_around_and_the_robot_stays_where_it_is() -> None:
    aside = Box(2.0, 3.0, 0.0, 0.5, 0.8, 0.4)
    scene = Scene("yard", Flat(), (aside,), (-2.0, -5.0, 6.0, 5.0))
    session = going(scene, (4.0, 0.0))
    before = places(session, 500)[-1]
    assert len(session.mind.route.path) == 1, "nothing is in the way yet"
    here = session.measured
    session.rearrange(replace(scene, boxes=(replace(aside, y=0.0),)))
    assert len(session.mind.route.path) > 1
    after = session.plant.sense()
    np.testing.assert_array_equal(after.q, here.q)
    np.testing.assert_array_equal(after.position_w, here.position_w)
    recording = record(session)
    assert recording.arrived, recording.stopped_because
    clear = np.hypot(recording["position_w"][:, 0] - 2.0, recording["position_w"][:, 1])
    assert before[0] < 1.6 and clear.min() > 0.3, "it went around"


def test_a_scene_is_in_the_robots_size() -> None:
    thesis = robot_called("thesis")
    assert scene_for(GO2, "blocks").bounds == load_scene("blocks").bounds
    assert scene_for(thesis, "blocks").bounds == load_scene("blocks", scale=9.0).bounds


class Telephone:
    """A robot that is no simulation: it has the two methods of a plant and no more."""

    dt = DT

    def __init__(self) -> None:
        self.plant = MujocoPlant(GO2, FLAT)

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        return self.plant.reset(seed, vary)

    def step(self, command: MotorCommand) -> Measured:
        return self.plant.step(command)


def test_a_real_robot_walks_but_cannot_be_pushed_from_here() -> None:
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, ""))
    session = Session(brain, Telephone(), Mission(()), 0.2, seed=3)
    with pytest.raises(WrongUse, match="a Telephone is no simulation"):
        session.push(Push(0.1, 0.0, at=0.1))
    assert record(session).stopped_because == "the 0.2 s asked for are over"


@pytest.mark.parametrize("error", [KeyboardInterrupt(), SystemError("a result with an exception set")])
def test_ctrl_c_keeps_what_was_recorded_also_where_it_meets_a_kernel(error: BaseException) -> None:
    if isinstance(error, SystemError):
        error.__cause__ = SystemError("another around it")
        error.__cause__.__cause__ = KeyboardInterrupt()

    def watch(lap: Lap) -> None:
        if lap.sensed.time > 0.05:
            raise error

    recording = record(trotting(), watch=watch)
    assert recording.stopped_because == "interrupted" and 20 < len(recording) < 30


def test_another_system_error_is_none_of_the_users() -> None:
    def watch(lap: Lap) -> None:
        raise SystemError("something else")

    with pytest.raises(SystemError, match="something else"):
        record(trotting(), watch=watch)
