"""Outlines of reachable ground: rings around cells, no more corners than there is room for."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from gaitwright.ground.scene import load_scene
from gaitwright.model.reachable import reachable
from gaitwright.numerics.cell_rings import traced
from gaitwright.numerics.geometry import rotation
from gaitwright.perception.reach_outline import RIM, area_in, reach_outlines, rings_of, separate, window
from oracles import robot_called


def rings_by_hand(cells: np.ndarray) -> list[np.ndarray]:
    places, numbers = traced(cells)
    return [places[numbers == k] for k in np.unique(numbers)]


def labelled(cells: np.ndarray, beside: np.ndarray | None = None) -> np.ndarray:
    """The number of its part in each cell."""
    out = np.zeros(cells.shape, dtype=int)
    ndimage.label(cells, beside, output=out)
    return out


def area(ring: np.ndarray) -> float:
    x, y = np.vstack([ring, ring[:1]]).T
    return float(0.5 * (x[:-1] @ y[1:] - x[1:] @ y[:-1]))


@given(st.integers(0, 2**32 - 1), st.floats(0.05, 0.95))
def test_every_part_and_every_hole_has_one_ring_the_cells_on_its_left(seed, share):
    rng = np.random.default_rng(seed)
    cells = rng.random(rng.integers(1, 12, 2)) < share
    rings = rings_by_hand(cells)
    outside = np.pad(~cells, 1, constant_values=True)
    parts = labelled(cells).max()
    gaps = labelled(outside, np.ones((3, 3))).max()  # holes touch each other across corners
    signs = [area(ring) for ring in rings]
    assert sum(sign > 0.0 for sign in signs) == parts
    assert sum(sign < 0.0 for sign in signs) == gaps - 1
    assert len({tuple(place) for ring in rings for place in ring}) == sum(map(len, rings))
    # Through the middles of sides: each convex corner loses an eighth of a cell, each other one gains it.
    for ring in rings:
        steps = np.abs(np.diff(np.vstack([ring, ring[:1]]), axis=0)).sum(axis=1)
        np.testing.assert_allclose(steps, 1.0)


def test_a_single_cell_is_a_diamond_and_cells_that_meet_in_a_corner_are_two():
    (ring,) = rings_by_hand(np.array([[False, True]]))
    np.testing.assert_allclose(ring, [[1.0, -0.5], [1.5, 0.0], [1.0, 0.5], [0.5, 0.0]])
    assert len(rings_by_hand(np.eye(3, dtype=bool))) == 3
    assert not len(traced(np.zeros((4, 5), dtype=bool))[0])


def disc(radius: float, hole: float = 0.0, n: int = 41) -> np.ndarray:
    away = np.hypot(*np.mgrid[-(n // 2) : n // 2 + 1, -(n // 2) : n // 2 + 1])
    return (away <= radius) & (away >= hole)


@pytest.mark.parametrize("radius", [6.0, 10.0, 18.0])
def test_a_disc_is_outlined_to_half_a_cell(radius: float):
    outline = rings_of(disc(radius))
    (ring,) = separate(outline)
    off = np.hypot(*(ring - 20.0).T) - radius
    assert np.abs(off).max() < 1.0 and abs(off.mean()) < 0.5
    assert area_in(outline) == pytest.approx(math.pi * radius**2, rel=0.08)
    np.testing.assert_array_equal(ring[0], ring[-1])


def test_a_hole_is_left_out_and_runs_the_other_way_round():
    outline = rings_of(disc(17.0, 8.0))
    out, hole = separate(outline)
    assert shapely.is_ccw(shapely.linearrings(out)) and not shapely.is_ccw(shapely.linearrings(hole))
    assert area_in(outline) == pytest.approx(math.pi * (17.0**2 - 8.0**2), rel=0.08)


def test_what_is_no_ring_has_no_area():
    outline = np.full((RIM, 2), np.nan)
    outline[[0, 2, 3, 5, 6, 7]] = np.arange(12.0).reshape(6, 2)
    assert not separate(outline) and area_in(outline) == 0.0


def test_whatever_there_is_fits_in_the_rows_there_are():
    rng = np.random.default_rng(1)
    for share in (0.0, 0.02, 0.2, 0.5, 0.8, 0.98, 1.0):
        outline = rings_of(rng.random((60, 60)) < share)
        assert len(outline) <= RIM
        assert all(len(ring) > 3 for ring in separate(outline))
    assert area_in(rings_of(np.ones((60, 60), dtype=bool))) == pytest.approx(3600.0, rel=0.02)


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
@pytest.mark.parametrize("scene", ["flat", "stairs", "rough"])
def test_an_outline_encloses_what_is_reached(name: str, scene: str):
    robot, ground = robot_called(name), load_scene(scene, 1)
    place = np.array([1.7, 0.1, float(ground.height(1.7, 0.1)) + 0.95 * robot.height])
    R_wb, spacing = rotation(np.array([1.0, 0.03, -0.05, 0.2])), robot.leg_length / 20
    x, y = window(robot, place, spacing)
    found = reachable(
        robot, place, R_wb, (x, y), np.array(ground.height(x[None, :], y[:, None]), dtype=float)
    )
    for mask, outline in zip(found, reach_outlines(robot, place, R_wb, ground), strict=True):
        drawn = shapely.polygons([ring for ring in separate(outline) if area(ring) > 0.0])
        inside = shapely.union_all(drawn)
        at = np.asarray(shapely.points(*np.meshgrid(x, y)))
        wide = np.ones((5, 5))
        firm = np.asarray(ndimage.binary_erosion(mask, wide))
        none = np.asarray(ndimage.binary_erosion(~mask, wide, border_value=1))
        assert shapely.contains(inside, at[firm]).all()
        none &= ~np.asarray(ndimage.binary_fill_holes(mask))
        assert not shapely.contains(inside, at[none]).any()
        assert area_in(outline) == pytest.approx(mask.sum() * spacing**2, rel=0.1, abs=4 * spacing**2)
