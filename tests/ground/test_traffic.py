"""The families in which things move: always inside, never near the ends, and harder is more and faster."""

import math

import numpy as np
import pytest

from gaitwright.ground.scene import load_scene
from gaitwright.ground.traffic import CLEAR

NAMES = ("crossing", "plaza")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("difficulty", ["0", "0.5", "1"])
def test_nothing_that_moves_leaves_the_field_or_comes_near_the_ends(name: str, difficulty: str) -> None:
    for seed in range(5):
        scene = load_scene(f"{name}:{difficulty}", seed)
        x_min, y_min, x_max, y_max = scene.bounds
        assert scene.goal is not None and scene.movers and not scene.solids
        for time in np.arange(0.0, 60.0, 0.5):
            for thing in scene.at(float(time)).things:
                x, y = thing.centre
                assert x_min < x < x_max and y_min < y < y_max
                for end in (scene.start[:2], scene.goal):
                    assert math.dist(end, (x, y)) - thing.reach > CLEAR - 0.2


@pytest.mark.parametrize("name", NAMES)
def test_harder_is_more_and_faster(name: str) -> None:
    scenes = [[load_scene(f"{name}:{d}", seed) for seed in range(6)] for d in ("0", "0.5", "1")]
    many = [np.mean([len(scene.movers) for scene in some]) for some in scenes]
    fast = [np.mean([mover.speed for scene in some for mover in scene.movers]) for some in scenes]
    assert many == sorted(many) and many[0] < many[2]
    assert fast == sorted(fast) and fast[0] < fast[2]


def test_in_a_crossing_everything_goes_to_and_fro_across_the_way() -> None:
    scene = load_scene("crossing", 4)
    for mover in scene.movers:
        y = [mover.place(float(time))[1] for time in np.arange(0.0, 60.0, 0.1)]
        assert mover.loop and min(y) < -1.0 and max(y) > 1.0


def test_in_a_plaza_some_come_and_go_before_a_robot_is_there() -> None:
    brief = [mover for mover in load_scene("plaza:1", 4).movers if not mover.along]
    assert len(brief) == 5
    assert all(math.hypot(*mover.path[0]) > mover.appears * 0.9 for mover in brief)
    assert all(math.isfinite(mover.vanishes) for mover in brief)
