"""Claim: a robot with a camera finds its way where it has never been, and puts no foot into a hole."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import robot_named
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

FAMILIES = (
    "blocks",
    "holes",
    "trench",
    "hills",
    "waves",
    "forest",
    "streets",
    "rooms",
    "maze",
    "bugtrap",
    "mixed",
)
GOALS = {"blocks": (6.0, 0.0)}
"""Of scenes that name none [m]."""
STARTS = 5
"""Courses of each family."""
SECONDS = 240.0
NOISE, LOST = 0.02, 0.3
"""Of the second row: standard deviation of a range [m], share of the rays that are lost."""
DEEP = 0.4
"""A foot this far below the ground around it is in a hole, in body heights."""
AROUND = 0.5
"""The ground around a foot begins so far from it, in body heights."""
EVERY = 10
"""Ticks from one look at the feet to the next."""
NOTE = (
    "Go2, the numerical controller, five courses of each family as it comes (difficulty 0.5), start to goal "
    "6 to 15 m. Nothing is known but the bounds of the field; the camera is the one that fits the robot. A "
    "foot is in a hole where it stands deeper than all eight places around it."
)


@dataclass(frozen=True)
class Course:
    """A mission in a scene that is seen, or known where there is no camera."""

    family: str
    seed: int
    camera: Camera | None


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


def measure(context: Context) -> Iterator[Figure]:
    """Missions with a good camera, a bad one, and the ground known."""
    camera = Camera.for_robot(robot_named("go2"))
    bad = replace(camera, noise=NOISE, dropouts=LOST)
    rows: list[tuple[str, Camera | None, bool]] = [
        ("camera", camera, True),
        (f"camera with {100 * NOISE:g} cm noise, {LOST:.0%} of the rays lost", bad, False),
        ("ground known", None, False),
    ]
    for what, eyes, is_wanted in rows:
        courses = [Course(f, seed, eyes) for f in FAMILIES for seed in context.seeds(STARTS, quick=1)]
        found = context.each(what, crossed, courses)
        yield from figures(what, courses, found, is_wanted)


def figures(
    what: str, courses: Sequence[Course], found: Sequence[Crossed], is_wanted: bool
) -> Iterator[Figure]:
    """How many arrived, and how many never put a foot into a hole."""
    lost = [f"{c.family} {c.seed}: {f.why}" for c, f in zip(courses, found, strict=True) if not f.arrived]
    good, n = sum(f.arrived and not f.fell for f in found), len(found)
    metres, seconds = (sum(getattr(f, name) for f in found if f.arrived) for name in ("metres", "seconds"))
    note = "; ".join([f"{metres:.0f} m in {seconds:.0f} s", *lost])
    every = {"each": [vars(f) for f in found]}
    yield count(f"{what}: arrived without a fall", good, n, 0.9 if is_wanted else None, note, every)
    clean = sum(f.in_holes == 0 for f in found)
    yield count(f"{what}: never a foot in a hole", clean, n, 0.95 if is_wanted else None, "", {})


def crossed(course: Course) -> Crossed:
    """Makes a mission."""
    robot, scene = robot_named("go2"), scene_for(robot_named("go2"), course.family, course.seed)
    goal, camera = scene.goal or GOALS[course.family], course.camera
    plant = MujocoPlant(robot, scene)
    brain = Brain.of(robot, scene, dt=DT, camera=camera)
    whole = plant if camera is None else SeeingPlant(plant, camera, scene)
    recording = record(Session(brain, whole, Mission((goal,)), SECONDS, course.seed), course.seed, scene.name)
    report, where = recording.report(), recording["position_w"][-1, :2]
    there = report.arrived and float(np.hypot(*(where - goal))) <= ARRIVED * robot.body_length
    holes = in_holes(robot, scene, recording)
    return Crossed(
        there, report.falls > 0, report.stopped_because, report.distance_m, report.duration_s, holes
    )


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
