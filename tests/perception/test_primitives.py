"""Things on the ground are taken for what they are, with their numbers and their doubt."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from gaitwright.bench.evidence.lone_things import KINDS, lone
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat, Slope
from gaitwright.model.camera import Camera
from gaitwright.perception.elevation_map import ElevationMap
from gaitwright.perception.primitives import UNKNOWN, label, recognised
from oracles import robot_called
from sights import walked

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)
NOISY = replace(CAMERA, noise=0.02, dropouts=0.3)
WALK = np.arange(-0.6, 0.6, 0.05)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [2, 3])
def test_each_kind_is_recognised_with_its_numbers(kind, seed):
    scene, true = lone(kind, seed)
    (thing,) = recognised(walked(DOG, scene, CAMERA, WALK)[0])
    assert thing.kind == kind and thing.cells > 50
    assert math.hypot(thing.numbers["x"] - true["x"], thing.numbers["y"] - true["y"]) < 0.03
    assert thing.numbers["height"] == pytest.approx(true["height"], abs=0.03)
    if "radius" in thing.numbers:
        assert thing.numbers["radius"] == pytest.approx(true["radius"], abs=0.03)
    else:
        sides = sorted(abs(thing.numbers[side]) for side in ("lx", "ly"))
        np.testing.assert_allclose(sides, sorted([true["lx"], true["ly"]]), atol=0.06)
    assert thing.numbers.keys() == thing.spread.keys()
    assert 0.0 < thing.spread["height"] < 0.02 and thing.spread["x"] < 0.02


@pytest.mark.parametrize("kind", KINDS)
def test_with_noise_and_drop_outs_most_are_recognised_still(kind):
    found = [recognised(walked(DOG, lone(kind, seed)[0], NOISY, WALK)[0])[0].kind for seed in range(4)]
    assert found.count(kind) >= 3


def test_what_is_no_primitive_is_not_taken_for_one():
    cross = tuple(Box(1.3, 0.0, yaw, 0.6, 0.12, 0.3) for yaw in (0.3, 0.3 + 0.5 * math.pi))
    (thing,) = recognised(walked(DOG, Scene("cross", Flat(), cross), CAMERA, WALK)[0])
    assert thing.kind == UNKNOWN and thing.numbers["height"] == pytest.approx(0.3, abs=0.02)
    assert math.hypot(thing.numbers["x"] - 1.3, thing.numbers["y"]) < 0.1


def test_several_things_are_several_on_a_slope_too():
    slope = Slope(math.radians(8.0))
    boxes = (Box(1.3, 0.5, 0.3, 0.3, 0.3, 0.15), Box(1.4, -0.4, 0.0, 0.2, 0.4, 0.2))
    things = recognised(walked(DOG, Scene("two", slope, boxes), CAMERA, WALK)[0])
    assert len(things) == 2
    places = sorted((thing.numbers["y"], thing.numbers["x"]) for thing in things)
    np.testing.assert_allclose(places, [(-0.4, 1.4), (0.5, 1.3)], atol=0.06)


def test_the_far_side_of_what_was_seen_from_the_front_is_in_doubt():
    """Higher than the camera: its depth was not seen, and it is not claimed to be known."""
    tall = Scene("tall", Flat(), (Box(1.6, 0.0, 0.0, 0.6, 0.5, 1.2),))
    (thing, *_) = recognised(walked(DOG, tall, CAMERA, WALK)[0])
    front = Scene("low", Flat(), (Box(1.6, 0.0, 0.0, 0.6, 0.5, 0.2),))
    (seen, *_) = recognised(walked(DOG, front, CAMERA, WALK)[0])
    assert seen.kind == "box" and abs(seen.numbers["x"] - 1.6) < 0.03
    assert thing.kind == UNKNOWN or abs(thing.numbers["x"] - 1.6) > 0.05


@pytest.mark.parametrize(
    "seen", [ElevationMap.for_robot(DOG), walked(DOG, load_scene("slope:10"), CAMERA, WALK)[0]]
)
def test_of_nothing_nothing_is_made(seen):
    assert recognised(seen) == ()


@given(st.integers(0, 10_000), st.floats(0.05, 0.6), st.integers(1, 3))
def test_things_are_those_of_scipy(seed, share, near):
    mask = np.random.default_rng(seed).random((15, 17)) < share
    mine = np.zeros(mask.shape, np.int64)
    count = label(mask, near, mine)
    graph = np.argwhere(mask)
    apart = np.abs(graph[:, None] - graph[None]).max(axis=2) <= near
    labels = np.arange(len(graph))
    for _ in range(len(graph)):
        new = np.where(apart, labels[None], len(graph)).min(axis=1) if len(graph) else labels
        if (new == labels).all():
            break
        labels = new
    assert count == len(set(labels)) == mine.max(initial=0)
    for one in set(labels):
        assert len(set(mine[tuple(graph[labels == one].T)])) == 1
    if near == 1:
        of_scipy = np.zeros(mask.shape, np.int64)
        ndimage.label(mask, np.ones((3, 3)), of_scipy)
        assert count == of_scipy.max()
