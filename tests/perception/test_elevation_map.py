"""The elevation map holds what was hit, where and how sure; it rolls, forgets, unlearns and believes feet."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.numerics.geometry import rotation
from gaitwright.perception.elevation_map import (
    FELT,
    ElevationMap,
    carrying,
    felt,
    fused,
    lowest_points,
    standing,
)
from gaitwright.perception.fusing import FLOOR, HEIGHT, HIGH, LOW, VARIANCE
from gaitwright.plant.eyes import Eyes
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import DepthFrame, MotorCommand, Sensed
from oracles import robot_called
from sights import crowd, footprints, posed, walked

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)
EMPTY = ElevationMap.for_robot(DOG)
NOTHING = DepthFrame(np.full(CAMERA.pixels, np.nan), 0.0)
WALK = np.arange(-1.0, 1.0, 0.04)


def hits_of(frame: DepthFrame, sensed, camera=CAMERA) -> np.ndarray:
    """Where the rays of a frame end `(hits, 3)`, world [m]."""
    R_wb = rotation(sensed.orientation_wb)
    points = camera.eye(sensed.position_w, R_wb) + frame.ranges.reshape(-1, 1) * (camera.rays @ R_wb.T)
    return points[np.isfinite(points).all(axis=1)]


def at(seen: ElevationMap, x: float, y: float) -> np.ndarray:
    """The numbers of the cell at a place."""
    row, column = (math.floor(v / seen.spacing + 0.5) % seen.n for v in (y, x))
    return seen.cells[row, column]


def test_one_frame_makes_known_what_it_hit_and_nothing_else():
    scene = load_scene("slope:15")
    sensed = posed(DOG, scene, (0.3, -0.2), (0.05, -0.1, 0.8))
    frame = Eyes(CAMERA, scene).see(sensed)
    seen = fused(EMPTY, frame, CAMERA, sensed)
    points = hits_of(frame, sensed)
    wanted: dict[tuple[int, int], list[float]] = {}
    for x, y, z in points:
        key = (math.floor(y / seen.spacing + 0.5), math.floor(x / seen.spacing + 0.5))
        wanted.setdefault(key, []).append(z)
    inside = {
        (row, column)
        for row, column in wanted
        if 0 <= row - seen.first[0] < seen.n and 0 <= column - seen.first[1] < seen.n
    }
    rows, columns = np.nonzero(seen.known)
    assert {(r + seen.first[0], c + seen.first[1]) for r, c in zip(rows, columns, strict=True)} == inside
    for row, column in inside:
        height, variance, low, high, time, _ = seen.cells[row % seen.n, column % seen.n]
        z = np.array(wanted[row, column])
        assert z.min() - 1e-5 <= height <= z.max() + 1e-5 and time == 0.0
        assert low <= height <= high and z.min() - 1e-5 <= low and high <= z.max() + 1e-5
        assert 0.0 < variance <= (FLOOR * seen.spacing) ** 2 * 1.001


@pytest.mark.parametrize("boxes, share", [(20, 0.995), (200, 0.99)])
def test_without_noise_cells_of_one_height_are_right_to_a_centimetre(boxes, share):
    scene = crowd(boxes)
    seen, _, _ = walked(DOG, scene, CAMERA, WALK)
    x, y = seen.places()
    inner = np.linspace(-0.5, 0.5, 7) * seen.spacing
    tops = np.array([scene.height(x[None, :] + a, y[:, None] + b) for a in inner for b in inner])
    looked_at = seen.known & (seen.layer(VARIANCE) < 1e-4)  # not only supposed
    one = looked_at & (np.ptp(tops, axis=0) == 0.0)
    assert one.sum() > 10_000
    assert (np.abs(seen.heights - tops[0])[one] <= 0.01).mean() >= share


def test_a_cell_with_an_edge_holds_both_heights():
    # The face stands in the middle of a cell.
    face = 30 * EMPTY.spacing
    scene = Scene("step", Flat(), (Box(face + 1.0, 0.0, 0.0, 2.0, 8.0, 0.09),))
    seen, _, _ = walked(DOG, scene, CAMERA, np.arange(-1.0, 0.3, 0.04))
    column = [at(seen, face, k * seen.spacing) for k in range(-8, 9)]
    assert np.median([cell[HIGH] for cell in column]) == pytest.approx(0.09, abs=0.005)
    assert np.median([cell[LOW] for cell in column]) == pytest.approx(0.0, abs=0.015)
    x, _ = seen.places()
    split = np.flatnonzero(seen.split[seen.n // 2 - 8 : seen.n // 2 + 8].mean(axis=0) > 0.5)
    np.testing.assert_allclose(x[split], face, atol=1.01 * seen.spacing)


@given(st.lists(st.tuples(st.integers(-90, 90), st.integers(-90, 90)), min_size=1, max_size=5))
def test_the_window_rolls_with_the_robot_and_forgets_what_it_leaves(moves):
    rng = np.random.default_rng(len(moves))
    cells = rng.uniform(0.1, 1.0, EMPTY.cells.shape).astype(np.float32)
    seen = replace(EMPTY, cells=cells)
    model = {
        (r + seen.first[0], c + seen.first[1]): seen.cells[
            (r + seen.first[0]) % seen.n, (c + seen.first[1]) % seen.n
        ]
        for r in range(0, seen.n, 7)
        for c in range(0, seen.n, 7)
    }
    x = y = 0.0
    flat = load_scene("flat")
    for dx, dy in moves:
        x, y = x + dx * seen.spacing, y + dy * seen.spacing
        seen = fused(seen, NOTHING, CAMERA, posed(DOG, flat, (x, y)))
        low, high = np.array(seen.first), np.array(seen.first) + seen.n
        assert np.abs(np.array([y, x]) / seen.spacing - (low + high) / 2).max() <= 4.01
        model = {key: cell for key, cell in model.items() if (low <= key).all() and (key < high).all()}
    known = seen.known
    for (row, column), cell in model.items():
        np.testing.assert_array_equal(seen.cells[row % seen.n, column % seen.n], cell)
        assert known[row - seen.first[0], column - seen.first[1]]
    overlap = [max(0, seen.n - abs(now - then)) for now, then in zip(seen.first, EMPTY.first, strict=True)]
    assert known.sum() <= overlap[0] * overlap[1]


def test_maps_are_values():
    scene = load_scene("flat")
    sensed = posed(DOG, scene, (0.0, 0.0))
    before = EMPTY.cells.copy()
    seen = fused(EMPTY, Eyes(CAMERA, scene).see(sensed), CAMERA, sensed)
    felt(seen, footprints(DOG, scene, sensed), 0.02, 0.0)
    np.testing.assert_array_equal(EMPTY.cells, before)
    assert seen.known.sum() > EMPTY.known.sum() == 0


def test_what_went_away_is_unlearned_and_what_is_hidden_is_kept():
    low = Box(1.2, 0.0, 0.0, 0.3, 0.3, 0.3)
    behind = Box(1.9, 0.9, 0.0, 0.3, 0.3, 0.3)
    scene = Scene("both", Flat(), (low, behind))
    seen, _, sensed = walked(DOG, scene, CAMERA, np.arange(-0.5, 0.01, 0.05))
    x, y = seen.places()
    was = np.flatnonzero(np.abs(x - 1.07) < 0.03), np.flatnonzero(np.abs(y) < 0.1)
    assert np.nanmax(seen.heights[np.ix_(was[1], was[0])]) > 0.25
    # One box goes, and a wall is put up that hides the other.
    other = Scene("wall", Flat(), (Box(1.2, 0.9, 0.0, 0.1, 1.0, 0.6),))
    eyes = Eyes(CAMERA, other)
    for k in range(15):
        frame = eyes.see(posed(DOG, other, (0.0, 0.0), time=10.0 + k), k)
        seen = fused(seen, frame, CAMERA, replace(sensed, time=10.0 + k, **_pose(other)))
    assert not np.nanmax(seen.heights[np.ix_(was[1], was[0])]) > 0.02
    rows, columns = np.flatnonzero(np.abs(y - 0.9) < 0.1), np.flatnonzero(np.abs(x - 1.76) < 0.03)
    assert np.nanmax(seen.heights[np.ix_(rows, columns)]) > 0.25


def _pose(scene: Scene) -> dict:
    sensed = posed(DOG, scene, (0.0, 0.0))
    return {"position_w": sensed.position_w, "orientation_wb": sensed.orientation_wb}


def test_what_appears_is_seen_at_once():
    scene = load_scene("flat")
    seen, _, _ = walked(DOG, scene, CAMERA, WALK)
    box = Scene("box", Flat(), (Box(2.0, 0.0, 0.0, 0.4, 0.4, 0.2),))
    sensed = posed(DOG, box, (1.0, 0.0), time=9.0)
    seen = fused(seen, Eyes(CAMERA, box).see(sensed), CAMERA, sensed)
    x, y = seen.places()
    part = np.ix_(np.flatnonzero(np.abs(y) < 0.15), np.flatnonzero(np.abs(x - 1.9) < 0.05))
    assert np.nanmax(seen.heights[part]) == pytest.approx(0.2, abs=0.01)


def test_with_noise_many_looks_are_better_than_one():
    camera, scene = replace(CAMERA, noise=0.02, dropouts=0.3), load_scene("flat")
    sensed, eyes = posed(DOG, scene, (0.0, 0.0)), Eyes(replace(CAMERA, noise=0.02, dropouts=0.3), scene)
    one = many = fused(EMPTY, eyes.see(sensed, 0), camera, sensed)
    for tick in range(1, 30):
        many = fused(many, eyes.see(sensed, tick), camera, sensed)
    both = one.known & many.known
    spread = [float(np.std(seen.heights[both])) for seen in (one, many)]
    assert spread[1] < 0.5 * spread[0]
    assert abs(float(np.mean(many.heights[both]))) < 0.003
    assert many.layer(VARIANCE)[both].mean() < 0.3 * one.layer(VARIANCE)[both].mean()
    # What a cell says of its own doubt is true within a factor of two.
    claimed = math.sqrt(float(one.layer(VARIANCE)[both].mean()))
    assert 0.5 < spread[0] / claimed < 2.0


def test_what_is_old_is_forgotten_if_asked():
    scene, sensed = load_scene("flat"), posed(DOG, load_scene("flat"), (0.0, 0.0))
    frame = Eyes(CAMERA, scene).see(sensed)
    for keep, left in ((5.0, False), (math.inf, True)):
        seen = fused(replace(EMPTY, keep=keep), frame, CAMERA, sensed)
        later = fused(seen, replace(NOTHING, time=4.9), CAMERA, sensed)
        assert later.known.sum() == seen.known.sum() > 500
        assert fused(later, replace(NOTHING, time=5.1), CAMERA, sensed).known.any() == left


# --- feet ------------------------------------------------------------------------------------------
def test_a_foot_that_sank_overrides_what_was_seen_higher():
    scene = load_scene("flat")
    seen, _, _ = walked(DOG, scene, CAMERA, WALK)
    after = felt(seen, np.array([[1.5, 0.1, -0.06]]), 0.03, 7.0)
    assert at(after, 1.5, 0.1)[HEIGHT] == pytest.approx(-0.06, abs=1e-6)
    assert at(after, 1.5, 0.1)[VARIANCE] == pytest.approx(FELT**2, rel=1e-4)
    assert at(after, 1.5, 0.3)[HEIGHT] == pytest.approx(0.0, abs=1e-3)
    changed = (~np.isclose(after.cells, seen.cells, equal_nan=True, rtol=0.0, atol=0.0)).any(axis=2).sum()
    assert 1 <= changed <= math.pi * (0.03 / seen.spacing + 1.0) ** 2


def test_a_foot_on_something_unseen_raises_what_was_seen_lower():
    seen, _, _ = walked(DOG, load_scene("flat"), CAMERA, WALK)
    after = felt(seen, np.array([[1.5, 0.1, 0.08]]), 0.03, 7.0)
    assert at(after, 1.5, 0.1)[HEIGHT] == at(after, 1.5, 0.1)[LOW] == pytest.approx(0.08, abs=1e-6)


def test_a_foot_at_the_rim_of_a_step_leaves_the_ground_beside_it():
    step = Scene("step", Flat(), (Box(2.0, 0.0, 0.0, 1.0, 4.0, 0.1),))
    seen, _, _ = walked(DOG, step, CAMERA, WALK)
    after = felt(seen, np.array([[1.51, 0.0, 0.1]]), 0.03, 7.0)
    assert at(after, 1.47, 0.0)[HEIGHT] == pytest.approx(0.0, abs=0.01)
    assert at(after, 1.53, 0.0)[HEIGHT] == pytest.approx(0.1, abs=0.01)


def test_a_foot_that_agrees_changes_nothing_and_one_far_away_neither():
    seen, _, _ = walked(DOG, load_scene("flat"), CAMERA, WALK)
    after = felt(seen, np.array([[1.5, 0.1, 0.002], [50.0, 0.0, 1.0]]), 0.03, 7.0)
    np.testing.assert_array_equal(after.cells, seen.cells)


def test_feet_that_carry_tell_where_the_ground_is():
    """A robot that settled on a scene in MuJoCo: its lowest points are on the ground, to its own softness."""
    scene = load_scene("rough:0.03", seed=4)
    plant = MujocoPlant(DOG, scene)
    measured = plant.reset(0, vary=False)
    still = np.zeros((DOG.n, 3))
    hold = MotorCommand(still, still, q=measured.q, qd=still, kp=still + 60.0, kd=still + 1.5)
    for _ in range(300):
        measured = plant.step(hold)
    down = carrying(DOG, measured)
    points = lowest_points(DOG, measured)[down]
    assert down.sum() >= 3
    np.testing.assert_allclose(points[:, 2], scene.height(points[:, 0], points[:, 1]), atol=0.006)
    seen = felt(EMPTY, points, float(DOG.foot_radius.max()), measured.time)
    assert seen.known.sum() >= 3
    row = measured.row.copy()
    aloft = Sensed.of_row(row, time=measured.time)
    aloft.load[:] = 0.0
    assert not carrying(DOG, aloft).any()


def test_at_the_start_the_ground_is_what_the_feet_stand_on():
    scene = load_scene("slope:10")
    sensed = posed(DOG, scene, (0.0, 0.0))
    feet = footprints(DOG, scene, sensed)
    seen = standing(DOG, sensed, feet)
    x, y = seen.places()
    known = seen.known
    true = np.asarray(scene.height(x[None, :], y[:, None]))
    np.testing.assert_allclose(seen.heights[known], true[known], atol=2e-3)
    for x_foot, y_foot in feet[:, :2]:
        assert at(seen, x_foot, y_foot)[VARIANCE] < math.inf
    assert not known[:, x > feet[:, 0].max() + 1.1 * DOG.height].any()
    # A look replaces what was only supposed.
    box = Scene("box", Flat(), (Box(0.6, 0.0, 0.0, 0.3, 1.0, 0.05),))
    sensed = posed(DOG, box, (0.0, 0.0))
    supposed = standing(DOG, sensed, footprints(DOG, box, sensed))
    for k in range(3):
        now = posed(DOG, box, (-0.1 * k, 0.0))
        supposed = fused(supposed, Eyes(CAMERA, box).see(now, k), CAMERA, now)
    x, y = supposed.places()
    part = np.ix_(np.flatnonzero(np.abs(y) < 0.1), np.flatnonzero(np.abs(x - 0.6) < 0.1))
    assert np.nanmedian(supposed.heights[part]) == pytest.approx(0.05, abs=0.01)
