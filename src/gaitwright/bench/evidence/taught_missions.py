"""Missions in physics that are driven by taught rules: what a person teaches in ten minutes, and what a
robot's own mistakes teach it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from gaitwright.bench.context import Context
from gaitwright.bench.trial import robot_named
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.live import LiveLessons
from gaitwright.learning.live_sources import Running
from gaitwright.learning.own_mistakes import lesson_of
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.recording import Recording
from gaitwright.session import DT, Session, record, scene_for
from gaitwright.signals import Mission
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST

EVERY, MOST = 0.5, 10
"""A person looks this often [s] and steps in so many times in a scene at most: three scenes, thirty times,
twenty seconds each are ten minutes."""
SECONDS = 60.0


@dataclass(frozen=True, slots=True)
class Trip:
    """One mission: scene, heading at its start [rad], goal [m], wished speed [m/s], seed."""

    scene: str
    yaw: float
    goal: tuple[float, float]
    speed: float
    seed: int = 0


LESSONS = (
    Trip("stairs:0.08", 0.0, (6.5, 0.0), 0.5),
    Trip("blocks", 2.6, (6.0, 0.0), 0.8),
    Trip("ramp:15", -1.2, (6.0, 0.0), 0.6),
)
EXAMS = (
    Trip("flat", 3.0, (3.0, 2.0), 0.5),
    Trip("slope:12", 0.5, (4.0, 1.0), 0.6),
    Trip("slope:-12", 0.0, (4.0, -1.0), 0.6),
    Trip("cross-slope:8", -0.8, (4.0, 0.0), 0.5),
    Trip("rough:0.03", 1.5, (4.0, 1.0), 0.5),
    Trip("rough:0.05", 0.0, (4.0, 0.0), 0.7),
    Trip("blocks", -2.0, (6.0, 0.0), 0.6, 3),
    Trip("stairs:0.06", 0.3, (6.5, 0.0), 0.7),
    Trip("stairs:0.1", 0.0, (6.5, 0.0), 0.4),
    Trip("ramp:20", 0.4, (6.0, 0.0), 0.5),
)
STARTS = 3
"""Starts of each of the other scenes."""
ICE = tuple(Trip(f"slippery:{grip}", 0.0, (4.0, 0.0), v) for grip in (0.12, 0.16) for v in (0.7, 1.1))
"""Where the robot may fall and learn."""
OTHER_ICE = tuple(
    Trip(f"slippery:{grip}", yaw, (3.5, 1.0), v)
    for grip in (0.1, 0.14, 0.18)
    for v in (0.6, 0.9, 1.3)
    for yaw in (0.0, 0.4)
)


def lesson_from_a_person(context: Context, seed: int) -> tuple[SkillPupil, int]:
    """A pupil after three scenes on which somebody stepped in now and then, and how often."""
    teacher, times = ScriptedTeacher(), 0
    with TemporaryDirectory() as folder:
        path = Skillbook.new(FOREST, "go2", "ten minutes", seed).save(Path(folder) / "a.skills")
        with open_for_learning(path) as ledger:
            room = LiveLessons(ledger, SkillPupil(seed))
            for trip in LESSONS:
                context.voice.say(f"lessons: ten minutes, {trip.scene}")
                source = Running(session_of(trip, room.ledger.book.rulebook), trip.scene)
                times += stepped_in(room, source, teacher)
            return room.pupil, times


def stepped_in(room: LiveLessons, source: Running, teacher: ScriptedTeacher) -> int:
    """How often a person stepped in on one mission: where the rules say another thing than she would."""
    times = 0
    while not source.over and times < MOST:
        seen = source.here()
        shown, choice = teacher.ideal(seen.moment.facts), room.pupil.choose(seen.moment)
        if choice.action != shown.action:
            room.keep(room.tried(told_at(seen.moment, shown, source.name)))
            source.drive_by(room.ledger.book.rulebook)
            times += 1
        room.seen += source.go(EVERY, until_change=False)
    return times


def lessons_from_mistakes(context: Context, pupil: SkillPupil) -> tuple[SkillPupil, int]:
    """A pupil after trips on ice that she drove, and how many mistakes she learned from."""
    taught, mistakes = pupil.copied(), 0
    for k, trip in enumerate(ICE):
        context.voice.say(f"lessons: own mistakes, {trip.scene}")
        told = lesson_of(driven(trip, taught.rulebook()), taught, f"{trip.scene}, trip {k}")
        if told is not None:
            taught.hear(told)
            mistakes += 1
    return taught, mistakes


def driven(trip: Trip, rulebook: Rulebook | None) -> Recording:
    """One mission driven by rules; `None`: by the plain ones."""
    return record(session_of(trip, rulebook), trip.seed, trip.scene)


def session_of(trip: Trip, rulebook: Rulebook | None) -> Session:
    """A mission about to begin."""
    robot = robot_named("go2")
    scene = scene_for(robot, trip.scene, trip.seed)
    x, y, _ = scene.start
    scene = replace(scene, start=(x, y, trip.yaw))
    brain = Brain.of(robot, scene, dt=DT, rulebook=rulebook)
    driver = "numerical" if rulebook is None else "hybrid"
    return Session(
        brain, MujocoPlant(robot, scene, DT), Mission((trip.goal,), trip.speed, driver), SECONDS, trip.seed
    )


def starts_of(trips: Sequence[Trip], starts: int) -> list[Trip]:
    """Each mission from so many starts."""
    return [replace(trip, seed=trip.seed + k) for trip in trips for k in range(starts)]
