"""What moves in a scene moves in every plant, is met there as a thing that goes, and is seen where it is."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from gaitwright.control.numerical import idle
from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder, Prism, Sphere
from gaitwright.ground.terrain import Box, Flat, Slope
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.plant.armstrong.touch_planes import Ground
from gaitwright.plant.eyes import Eyes
from gaitwright.plant.faults import FaultyPlant
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.plant.mujoco.movers import AWAY
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called
from sights import posed

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
BOX = Mover(Box(1.5, -1.0, 0.3, 0.5, 0.4, 0.5), ((1.5, 1.0),), 0.5, loop=True)
POST = Mover(Cylinder(2.0, 1.0, 0.2, 0.6), ((2.0, -1.0),), 0.4, vanishes=3.0)
PRISM = Mover(Prism(((1.0, 1.0), (1.4, 1.0), (1.4, 1.5)), 0.3), ((1.0, 3.0),), 0.3, begins=1.0)
BALL = Mover(Sphere(3.0, 0.0, 0.3, 0.2), ((3.0, 2.0),), 0.3, appears=1.0)
BUSY = Scene("busy", Slope(0.1, 0.05), (Box(2.5, 0.5, 0.2, 0.3, 0.3, 0.4),), movers=(BOX, POST, PRISM, BALL))


def pushing(speed: float) -> Scene:
    """A block that comes from the right, to one who stands at (0, 0)."""
    return Scene("push", Flat(), movers=(Mover(Box(0.0, -1.0, 0.0, 0.6, 0.4, 0.5), ((0.0, 3.0),), speed),))


def standing(scene: Scene, seconds: float) -> Session:
    brain = Brain.of(GO2, Scene("empty", Flat()), fixed_skill(GO2, "stand", 0.0, 0.0, 0.0, "numerical"))
    return Session(brain, MujocoPlant(GO2, scene), Mission(()), seconds, 1)


# --- MuJoCo ------------------------------------------------------------------------------------------
def test_things_are_where_their_scripts_say_and_as_fast() -> None:
    plant = MujocoPlant(GO2, BUSY)
    plant.reset(0)
    for _ in range(2000):
        plant.step(idle(GO2))
        time = plant.data.time
        for k, mover in enumerate(BUSY.movers):
            offset = plant.data.qpos[plant.world.movers.qpos].reshape(-1, 3)[k]
            # put there before a step: what appears, vanishes or turns in it does so a step later
            if not mover.is_there(time - 0.002):
                assert offset[2] == -AWAY
                continue
            np.testing.assert_allclose(offset[:2] + mover.path[0], mover.place(time), atol=1e-3)
            ground = BUSY.surface.height(*mover.place(time)) - BUSY.surface.height(*mover.path[0])
            assert offset[2] == pytest.approx(float(ground), abs=2e-4)
    speed = plant.data.qvel[plant.world.movers.qvel].reshape(-1, 3)[0, :2]
    np.testing.assert_allclose(speed, BOX.velocity(plant.data.time), atol=1e-3)


def test_their_geoms_are_the_scene_of_that_time() -> None:
    plant = MujocoPlant(GO2, BUSY)
    plant.reset(0)
    for _ in range(1000):
        plant.step(idle(GO2))
    now = BUSY.at(plant.data.time)
    x, y = np.random.default_rng(1).uniform((0.5, -1.5), (3.5, 2.5), (200, 2)).T
    down, geom = np.array([0.0, 0.0, -1.0]), np.zeros(1, np.int32)
    group = np.array([1, 1, 1, 1, 1, 1], np.uint8)
    base = plant.world.addresses[0].base
    off = [
        9.0
        - mujoco.mj_ray(plant.model, plant.data, np.array([u, v, 9.0]), down, group, 1, base, geom)
        - float(now.height(u, v))
        for u, v in zip(x, y, strict=True)
        if math.hypot(u, v) > 0.6
    ]
    assert np.mean(np.abs(off) < 2e-3) > 0.98, "all but places at the very rim of a thing"


def test_a_thing_pushes_who_stands_in_its_way_and_is_not_slowed_by_it() -> None:
    session = standing(pushing(0.3), 6.0)
    world, first, place = session.plant.world, None, None
    for lap in session:
        touched = list(world.movers.touching(world.model, world.data, world.addresses[0].base))
        if touched and first is None:
            first, place = lap.sensed.time, lap.sensed.position_w.copy()
        thing = world.data.qpos[world.movers.qpos][1]
        assert thing == pytest.approx(0.3 * world.data.time, abs=1e-4)
    assert session.lap is not None and first is not None and place is not None
    # Its front is at y = -0.8 at first; feet and legs stand some 0.15 m to the right of the middle.
    assert 0.5 / 0.3 < first < 0.75 / 0.3
    assert session.lap.sensed.position_w[1] - place[1] > 0.2


def test_what_does_not_come_near_touches_nothing() -> None:
    aside = Scene("aside", Flat(), movers=(replace(BOX, speed=0.3),))
    session = standing(aside, 3.0)
    world = session.plant.world
    for _ in session:
        assert not list(world.movers.touching(world.model, world.data, world.addresses[0].base))


def test_who_lies_on_a_plate_is_carried_at_its_speed() -> None:
    plate = Scene("plate", Flat(), movers=(Mover(Box(0.0, 0.0, 0.0, 3.0, 3.0, 0.05), ((2.0, 0.0),), 0.3),))
    plant = MujocoPlant(GO2, plate)
    plant.reset(0, vary=False)
    plant.data.qpos[2] += 0.05
    for _ in range(1500):
        plant.step(idle(GO2))
    assert plant.data.qvel[0] == pytest.approx(0.3, abs=0.02)


def test_the_others_are_where_they_were_in_the_numbers_of_a_world() -> None:
    still, moving = MujocoPlant(GO2, load_scene("flat")), MujocoPlant(GO2, pushing(0.3))
    assert moving.model.nq == still.model.nq + 3
    assert moving.world.addresses == still.world.addresses
    np.testing.assert_array_equal(moving.model.body_mass[: still.model.nbody], still.model.body_mass)


def test_far_from_things_a_robot_walks_as_without_them() -> None:
    far = Scene("far", Flat(), movers=(Mover(Cylinder(8.0, 3.0, 0.2, 0.5), ((8.0, 2.0),), 0.3),))
    ends = []
    for scene in (far, Scene("none", Flat())):
        brain = Brain.of(GO2, Scene("empty", Flat()), fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical"))
        session = Session(brain, MujocoPlant(GO2, scene), Mission(()), 2.0, 1)
        for lap in session:
            ends.append(lap.sensed.position_w)
    one, other = np.array(ends[: len(ends) // 2]), np.array(ends[len(ends) // 2 :])
    np.testing.assert_allclose(one, other, atol=2e-3)


def test_a_world_may_be_rearranged_into_one_that_moves() -> None:
    session = standing(Scene("empty", Flat()), 5.0)
    for _ in range(300):
        session.step()
    before = session.measured
    session.rearrange(pushing(0.3))
    after = session.plant.sense()
    np.testing.assert_array_equal(after.q, before.q)
    np.testing.assert_array_equal(after.position_w, before.position_w)
    for _ in session:
        pass
    assert list(session.plant.world.data.qpos[session.plant.world.movers.qpos][:2]) == pytest.approx(
        [0.0, 0.3 * session.plant.data.time], abs=1e-3
    )


# --- the other plants ------------------------------------------------------------------------------
def test_without_mechanics_feet_stand_on_what_has_come_under_them() -> None:
    plate = Mover(Box(-3.0, 0.0, 0.0, 2.0, 2.0, 0.04), ((0.0, 0.0),), 1.0)
    scene = Scene("plate", Flat(), movers=(plate,))
    brain = Brain.of(GO2, Scene("empty", Flat()), fixed_skill(GO2, "stand", 0.0, 0.0, 0.0, "kinematic"))
    session = Session(brain, KinematicPlant(GO2, scene), Mission((), driver="kinematic"), 4.0, vary=False)
    heights = [lap.sensed.position_w[2] for lap in session]
    assert heights[-1] - heights[0] == pytest.approx(0.04, abs=5e-3)


def test_the_thesis_plant_has_things_among_its_planes() -> None:
    at = BUSY.at(2.0)
    ground = Ground.of(at)
    assert len(ground.boxes) == 2, "the box that stands there, and the one that moves"
    places = np.array([[3.0, 0.3, 1.0], [0.0, 0.0, 0.3]])
    planes = ground.planes(places).reshape(2, -1, 6)
    np.testing.assert_allclose(
        planes[:, 0, 2], replace(at, boxes=(), things=at.things[1:]).height(*places.T[:2])
    )


# --- eyes --------------------------------------------------------------------------------------------
@pytest.mark.parametrize("surface", [Flat(), Slope(0.1, 0.05), load_scene("rough:0.03", 1).surface])
def test_frames_and_facets_are_those_of_the_scene_drawn_anew(surface) -> None:
    scene = replace(BUSY, surface=surface)
    eyes = Eyes(CAMERA, scene)
    for time in (0.0, 0.7, 2.5, 3.1, 7.0, 0.3):
        sensed = posed(GO2, scene, (0.0, 0.0), time=time)
        ranges, anew = eyes.see(sensed).ranges, Eyes(CAMERA, scene.at(time))
        np.testing.assert_allclose(ranges, anew.see(sensed).ranges, atol=1e-5)
        np.testing.assert_allclose(eyes.facets.planes, anew.facets.planes, atol=1e-5)
        np.testing.assert_allclose(eyes.facets.tops, anew.facets.tops, atol=1e-5)


def test_what_is_beyond_the_facets_is_drawn_once_the_robot_is_there() -> None:
    far = Mover(Box(200.0, 0.0, 0.0, 0.5, 0.5, 0.5), ((1.0, 0.0),), 10.0)
    wide = Scene("wide", Flat(), bounds=(-400.0, -400.0, 400.0, 400.0), movers=(far,))
    eyes = Eyes(CAMERA, wide)
    eyes.see(posed(GO2, wide, (0.0, 0.0)))
    assert eyes.facets.planes[..., 0].max() == 0.0
    eyes.see(posed(GO2, wide, (0.0, 0.0), time=19.8))
    assert eyes.facets.planes[..., 0].max() == pytest.approx(0.5)


def test_the_range_to_what_comes_nearer_falls_as_it_should() -> None:
    comes = Scene("comes", Flat(), movers=(Mover(Box(3.0, 0.0, 0.0, 0.4, 2.0, 1.0), ((1.5, 0.0),), 0.5),))
    eyes = Eyes(CAMERA, comes)
    for time in (0.5, 1.0, 2.0, 2.5):
        sensed = posed(GO2, comes, (0.0, 0.0), time=time)
        level = eyes.see(sensed).ranges[0, CAMERA.columns // 2]  # the highest ray is nearly level
        face = 3.0 - 0.2 - 0.5 * time
        assert level == pytest.approx(face - CAMERA.mount[0], abs=0.03)


def test_a_plant_with_a_camera_and_one_with_faults_tell_their_scene() -> None:
    plant = MujocoPlant(GO2, BUSY)
    assert SeeingPlant(FaultyPlant(plant, GO2), CAMERA, BUSY).scene is BUSY
    assert FaultyPlant(plant, GO2).scene is BUSY
