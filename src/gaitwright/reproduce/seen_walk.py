"""A walk in contact physics by a robot with a camera, and what is kept of it for off-line analysis.

What the thesis kept is kept (6.5): where the feet were, and what the terrain scanner had seen of the ground.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.gait.operators import Operator
from gaitwright.ground.scene import Scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.camera import Camera
from gaitwright.model.kinematics import feet_over_time
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotations
from gaitwright.perception.scanner import BEHIND, FAR
from gaitwright.plant.registry import make_plant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.record.metrics import attitude
from gaitwright.record.recording import Recording
from gaitwright.session import DT, Session, record
from gaitwright.signals import Elevation, GroundMap, Mission
from gaitwright.stages import Chooser

ANALYSED = (
    "The terrain curves are what the terrain scanner had seen of the ground when it last looked, along the "
    "line of the left feet and that of the right ones. The scan of the thesis has no curves and its text "
    "no numbers: its sentences are judged."
)
"""What has to be known to read a walk."""
FINE = 0.01
"""From place to place of a terrain curve [m]."""
EVERY = 2
"""Ticks from place to place of a foot."""
KEPT = 5
"""Every so many of these places are written down."""


class TerrainCurve(NamedTuple):
    """The ground along a line that goes straight ahead."""

    y: float
    """Of the line [m]."""
    x: Float[np.ndarray, " n"]
    """Places along it [m]."""
    seen: Float[np.ndarray, " n"]
    """Heights as the scanner saw them last [m]; NaN where it never saw any."""
    true: Float[np.ndarray, " n"]
    """Heights of the scene [m]."""


class FootPaths(NamedTuple):
    """Where the feet went, moment by moment."""

    place_w: Float[np.ndarray, "n legs 3"]
    """Of each foot's lowest point [m]."""
    swings: Float[np.ndarray, "n legs"]
    """1 where a leg swings."""
    touches: Float[np.ndarray, "n legs"]
    """1 where a foot feels something."""
    raised: Float[np.ndarray, "n legs"]
    """1 where a terrain operator acts on a leg."""


class Leans(NamedTuple):
    """Lean of ground and body along the way, uphill positive."""

    x: Float[np.ndarray, " n"]
    """Of the body [m]."""
    ground: Float[np.ndarray, " n"]
    """From under the hind hips to under the front ones [°]."""
    body: Float[np.ndarray, " n"]
    """[°]"""
    over: Float[np.ndarray, " n"]
    """Height of the body over the middle of these places [m]."""


@dataclass(frozen=True, eq=False)
class SeenWalk:
    """What is left of a walk."""

    scene: Scene
    recording: Recording
    curves: tuple[TerrainCurve, TerrainCurve]
    """Along the left feet and along the right ones."""
    feet: FootPaths

    @property
    def robot(self) -> Robot:
        return self.recording.robot

    def curve_of(self, leg: int) -> TerrainCurve:
        """The curve along which a leg goes."""
        return self.curves[0 if self.robot.nominal_feet[leg, 1] > 0.0 else 1]


def seen_walk(
    robot: Robot,
    scene: Scene,
    mission: Mission,
    seconds: float,
    chooser: Chooser | None = None,
    operators: Sequence[Operator] = (),
) -> SeenWalk:
    """Takes a robot straight along x through a scene of which it knows what it sees and feels."""
    camera = Camera.for_robot(robot)
    brain = Brain.of(robot, scene, chooser, DT, camera=camera).with_operators(operators)
    plant = SeeingPlant(make_plant("mujoco", robot, scene, DT), camera, scene)
    session = Session(brain, plant, mission, seconds, vary=False)
    half = float(abs(robot.nominal_feet[:, 1]).max())
    scanned = Scanned(robot, scene, (half, -half))

    def watch(lap: Lap) -> None:
        scanned.look(session.mind.ground, float(lap.sensed.position_w[0]))

    recording = record(session, scene=scene.name, watch=watch).of_trip()
    return SeenWalk(scene, recording, scanned.curves(), paths_of(recording))


class Scanned:
    """Gathers what the scanner sees along two lines, look by look."""

    def __init__(self, robot: Robot, scene: Scene, lines: tuple[float, float]) -> None:
        x_min, _, x_max, _ = scene.bounds
        self.x = np.arange(x_min, x_max, FINE)
        self.lines, self.scene, self.height = lines, scene, robot.height
        self.seen = np.full((2, len(self.x)), np.nan)
        self.last: Elevation | None = None

    def look(self, ground: GroundMap, here: float) -> None:
        """Takes what a new map says of the ground from under the hind feet on, as far as a scan goes; `here`:
        x of the robot [m]."""
        if ground.elevation is None or ground.elevation is self.last:
            return
        self.last = ground.elevation
        away = (self.x - here) / self.height
        near = (away > BEHIND) & (away < FAR)
        x = self.x[near]
        for seen, y in zip(self.seen, self.lines, strict=True):
            heights = np.asarray(ground.elevation.height(x, np.full_like(x, y)), dtype=float)
            seen[near] = np.where(np.isnan(heights), seen[near], heights)

    def curves(self) -> tuple[TerrainCurve, TerrainCurve]:
        """What came of it, beside the truth."""
        left, right = (
            TerrainCurve(y, self.x, seen, np.asarray(self.scene.height(self.x, np.full_like(self.x, y))))
            for seen, y in zip(self.seen, self.lines, strict=True)
        )
        return left, right


def paths_of(recording: Recording) -> FootPaths:
    """The paths of the feet in a recording."""
    robot, of = recording.robot, recording.robot.arrays
    q, position, turned = (recording[name][::EVERY] for name in ("q", "position_w", "orientation_wb"))
    legs = np.ascontiguousarray(q).reshape(-1, robot.n, 3)
    feet_b = feet_over_time(of.hip, of.leg_frame, of.offset, of.sign, legs)
    place = position[:, None] + feet_b @ rotations(np.ascontiguousarray(turned)).transpose(0, 2, 1)
    place[..., 2] -= robot.foot_radius
    stance, load, operator = (recording[name][::EVERY] for name in ("stance", "load", "operator"))
    return FootPaths(place, 1.0 - stance, (load > 0.0).astype(float), (operator > 0.0).astype(float))


def leans(walk: SeenWalk) -> Leans:
    """How the body leans, and the ground under the hips in the middle of its way."""
    x, _, z = walk.recording["position_w"].T
    half = float(np.abs(walk.robot.nominal_feet[:, 0]).max())
    front, hind = (np.asarray(walk.scene.height(x + way, np.zeros_like(x))) for way in (half, -half))
    _, pitch = attitude(walk.recording.channel("orientation_wb"))
    ground = np.degrees(np.arctan2(front - hind, 2.0 * half))
    return Leans(x, ground, -np.degrees(pitch), z - 0.5 * (front + hind))


def paths_as_plain(walk: SeenWalk) -> dict[str, Any]:
    """Curves and trajectories as plain JSON values [m]; `null` where nothing was seen."""
    curves = {
        side: {"x": rounded(curve.x), "seen": rounded(curve.seen), "true": rounded(curve.true)}
        for side, curve in zip(("left", "right"), walk.curves, strict=True)
    }
    feet = {
        name: {"x": rounded(way[:, 0]), "height": rounded(way[:, 2])}
        for name, way in zip(walk.robot.legs, walk.feet.place_w[::KEPT].swapaxes(0, 1), strict=True)
    }
    return {"curves": curves, "feet": feet}


def rounded(values: Float[np.ndarray, " n"]) -> list[float | None]:
    """Numbers to the tenth of a millimetre."""
    return [None if np.isnan(value) else round(float(value), 4) for value in values]
