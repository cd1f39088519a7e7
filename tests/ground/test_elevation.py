"""Ground as feet see it: no plane has an edge, every step has one, and heights are the scene's."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gaitwright.ground.elevation import (
    EDGE,
    MARGIN,
    edges,
    elevation_grid,
    height_at,
    is_known,
    nearest,
)
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Pyramid
from gaitwright.ground.terrain import STEEPEST, Box, Flat
from oracles import robot_called

DOG = robot_called("dog")
STEP = EDGE * DOG.height


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
def test_a_plane_has_no_edge_but_where_it_is_too_steep_to_stand_on(a: float, b: float) -> None:
    x, y = 0.02 * np.arange(12), 0.02 * np.arange(10)
    rise = max(abs(a), abs(b), abs(a + b) / math.sqrt(2.0), abs(a - b) / math.sqrt(2.0))
    assume(abs(rise - STEEPEST) > 1e-6)
    assert (edges(a * x[None, :] + b * y[:, None], STEP, 0.02) == float(rise > STEEPEST)).all()


@given(st.floats(1.05, 5.0), st.sampled_from([-1.0, 1.0]), st.booleans())
def test_every_step_has_one_on_both_sides(times: float, sign: float, along: bool) -> None:
    heights = np.zeros((9, 20))
    heights[:, 10:] = sign * times * STEP
    found = edges(heights if along else heights.T.copy(), STEP, 0.02)
    found = found if along else found.T
    columns = np.flatnonzero(found.all(axis=0))
    assert columns.tolist() == list(range(10 - MARGIN, 10 + MARGIN))


def test_heights_are_the_scenes() -> None:
    scene = load_scene("rough:0.05", seed=3)
    grid = elevation_grid(scene, DOG)
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-3.0, 9.0, 200), rng.uniform(-3.0, 3.0, 200)
    mine = [height_at(grid, a, b) for a, b in zip(x, y, strict=True)]
    np.testing.assert_allclose(mine, scene.height(x, y), atol=0.012)
    x_min, y_min, spacing = grid.place
    all_y, all_x = (np.arange(n) * spacing for n in grid.heights.shape)
    for a, b in zip(x, y, strict=True):
        assert nearest(grid, a, b) == (np.abs(y_min + all_y - b).argmin(), np.abs(x_min + all_x - a).argmin())


@pytest.mark.parametrize("name", ["flat", "slope:12", "cross-slope:-8"])
def test_a_plane_needs_no_grid(name: str) -> None:
    assert not is_known(elevation_grid(load_scene(name), DOG))


def test_a_field_too_wide_for_a_grid_is_walked_blind() -> None:
    far = tuple(Box(side * 490.0, side * 490.0, 0.0, 1.0, 1.0, 0.1) for side in (-1.0, 1.0))
    wide = Scene("wide", Flat(), far, (-500.0, -500.0, 500.0, 500.0))
    assert not is_known(elevation_grid(wide, DOG))


def test_no_foot_stands_at_the_rim_of_a_block() -> None:
    scene = Scene("one", Flat(), (Box(1.0, 0.0, 0.3, 0.6, 0.6, 0.1),), (-1.0, -2.0, 3.0, 2.0))
    grid = elevation_grid(scene, DOG)
    x, y = scene.boxes[0].corners().T
    assert all(grid.edges[nearest(grid, *corner)] == 1.0 for corner in zip(x, y, strict=True))
    assert grid.edges[nearest(grid, 1.0, 0.0)] == grid.edges[nearest(grid, 0.2, 0.0)] == 0.0


WIDE, NARROW = (-100.0, -100.0, 100.0, 100.0), (-4.0, -4.0, 6.0, 4.0)


@pytest.mark.parametrize(
    "scene",
    [
        Scene("a box in a wide field", Flat(), (Box(3.0, 1.0, 0.4, 0.5, 0.8, 0.06),), WIDE),
        Scene("a pyramid", Flat(), (), NARROW, shapes=(Pyramid(3.0, 1.0, 0.0, 0.8, 0.8, 0.06),)),
    ],
    ids=lambda scene: scene.name,
)
def test_what_stands_on_a_plane_is_known_to_feet(scene: Scene):
    ground = elevation_grid(scene, DOG)
    for x, y in ((3.0, 1.0), (2.9, 1.1), (1.0, 1.0), (5.0, -2.0), (3.0, 3.0)):
        assert height_at(ground, x, y) == pytest.approx(float(scene.height(x, y)), abs=0.004)
