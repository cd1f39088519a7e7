"""Scenes of as many boxes as a file may have: heights, maps and ways as with few, and as quick."""

import json
import re
from pathlib import Path
from time import perf_counter

import numpy as np
import pytest

from gaitwright.description.load import load_robot
from gaitwright.errors import BadFile
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Slope
from gaitwright.navigation.known_field import known_field
from gaitwright.navigation.room_needed import half_width
from gaitwright.perception.known_ground import map_of


def test_many_boxes_are_as_high_as_few(rng: np.random.Generator):
    x, y, yaw = rng.uniform(-5.0, 5.0, (3, 300))
    sides = rng.uniform(0.05, 1.5, (300, 3)).tolist()
    boxes = tuple(Box(*place, *size) for place, size in zip(np.transpose([x, y, yaw]), sides, strict=True))
    scene = Scene("yard", Slope(0.1), boxes)
    at_x, at_y = rng.uniform(-6.0, 6.0, (2, 2000))
    one_by_one = [float(scene.height(a, b)) for a, b in zip(at_x[:300], at_y[:300], strict=True)]
    np.testing.assert_array_equal(np.asarray(scene.height(at_x, at_y))[:300], one_by_one)


@pytest.mark.parametrize("height", [0.04, 0.5])
def test_two_thousand_boxes_are_looked_at_in_a_second_or_two(height: float, tmp_path: Path):
    boxes = [
        {"x": 1.0 + 0.5 * (k % 50), "y": 0.5 * (k // 50) - 10.0, "lx": 0.3, "ly": 0.2, "height": height}
        for k in range(2000)
    ]
    (tmp_path / "many.json").write_text(json.dumps({"boxes": boxes, "bounds": [-4, -12, 28, 12]}))
    robot, began = load_robot("go2"), perf_counter()
    scene = load_scene(str(tmp_path / "many.json"))
    ground = map_of(scene, robot)
    assert known_field(ground, half_width(robot)).way((0.0, 0.0), (-2.0, 5.0))
    assert perf_counter() - began < 10.0  # 0.5 s on a machine that does nothing else; 20 s it was


@pytest.mark.parametrize("name", ["friction", "boxes[0].height"])
def test_what_is_too_small_for_physics_is_refused(name: str, tmp_path: Path):
    boxes = [{"x": 1.0, "y": 0.0, "lx": 1.0, "ly": 1.0, "height": 0.1}]
    scene: dict = {"boxes": boxes, "friction": 0.5}
    place = scene if name == "friction" else boxes[0]
    place[name.rpartition(".")[2]] = 5e-324
    (tmp_path / "yard.json").write_text(json.dumps(scene))
    with pytest.raises(BadFile, match=rf"{re.escape(name)} is 5e-324: expected at least 0\.0001"):
        load_scene(str(tmp_path / "yard.json"))
