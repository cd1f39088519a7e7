"""A robot with a camera on its back, in a world of which it is told nothing."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from gaitwright.control.numerical import idle
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.perception.seeing import STEPS
from gaitwright.plant.faults import FaultyPlant
from gaitwright.plant.imperfections import NOISE
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session, record
from gaitwright.signals import GroundMap, Mission
from oracles import robot_called

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
WALL = Scene("wall", Flat(), (Box(2.0, 0.3, 0.0, 0.4, 1.4, 0.6),), (-3.0, -4.0, 7.0, 4.0))


def seeing(
    scene: Scene, goal: tuple[float, float], camera: Camera = CAMERA, seconds: float = 30.0
) -> Session:
    plant = SeeingPlant(MujocoPlant(GO2, scene), camera, scene)
    return Session(Brain.of(GO2, scene, camera=camera), plant, Mission((goal,)), seconds, 1)


def test_frames_come_at_the_cameras_rate_and_the_first_before_the_start() -> None:
    plant = SeeingPlant(MujocoPlant(GO2, WALL), replace(CAMERA, rate=25.0), WALL)
    had = [plant.reset(0).frame is not None]
    had += [plant.step(idle(GO2)).frame is not None for _ in range(60)]
    assert list(np.flatnonzero(had)) == [0, 20, 40, 60]


def test_the_same_seed_sees_the_same_and_another_one_other_noise() -> None:
    noisy = replace(CAMERA, noise=0.02, dropouts=0.3)
    plant = SeeingPlant(MujocoPlant(GO2, WALL), noisy, WALL)
    first, again, other = (plant.reset(seed, vary=False).frame for seed in (1, 1, 2))
    assert first is not None and again is not None and other is not None
    np.testing.assert_array_equal(first.ranges, again.ranges)
    assert not np.array_equal(first.ranges, other.ranges, equal_nan=True)


def test_a_camera_looks_from_where_the_robot_is_whatever_its_sensors_say() -> None:
    sound = SeeingPlant(MujocoPlant(GO2, WALL), CAMERA, WALL).reset(1)
    faulty = FaultyPlant(MujocoPlant(GO2, WALL), GO2, (), NOISE["legged-gym"])
    told = SeeingPlant(faulty, CAMERA, WALL).reset(1)
    assert not np.array_equal(told.row, sound.row)
    assert told.frame is not None and sound.frame is not None
    np.testing.assert_array_equal(told.frame.ranges, sound.frame.ranges)


def test_feet_stand_on_what_was_seen_or_felt_and_nothing_else_is_known() -> None:
    session = seeing(WALL, (5.0, 0.0))
    ground = session.mind.ground
    x, y, spacing = ground.footholds.place

    def is_open(at_x: float, at_y: float) -> bool:
        return bool(ground.footholds.edges[round((at_y - y) / spacing), round((at_x - x) / spacing)] == 0.0)

    place = session.measured.position_w[:2]
    assert all(is_open(*(place + foot[:2])) for foot in GO2.nominal_feet), "it stands on its feet"
    assert is_open(0.6, 0.0) and not is_open(1.8, 0.3), "open ground is seen, the wall's foot is an edge"
    assert not is_open(2.45, 0.3) and not is_open(-1.5, 0.0), "nothing is known behind the wall, or behind it"
    assert ground.obstacles == () and ground.elevation is not None
    assert np.isnan(ground.elevation.height(-2.0, 0.0)) and ground.bounds == WALL.bounds


def test_between_two_frames_the_map_is_the_same() -> None:
    session = seeing(WALL, (5.0, 0.0))
    maps: list[GroundMap] = []
    for _ in range(101):
        session.step()
        maps.append(session.mind.ground)
    done = len(STEPS)  # a frame is in the map after so many ticks
    assert len({id(one) for one in maps[done:]}) in (2, 3)
    assert maps[done] is maps[40] and maps[done] is not maps[100]


def test_edges_that_are_seen_are_those_of_what_stands_there() -> None:
    session = seeing(WALL, (5.0, 0.0), seconds=6.0)
    record(session)
    pieces = session.mind.memories.navigator.known.pieces
    outline = shapely.Polygon(WALL.boxes[0].corners()).exterior
    away = [shapely.hausdorff_distance(shapely.LineString(p.reshape(2, 2)), shapely.intersection(
        outline, shapely.LineString(p.reshape(2, 2)).buffer(0.1))) for p in pieces]  # fmt: skip
    assert (
        len(pieces) >= 2
        and max(outline.distance(shapely.Point(p[k : k + 2])) for p in pieces for k in (0, 2)) < 0.04
    )
    assert len(away) == len(pieces)


@pytest.mark.parametrize("camera", [CAMERA, replace(CAMERA, noise=0.02, dropouts=0.3)])
def test_it_walks_around_a_wall_that_it_was_not_told_of(camera: Camera) -> None:
    recording = record(seeing(WALL, (4.0, 0.0), camera))
    assert recording.arrived, recording.stopped_because
    path = shapely.LineString(recording["position_w"][:, :2])
    assert path.distance(shapely.Polygon(WALL.boxes[0].corners())) > 0.15
    assert path.length > 4.1


def test_what_is_moved_into_the_way_is_seen_and_walked_around() -> None:
    aside = Box(2.6, 3.0, 0.0, 0.4, 1.0, 0.5)
    scene = Scene("aside", Flat(), (aside,), (-3.0, -4.0, 7.0, 4.0))
    session = seeing(scene, (4.0, 0.0))
    while session.measured.time < 1.0:
        session.step()
    assert session.mind.route.path == ((4.0, 0.0),)
    there = replace(aside, y=0.2)
    session.rearrange(replace(scene, boxes=(there,)))
    assert session.mind.route.path == ((4.0, 0.0),), "nobody told it"
    recording = record(session)
    assert recording.arrived, recording.stopped_because
    assert (
        shapely.LineString(recording["position_w"][:, :2]).distance(shapely.Polygon(there.corners())) > 0.15
    )


def test_stairs_are_climbed_as_far_as_they_are_seen() -> None:
    recording = record(seeing(load_scene("stairs:0.08"), (3.5, 0.0)))
    assert recording.arrived, recording.stopped_because
    assert recording["position_w"][:, 2].max() > GO2.height + 0.3


def test_a_goal_that_is_shut_in_is_said_to_be() -> None:
    walls = [(3.0, 1.0, 0.0), (3.0, -1.0, 0.0), (2.0, 0.0, math.pi / 2), (4.0, 0.0, math.pi / 2)]
    boxes = tuple(Box(x, y, yaw, 2.2, 0.1, 0.6) for x, y, yaw in walls)
    recording = record(seeing(Scene("shut", Flat(), boxes, (-3.0, -4.0, 7.0, 4.0)), (3.0, 0.0), seconds=90.0))
    assert recording.stopped_because == "there is no way to the goal: to (3, 0) leads no way"
    assert not recording.fell
