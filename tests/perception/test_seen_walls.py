"""What a look shows of walls: nothing imagined, nothing near left out, corners told from ends (shapely)."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.perception.edge_runs import SECTORS, kept_points
from gaitwright.perception.elevation_map import ElevationMap, fused
from gaitwright.perception.walls import sight_of
from gaitwright.plant.eyes import Eyes
from gaitwright.signals import Sight
from oracles import robot_called
from sights import crowd, posed, walked

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)
STEP = DOG.step_limit
CELL = ElevationMap.for_robot(DOG).spacing


def sight_at(scene: Scene, x: float, y: float = 0.0, camera: Camera = CAMERA) -> Sight:
    """The last sight of a walk of half a metre that ends at x."""
    seen, frame, sensed = walked(DOG, scene, camera, np.arange(x - 0.5, x + 0.001, 0.05), y)
    return sight_of(seen, frame, camera, sensed, STEP)


def solid(scene: Scene) -> shapely.Geometry:
    """All that is too high to step on."""
    return shapely.union_all([shapely.Polygon(box.corners()) for box in scene.obstacles(STEP)])


def along(sight: Sight) -> np.ndarray:
    """Points on the pieces, a few millimetres from each other."""
    lines = np.asarray(shapely.linestrings(sight.pieces.reshape(-1, 2, 2)))
    return shapely.line_interpolate_point(lines[:, None], np.linspace(0.0, 1.0, 40)[None], normalized=True)


@given(st.integers(0, 1000), st.floats(-3.0, 3.0), st.sampled_from([40, 100, 200]))
@settings(max_examples=12)
def test_every_piece_is_on_an_obstacle_and_none_is_in_what_is_free(seed, x, boxes):
    scene = crowd(boxes, seed)
    sight, truth = sight_at(scene, x), solid(scene)
    if len(sight.pieces):
        ends = shapely.points(sight.pieces.reshape(-1, 2))
        assert shapely.distance(truth, ends).max() <= 1.5 * CELL
        # Off it is only what joins two obstacles that leave no room for a robot between them.
        off = (shapely.distance(truth, along(sight)) > 0.75 * CELL).mean(axis=1)
        length = np.hypot(*(sight.pieces[:, 2:] - sight.pieces[:, :2]).T)
        assert (off * length).max() <= 0.8 * DOG.height + CELL
    free = shapely.Polygon(sight.free)
    assert free.buffer(0.0).intersection(truth.buffer(-2.0 * CELL)).area <= 0.01
    away = np.hypot(*(sight.free - sight.eye).T)
    assert away.max() <= CAMERA.range + 1e-9


def test_nothing_near_is_left_out():
    """Rays by shapely against all that is high: where they end within reach, a piece is near."""
    covered = []
    for seed in range(12):
        scene = crowd(250, seed)
        high = replace(scene, boxes=tuple(box for box in scene.boxes if box.height > STEP))
        sight, truth = sight_at(high, -2.0 + 0.3 * seed), solid(high)
        angles = np.linspace(-0.6, 0.6, 61)
        ends = np.column_stack([np.cos(angles), np.sin(angles)]) * 0.8 * CAMERA.range + sight.eye
        rays = shapely.linestrings([[sight.eye, end] for end in ends])
        cut = [shapely.get_coordinates(part) for part in shapely.intersection(rays, truth)]
        nearest = [part[np.hypot(*(part - sight.eye).T).argmin()] for part in cut if len(part)]
        if nearest:
            hits = shapely.points(nearest)
            pieces = shapely.union_all(shapely.linestrings(sight.pieces.reshape(-1, 2, 2)))
            sector = 2.0 * math.pi / SECTORS * shapely.distance(hits, shapely.Point(sight.eye))
            covered += list(shapely.distance(pieces, hits) <= sector + CELL)
    assert len(covered) > 100 and np.mean(covered) >= 0.95


@pytest.mark.parametrize(
    "name", ["flat", "stairs:0.08", "gap:0.2", "rough:0.04", "ramp:30", "boxes:0.08", "slope:20"]
)
def test_what_can_be_walked_on_is_no_wall(name):
    sight = sight_at(load_scene(name), 0.9)
    assert not len(sight.pieces)
    if name in {"flat", "slope:20", "ramp:30"}:
        assert shapely.Polygon(sight.free).area > 1.0


def test_a_step_too_high_is_a_wall_right_across():
    sight = sight_at(load_scene("boxes:0.15"), 0.0)
    assert len(sight.pieces) and np.abs(sight.pieces[:, [0, 2]] - 1.2).max() < 0.5 * CELL
    assert np.ptp(sight.pieces[:, [1, 3]]) > 1.2
    assert not sight.corners.any()  # the field of view ends it on either side


def dug_out(x: float, wide: float, turned: float = 0.0) -> Scene:
    """A trench right across, 0.5 m deep, whose near bank crosses the x axis at x."""
    c, s = math.cos(turned), math.sin(turned)
    corners = [(0.0, -6.0), (wide, -6.0), (wide, 6.0), (0.0, 6.0)]
    outline = tuple((x + c * a - s * b, c * b + s * a) for a, b in corners)
    holes = [Hole(outline, 0.5)]
    return Scene("trench", dug(Flat(), holes), holes=tuple(holes), bounds=(-8.0, -8.0, 8.0, 8.0))


@pytest.mark.parametrize("turned", [0.0, 0.5, -0.5])
def test_ground_that_ends_is_a_wall_from_near_by(turned):
    scene = dug_out(1.0, 0.8, turned)
    sight = sight_at(scene, 0.3)
    hole = shapely.Polygon(scene.holes[0].outline)
    near = shapely.LineString(np.array(scene.holes[0].outline)[[0, 3]])
    places = sight.pieces.reshape(-1, 2)
    ends = np.asarray(shapely.points(places))
    assert len(sight.pieces) and shapely.distance(near, ends).min() < CELL
    assert shapely.distance(hole, ends).max() <= 2.5 * CELL
    close = ends[np.hypot(*(places - sight.eye).T) < 0.8]
    assert len(close) and shapely.distance(near, close).max() <= 2.5 * CELL
    assert shapely.Polygon(sight.free).buffer(0.0).intersection(hole).area < 0.02, "nobody looks through it"


@pytest.mark.parametrize("turned", [0.0, 0.4, -0.4])
@pytest.mark.parametrize("x", [0.2, 0.45, 0.7])
def test_the_bank_of_what_is_stepped_over_is_none(turned, x):
    sight = sight_at(dug_out(1.0, 0.2, turned), x)
    assert not len(sight.pieces)


@pytest.mark.parametrize("name", ["stairs:0.08", "rough:0.05", "hills:1", "waves:1", "ramp:30"])
def test_ground_that_falls_gently_has_no_brink(name):
    """Down the other way, too: from where it is highest."""
    scene = load_scene(name)
    x = np.arange(0.0, 5.0, 0.05)
    top = float(x[np.argmax(scene.height(x, 0.0))])
    assert not len(sight_at(scene, top).pieces)


def test_ground_lies_on_the_left_of_pieces_and_a_box_shows_its_corners():
    """A box that stands on its corner: two faces, three corners, all with free ground beside them."""
    box = Box(1.2, 0.0, math.pi / 4, 0.4, 0.4, 0.3)
    scene = Scene("one", Flat(), (box,))
    sight = sight_at(scene, 0.0)
    assert len(sight.pieces) == 2 and sight.corners.all()
    near = (1.2 - 0.2 * math.sqrt(2.0), 0.0)
    np.testing.assert_allclose(sight.pieces[0, 2:], near, atol=CELL)
    np.testing.assert_array_equal(sight.pieces[0, 2:], sight.pieces[1, :2])
    for x0, y0, x1, y1 in sight.pieces:
        assert (x1 - x0) * (sight.eye[1] - y0) - (y1 - y0) * (sight.eye[0] - x0) > 0.0
    assert np.hypot(*(sight.pieces[:, 2:] - sight.pieces[:, :2]).T).min() > 0.3


def test_where_something_nearer_covers_it_an_end_is_no_corner():
    wall, post = Box(1.8, 0.0, 0.0, 0.2, 3.0, 0.4), Box(1.0, -0.25, 0.0, 0.1, 0.2, 0.6)
    sight = sight_at(Scene("covered", Flat(), (wall, post)), 0.0)
    ends = sight.pieces.reshape(-1, 2, 2)
    covered = (ends[..., 0] > 1.5) & (np.abs(ends[..., 1]) < 1.2)
    assert covered.sum() == 2 and not sight.corners[covered].any()
    nearer = ends[..., 0] < 1.1
    assert nearer.sum() >= 2 and sight.corners[nearer].all()


def test_an_inner_corner_is_none():
    boxes = (Box(1.8, 0.0, 0.0, 0.2, 3.0, 0.4), Box(1.35, 0.8, 0.0, 0.7, 0.2, 0.4))
    sight = sight_at(Scene("inner", Flat(), boxes), 0.0, -0.2)
    inner = np.hypot(sight.pieces[:, [0, 2]] - 1.7, sight.pieces[:, [1, 3]] - 0.7) < 0.15
    assert inner.any() and not sight.corners[inner].any()


def test_one_frame_into_an_empty_map_shows_walls_at_a_distance():
    scene = Scene("far", Flat(), (Box(2.6, 0.2, 0.2, 0.3, 1.0, 0.4),))
    sensed = posed(DOG, scene, (0.0, 0.0))
    frame = Eyes(CAMERA, scene).see(sensed)
    seen = fused(ElevationMap.for_robot(DOG), frame, CAMERA, sensed)
    sight = sight_of(seen, frame, CAMERA, sensed, STEP)
    assert np.hypot(*(sight.pieces[:, 2:] - sight.pieces[:, :2]).T).sum() > 0.7
    assert shapely.distance(solid(scene), along(sight)).max() < CELL


def test_with_noise_pieces_stay_near():
    camera = replace(CAMERA, noise=0.02, dropouts=0.3)
    scene = Scene("noisy", Flat(), (Box(1.6, 0.1, 0.3, 0.4, 0.8, 0.35),))
    sight, truth = sight_at(scene, 0.0, camera=camera), solid(scene)
    off = shapely.distance(truth.boundary, along(sight))
    assert np.hypot(*(sight.pieces[:, 2:] - sight.pieces[:, :2]).T).sum() > 0.5
    assert np.median(off) < 0.02 and off.max() < 0.08


def test_a_look_at_nothing_shows_nothing():
    flat = load_scene("flat")
    sensed, empty = posed(DOG, flat, (0.0, 0.0)), ElevationMap.for_robot(DOG)
    frame = replace(Eyes(CAMERA, flat).see(sensed), ranges=np.full(CAMERA.pixels, np.nan))
    sight = sight_of(empty, frame, CAMERA, sensed, STEP)
    assert sight.pieces.shape == (0, 4) and sight.corners.shape == (0, 2) and sight.free.shape == (0, 2)


@given(st.integers(0, 10_000), st.integers(2, 30), st.floats(0.01, 0.5))
def test_chords_keep_within_what_is_asked_and_no_more_points_than_shapely(seed, count, bent):
    line = np.cumsum(np.random.default_rng(seed).uniform(-0.3, 1.0, (count, 2)), axis=0)
    kept = np.empty(count, dtype=bool)
    kept_points(line, count, bent, kept)
    simple = shapely.LineString(line).simplify(bent, preserve_topology=False)
    assert kept[0] and kept[-1]
    assert abs(kept.sum() - len(simple.coords)) <= 2
    chords = shapely.LineString(line[kept])
    assert shapely.distance(chords, shapely.points(line)).max() <= bent + 1e-9
