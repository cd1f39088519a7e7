"""Missions to learn on and to be examined on: scenes of every kind, drawn from a seed."""

import math
from dataclasses import replace

import numpy as np

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.learning.kinematic import Course
from gaitwright.model.robot import Robot
from gaitwright.navigation.known_field import is_blocked, is_within
from gaitwright.navigation.navigator import Navigator
from gaitwright.navigation.room_needed import half_width
from gaitwright.perception.known_ground import KnownGround
from gaitwright.session import scene_scale
from gaitwright.signals import GroundMap, Mission
from gaitwright.skills.library import speed_scale

KINDS = ("flat", "slope", "cross-slope", "rough", "blocks", "blocks", "stairs", "ramp", "gap")
"""The kinds of scenes, each as often as it stands here."""
SPEEDS = ((0.12, 0.3), (0.3, 1.0), (1.0, 1.6), (1.6, 2.0))
"""Ranges of wished speeds [m/s], at h = 0.29 m: as many missions of each."""
REACH = 4.0
"""Way-points lie within this many metres of the start's line, at h = 0.29 m."""
BACK = 0.4
"""Share of the missions that come back the way they went."""


def course(robot: Robot, seed: int, kind: str = "", name: str = "") -> Course:
    """A mission for a robot in a scene; `kind` is drawn too where none is given."""
    rng = np.random.default_rng([seed, 6])
    kind = kind or KINDS[int(rng.integers(len(KINDS)))]
    scale = scene_scale(robot)
    scene = replace(scene_of(kind, rng, scale), start=(0.0, 0.0, 0.0))
    navigator, perception = Navigator(robot, makes_room=False), KnownGround.of(scene, robot)
    low, high = SPEEDS[int(rng.integers(len(SPEEDS)))]
    speed = float(rng.uniform(low, high)) * speed_scale(robot)
    is_across, room = kind in ("stairs", "ramp", "gap"), half_width(robot)
    points = way_points(perception.ground, room, rng, scale, is_across)
    yaw = float(rng.uniform(-math.pi, math.pi)) if rng.uniform() < 0.5 else float(rng.normal(0.0, 0.3))
    return Course(
        robot,
        navigator,
        perception,
        scene,
        Mission(points, speed),
        yaw,
        name or f"{scene.name} (seed {seed})",
    )


def scene_of(kind: str, rng: np.random.Generator, scale: float) -> Scene:
    """A scene of a kind, its number drawn."""
    sign = float(rng.choice([-1.0, 1.0]))
    numbers = {
        "slope": sign * rng.uniform(4.0, 20.0),
        "cross-slope": sign * rng.uniform(4.0, 15.0),
        "rough": rng.uniform(0.02, 0.07),
        "stairs": rng.uniform(0.05, 0.1),
        "ramp": rng.uniform(10.0, 25.0),
        "gap": rng.uniform(0.08, 0.25),
    }
    asked = f"{kind}:{numbers[kind]:.3f}" if kind in numbers else kind
    return load_scene(asked, int(rng.integers(1_000_000)), scale)


def way_points(
    ground: GroundMap, room: float, rng: np.random.Generator, scale: float, across: bool
) -> tuple[tuple[float, float], ...]:
    """One to three points that can be gone to with `room` [m] on both sides, and often back again; `across`:
    over what lies along x."""
    far = scale * REACH
    points: list[tuple[float, float]] = [(1.5 * far, float(rng.uniform(-0.3, 0.3)) * far)] if across else []
    wanted = int(rng.integers(1, 4))
    while len(points) < wanted:
        point = (float(rng.uniform(-0.7, 2.2)) * far, float(rng.uniform(-0.8, 0.8)) * far)
        if is_within(ground.bounds, point) and not is_blocked(ground, room, point):
            points.append(point)
    there_and_back = [*points[-2::-1], (0.0, 0.0)] if rng.uniform() < BACK else []
    return (*points, *there_and_back)
