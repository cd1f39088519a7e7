"""Claim: a robot gives way to what moves, where it is told of it and where it sees it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.touches import Touch, Touches
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import robot_named
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.perception.seeing import SeeingGround
from gaitwright.perception.told_things import ToldThings
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import DT, Session, record, scene_for
from gaitwright.signals import Mission
from gaitwright.skills.giving_way import GivesWay

FAMILIES = ("crossing", "plaza")
STARTS = 20
SECONDS = 120.0
WIDE, COLUMNS = math.radians(150.0), 256
"""Of the second camera: its field of view, and its pixels in a row."""
NOTE = (
    "Go2, the numerical controller, 20 courses of each family as it comes (difficulty 0.5), 12 m from start "
    "to goal. Touches are MuJoCo's contacts, the first one of each thing. Where the robot came nearer to the "
    "thing by its own going, faster than 0.1 m/s over the half second before, it walked into it; else the "
    "thing ran into the robot. Without giving way what moves is to the robot what stands where it is."
)


@dataclass(frozen=True)
class Course:
    """A mission among moving things, which are told, or seen with a camera."""

    family: str
    seed: int
    camera: Camera | None
    gives_way: bool


@dataclass(frozen=True)
class Met:
    """What became of it."""

    arrived: bool
    fell: bool
    why: str
    seconds: float
    touches: tuple[Touch, ...]

    @property
    def walked(self) -> bool:
        """Whether the robot walked into something."""
        return any(touch.walked for touch in self.touches)


def measure(context: Context) -> Iterator[Figure]:
    """Missions with the things told and seen, with and without giving way."""
    camera = Camera.for_robot(robot_named("go2"))
    wide = replace(camera, across=WIDE, columns=COLUMNS)
    rows: list[tuple[str, Camera | None, bool]] = [
        ("things told", None, True),
        ("things told, gives no way", None, False),
        ("camera", camera, True),
        ("camera of 150°", wide, True),
        ("camera, gives no way", camera, False),
    ]
    for family in FAMILIES:
        for what, eyes, gives_way in rows:
            seeds = context.seeds(STARTS, quick=2)
            courses = [Course(family, seed, eyes, gives_way) for seed in seeds]
            found = context.each(f"{family}, {what}", met, courses)
            yield from figures(f"{family}, {what}", courses, found)


def figures(what: str, courses: Sequence[Course], found: Sequence[Met]) -> Iterator[Figure]:
    """How many arrived without a fall, were touched by nothing, and walked into nothing."""
    n, wanted = len(found), wanted_of(courses[0])
    lost = [f"{c.seed}: {f.why}" for c, f in zip(courses, found, strict=True) if not f.arrived]
    falls, seconds = sum(f.fell for f in found), sum(f.seconds for f in found)
    said = "; ".join([f"{falls} fell", f"{seconds / n:.0f} s each", *lost])
    every = {"each": [asdict(f) for f in found]}
    yield count(f"{what}: arrived without a fall", sum(f.arrived for f in found), n, wanted, said, every)
    free, free_of_own = sum(not f.touches for f in found), sum(not f.walked for f in found)
    yield count(f"{what}: touched by nothing that moves", free, n, None, "", {})
    yield count(f"{what}: walked into nothing that moves", free_of_own, n, wanted, "", {})


def wanted_of(course: Course) -> float | None:
    """The share that is wanted: of who gives way in a crossing."""
    return 0.9 if course.gives_way and course.family == "crossing" else None


def met(course: Course) -> Met:
    """Makes a mission."""
    robot, camera = robot_named("go2"), course.camera
    scene = scene_for(robot, course.family, course.seed)
    assert scene.goal is not None
    brain = Brain.of(robot, scene, dt=DT, camera=camera)
    touched = Touches(MujocoPlant(robot, scene))
    plant = touched if camera is None else SeeingPlant(touched, camera, scene)
    session = Session(
        brain if course.gives_way else without_way(brain), plant, Mission((scene.goal,)), SECONDS, course.seed
    )
    report = record(session, course.seed, scene.name).report()
    arrived = report.arrived and not report.falls
    return Met(arrived, report.falls > 0, report.stopped_because, report.duration_s, tuple(touched.touches))


def without_way(brain: Brain) -> Brain:
    """The same brain without giving way: what moves is to it what stands where it is."""
    assert isinstance(brain.chooser, GivesWay) and isinstance(brain.perception, ToldThings | SeeingGround)
    return replace(brain, chooser=brain.chooser.chooser, perception=replace(brain.perception, apart=False))
