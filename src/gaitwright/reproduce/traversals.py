"""Traversals of a micro-world in succession, in contact physics, with a map that grows (figure 6.11)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.learning.map_books import length_of, way_walked, with_trip
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.navigator import Navigator
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.plant.registry import make_plant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.reproduce.claim import Say
from gaitwright.session import DT, Session, record
from gaitwright.signals import Mission

SECONDS = 120.0
"""A traversal is given up after this time [s]."""

Place = tuple[float, float]
"""x, y [m]."""


@dataclass(frozen=True, eq=False)
class Traversal:
    """One way through the micro-world, and what is known of it afterwards."""

    route: tuple[int, int]
    """Numbers of the points from which and to which."""
    way: Float[np.ndarray, "n 2"]
    """Where the robot walked [m]."""
    arrived: bool
    ended: str
    """Why it ended, as a sentence."""
    seconds: float
    shortest: float
    """Length of the shortest way there is for the robot's disc between its ends [m]; NaN: none."""
    known: LearnedMap

    @property
    def length(self) -> float:
        """[m]"""
        return length_of(self.way)

    @property
    def ratio(self) -> float | None:
        """Its length over the shortest; `None` where it did not arrive, or there is none."""
        return self.length / self.shortest if self.arrived and self.shortest > 0.0 else None

    def plain(self) -> dict[str, Any]:
        """As plain JSON values [m, s]."""
        return {
            "route": self.route,
            "way": self.way.round(3).tolist(),
            "arrived": self.arrived,
            "ended": self.ended,
            "seconds": round(self.seconds, 3),
            "length": round(self.length, 3),
            "shortest": None if np.isnan(self.shortest) else round(self.shortest, 3),
            "pieces": self.known.pieces.round(3).tolist(),
        }


def traversed(
    robot: Robot, scene: Scene, points: Mapping[int, Place], tour: Sequence[int], strategy: str, say: Say
) -> list[Traversal]:
    """Takes a robot from point to point of a tour through a scene that it has never seen, by a strategy of
    `LearnedMap`. It sets out from where it came to rest; one that does not arrive is carried to its goal."""
    known = nothing_known(robot, scene, strategy)
    here, found = (*points[tour[0]], 0.0), []
    for route in pairwise(tour):
        say(f"{strategy}: {route[0]} → {route[1]}")
        one, here = traversal(robot, replace(scene, start=here), points[route[1]], route, known)
        known = one.known
        found.append(one)
    return found


def nothing_known(robot: Robot, scene: Scene, strategy: str) -> LearnedMap:
    """The empty map of a robot that has never been there."""
    explorer = Brain.of(robot, scene, camera=Camera.for_robot(robot)).navigator
    assert isinstance(explorer, Navigator), "a robot with a camera explores"
    return replace(explorer.nothing(scene.bounds), strategy=strategy)


def traversal(
    robot: Robot, scene: Scene, goal: Place, route: tuple[int, int], before: LearnedMap
) -> tuple[Traversal, tuple[float, float, float]]:
    """One traversal by what is known before; x, y [m] and yaw [rad] with which the next one begins."""
    camera = Camera.for_robot(robot)
    brain = Brain.of(robot, scene, dt=DT, camera=camera)
    plant = SeeingPlant(make_plant("mujoco", robot, scene, DT), camera, scene)
    session = Session(brain.with_map(before), plant, Mission((goal,)), SECONDS, vary=False)
    recording = record(session, scene=scene.name).of_trip()
    way = way_walked(recording, scene.bounds)
    one = Traversal(
        route,
        way,
        recording.arrived,
        recording.stopped_because,
        float(recording["time"][-1]),
        shortest_way(robot, scene, before.radius, way),
        with_trip(session.mind.memories.navigator.known, recording),
    )
    x, y, _ = recording["position_w"][-1]
    yaw = heading(rotation(np.ascontiguousarray(recording["orientation_wb"][-1])))
    return one, (float(x), float(y), float(yaw)) if one.arrived else (*goal, 0.0)


def shortest_way(robot: Robot, scene: Scene, radius: float, way: Float[np.ndarray, "n 2"]) -> float:
    """Length of the shortest way between the ends of one, for a disc that knows everything [m]."""
    rims = [[(float(x), float(y)) for x, y in rim] for rim in rims_of(robot, scene)]
    best = LearnedMap.of_polygons(scene.bounds, radius, rims).way(tuple(way[0]), tuple(way[-1]))
    return float("nan") if best is None else best.length


def rims_of(robot: Robot, scene: Scene) -> list[Float[np.ndarray, "corners 2"]]:
    """The outlines of what a robot walks around [m]."""
    return [np.asarray(one.corners(), dtype=float) for one in scene.obstacles(robot.step_limit)]
