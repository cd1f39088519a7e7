"""What the terrain scanner holds, against hulls by Qhull, MuJoCo, each foot lifted in turn, and what came."""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import mujoco
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.state import STANCE
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap, Mind
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.perception.reach_outline import separate
from gaitwright.perception.terrain_preview import (
    AHEAD,
    EVENT,
    LAYOUT,
    SPACING,
    TerrainPreview,
    corners_of,
    critical_feet,
    down_next,
    preview,
    preview_in,
)
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.record.previews import preview_of
from gaitwright.record.scene_of import scene_for
from gaitwright.session import Session
from gaitwright.signals import Gait, GroundMap, Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import bare_world, put, robot_called

RUNS = (
    ("go2", "flat", "trot", 0.0, ""),
    ("go2", "stairs", "walk", 1.2, ""),
    ("go2", "slope:-8", "pronk", 0.0, ""),
    ("go2", "stairs", "trot", 1.0, "camera"),
    ("thesis", "rough", "walk", 0.0, ""),
    ("hexapod", "rough", "tripod", 0.0, ""),
    ("hexapod", "flat", "wave", 0.0, "camera"),
)
"""Robot, scene, skill, x of the start in body heights of a dog, and how the ground is known."""
EVERY, SECONDS = 30, 1.6


class Moment(NamedTuple):
    robot: Robot
    lap: Lap
    mind: Mind
    held: TerrainPreview


@cache
def run(name: str, ground: str, skill: str, x: float, sight: str) -> tuple[Moment, ...]:
    """Moments of a run in physics."""
    robot = robot_called(name)
    scene = scene_for(robot, ground, 1)
    scene = replace(scene, start=(scene.start[0] + x, *scene.start[1:]))
    camera = Camera.for_robot(robot) if sight else None
    chooser = fixed_skill(robot, skill, None, 0.0, None, "numerical")
    plant = MujocoPlant(robot, scene)
    session = Session(
        Brain.of(robot, scene, chooser, camera=camera),
        SeeingPlant(plant, camera, scene) if camera else plant,
        Mission(()),
        SECONDS * math.sqrt(robot.height / 0.3),
        1,
    )
    laps = ((lap, session.mind) for lap in session)
    return tuple(
        Moment(robot, lap, mind, preview_of(robot, lap, mind))
        for k, (lap, mind) in enumerate(laps)
        if k % EVERY == 0
    )


@pytest.fixture(scope="module", params=RUNS, ids=[" ".join(map(str, run)) for run in RUNS])
def moments(request) -> tuple[Moment, ...]:
    return run(*request.param)


def hull_by_others(points: np.ndarray) -> shapely.Geometry:
    """By GEOS."""
    return shapely.convex_hull(shapely.multipoints(points))


def same_polygon(corners: np.ndarray, points: np.ndarray) -> None:
    """The corners are those of the convex hull of some points, anticlockwise."""
    expected = hull_by_others(points)
    if len(corners) < 3:
        assert expected.area < 1e-9
        assert shapely.hausdorff_distance(shapely.multipoints(corners), shapely.multipoints(points)) < 1e-9
        return
    assert shapely.symmetric_difference(shapely.polygons(corners), expected).area < 1e-12
    assert shapely.is_ccw(shapely.linearrings(corners))


# --- (1) to (4), (7) -------------------------------------------------------------------------------
def test_feet_and_centre_of_gravity_are_where_mujoco_has_them(moments):
    model, data = bare_world(moments[0].robot)
    for robot, lap, _, held in moments:
        seen = lap.sensed
        put(data, seen.position_w, seen.orientation_wb, np.zeros(3), np.zeros(3), seen.q, 0.0 * seen.qd)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        soles = data.site_xpos[: robot.n] - np.outer(robot.foot_radius, [0.0, 0.0, 1.0])
        np.testing.assert_allclose(held.feet_w, soles, atol=1e-9 * robot.height)
        np.testing.assert_allclose(held.centre_w, data.subtree_com[0, :2], atol=1e-9 * robot.height)


def test_supporting_feet_carry_the_robot(moments):
    for robot, lap, _, held in moments:
        share = lap.sensed.load / (robot.total_mass * GRAVITY)
        assert (share[held.supporting] > 0.02).all() and (share[~held.supporting] <= 0.02).all()


def test_the_polygons_are_hulls_of_the_feet_that_are_down_or_lowered(moments):
    for _, _, _, held in moments:
        same_polygon(corners_of(held.lowered_w), held.feet_w[:, :2])
        if held.supporting.any():
            same_polygon(corners_of(held.support_w), held.feet_w[held.supporting, :2])
        else:
            assert np.isnan(held.support_w).all() and math.isnan(held.margin)


def test_the_margin_is_the_distance_from_the_rim_and_negative_outside(moments):
    for robot, _, _, held in moments:
        if not held.supporting.any():
            continue
        support = hull_by_others(held.feet_w[held.supporting, :2])
        centre = shapely.points(held.centre_w)
        if support.area > 0.0 and support.contains(centre):
            assert held.margin == pytest.approx(support.exterior.distance(centre), abs=1e-9 * robot.height)
        else:
            assert held.margin <= 0.0 and -held.margin <= support.distance(centre) + 1e-9 * robot.height


def test_pitch_and_roll_are_the_angles_of_the_bodys_axes_with_the_level(moments):
    for _, lap, _, held in moments:
        model, data = mujoco.mju_quat2Mat, np.empty(9)
        model(data, lap.sensed.orientation_wb)
        forward, left = data.reshape(3, 3).T[:2]
        assert held.pitch == pytest.approx(-math.asin(forward[2]), abs=1e-9)
        assert math.sin(held.roll) * math.cos(held.pitch) == pytest.approx(left[2], abs=1e-9)
        assert held.yaw == pytest.approx(math.atan2(forward[1], forward[0]), abs=1e-9)


# --- (3) what comes --------------------------------------------------------------------------------
def test_feet_that_swing_are_to_land_where_the_gait_says(moments):
    seen = 0
    for robot, lap, mind, held in moments:
        state = mind.memories.gait.state
        swings = state.mode != STANCE
        soles = state.foothold - np.outer(robot.foot_radius, [0.0, 0.0, 1.0])
        np.testing.assert_array_equal(held.footholds_w[swings], soles[swings])
        assert np.isnan(held.footholds_w[~swings]).all()
        down = down_next(float(lap.target.phase), mind.memories.gait.gait)
        same = np.where(swings[:, None], soles, held.feet_w)[down, :2]
        if down.any():
            same_polygon(corners_of(held.coming_w), same)
        seen += int(swings.sum())
    assert seen > 5


@given(
    st.floats(0.0, 0.999),
    st.floats(0.3, 1.0),
    st.lists(st.integers(0, 99), min_size=4, max_size=8),
    st.data(),
)
def test_what_is_down_next_is_what_a_clock_finds(phase, duty, hundredths, data):
    gait = Gait("any", 1.0, duty, tuple(k / 100 for k in hundredths))

    def down(at: float) -> np.ndarray:
        return (at + np.array(gait.offsets)) % 1.0 < duty

    step = 1e-4
    now = down(phase)
    at = phase
    while (down(at) == now).all() and at < phase + 1.0:
        at += step
    if duty == 1.0:
        assert down_next(phase, gait).all()
        return
    # Events that are nearer to the moment asked about than the clock's step may fall to either side.
    either = {tuple(down(at + EVENT + k * step)) for k in (-2, -1, 0, 1, 2)}
    assert tuple(down_next(phase, gait)) in either


def test_the_coming_polygon_comes():
    """Go2 trots on the flat: where its feet touch down they were seen to land 0.06 s before."""
    moments = run("go2", "flat", "trot", 0.0, "")
    robot, off = moments[0].robot, []
    for before, after in pairwise(moments):
        lands = np.isfinite(before.held.footholds_w[:, 0]) & after.held.supporting
        off += np.linalg.norm(
            before.held.footholds_w[lands, :2] - after.held.feet_w[lands, :2], axis=1
        ).tolist()
    assert len(off) > 8 and max(off) < 0.12 * robot.height, off


def test_without_a_gait_nothing_is_said_of_what_comes():
    _, lap, mind, held = run("go2", "flat", "trot", 0.0, "")[3]
    alone = preview(robot_called("go2"), lap.sensed, mind.ground)
    assert np.isnan(alone.coming_w).all() and np.isnan(alone.footholds_w).all()
    np.testing.assert_array_equal(alone.support_w, held.support_w)


# --- (6) critical feet -----------------------------------------------------------------------------
def test_a_foot_is_critical_if_and_only_if_the_robot_tips_without_it(moments):
    for _, _, _, held in moments:
        for leg in range(len(held.critical)):
            others = held.supporting & (np.arange(len(held.critical)) != leg)
            stands = others.sum() > 2 and hull_by_others(held.feet_w[others, :2]).covers(
                shapely.points(held.centre_w)
            )
            assert held.critical[leg] == (held.supporting[leg] and not stands)


@given(st.integers(0, 2**32 - 1), st.integers(4, 8))
def test_feet_drawn_at_random_are_critical_as_lifting_them_says(seed, legs):
    rng = np.random.default_rng(seed)
    feet, down, centre = rng.normal(size=(legs, 2)), rng.random(legs) < 0.7, 0.4 * rng.normal(size=2)
    found = critical_feet(feet, down, centre)
    for leg in range(legs):
        others = down & (np.arange(legs) != leg)
        area = hull_by_others(feet[others]) if others.sum() > 2 else shapely.Polygon()
        assert found[leg] == (down[leg] and not area.covers(shapely.points(centre)))


# --- (5) and the ground ahead ----------------------------------------------------------------------
def test_where_a_foot_stands_it_reaches(moments):
    for robot, lap, _, held in moments:
        firm = lap.sensed.load > 0.1 * robot.total_mass * GRAVITY
        for leg in np.flatnonzero(firm):
            area = shapely.union_all([shapely.polygons(ring) for ring in separate(held.reach_w[leg])])
            near = robot.leg_length / 10
            assert area.distance(shapely.points(held.feet_w[leg, :2])) < near, robot.legs[leg]


def test_slope_and_height_ahead_are_those_of_the_ground(moments):
    known = 0
    for robot, _, mind, held in moments:
        for leg, (x, y, _) in enumerate(held.feet_w):
            samples = []
            for k in range(round(AHEAD / SPACING) + 1):
                s = k * SPACING * robot.height
                place = x + s * math.cos(held.yaw), y + s * math.sin(held.yaw)
                samples.append((s, float(mind.ground.elevation.height(*place))))
            told = [(s, z) for s, z in samples if s <= AHEAD * robot.height * 1.04 and not math.isnan(z)]
            if len(told) < 3:
                assert math.isnan(held.slope[leg]) and math.isnan(held.elevation[leg])
                continue
            slope, _ = np.polyfit(*np.array(told).T, 1)
            assert held.slope[leg] == pytest.approx(math.atan(slope), abs=1e-6)
            assert held.elevation[leg] == pytest.approx(np.mean([z for _, z in told]), abs=1e-6)
            known += 1
    assert known > 20


def test_on_a_slope_the_ground_ahead_has_its_slope():
    scene = load_scene("slope:10")
    for _, _, mind, held in run("go2", "slope:10", "walk", 0.0, ""):
        ahead = held.position_w[0] + 0.3, held.position_w[1]
        n = np.asarray(scene.surface.normal(*ahead))
        uphill = -(n[0] * math.cos(held.yaw) + n[1] * math.sin(held.yaw)) / n[2]
        np.testing.assert_allclose(np.tan(held.slope), uphill, atol=1e-6)
        assert mind.ground.elevation is not None and abs(uphill) > 0.1


def test_of_ground_that_is_not_known_nothing_is_said():
    moment = run("go2", "flat", "trot", 0.0, "")[2]

    class Half:
        """Known for x below a line."""

        def __init__(self, line: float) -> None:
            self.line = line

        def height(self, x, y):
            return np.where(np.asarray(x) + 0.0 * np.asarray(y) < self.line, 0.0, np.nan)

    def held_with(elevation) -> TerrainPreview:
        ground = GroundMap(moment.mind.ground.bounds, (), elevation, moment.mind.ground.footholds, 0.1)
        return preview(moment.robot, moment.lap.sensed, ground)

    front, hind = moment.held.feet_w[0, 0], moment.held.feet_w[2, 0]
    half = held_with(Half(0.5 * (front + hind)))
    assert np.isnan(half.slope[:2]).all() and np.isfinite(half.slope[2:]).all()
    assert np.nanmax(half.reach_w[..., 0]) < 0.5 * (front + hind) + moment.robot.leg_length / 20
    step = SPACING * moment.robot.height
    for samples, told in ((2, False), (3, True)):
        few = held_with(Half(front + (samples - 0.5) * step))
        assert (math.isfinite(few.slope[0]), math.isfinite(few.elevation[0])) == (told, told)
    assert np.isnan(held_with(None).reach_w).all() and np.isnan(held_with(None).elevation).all()


def test_with_a_camera_more_is_known_of_the_ground_as_it_walks_and_only_of_what_was_seen():
    moments = run("go2", "stairs", "trot", 1.0, "camera")
    for _, _, mind, held in moments:
        for outline in held.reach_w:
            for ring in separate(outline):
                inside = shapely.polygons(ring).representative_point()
                assert math.isfinite(float(mind.ground.elevation.height(inside.x, inside.y)))
    assert np.isfinite(moments[-1].held.slope[:2]).all()


# --- rows ------------------------------------------------------------------------------------------
def test_a_preview_survives_its_row(moments):
    held = moments[-1].held
    for before, after in zip(held, preview_in(LAYOUT.pack(held)), strict=True):
        np.testing.assert_array_equal(before, after)


def test_a_preview_changes_nothing(moments):
    robot, lap, mind, held = moments[-1]
    row, memory = lap.sensed.row.copy(), mind.memories.gait.row.copy()
    again = preview_of(robot, lap, mind)
    np.testing.assert_array_equal(row, lap.sensed.row)
    np.testing.assert_array_equal(memory, mind.memories.gait.row)
    for one, other in zip(held, again, strict=True):
        np.testing.assert_array_equal(one, other)
