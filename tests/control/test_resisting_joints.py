"""Robots whose joints resist a great deal walk as others do: what is in the file is known."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.bench.trial import beyond_limits, held
from gaitwright.description.load import load_robot
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.recording import Recording
from gaitwright.session import Session, record
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill


def trip(damping: float, friction: float, skill: str, speed: float, seconds: float) -> Recording:
    """A trip of a Go2 whose every joint resists so much [N·m·s/rad, N·m]."""
    robot, scene = load_robot("go2"), load_scene("flat")
    ones = np.ones((robot.n, 3))
    robot = replace(robot, damping=damping * ones, friction=friction * ones)
    brain = Brain.of(robot, scene, fixed_skill(robot, skill, speed, 0.0, 0.0, "numerical"))
    return record(Session(brain, MujocoPlant(robot, scene), Mission(()), seconds, seed=3), 3, "flat")


@pytest.mark.parametrize(("damping", "friction"), [(1.0, 0.2), (0.1, 1.5), (0.0, 0.0)])
@pytest.mark.parametrize(("skill", "speed"), [("trot", 0.4), ("walk", 0.25)])
def test_it_holds_its_speed(damping: float, friction: float, skill: str, speed: float) -> None:
    recording = trip(damping, friction, skill, speed, 6.0)
    assert not recording.fell, recording.stopped_because
    assert held(recording) == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("skill", "speed"), [("gallop", 1.7), ("rotary-gallop", 1.4), ("rack", None)])
def test_fast_legs_keep_off_their_stops(skill: str, speed: float | None) -> None:
    robot, scene = load_robot("go2"), load_scene("flat")
    brain = Brain.of(robot, scene, fixed_skill(robot, skill, speed, 0.0, None, "numerical"))
    recording = record(Session(brain, MujocoPlant(robot, scene), Mission(()), 4.0, seed=1), 1, "flat")
    assert not recording.fell, recording.stopped_because
    assert beyond_limits(recording) < 1.0
