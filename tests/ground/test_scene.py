"""Grounds tell their height and normal, scenes come out of seeds and files, wrong input gets a sentence."""

import json
import math
import subprocess
import sys
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from shapely import Point, Polygon, box, unary_union

from gaitwright.errors import BadFile, WrongUse
from gaitwright.ground.layouts import BUILDERS, CLEAR, GOAL, PASSAGE
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.scenes_list import OFFERS, scene_names
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Surface, sampled
from robots_by_hand import dog

RANDOM = np.random.default_rng(0)
FIELD = HeightField(-1.0, -2.0, 0.25, RANDOM.uniform(-0.1, 0.1, (17, 9)))
SURFACES = [Flat(), Slope(0.2, -0.3), FIELD]
DOG = dog()
"""0.29 m high."""
LOW = 0.2 * DOG.height
"""What it steps on without seeing it [m]."""


# --- surfaces ------------------------------------------------------------------------------------
@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: type(s).__name__)
def test_normals_are_the_slope_of_heights(surface: Surface) -> None:
    x, y = RANDOM.uniform(-0.99, 0.99, 500), RANDOM.uniform(-1.99, 1.99, 500)
    tiny = 1e-9
    rise_x = (surface.height(x + tiny, y) - surface.height(x - tiny, y)) / (2 * tiny)
    rise_y = (surface.height(x, y + tiny) - surface.height(x, y - tiny)) / (2 * tiny)
    normal = surface.normal(x, y)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0)
    np.testing.assert_allclose(-normal[:, 0] / normal[:, 2], rise_x, atol=1e-6)
    np.testing.assert_allclose(-normal[:, 1] / normal[:, 2], rise_y, atol=1e-6)


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: type(s).__name__)
def test_places_broadcast_and_single_ones_are_welcome(surface: Surface) -> None:
    x, y = np.linspace(-1, 1, 5)[None, :], np.linspace(-1, 1, 4)[:, None]
    heights, normals = np.asarray(surface.height(x, y)), surface.normal(x, y)
    assert heights.shape == (4, 5) and normals.shape == (4, 5, 3)
    assert float(surface.height(x[0, 2], y[1, 0])) == heights[1, 2]
    np.testing.assert_array_equal(surface.normal(x[0, 2], y[1, 0]), normals[1, 2])


def test_a_slope_rises_ahead_and_to_the_left() -> None:
    assert float(load_scene("slope:10").height(1.0, 5.0)) == pytest.approx(math.tan(math.radians(10)))
    assert float(load_scene("cross-slope:10").height(5.0, 1.0)) == pytest.approx(math.tan(math.radians(10)))


def test_a_field_meets_its_nodes_and_keeps_its_edge() -> None:
    x = FIELD.x_min + FIELD.spacing * np.arange(9)
    y = FIELD.y_min + FIELD.spacing * np.arange(17)
    np.testing.assert_allclose(FIELD.height(x[None, :], y[:, None]), FIELD.heights, atol=1e-12)
    assert FIELD.height(50.0, 0.0) == FIELD.height(FIELD.x_max, 0.0)


def test_a_sampled_plane_is_the_plane() -> None:
    plane = Slope(0.1, 0.2)
    copy = sampled(plane, (-1.0, -1.0, 2.0, 1.0), 0.1)
    x, y = RANDOM.uniform(-1, 2, 100), RANDOM.uniform(-1, 1, 100)
    np.testing.assert_allclose(copy.height(x, y), plane.height(x, y), atol=1e-12)


# --- boxes ---------------------------------------------------------------------------------------
def test_a_box_covers_what_its_corners_span() -> None:
    block = Box(0.3, -0.2, 0.7, 1.0, 0.4, 0.2)
    outline = Polygon(block.corners())
    assert outline.exterior.is_ccw and outline.area == pytest.approx(0.4)
    places = RANDOM.uniform(-1, 1, (500, 2))
    inside = [outline.contains(Point(place)) for place in places]
    np.testing.assert_array_equal(block.covers(*places.T), inside)


def test_a_scene_is_as_high_as_its_highest_thing() -> None:
    low, on_it = Box(0.0, 0.0, 0.0, 1.0, 1.0, 0.1), Box(0.0, 0.0, 0.0, 0.5, 0.5, 0.1, base=0.1)
    scene = Scene("two", Slope(0.1), (low, on_it))
    np.testing.assert_allclose(scene.height(np.array([0.0, 0.4, 2.0]), 0.0), [0.2, 0.1, 2 * math.tan(0.1)])
    np.testing.assert_allclose(scene.normal(0.4, 0.0), [0, 0, 1])
    np.testing.assert_allclose(scene.normal(2.0, 0.0), scene.surface.normal(2.0, 0.0))


@pytest.mark.parametrize("name", ["gap:0.2", "gap:0.6"])
def test_a_floor_made_of_blocks_is_no_obstacle_but_what_stands_on_it_is(name: str) -> None:
    scene = load_scene(name)
    assert scene.obstacles(LOW) == ()
    wall = Box(0.6, 1.0, 0.0, 0.2, 0.2, 0.5 + 0.3)
    assert replace(scene, boxes=(*scene.boxes, wall)).obstacles(LOW) == (wall,)


def test_only_what_is_too_high_to_step_on_is_an_obstacle() -> None:
    low, high = Box(0.0, 0.0, 0.0, 1.0, 1.0, 0.05), Box(3.0, 0.0, 0.0, 1.0, 1.0, 0.07)
    scene = Scene("two", Flat(), (low, high))
    assert scene.obstacles(LOW) == (high,)
    assert scene.obstacles(0.5 * DOG.height) == ()


# --- built-in scenes -----------------------------------------------------------------------------
def test_every_name_has_a_builder_and_a_line() -> None:
    assert list(OFFERS) == list(BUILDERS) == list(scene_names())


def test_the_list_of_scenes_is_cheap() -> None:
    code = (
        "import sys, gaitwright.ground.scenes_list as scenes; scenes.scene_names();"
        "print(*{'numpy', 'mujoco'} & {*sys.modules})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def heights_of(scene: Scene) -> np.ndarray:
    x_min, y_min, x_max, y_max = scene.bounds
    x, y = np.linspace(x_min, x_max, 150), np.linspace(y_min, y_max, 90)
    return np.asarray(scene.height(x[None, :], y[:, None]))


@pytest.mark.parametrize("name", list(OFFERS))
def test_the_same_seed_gives_the_same_scene(name: str) -> None:
    np.testing.assert_array_equal(heights_of(load_scene(name, 5)), heights_of(load_scene(name, 5)))


@pytest.mark.parametrize("name", ["rough", "blocks"])
def test_another_seed_gives_another_scene(name: str) -> None:
    assert np.any(heights_of(load_scene(name, 5)) != heights_of(load_scene(name, 6)))


@pytest.mark.parametrize("name", list(OFFERS))
def test_scale_multiplies_every_length(name: str) -> None:
    np.testing.assert_allclose(
        heights_of(load_scene(name, 2, scale=8.0)), 8.0 * heights_of(load_scene(name, 2)), atol=1e-9
    )


def test_rough_ground_keeps_its_amplitude_and_is_level_at_the_start() -> None:
    scene = load_scene("rough:0.05", 1)
    heights = heights_of(scene)
    assert 0.045 < heights.max() <= 0.05 and -0.05 <= heights.min() < -0.045
    angle = np.linspace(0, 6, 50)
    np.testing.assert_array_equal(scene.height(0.5 * np.cos(angle), 0.5 * np.sin(angle)), 0.0)


def test_stairs_go_up_and_down_by_their_step() -> None:
    profile = load_scene("stairs:0.08").height(np.linspace(-1, 9, 2000), 0.3)
    assert isinstance(profile, np.ndarray)
    steps = np.diff(profile)[np.abs(np.diff(profile)) > 1e-9]
    np.testing.assert_allclose(steps, [0.08] * 5 + [-0.08] * 5)


@pytest.mark.parametrize("seed", range(21))
def test_blocks_always_leave_a_way_around_the_one_in_the_way(seed: int) -> None:
    scene = load_scene("blocks", seed)
    large = [Polygon(block.corners()) for block in scene.obstacles(LOW)]
    small = [block for block in scene.boxes if block.height <= 0.04]
    room = box(*scene.bounds)
    assert len(large) >= 2 and len(small) >= 20 and len(large) + len(small) == len(scene.boxes)
    assert any(outline.intersects(Polygon([(0, 0), GOAL, (3, 0.001)])) for outline in large)
    assert all(a.distance(b) >= PASSAGE for a, b in combinations(large, 2))
    assert all(room.exterior.distance(outline) >= PASSAGE for outline in large)
    assert all(
        Point(end).distance(Polygon(b.corners())) >= CLEAR for b in scene.boxes for end in [(0, 0), GOAL]
    )
    free = room.buffer(-PASSAGE / 2).difference(unary_union(large).buffer(PASSAGE / 2 - 1e-9))
    assert any(
        part.contains(Point(0, 0)) and part.contains(Point(GOAL)) for part in getattr(free, "geoms", [free])
    )


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("moon", "no scene 'moon'; there is: flat, slippery, slope"),
        ("slope:80", "scene 'slope' takes an angle in degrees from -45 to 45, not '80'"),
        ("slope:steep", "not 'steep'"),
        ("slope:nan", "not 'nan'"),
        ("flat:1", "scene 'flat' takes no number, but 'flat:1' gives one"),
    ],
)
def test_a_wrong_name_or_number_is_told(asked: str, told: str) -> None:
    with pytest.raises(WrongUse) as error:
        load_scene(asked)
    assert told in str(error.value)


def test_a_wrong_seed_or_scale_is_told() -> None:
    with pytest.raises(WrongUse, match="a seed is a whole number from 0, not -1"):
        load_scene("blocks", -1)
    with pytest.raises(WrongUse, match="not by nan"):
        load_scene("blocks", scale=math.nan)


# --- scenes from files ---------------------------------------------------------------------------
BLOCK = {"x": 2.0, "y": 0.5, "yaw": 0.3, "lx": 0.5, "ly": 0.4, "height": 0.3}


def written(folder: Path, scene: object) -> str:
    path = folder / "yard.json"
    path.write_text(scene if isinstance(scene, str) else json.dumps(scene))
    return str(path)


def test_a_file_gives_the_scene_it_describes(tmp_path: Path) -> None:
    described = {
        "surface": {"type": "slope", "pitch": 0.1},
        "boxes": [BLOCK],
        "start": [1, 0, 0.5],
        "friction": 0.6,
    }
    scene = load_scene(written(tmp_path, described), seed=4)
    wanted = Scene("yard", Slope(0.1), (Box(**BLOCK),), start=(1.0, 0.0, 0.5), friction=0.6, seed=4)
    assert scene == wanted


def test_a_file_may_hold_heights(tmp_path: Path) -> None:
    surface = {"type": "heights", "x_min": 0, "y_min": 0, "spacing": 1, "heights": [[0, 1, 2], [1, 2, 3]]}
    scene = load_scene(written(tmp_path, {"surface": surface}))
    np.testing.assert_allclose(scene.height(np.array([0.5, 1.5]), np.array([0.0, 1.0])), [0.5, 2.5])


@pytest.mark.parametrize(
    ("scene", "told"),
    [
        ({"boxes": [BLOCK, BLOCK | {"lx": -1}]}, "boxes[1].lx is -1: expected `float` > 0.0"),
        ({"boxes": [BLOCK | {"x": 1e9}]}, "boxes[0].x is 1000000000.0: expected `float` <= 1000.0"),
        ({"boxes": [BLOCK] * 2001}, "expected `array` of length <= 2000"),
        ({"surface": {"type": "sea"}}, "surface.type is 'sea'"),
        ({"wind": 3}, "unknown field `wind`"),
        ({"start": [50, 0, 0]}, "start is [50.0, 0.0, 0.0], which lies outside bounds"),
        ({"bounds": [1, 0, 0, 1]}, "bounds is [1.0, 0.0, 0.0, 1.0]"),
        ('{"friction": 1e999}', "friction is inf: number out of range"),
        ('{"friction": NaN}', "is not JSON"),
        ('{"friction": 0.8', "is not JSON"),
        ("[" * 100_000, "yard.json"),
        (" " * 5_000_001, "is larger than the limit of 5 MB"),
    ],
)
def test_a_file_that_cannot_be_used_is_told(tmp_path: Path, scene: object, told: str) -> None:
    with pytest.raises(BadFile) as error:
        load_scene(written(tmp_path, scene))
    assert told in str(error.value) and "yard.json" in str(error.value)


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match="cannot be read: No such file"):
        load_scene(str(tmp_path / "none.json"))
