"""Missions through scenes that are seen by a camera, or known where there is none: one by one, in physics."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from gaitwright.bench.trial import robot_named
from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED, NUMERICAL
from gaitwright.ground.scene import Scene
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.navigation.reached import ARRIVED
from gaitwright.numerics.geometry import rotation
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.record.recording import Recording
from gaitwright.session import DT, Session, record, scene_for
from gaitwright.signals import Mission

SECONDS = 240.0
DEEP = 0.4
"""A foot this far below the ground around it is in a hole, in body heights."""
AROUND = 0.5
"""The ground around a foot begins so far from it, in body heights."""
EVERY = 10
"""Ticks from one look at the feet to the next."""
GOALS = {"blocks": (6.0, 0.0), "stairs:0.1": (6.5, 0.0), "gap:0.2": (4.6, 0.0), "ramp:20": (6.0, 0.0)}
"""Of scenes that name none [m]."""


@dataclass(frozen=True)
class Course:
    """A mission in a scene that is seen, or known where there is no camera."""

    scene: str
    seed: int
    camera: Camera | None
    profiles: Mapping[str, Sequence[Profile]] = field(default_factory=dict, repr=False)
    """What the learned controller plays, by the skill; where there are none the numerical one drives."""


@dataclass(frozen=True)
class Crossed:
    """What became of it."""

    arrived: bool
    fell: bool
    why: str
    metres: float
    seconds: float
    in_holes: int
    """Looks at which a foot stood in a hole."""
    learned: float
    """Share of the time that the learned controller drove [-]."""

    @property
    def is_good(self) -> bool:
        """Whether it arrived without a fall."""
        return self.arrived and not self.fell


def crossed(course: Course) -> Crossed:
    """Makes a mission."""
    robot, scene = robot_named("go2"), scene_for(robot_named("go2"), course.scene, course.seed)
    goal, camera = scene.goal or GOALS[course.scene], course.camera
    plant = MujocoPlant(robot, scene)
    brain = Brain.of(robot, scene, dt=DT, camera=camera)
    if course.profiles:
        brain = brain.with_profiles(course.profiles)
    mission = Mission((goal,), driver=LEARNED if course.profiles else NUMERICAL)
    whole = plant if camera is None else SeeingPlant(plant, camera, scene)
    recording = record(Session(brain, whole, mission, SECONDS, course.seed), course.seed, scene.name)
    report, where = recording.report(), recording["position_w"][-1, :2]
    there = report.arrived and float(np.hypot(*(where - goal))) <= ARRIVED * robot.body_length
    return Crossed(
        there, report.falls > 0, report.stopped_because, report.distance_m, report.duration_s,
        in_holes(robot, scene, recording), report.driver_share.get(LEARNED, 0.0),
    )  # fmt: skip


def in_holes(robot: Robot, scene: Scene, recording: Recording) -> int:
    """At how many looks a loaded foot stood deeper than the ground in all directions."""
    h, turns = robot.height, 2.0 * np.pi * np.arange(8) / 8.0
    ring = AROUND * h * np.column_stack([np.cos(turns), np.sin(turns)])
    found = 0
    for k in range(0, len(recording), EVERY):
        R_wb, load = rotation(recording["orientation_wb"][k]), recording["load"][k]
        places = recording["position_w"][k] + feet(robot, recording["q"][k].reshape(-1, 3)) @ R_wb.T
        places[:, 2] -= robot.foot_radius
        around = places[:, None, :2] + ring
        level = np.min(scene.height(around[..., 0], around[..., 1]), axis=1)
        found += bool(((places[:, 2] < level - DEEP * h) & (load > 0.0)).any())
    return found
