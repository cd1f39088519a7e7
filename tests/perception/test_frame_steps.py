"""A frame becomes ground in some ticks, a part of the work in each: the same ground as all at once."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.model.camera import Camera
from gaitwright.perception.seeing import STEPS, Looked, SeeingGround
from gaitwright.plant.eyes import Eyes
from gaitwright.signals import GroundMap, Measured
from oracles import robot_called
from sights import posed

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
SCENE = load_scene("forest", 3)
SEES = SeeingGround.of(SCENE.bounds, GO2, CAMERA)
EYES = Eyes(CAMERA, SCENE)


def measured(x: float, time: float, looks: bool = True) -> Measured:
    sensed = posed(GO2, SCENE, (x, 0.0), time=time)
    frame = EYES.see(sensed) if looks else None
    return Measured.of_row(sensed.row, time=time, specific_force_b=(0.0, 0.0, 9.81), frame=frame)


@pytest.fixture(scope="module")
def begun() -> Looked:
    _, _, memory = SEES.perceive(measured(0.0, 0.0), None)
    return memory


def same(one: GroundMap, other: GroundMap) -> None:
    np.testing.assert_array_equal(one.footholds.heights, other.footholds.heights)
    np.testing.assert_array_equal(one.footholds.edges, other.footholds.edges)
    assert one.sight is not None and other.sight is not None
    np.testing.assert_array_equal(one.sight.pieces, other.sight.pieces)


def test_the_first_way_is_planned_by_what_the_first_look_shows(begun: Looked) -> None:
    assert begun.ground.sight is not None and begun.looking is None


def test_the_ground_is_another_one_with_the_last_step_and_not_before(begun: Looked) -> None:
    memory, grounds = begun, []
    for tick in range(len(STEPS) + 1):
        _, ground, memory = SEES.perceive(measured(0.2, 0.1 + 0.002 * tick, looks=tick == 0), memory)
        grounds.append(ground)
    *before, told, later = grounds
    assert all(ground is begun.ground for ground in before) and told is not begun.ground and later is told
    same(told, SEES.finished(begun_with(begun, 0.2)).ground)


def begun_with(memory: Looked, x: float) -> Looked:
    """With a frame of which the first step alone is done."""
    _, _, memory = SEES.perceive(measured(x, 0.1), memory)
    assert memory.looking is not None and memory.looking.steps == 1
    return memory


def test_a_frame_that_comes_before_the_last_one_is_done_loses_nothing(begun: Looked) -> None:
    _, hurried, memory = SEES.perceive(measured(0.4, 0.102), begun_with(begun, 0.2))
    calm = SEES.finished(begun_with(begun, 0.2))
    same(hurried, calm.ground)
    same(SEES.finished(memory).ground, SEES.finished(SEES.perceive(measured(0.4, 0.102), calm)[2]).ground)


def test_what_feet_felt_counts_as_of_the_frame(begun: Looked) -> None:
    """It is where the robot was when the frame was taken, and not where it is when the work is done."""
    memory = begun_with(begun, 0.2)
    assert memory.looking is not None
    assert memory.looking.sensed.time == 0.1
    late = replace(measured(0.3, 0.104), frame=None)
    same(SEES.finished(SEES.perceive(late, memory)[2]).ground, SEES.finished(memory).ground)


def test_a_frame_of_another_camera_is_refused(begun: Looked) -> None:
    other = Eyes(replace(CAMERA, columns=32), SCENE).see(posed(GO2, SCENE, (0.0, 0.0)))
    wrong = replace(measured(0.0, 0.1), frame=other)
    with pytest.raises(WrongUse, match=r"a frame has \(48, 32\) ranges, and this camera \(48, 64\)"):
        SEES.perceive(wrong, begun)
