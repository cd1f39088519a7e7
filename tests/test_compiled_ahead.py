"""What is compiled ahead of a first run is what the run then finds."""

import subprocess
import sys

import pytest

from gaitwright import compiled_ahead
from gaitwright.control.numerical import tick
from gaitwright.description.load import load_robot
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.perception.watch import look
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import walk
from gaitwright.signals import Mission


def test_the_kernels_are_those_that_a_run_calls():
    robot, scene = load_robot("go2"), load_scene("flat")
    walk(Brain.of(robot, scene), MujocoPlant(robot, scene), Mission(((1.0, 0.0),)), 0.02)
    called = set(tick.signatures), set(look.signatures)
    compiled_ahead.compile_control()
    assert (set(tick.signatures), set(look.signatures)) == called, "other types are another kernel"


def test_where_all_is_compiled_nobody_is_begun(monkeypatch: pytest.MonkeyPatch):
    begun: list[object] = []
    monkeypatch.setattr(subprocess, "Popen", lambda *given, **more: begun.append(given))
    monkeypatch.setattr(compiled_ahead, "is_warm", lambda: True)
    compiled_ahead.begin()
    assert not begun
    monkeypatch.setattr(compiled_ahead, "is_warm", lambda: False)
    monkeypatch.setattr(compiled_ahead, "cores", lambda: 1)
    compiled_ahead.begin()
    assert not begun, "on one core it would only be slower"
    monkeypatch.setattr(compiled_ahead, "cores", lambda: 2)
    compiled_ahead.begin()
    assert begun == [([sys.executable, "-P", "-m", "gaitwright.compiled_ahead"],)]
