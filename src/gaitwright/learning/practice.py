"""Trips in physics on which a hybrid practises: trust grows or falls, and mistakes become lessons."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import HYBRID
from gaitwright.knowledge.trust import grades_in
from gaitwright.learning.courses import course
from gaitwright.learning.equipped import equipped
from gaitwright.learning.growth import Returns, grown, lived_through
from gaitwright.learning.live import LiveLessons
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.own_mistakes import lesson_of
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.record.metrics import Report
from gaitwright.record.recording import INTERRUPTED, Recording
from gaitwright.session import DT, Session, record
from gaitwright.skillbook.writer import Ledger

FIRST = 800_000
"""Numbers of the courses begin here: those of schools and exams lie elsewhere."""
SECONDS = 40.0
"""A trip is that long at most [s]."""


class Trip(NamedTuple):
    """What came of one trip: its figures, and a sentence for all that it changed."""

    number: int
    report: Report
    changed: tuple[str, ...]


def practise(
    robot: Robot, ledger: Ledger, profiles: Mapping[str, Sequence[Profile]], seed: int, number: int
) -> Trip:
    """The trip of that number of a seed, driven by the rules and profiles of a book as far as it is trusted;
    what it teaches is in the book."""
    drawn = seed * 1_000_000 + FIRST + number
    asked = course(robot, drawn)
    x, y, _ = asked.scene.start
    scene = replace(asked.scene, start=(x, y, asked.yaw))
    brain = Brain.of(robot, scene, dt=DT, rulebook=ledger.book.rulebook)
    brain = equipped(brain, ledger.book, profiles, ledger.path.name)
    mission = replace(asked.mission, driver=HYBRID)
    session = Session(brain, make_plant("mujoco", robot, scene, DT), mission, SECONDS, drawn)
    recording = record(session, drawn, scene.name)
    if recording.stopped_because == INTERRUPTED:
        raise KeyboardInterrupt
    returns = session.mind.memories.drive.handed_back
    return Trip(number, recording.report(), tuple(after_trip(ledger, recording, returns, asked.name)))


def after_trip(ledger: Ledger, recording: Recording, handed_back: Returns, name: str) -> list[str]:
    """Puts into the book what a trip does to the trust in the learned controller, and what the first of the
    robot's own mistakes teaches; a sentence for each."""
    said = grown(ledger, lived_through(recording, name, handed_back, grades_in(ledger.book.trust)))
    room = LiveLessons(ledger, pupil_of(ledger.book))
    told = lesson_of(recording, room.pupil, name)
    if told is None:
        return said
    tried = room.tried(replace(told, id=room.unused(told.id)))
    room.keep(tried)
    better = f"{told.because}: {told.action.skill} would have been better, learned as {tried.told.id!r}"
    return [*said, better, *(f"  {event.why}" for event in tried.taken.events)]
