"""Who sees tells by itself what moves: how fast, from when on, and nothing of what stands."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.model.kinematics import angles
from gaitwright.perception.seeing import STEPS, SeeingGround
from gaitwright.perception.seen_moving import HELD, LOOKS, Watched, told_apart
from gaitwright.plant.eyes import Eyes
from gaitwright.signals import GroundMap, Measured, Sight
from oracles import robot_called
from sights import posed

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
STANCE = angles(GO2, GO2.nominal_feet)[0]
BOX = Box(2.0, -1.2, 0.0, 0.4, 0.4, 0.6)
ACROSS = Mover(BOX, ((2.0, 1.2),), 0.5)
"""From the right to the left, 2 m ahead, within the view all the time."""
HEAD_ON = Mover(Cylinder(3.2, 0.1, 0.25, 0.6), ((0.9, 0.1),), 0.4)
STANDS = Box(2.8, -0.8, 0.0, 0.3, 0.3, 0.6)


def looked(
    scene: Scene, poses, camera: Camera = CAMERA, seed: int = 0, apart: bool = True
) -> list[GroundMap]:
    """What is known of the ground after each look, ten of them a second: x, y [m], yaw [rad]."""
    perception = replace(SeeingGround.of(scene.bounds, GO2, camera), apart=apart)
    eyes = Eyes(camera, scene, seed)
    memory, grounds = None, []
    for k, (x, y, yaw) in enumerate(poses):
        sensed = replace(posed(GO2, scene, (x, y), (0.0, 0.01 * math.sin(k), yaw), 0.1 * k), q=STANCE)
        measured = Measured.of_row(
            sensed.row, time=sensed.time, specific_force_b=(0.0, 0.0, 9.8), frame=eyes.see(sensed, k)
        )
        for _ in STEPS:
            _, ground, memory = perception.perceive(measured, memory)
            measured = replace(measured, frame=None)
        grounds.append(ground)
    return grounds


def field(*movers: Mover, boxes=(STANDS,)) -> Scene:
    return Scene("field", Flat(), boxes, (-2.0, -4.0, 6.0, 4.0), movers=movers)


def standing(seconds: float) -> list[tuple[float, float, float]]:
    return [(0.0, 0.0, 0.0)] * round(10 * seconds)


def walking(seconds: float) -> list[tuple[float, float, float]]:
    """At 0.4 m/s along x, turning to and fro as legs do."""
    return [(0.04 * k, 0.0, 0.05 * math.sin(k)) for k in range(round(10 * seconds))]


@pytest.mark.parametrize("poses", [standing(4.0), walking(3.0)], ids=["standing", "walking"])
@pytest.mark.parametrize("mover", [ACROSS, HEAD_ON], ids=["across", "head-on"])
def test_what_moves_is_seen_to_within_half_a_second_and_its_velocity(mover: Mover, poses) -> None:
    grounds = looked(field(mover), poses)
    first = next(k for k, ground in enumerate(grounds) if ground.moving)
    assert first <= 6
    off = []
    for k, ground in enumerate(grounds[first + 3 :], start=first + 3):
        time = 0.1 * k
        for one in ground.moving:
            if one.time == pytest.approx(time) and math.hypot(*mover.velocity(time)) > 0.0:
                off.append(math.dist(one.velocity, mover.velocity(time)))
                assert math.dist(one.edge.mean(axis=0), mover.place(time)) < 0.45, "it is the thing itself"
    assert len(off) > 10 and np.median(off) < 0.15


def test_what_stands_beside_it_stays_in_the_sight_and_what_moves_does_not() -> None:
    for k, ground in enumerate(looked(field(ACROSS), standing(4.0))):
        assert ground.sight is not None
        middles = (ground.sight.pieces[:, :2] + ground.sight.pieces[:, 2:]) / 2.0
        near_standing = np.hypot(*(middles - (2.8, -0.8)).T) < 0.35
        hidden = math.hypot(ACROSS.place(0.1 * k)[1] + 0.57) < 0.4  # the box stands before it
        assert near_standing.any() or hidden
        if k > 6:
            near_mover = np.hypot(*(middles - ACROSS.place(0.1 * k)).T) < 0.3
            assert not near_mover.any()


@pytest.mark.parametrize("name", ["forest", "maze", "rooms", "streets", "blocks", "mixed", "hills"])
def test_where_nothing_moves_nothing_is_seen_to(name: str) -> None:
    scene = load_scene(name, 3)
    poses = [(0.03 * k, 0.1 * math.sin(0.1 * k), 0.4 * math.sin(0.13 * k)) for k in range(25)]
    poses += [(*poses[-1][:2], poses[-1][2] + 0.08 * k) for k in range(25)]  # then it turns on the spot
    with_all = looked(scene, poses)
    assert not any(ground.moving for ground in with_all)


def test_what_appears_and_stands_is_held_back_for_some_looks_and_is_in_the_sight_then() -> None:
    appears = Mover(Box(1.6, 0.0, 0.0, 0.4, 0.6, 0.5), appears=1.0)
    counts = []
    for ground in looked(field(appears, boxes=()), standing(2.5)):
        assert ground.moving == () and ground.sight is not None
        counts.append(len(ground.sight.pieces))
    assert not any(counts[: 10 + LOOKS - 1]) and all(counts[10 + LOOKS :])


def test_out_of_view_it_is_taken_to_go_on_for_a_while() -> None:
    grounds = looked(field(replace(ACROSS, along=((2.0, 4.0),)), boxes=()), standing(9.0))
    seen = [max((one.time for one in ground.moving), default=-1.0) for ground in grounds]
    left = next(k for k in range(20, len(seen)) if seen[k] < 0.1 * k - 1e-6)
    assert 4.0 < 0.1 * left < 7.5, "from y = -1.2 to the rim of the view, about y = 1.7"
    kept = [k for k in range(left, len(seen)) if seen[k] > 0.0]
    assert len(kept) == pytest.approx(10 * HELD, abs=1)


def test_what_is_seen_to_be_gone_is_not_kept() -> None:
    gone = looked(field(replace(ACROSS, vanishes=2.0), boxes=()), standing(3.0))
    assert gone[19].moving and not gone[21].moving


def test_feet_do_not_keep_the_trail_of_what_went_by() -> None:
    """It comes up to the robot, and leaves to the left, where it is not seen to go."""
    scene = field(replace(HEAD_ON, along=((1.0, 0.1), (1.0, 3.0))), boxes=())
    x, y = np.meshgrid(np.linspace(0.7, 1.5, 30), np.linspace(0.2, 1.0, 30))
    trail = []
    for apart in (True, False):
        heights = looked(scene, standing(13.0), apart=apart)[-1].elevation.height(x, y)
        assert np.isfinite(heights).mean() > 0.3
        trail.append(float((heights > 0.1).mean()))
    assert trail[0] == 0.0 < trail[1]


def test_with_a_bad_camera_it_is_seen_too_and_nothing_else_is() -> None:
    bad = replace(CAMERA, noise=0.02, dropouts=0.3)
    grounds = looked(field(ACROSS), standing(4.0), bad, seed=2)
    moving = [one for ground in grounds for one in ground.moving]
    assert len(moving) > 15
    for k, ground in enumerate(grounds):
        for one in ground.moving:
            if one.time == pytest.approx(0.1 * k):
                assert math.dist(one.edge.mean(axis=0), ACROSS.place(0.1 * k)) < 0.5


def test_a_sight_of_nothing_is_nothing() -> None:
    empty = Sight((0.0, 0.0), np.empty((0, 4)), np.empty((0, 2), bool), np.empty((0, 2)))
    sight, watched = told_apart(empty, 0.0, Watched(), 0.3, 0.01)
    assert sight is empty and watched.moving == ()
    again, watched = told_apart(empty, 0.1, watched, 0.3, 0.01)
    assert again is empty and len(watched.looks) == 2
