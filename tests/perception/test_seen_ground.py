"""The seen ground, for feet and scanner: as the known one where all was seen, harmless where not."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.ground.elevation import EDGE, edges, elevation_grid, is_known
from gaitwright.ground.footholds import FootholdRequest, choose_foothold
from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.perception.elevation_map import ElevationMap, standing
from gaitwright.perception.fusing import VARIANCE
from gaitwright.perception.known_ground import map_of
from gaitwright.perception.scanner import Scanner, carried_on
from gaitwright.perception.seen_ground import SeenElevation, fill, footholds_of, mark_breaks
from gaitwright.signals import Elevation
from oracles import robot_called
from sights import footprints, posed, walked

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)
FINE = replace(CAMERA, rows=96, columns=128)
"""Sees every cell near by."""
WALK = np.arange(-1.0, 1.2, 0.03)


def dilated(mask: np.ndarray, by: int = 1) -> np.ndarray:
    """A mask and all within so many cells of it."""
    out = np.zeros_like(mask)
    wide = np.pad(mask, by)
    rows, columns = mask.shape
    for i in range(2 * by + 1):
        for j in range(2 * by + 1):
            out |= wide[i : i + rows, j : j + columns]
    return out


def beside(mask: np.ndarray) -> np.ndarray:
    """A mask and what lies beside it, in rows and columns."""
    wide = np.pad(mask, 1)
    return mask | wide[:-2, 1:-1] | wide[2:, 1:-1] | wide[1:-1, :-2] | wide[1:-1, 2:]


def holed(outline: list[list[float]]) -> Scene:
    """A plane with one hole, 0.3 m deep."""
    hole = Hole(tuple((x, y) for x, y in outline), 0.3)
    return Scene("holed", dug(Flat(), (hole,)), holes=(hole,))


def stands_in_a_hole(scene: Scene, camera: Camera, xs: np.ndarray) -> float:
    """Share of the hole's places a cell from its rim [-] that feet are told to be ground, after a walk."""
    seen, _, _ = walked(DOG, scene, camera, xs)
    grid, (x, y) = footholds_of(seen), seen.places()
    even = scene.height(x[None, :], y[:, None]) > -0.1
    deep = ~(even | beside(even))
    assert deep.sum() > 12
    return float((grid.edges[deep] < 0.5).mean())


@pytest.mark.parametrize("x", [1.5, 1.507, 1.513, 1.52])
def test_in_a_small_hole_feet_are_told_of_no_ground_up_to_its_rim(x):
    """A square of 13 cm that stands on a corner: rays leave little gaps in its corners."""
    corners = [[x + 0.09, 0.2], [x, 0.29], [x - 0.09, 0.2], [x, 0.11]]
    assert stands_in_a_hole(holed(corners), CAMERA, np.arange(-1.0, 1.6, 0.04)) <= 0.03


@pytest.mark.parametrize("x", [1.2, 1.3, 1.4])
def test_with_noise_a_trench_stays_a_trench(x):
    """10 cm wide, seen with 2 cm of noise and a third of the rays lost: single hits fall into it."""
    trench = [[x, -1.0], [x + 0.1, -1.0], [x + 0.1, 1.0], [x, 1.0]]
    noisy = replace(CAMERA, noise=0.02, dropouts=0.3)
    assert stands_in_a_hole(holed(trench), noisy, np.arange(-0.5, x - 0.3, 0.04)) <= 0.03


@pytest.mark.parametrize("name", ["stairs:0.08", "blocks", "gap:0.15", "rough:0.04", "ramp:15", "boxes:0.06"])
def test_where_all_was_seen_it_is_the_known_ground(name):
    scene = load_scene(name, seed=1)
    seen, _, _ = walked(DOG, scene, FINE, WALK)
    mine, n = footholds_of(seen), seen.n
    (x, y), spacing = (mine.place[0], mine.place[1]), mine.place[2]
    same_nodes = replace(scene, bounds=(x, y, x + (n - 1.5) * spacing, y + (n - 1.5) * spacing))
    known = elevation_grid(same_nodes, DOG)
    np.testing.assert_allclose(known.place, mine.place)
    sure = ~dilated(~(seen.layer(VARIANCE) < 1e-4), 3)  # seen, not only supposed
    assert sure.sum() > 4000
    breaks = dilated(known.edges > 0.5)
    even = sure & ~breaks
    assert (np.abs(mine.heights - known.heights)[even] <= 0.01).mean() >= 0.99
    ours, theirs = mine.edges > 0.5, known.edges > 0.5
    assert (ours & sure <= breaks).mean() >= 0.999  # an edge here is one there, or beside one
    assert (theirs & sure <= dilated(ours)).mean() >= 0.999


def test_noise_breaks_no_even_ground_and_hides_no_step():
    """What lies before the robot after a walk, with 2 cm of noise and a third of the rays lost."""
    noisy = replace(CAMERA, noise=0.02, dropouts=0.3)
    fit = {}
    for name in ("flat", "boxes:0.08"):
        scene = load_scene(name)
        seen, _, _ = walked(DOG, scene, noisy, np.arange(-1.5, 0.8, 0.04))
        grid, (x, y) = footholds_of(seen), seen.places()
        part = np.ix_(np.flatnonzero(np.abs(y) < 0.25), np.flatnonzero((x > 0.8) & (x < 1.5)))
        fit[name] = grid.edges[part] < 0.5
    assert fit["flat"].mean() >= 0.95
    columns = x[(x > 0.8) & (x < 1.5)]
    face = np.abs(columns - 1.2) < 1.01 * seen.spacing
    assert fit["boxes:0.08"][:, face].mean() <= 0.1
    away = np.abs(columns - 1.2) > 4.0 * seen.spacing
    assert fit["boxes:0.08"][:, away & (columns < 1.2)].mean() >= 0.9


def test_on_the_unknown_no_foot_stands_and_nothing_else_comes_of_it():
    scene = load_scene("slope:10")
    sensed = posed(DOG, scene, (0.0, 0.0))
    feet = footprints(DOG, scene, sensed)
    seen = standing(DOG, sensed, feet)
    grid = footholds_of(seen)
    np.testing.assert_array_equal(grid.edges > 0.0, beside(beside(~seen.known)))
    assert np.isfinite(grid.heights).all()
    # No height that was not seen: neither step nor hole comes of it.
    known = grid.heights[seen.known]
    assert known.min() - 1e-9 <= grid.heights.min() and grid.heights.max() <= known.max() + 1e-9
    x, y = float(feet[0, 0]), float(feet[0, 1])
    wish = FootholdRequest(x + 5.0, y, x + 5.0, y, 0.0, 10.0, (0.0, 0.0), DOG.height)
    assert not choose_foothold(grid, wish)[0]
    wish = wish._replace(x=x, y=y, before_x=x, before_y=y, level=float(scene.height(x, y)))
    assert choose_foothold(grid, wish) == (True, x, y)


def test_of_a_map_of_nothing_feet_know_nothing():
    grid = footholds_of(ElevationMap.for_robot(DOG))
    assert is_known(grid) and (grid.edges == 1.0).all() and (grid.heights == 0.0).all()


@given(st.integers(0, 10_000), st.floats(0.02, 0.98))
def test_unknown_nodes_get_a_near_known_height_and_small_gaps_are_bridged(seed, share):
    rng = np.random.default_rng(seed)
    heights = rng.uniform(-1.0, 1.0, (12, 12))
    known = (rng.random((12, 12)) < share).astype(float)
    before, was = np.where(known > 0.0, heights, np.nan), known > 0.0
    filled, now = before.copy(), known.copy()
    hidden = np.zeros((12, 12), np.uint8)
    fill(filled, now, 0.2, False, hidden)
    np.testing.assert_array_equal(filled[was], before[was])
    if was.any():
        near = filled[now == 0.0]
        assert np.isin(near[np.isfinite(near)], before[was]).all()
        nothing = ~was.any(axis=1)[:, None] & ~was.any(axis=0)[None, :]
        np.testing.assert_array_equal(np.isnan(filled), nothing)
    for u, v in zip(*np.nonzero(~was), strict=True):
        reach = {}
        for line, at, axis in ((was[u], v, 0), (was[:, v], u, 1)):
            before_it, after_it = np.flatnonzero(line[:at]), np.flatnonzero(line[at + 1 :])
            if len(before_it) and len(after_it):
                reach[axis] = (at - before_it[-1], after_it[0] + 1)
        bridged = now[u, v] == 1.0
        gaps = [a + b for a, b in reach.values()]
        assert not bridged or min(gaps) <= 2 or (len(gaps) == 2 and max(gaps) <= 3)
        assert (hidden[u, v] == 1) == (not bridged and (not gaps or min(gaps) > 3))
    assert not hidden[was].any()


@given(st.integers(0, 10_000))
def test_breaks_are_those_of_the_known_grid(seed):
    rng = np.random.default_rng(seed)
    heights = np.repeat(rng.uniform(0.0, 0.14, (6, 12)), 2, axis=0)
    mine = np.zeros(heights.shape)
    sure = np.zeros((12, 12, 5), np.float32)
    mark_breaks(heights, np.ones(heights.shape), 0.05, 0.06, mine, sure, (0, 0))
    np.testing.assert_array_equal(mine[2:-2, 2:-2], edges(heights, 0.05, 0.03)[2:-2, 2:-2])


def test_eyes_are_told_what_was_seen_and_nan_elsewhere():
    scene = load_scene("rough:0.04", seed=3)
    seen, _, _ = walked(DOG, scene, FINE, WALK)
    elevation = SeenElevation(seen)
    assert isinstance(elevation, Elevation)
    x, y = np.meshgrid(np.linspace(1.6, 2.2, 20), np.linspace(-0.3, 0.3, 20))
    heights = elevation.height(x, y)
    known = np.isfinite(heights)
    assert known.mean() > 0.9
    assert np.abs(heights - scene.height(x, y))[known].max() < 0.02
    assert np.isnan(elevation.height(np.array([-3.0, 100.0, 1e6]), np.array([0.0, 0.0, -1e6]))).all()


@pytest.mark.parametrize("name", ["stairs:0.08", "ramp:15", "boxes:0.06"])
def test_the_scanner_says_of_it_what_it_says_of_the_known_ground(name):
    scene, eyes = load_scene(name), Scanner.of(DOG)
    seen, _, sensed = walked(DOG, scene, FINE, WALK)
    known = map_of(scene, DOG)
    a = eyes.look(known, sensed.position_w, 0.0)
    b = eyes.look(replace(known, elevation=SeenElevation(seen)), sensed.position_w, 0.0)
    assert a is not None and b is not None
    assert b.slope == pytest.approx(a.slope, abs=0.06) and b.obstacle == a.obstacle
    assert b.step_up == pytest.approx(a.step_up, abs=0.03) and b.gap == a.gap


def test_the_scanner_sees_a_wall_that_was_seen_and_nothing_of_ground_that_was_not():
    scene = Scene("wall", Flat(), (Box(2.5, 0.0, 0.0, 0.4, 4.0, 0.5),))
    seen, _, sensed = walked(DOG, scene, CAMERA, WALK)
    ground = replace(map_of(scene, DOG), elevation=SeenElevation(seen))
    scan = Scanner.of(DOG).look(ground, sensed.position_w, 0.0)
    assert scan is not None and scan.obstacle == pytest.approx(2.3 - sensed.position_w[0], abs=0.1)
    assert Scanner.of(DOG).look(ground, (50.0, 0.0), 0.0) is None


@given(st.integers(0, 10_000))
def test_unknown_ground_goes_on_as_it_was(seed):
    rng = np.random.default_rng(seed)
    heights = rng.uniform(-1.0, 1.0, (3, 9))
    heights[rng.random((3, 9)) < 0.5] = np.nan
    heights[1, 4] = 0.5
    out = carried_on(heights)
    assert np.isfinite(out).all()
    for lane, known in zip(out, heights, strict=True):
        last = None
        for value, seen in zip(lane, known, strict=True):
            assert not np.isfinite(seen) or value == seen
            last = seen if np.isfinite(seen) else last
            assert last is None or value == last


def test_the_law_of_edges_is_the_feets():
    assert ElevationMap.for_robot(DOG).edge == EDGE * DOG.height
