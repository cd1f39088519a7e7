"""The eyes of unknown worlds, beside rays that are cast one by one."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString
from unknown_by_hand import boxes_by_lot, free_places, made

from gaitwright.bench.unknown_worlds.eyes import DROPPED, SIGMA, Camera, blurred, look
from gaitwright.bench.unknown_worlds.world import Point, World
from gaitwright.signals import Sight

CAMERAS = (Camera(), Camera(3.0, 2.0 * math.pi), Camera(6.0, math.pi))
NARROW = math.radians(3.0)
"""Ends seen at a flatter angle than this are not judged: a step beyond them is no step aside [rad]."""


def star(sight: Sight) -> shapely.Geometry:
    """The region seen to be free."""
    parts = shapely.get_parts(shapely.make_valid(shapely.Polygon(sight.free)))
    return shapely.union_all([part for part in parts if part.area > 0.0])  # slits of rounding are lines


def ray(world: World, eye: Point, angle: float, reach: float) -> float:
    """How far a ray gets [m], by shapely alone."""
    end = (eye[0] + reach * math.cos(angle), eye[1] + reach * math.sin(angle))
    hit = shapely.intersection(LineString([eye, end]), world.solid)
    return reach if hit.is_empty else float(shapely.distance(hit, shapely.Point(eye)))


def relative(sight: Sight, point: np.ndarray, heading: float) -> float:
    """Direction of a point from the eye, from the heading [rad]."""
    to = point - np.array(sight.eye)
    return math.remainder(math.atan2(to[1], to[0]) - heading, 2.0 * math.pi)


@given(st.integers(0, 10_000), st.sampled_from(CAMERAS), st.floats(-3.0, 3.0))
def test_the_free_star_ends_where_rays_end(seed: int, camera: Camera, heading: float) -> None:
    world = made(boxes_by_lot(seed, 25))
    (eye,) = free_places(world, seed, 1, 0.05)
    seen = star(look(world, eye, heading, camera))
    for angle in np.linspace(-camera.view / 2.0 + 0.01, camera.view / 2.0 - 0.01, 23):
        far = ray(world, eye, heading + angle, camera.range)
        rim = np.array(eye) + far * np.array([math.cos(heading + angle), math.sin(heading + angle)])
        chord = camera.range * (1.0 - math.cos(0.05)) if far == camera.range else 0.0
        assert shapely.distance(seen.boundary, shapely.Point(rim)) <= chord + 2e-5


@given(st.integers(0, 10_000), st.sampled_from(CAMERAS), st.floats(-3.0, 3.0))
def test_pieces_lie_on_obstacles_and_a_corner_is_where_free_ground_is_seen_beyond(
    seed: int, camera: Camera, heading: float
) -> None:
    world = made(boxes_by_lot(seed, 25))
    (eye,) = free_places(world, seed, 1, 0.05)
    sight = look(world, eye, heading, camera)
    seen, half = star(sight), camera.view / 2.0
    lines = shapely.linestrings(sight.pieces.reshape(-1, 2, 2))
    assert shapely.within(lines, world.solid.boundary.buffer(1e-9)).all()
    assert (shapely.distance(lines, seen) < 1e-9).all()
    for piece, corners in zip(sight.pieces.reshape(-1, 2, 2), sight.corners, strict=True):
        for end, other, is_corner in zip(piece, piece[::-1], corners, strict=True):
            on = (end - other) / np.hypot(*(end - other))
            sight_line = (end - np.array(eye)) / np.hypot(*(end - np.array(eye)))
            is_flat = abs(on[0] * sight_line[1] - on[1] * sight_line[0]) < NARROW
            is_at_rim = half < math.pi and abs(relative(sight, end, heading)) > half - 1e-3
            if is_flat or is_at_rim or np.hypot(*(end - eye)) > camera.range - 1e-2:
                assert not (is_corner and is_at_rim and abs(relative(sight, end, heading)) > half - 1e-9)
                continue
            beyond = shapely.Point(end + 1e-4 * on)
            depth = float(shapely.distance(seen.boundary, beyond))
            if depth > 1e-7:  # else the wall goes straight on there
                assert is_corner == bool(seen.contains(beyond))
            elif depth < 1e-10:
                assert not is_corner


def test_every_visible_stretch_is_in_some_piece() -> None:
    world, camera = made(boxes_by_lot(3, 25)), Camera(6.0, 2.0 * math.pi)
    for eye in free_places(world, 3, 20, 0.05):
        pieces = shapely.union_all(
            shapely.linestrings(look(world, eye, 0.0, camera).pieces.reshape(-1, 2, 2))
        )
        for angle in np.linspace(0.0, 2.0 * math.pi, 60):
            far = ray(world, eye, angle, camera.range)
            hit = shapely.Point(eye[0] + far * math.cos(angle), eye[1] + far * math.sin(angle))
            assert far == camera.range or shapely.distance(pieces, hit) < 1e-6


def test_hidden_ends_and_ends_of_range_and_view_are_no_corners() -> None:
    front, behind = shapely.box(4.0, 9.0, 4.5, 10.2), shapely.box(4.8, 9.7, 5.0, 10.8)
    sight = look(made([front, behind]), (2.5, 10.0), 0.0, Camera(3.0, math.pi))
    found = {
        tuple(np.round(piece, 6)): tuple(ends)
        for piece, ends in zip(sight.pieces, sight.corners, strict=True)
    }
    assert found[4.0, 9.0, 4.0, 10.2] == (True, True)
    (hidden,) = [piece for piece in found if piece[0] == piece[2] == 4.8]
    assert found[hidden] == (False, True) and hidden[3] == 10.8 and 10.2 < hidden[1] < 10.8
    wall = shapely.box(4.0, 5.0, 4.5, 15.0)
    in_view = look(made([wall]), (3.0, 10.0), 0.0, Camera())
    np.testing.assert_allclose(np.sort(in_view.pieces[0, [1, 3]]), [9.0, 11.0], atol=1e-9)
    in_range = look(made([wall]), (3.0, 10.0), 0.0, Camera(3.0, math.pi))
    np.testing.assert_allclose(np.sort(in_range.pieces[0, [1, 3]]), 10.0 + np.array([-1, 1]) * math.sqrt(8.0))
    assert not in_view.corners.any() and not in_range.corners.any()


@pytest.mark.parametrize("apart", [0.0, 1e-9, -1e-9, 0.05])
def test_a_wall_of_boxes_shows_no_corner_in_its_middle(apart: float) -> None:
    wall = [shapely.box(4.0, 8.0 + k, 4.5, 9.0 + k - apart) for k in range(4)]
    sight = look(made(wall), (2.5, 10.1), 0.0, Camera(3.0, math.pi))
    on_wall = np.isclose(sight.pieces[:, 0], 4.0) & np.isclose(sight.pieces[:, 2], 4.0)
    ends, corners = sight.pieces[on_wall][:, [1, 3]], sight.corners[on_wall]
    is_slit = apart > 0.01  # one can look into it
    inner = np.abs(ends - 10.0) < 1.5
    assert corners[~inner].all()
    assert not corners[inner].any() or is_slit
    if not is_slit:
        assert abs(np.abs(np.diff(ends, axis=1)).sum() - 4.0) < 1e-6
        assert not (sight.pieces[:, [0, 2]] > 4.0 + 1e-6).any(), "nothing is seen through a slit of 1 nm"


def test_noise_moves_pieces_as_they_are_and_leaves_some_out() -> None:
    pieces = np.tile([[1.0, 2.0, 3.0, 2.5]], (4000, 1))
    sight = Sight((0.0, 0.0), pieces, np.ones((4000, 2), dtype=bool), np.empty((0, 2)))
    seen = blurred(sight, np.random.default_rng(0))
    assert len(seen.pieces) == len(seen.corners) == pytest.approx(4000 * (1.0 - DROPPED), rel=0.05)
    off = seen.pieces - pieces[0]
    np.testing.assert_allclose(off[:, :2], off[:, 2:], atol=1e-12)
    np.testing.assert_allclose(off[:, :2].std(axis=0), SIGMA, rtol=0.1)
    assert seen.free is sight.free
