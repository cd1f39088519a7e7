"""The simulated camera against MuJoCo's rays, and against geometry worked out by hand."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat, Slope
from gaitwright.model.camera import Camera
from gaitwright.numerics.geometry import rotation
from gaitwright.plant.eyes import Eyes
from gaitwright.plant.facets import MOST_CELLS, facets_of
from gaitwright.plant.mujoco.depth import depth_frame
from gaitwright.plant.mujoco.simulation import MujocoPlant
from oracles import robot_called
from sights import crowd, posed

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)


def both(scene: Scene, place=(0.0, 0.0), angles=(0.0, 0.0, 0.0)) -> tuple[np.ndarray, np.ndarray, float]:
    """Ranges of our camera and of MuJoCo's at a place, and the side of a cell [m]."""
    plant, sensed = MujocoPlant(DOG, scene), posed(DOG, scene, place, angles)
    plant.data.qpos[:3], plant.data.qpos[3:7] = sensed.position_w, sensed.orientation_wb
    mujoco.mj_forward(plant.model, plant.data)
    eyes = Eyes(CAMERA, scene)
    return eyes.see(sensed).ranges, depth_frame(plant.world, CAMERA).ranges, float(eyes.facets.place[2])


# The share of rays that may be more than a cell's diagonal off: those that just miss or meet a block's rim.
@pytest.mark.parametrize(
    "scene, share",
    [
        (crowd(20), 0.002),
        (crowd(200), 0.01),
        (crowd(2000), 0.025),
        (load_scene("blocks", seed=1), 0.005),
        (load_scene("stairs"), 0.001),
        (load_scene("gap"), 0.001),
        (load_scene("rough:0.05", seed=2), 0.003),
        (load_scene("slope:12"), 0.0),
        (load_scene("cross-slope:9"), 0.0),
        (load_scene("flat"), 0.0),
    ],
    ids=lambda value: value.name if isinstance(value, Scene) else "",
)
@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (0.1, -0.15, 0.7)], ids=["level", "turned"])
def test_rays_end_where_mujocos_do(scene, share, angles):
    ours, theirs, cell = both(scene, angles=angles)
    seen = np.isfinite(ours) & np.isfinite(theirs)
    assert (np.isfinite(ours) != np.isfinite(theirs)).mean() <= share + 0.001
    assert seen.sum() > 2000
    assert (np.abs(ours - theirs)[seen] > 1.5 * cell).mean() <= share


@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-3.0, 3.0), st.floats(-0.3, 0.3))
def test_on_a_plane_ranges_are_exact(pitch, cross, yaw, roll):
    scene = Scene("plane", Slope(pitch, cross), (), (-2.0, -2.0, 2.0, 2.0))
    sensed = posed(DOG, scene, (0.0, 0.0), (roll, 0.0, yaw))
    R_wb = rotation(sensed.orientation_wb)
    eye, rays = CAMERA.eye(sensed.position_w, R_wb), CAMERA.rays @ R_wb.T
    normal = scene.normal(0.0, 0.0)
    wanted = -(eye @ normal) / (rays @ normal)
    wanted[(wanted <= 0.0) | (wanted > CAMERA.range)] = np.nan
    ranges = Eyes(replace(CAMERA, range=CAMERA.range), scene).see(sensed).ranges.ravel()
    near_limit = np.abs(wanted - CAMERA.range) < 1e-3
    np.testing.assert_allclose(ranges[~near_limit], wanted[~near_limit], atol=2e-4)


def test_what_is_hidden_stays_hidden():
    wall = Box(1.0, 0.0, 0.0, 0.1, 8.0, 1.5)
    with_wall = Scene("wall", Flat(), (wall, Box(1.5, 0.0, 0.0, 0.3, 0.3, 0.3)))
    alone = replace(with_wall, boxes=(wall,))
    sensed = posed(DOG, alone, (0.0, 0.0))
    a, b = (Eyes(CAMERA, scene).see(sensed).ranges for scene in (with_wall, alone))
    np.testing.assert_array_equal(a, b)
    assert np.isfinite(a).all()


def test_a_scene_larger_than_memory_is_drawn_around_the_robot_as_it_walks():
    far = Scene("far", Flat(), (Box(81.0, 0.0, 0.0, 0.2, 2.0, 0.4),), (-400.0, -400.0, 400.0, 400.0))
    eyes = Eyes(CAMERA, far)
    assert eyes.facets.planes.shape[0] * eyes.facets.planes.shape[1] <= 1.1 * MOST_CELLS
    first = eyes.facets
    eyes.see(posed(DOG, far, (0.1, 0.0)))
    assert eyes.facets is first
    ranges = eyes.see(posed(DOG, far, (80.0, 0.0))).ranges
    assert eyes.facets is not first
    small = replace(far, bounds=(76.0, -4.0, 84.0, 4.0))
    np.testing.assert_allclose(
        ranges, Eyes(CAMERA, small).see(posed(DOG, far, (80.0, 0.0))).ranges, atol=0.03
    )


def test_another_arrangement_is_seen_at_once():
    scene = Scene("one", Flat(), (Box(1.0, 0.0, 0.0, 0.3, 0.3, 0.3),))
    eyes, sensed = Eyes(CAMERA, scene), posed(DOG, scene, (0.0, 0.0))
    before = eyes.see(sensed).ranges
    eyes.rearrange(replace(scene, boxes=()))
    assert np.nanmax(eyes.see(sensed).ranges - before) > 0.3


def test_noise_and_dropouts_are_as_set_and_drawn_by_seed_and_tick():
    scene = load_scene("flat")
    camera = replace(CAMERA, noise=0.01, noise_growth=0.004, dropouts=0.3)
    sensed, eyes = posed(DOG, scene, (0.0, 0.0)), Eyes(camera, scene, seed=5)
    true = Eyes(CAMERA, scene).see(sensed).ranges
    frames = np.array([eyes.see(sensed, tick).ranges for tick in range(60)])
    lost = np.isnan(frames[:, np.isfinite(true)])
    assert lost.mean() == pytest.approx(0.3, abs=0.01)
    off = (frames - true) / camera.spread(true)
    assert np.nanmean(off) == pytest.approx(0.0, abs=0.02) and np.nanstd(off) == pytest.approx(1.0, abs=0.02)
    np.testing.assert_array_equal(frames[7], Eyes(camera, scene, seed=5).see(sensed, 7).ranges)
    assert not np.array_equal(frames[7], Eyes(camera, scene, seed=6).see(sensed, 7).ranges, equal_nan=True)


def test_mujocos_camera_has_the_same_imperfections_and_sees_no_leg_of_its_own():
    scene = load_scene("flat")
    plant = MujocoPlant(DOG, scene)
    plant.reset(0, vary=False)
    down = replace(CAMERA, tilt=1.2, mount=(0.0, 0.0, CAMERA.mount[2]))
    clean = depth_frame(plant.world, down).ranges
    heights = CAMERA.mount[2] + DOG.height + (down.rays[:, 2] * clean.ravel())
    assert np.isnan(clean).any() and np.nanmax(np.abs(heights)) < 0.01
    noisy = depth_frame(plant.world, replace(down, noise=0.02, dropouts=0.5), seed=3, tick=4).ranges
    assert np.isnan(noisy).sum() > np.isnan(clean).sum() + 500
    assert np.nanstd(noisy - clean) == pytest.approx(0.02, abs=0.003)


def test_a_relief_goes_beyond_the_bounds_and_its_tiles_hold_their_cells():
    relief = facets_of(crowd(50), (0.0, 0.0), 1.0, 0.02)
    x, y, cell = relief.place
    rows, columns, _ = relief.planes.shape
    assert x <= -8.0 and y <= -8.0 and x + cell * columns >= 8.0 and y + cell * rows >= 8.0
    shape = (*relief.tops.shape, -1)
    tile = rows // relief.tops.shape[0]
    blocks = relief.planes[..., 0].reshape(shape[0], tile, shape[1], tile)
    assert (blocks.max(axis=(1, 3)) <= relief.tops).all()
