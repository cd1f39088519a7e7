"""Holes: the ground is lower within their outlines and nowhere else; the deepest counts."""

import numpy as np
import pytest
import shapely

from gaitwright.ground.holes import Hole, Pitted, dug, filled
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Surface

ROUND = Hole(outline_of(regular(1.0, 0.0, 0.5, 20)), 0.3)
TRENCH = Hole(((-2.0, -0.1), (2.0, -0.1), (2.0, 0.2), (-2.0, 0.2)), 0.5)
BENT = Hole(((-2.0, 1.0), (0.0, 1.0), (0.0, 2.0), (-1.0, 1.4), (-2.0, 2.0)), 0.2)
HOLES = (ROUND, TRENCH, BENT)


def depths(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """How deep the floor lies, by shapely."""
    deep = np.zeros(len(x))
    for hole in HOLES:
        deep = np.where(
            shapely.contains_xy(shapely.Polygon(hole.outline), x, y), np.maximum(deep, hole.depth), deep
        )
    return deep


@pytest.mark.parametrize("plane", [Flat(), Slope(0.2, -0.1)])
def test_the_floor_lies_deeper_where_the_outlines_are(plane: Surface, rng: np.random.Generator) -> None:
    x, y = rng.uniform(-3.0, 3.0, (2, 5000))
    pitted = dug(plane, HOLES)
    assert isinstance(pitted, Pitted)
    np.testing.assert_allclose(pitted.height(x, y), plane.height(x, y) - depths(x, y), atol=1e-12)
    np.testing.assert_array_equal(pitted.normal(x, y), plane.normal(x, y))
    assert (depths(x, y) == 0.5).any() and (depths(x, y) == 0.3).any()


def test_nodes_of_a_field_are_lowered() -> None:
    x, y = -3.0 + 0.1 * np.arange(61), -3.0 + 0.1 * np.arange(61)
    field = HeightField(-3.0, -3.0, 0.1, np.sin(x)[None, :] * np.cos(y)[:, None])
    lower = dug(field, HOLES)
    at_x, at_y = (v.ravel() for v in np.meshgrid(x, y))
    clear = (
        np.min(
            [
                shapely.distance(shapely.Polygon(h.outline).exterior, shapely.points(at_x, at_y))
                for h in HOLES
            ],
            axis=0,
        )
        > 1e-6
    )
    gone = (field.heights - lower.heights).ravel()
    np.testing.assert_allclose(gone[clear], depths(at_x, at_y)[clear], atol=1e-12)


@pytest.mark.parametrize(
    "surface", [Flat(), Slope(0.2, -0.1), HeightField(-3.0, -3.0, 0.5, np.arange(169.0).reshape(13, 13))]
)
def test_filled_ground_is_as_before(surface: Surface, rng: np.random.Generator) -> None:
    x, y = rng.uniform(-3.0, 3.0, (2, 500))
    again = filled(dug(surface, HOLES), HOLES)
    np.testing.assert_allclose(again.height(x, y), surface.height(x, y), atol=1e-12)


def test_no_hole_changes_nothing() -> None:
    flat = Flat()
    assert dug(flat, ()) is flat


def test_a_box_stands_on_the_floor_of_the_hole_under_its_centre() -> None:
    scene = Scene("pit", dug(Flat(), (ROUND,)), (Box(1.0, 0.0, 0.0, 0.2, 0.2, 0.5),), holes=(ROUND,))
    assert float(scene.height(1.0, 0.0)) == pytest.approx(0.2)
    assert float(scene.height(1.3, 0.0)) == pytest.approx(-0.3)


@pytest.mark.parametrize(("hole", "wide"), [(ROUND, 0.99), (TRENCH, 0.3)])
def test_a_hole_is_as_wide_as_the_circle_in_it(hole: Hole, wide: float) -> None:
    assert hole.width == pytest.approx(wide, abs=0.02)


def test_wide_deep_holes_are_walked_around_and_narrow_ones_are_not() -> None:
    scene = Scene("pits", dug(Flat(), HOLES), holes=HOLES)
    assert scene.obstacles(0.1) == HOLES
    assert scene.obstacles(0.2) == (ROUND,)  # one is too shallow, and the trench is stepped over
    assert scene.obstacles(0.4) == ()
