"""Where things are over time: by hand, against a plain scene of them, and from files; wrong ones are told."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import BadFile
from gaitwright.ground.moving import Mover, moved
from gaitwright.ground.moving_entries import MOST_MOVERS, entry_of
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.terrain import Box, Slope

BOX = Box(2.0, 0.0, 0.3, 0.5, 0.4, 0.3)
POST = {"type": "cylinder", "x": 1, "y": 1, "radius": 0.2, "height": 0.5}
AROUND = Mover(BOX, ((2.0, 2.0), (4.0, 2.0)), 0.5, begins=2.0, loop=True)
"""2 m up, 2 m along, and √8 m back."""
KINDS = (
    BOX,
    Cylinder(1.0, 2.0, 0.3, 0.4),
    Pyramid(1.0, 2.0, 0.4, 1.0, 0.8, 0.3, 0.3),
    Wedge(1.0, 2.0, 1.0, 0.8, 0.6, 0.3),
    Sphere(1.0, 2.0, 0.5, 0.3),
    Prism(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.2, 0.4)), 0.4),
)


def loaded(folder: Path, **scene) -> Scene:
    path = folder / "yard.json"
    path.write_text(json.dumps(scene))
    return load_scene(str(path))


# --- places over time --------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("time", "place", "velocity"),
    [
        (0.0, (2.0, 0.0), (0.0, 0.0)),
        (1.99, (2.0, 0.0), (0.0, 0.0)),
        (4.0, (2.0, 1.0), (0.0, 0.5)),
        (6.0, (2.0, 2.0), (0.5, 0.0)),
        (8.0, (3.0, 2.0), (0.5, 0.0)),
        (10.0 + math.sqrt(8.0), (3.0, 1.0), (-0.5 / math.sqrt(2), -0.5 / math.sqrt(2))),
        (12.0 + 2 * math.sqrt(8.0), (2.0, 1.0), (0.0, 0.5)),
    ],
)
def test_a_loop_by_hand(time: float, place: tuple, velocity: tuple) -> None:
    assert AROUND.place(time) == pytest.approx(place)
    assert AROUND.velocity(time) == pytest.approx(velocity)


def test_who_does_not_loop_stays_where_its_way_ends() -> None:
    once = Mover(BOX, ((2.0, 1.0),), 0.25)
    assert once.place(2.0) == (2.0, 0.5) and once.velocity(2.0) == (0.0, 0.25)
    assert once.place(4.0) == once.place(1e5) == (2.0, 1.0) and once.velocity(4.0) == (0.0, 0.0)


def test_points_twice_in_a_row_take_no_time() -> None:
    twice = Mover(BOX, ((2.0, 0.0), (2.0, 1.0), (2.0, 1.0), (3.0, 1.0)), 1.0)
    assert twice.place(0.5) == (2.0, 0.5) and twice.place(1.5) == (2.5, 1.0)


def test_what_appears_and_vanishes_is_there_in_between() -> None:
    for_a_time = Mover(BOX, appears=3.0, vanishes=8.0)
    there = [for_a_time.at(time) is not None for time in (0.0, 2.999, 3.0, 7.999, 8.0, 100.0)]
    assert there == [False, False, True, True, False, False]


@given(st.floats(0.0, 60.0))
def test_it_goes_as_fast_as_it_is_said_to(time: float) -> None:
    before, after = AROUND.place(time), AROUND.place(time + 1e-3)
    assert math.dist(before, after) <= 0.5e-3 + 1e-9
    x, y = AROUND.velocity(time)
    if AROUND.stretch(time)[0] == AROUND.stretch(time + 1e-3)[0]:
        assert after == pytest.approx((before[0] + 1e-3 * x, before[1] + 1e-3 * y), abs=1e-9)


@pytest.mark.parametrize("solid", KINDS, ids=lambda one: type(one).__name__)
def test_a_solid_somewhere_else_is_the_same_solid(solid) -> None:
    by = np.array([0.7, -1.3])
    there = moved(solid, (0.7, -1.3))
    np.testing.assert_allclose(there.corners(), solid.corners() + by)
    np.testing.assert_allclose(there.centre, solid.centre + by)
    assert (there.height, there.base) == (solid.height, solid.base)


# --- scenes ------------------------------------------------------------------------------------------
def test_a_scene_in_which_nothing_moves_is_itself_at_any_time() -> None:
    scene = load_scene("forest", 2)
    assert scene.at(0.0) is scene and scene.at(17.0) is scene


def test_at_a_time_a_scene_is_the_plain_one_with_these_things() -> None:
    movers = tuple(Mover(solid, ((4.0, -1.0), (0.5, 0.5)), 0.3, loop=True) for solid in KINDS)
    scene = Scene("busy", Slope(0.1, -0.05), (Box(0.0, 0.0, 0.2, 0.6, 0.6, 0.2),), movers=movers)
    x, y = np.meshgrid(np.linspace(-1.0, 5.0, 121), np.linspace(-2.0, 3.0, 101))
    without = scene.height(x, y)
    for time in (0.0, 3.7, 20.0):
        now = scene.at(time)
        plain = Scene("plain", scene.surface, scene.boxes, shapes=now.things)
        np.testing.assert_array_equal(now.height(x, y), plain.height(x, y))
        np.testing.assert_array_equal(now.normal(x, y), plain.normal(x, y))
        assert (np.asarray(now.height(x, y)) >= without).all() and len(now.solids) == 1 + len(KINDS)
    assert scene.solids == scene.boxes, "by itself it has only what stands there all the time"


def test_a_larger_scene_has_the_same_motion_for_its_size() -> None:
    small, large = load_scene("crossing", 3), load_scene("crossing", 3, scale=4.0)
    for one, other in zip(small.movers, large.movers, strict=True):
        assert other.speed == pytest.approx(2.0 * one.speed)
        assert other.place(2.0 * 7.3) == pytest.approx(4.0 * np.array(one.place(7.3)))


# --- files -------------------------------------------------------------------------------------------
def test_a_file_says_what_moves_appears_and_vanishes(tmp_path: Path) -> None:
    go = {"along": [[2, 2], [4, 2]], "speed": 0.5, "from": 2.0, "loop": True}
    box = {"x": 2, "y": 0, "yaw": 0.3, "lx": 0.5, "ly": 0.4, "height": 0.3}
    prism = {"type": "prism", "outline": [[0, 0], [1, 0], [1, 1]], "height": 0.4}
    scene = loaded(
        tmp_path,
        boxes=[box, {**box, "moves": go}],
        shapes=[POST, {**POST, "appears": 3.0}, {**prism, "vanishes": 8.0, "moves": {**go, "loop": False}}],
    )
    assert scene.boxes == (BOX,) and scene.shapes == (Cylinder(1.0, 1.0, 0.2, 0.5),)
    first, second, third = scene.movers
    assert first == AROUND
    assert second == Mover(Cylinder(1.0, 1.0, 0.2, 0.5), appears=3.0)
    assert (third.vanishes, third.loop) == (8.0, False) and isinstance(third.solid, Prism)


@pytest.mark.parametrize("solid", KINDS, ids=lambda one: type(one).__name__)
def test_a_mover_as_an_entry_is_read_as_itself(tmp_path: Path, solid) -> None:
    mover = Mover(solid, ((0.25, 1.5), (3.0, 3.0)), 0.125, 1.5, True, 0.5, 9.0)
    assert loaded(tmp_path, shapes=[entry_of(mover)]).movers == (mover,)
    brief = Mover(solid, appears=2.0)
    assert loaded(tmp_path, shapes=[entry_of(brief)]).movers == (brief,)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        (
            {"moves": {"along": [[1, 20]], "speed": 1}},
            "shapes[0].moves.along[0] is [1, 20], which lies outside",
        ),
        ({"x": 50, "moves": {"along": [[1, 2]], "speed": 1}}, "shapes[0].moves: it begins at [50, 1], which"),
        ({"moves": {"along": [[1, 1]], "speed": 1}}, "shapes[0] moves along no way: all points of it are"),
        (
            {"moves": {"along": [], "speed": 1}},
            "shapes[0].moves.along is []: expected `array` of length",
        ),
        ({"moves": {"along": [[1, 2]] * 201, "speed": 1}}, "expected `array` of length <= 200"),
        ({"moves": {"along": [[1, 2]], "speed": 0}}, "shapes[0].moves.speed is 0: expected `float` >= 0.001"),
        ({"moves": {"along": [[1, 2]], "speed": 1e3}}, "shapes[0].moves.speed is 1000.0"),
        ({"moves": {"along": [[1, 2]]}}, "missing required field `speed`"),
        ({"moves": {"along": [[1, 2]], "speed": 1, "from": -1}}, "shapes[0].moves.from is -1: expected"),
        ({"moves": {"along": [[1, 2]], "speed": 1, "turns": 1}}, "object contains unknown field `turns`"),
        ({"appears": 5, "vanishes": 5}, "shapes[0] vanishes at 5 s and appears at 5 s: never there"),
        ({"appears": 1e9}, "shapes[0].appears is 1000000000.0: expected `float` <= 100000.0"),
    ],
)
def test_a_wrong_motion_is_told_in_a_sentence(tmp_path: Path, entry: dict, told: str) -> None:
    with pytest.raises(BadFile) as error:
        loaded(tmp_path, shapes=[POST | entry])
    assert told in str(error.value)


def test_a_number_that_is_none_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "yard.json"
    path.write_text('{"shapes": [{"type": "sphere", "x": 1, "y": 1, "radius": 1, "vanishes": NaN}]}')
    with pytest.raises(BadFile, match="not JSON"):
        load_scene(str(path))


def test_there_is_a_limit_to_what_moves(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match="101 things move, appear or vanish, and 100 may"):
        loaded(tmp_path, shapes=[POST | {"appears": 1.0}] * (MOST_MOVERS + 1))
