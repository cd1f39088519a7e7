"""One test teacher and her pupils: labels, exams on the way, and scikit-learn on the same labels."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import count
from time import perf_counter, thread_time

import numpy as np

from gaitwright.bench.evidence.driven import pupil_drives, trip
from gaitwright.bench.peers.rules_client import RulesPeer
from gaitwright.bench.teachers import BenchTeacher, Facts
from gaitwright.bench.trial import robot_named
from gaitwright.induction.cases import NOBODY
from gaitwright.induction.pupil import Lesson, Pupil
from gaitwright.learning.trips import EXAM
from gaitwright.model.robot import Robot
from gaitwright.skills.situation import DOING
from gaitwright.skills.vocabulary import VOCABULARY

LESSONS = 30_000
"""Courses of lessons are numbered from here on, far from those of all exams (`EXAM`), in millions."""
PEER_TIMEOUT_S = 900.0
"""Within this time scikit-learn has learned from all labels of a school."""


@dataclass(frozen=True, slots=True)
class School:
    """What is to be done: who teaches, how many labels, and how many moments are asked after so many."""

    teacher: BenchTeacher
    place: int
    """Her place among the teachers: she has courses of her own."""
    seed: int
    asked: tuple[tuple[int, int], ...]
    """(labels, moments asked), in ascending order."""


@dataclass(frozen=True, slots=True)
class Marks:
    """How a pupil did in an exam; shares of the moments asked."""

    right: float
    sure: float
    sure_wrong: float
    """Wrong and sure of it."""
    rules: int
    """Rules of its list, the last line included."""
    actions: int
    """Actions it has met."""


@dataclass(frozen=True, slots=True)
class Exam:
    """An exam after so many labels."""

    labels: int
    asked: int
    silent: Marks
    """The pupil that heard labels alone."""
    told: Marks
    """The pupil that heard the reasons too."""
    others: dict[str, float]
    """The share right of each other learner."""


@dataclass(frozen=True, slots=True)
class Taught:
    """What came of a school."""

    teacher: str
    is_list: bool
    seed: int
    exams: tuple[Exam, ...]
    slowest: float
    """The lesson that took longest, as time of the processor [s]: other schools are held at the same time."""
    slowest_wall: float
    """And by the clock [s]."""
    missing: str
    """Why other learners were not measured, where they were not."""


@dataclass
class Classroom:
    """A school while it is held."""

    school: School
    robot: Robot
    silent: Pupil
    told: Pupil
    skills: list[str] = field(default_factory=list)
    """The words for the pupils' actions."""
    heard: list[tuple[Facts, str]] = field(default_factory=list)
    """What was labelled so far, and as what."""
    took: list[tuple[float, float]] = field(default_factory=list)
    """Of each lesson the time of the processor and that by the clock [s]."""

    def first(self, millions: int) -> int:
        """The first number of the courses that are this teacher's own, of those that begin so."""
        return (millions + self.school.seed) * 1_000_000 + self.school.place * 50_000

    def lessons(self) -> Iterator[tuple[int, Facts]]:
        """(trip, moment) of trips that the silent pupil drives, on and on."""
        drive = pupil_drives(self.robot, self.silent, self.skills)
        for k in count():
            yield from ((k, facts) for facts in trip(self.robot, self.first(LESSONS) + k, drive))

    def hear(self, scene: int, facts: Facts) -> None:
        """Both pupils hear what the teacher says of a moment, one of them also why."""
        said = self.school.teacher.says(facts, len(self.heard))
        if said.skill not in self.skills:
            self.skills.append(said.skill)
        self.heard.append((facts, said.skill))
        for pupil, about in ((self.silent, ""), (self.told, said.about)):
            reason = VOCABULARY.place_of(about) if about else NOBODY
            lesson = Lesson(VOCABULARY.row(facts), self.skills.index(said.skill), reason, scene)
            self.took.append(timed(pupil, lesson))

    def questions(self, asked: int) -> list[Facts]:
        """Moments of trips on courses of exams that the silent pupil drives as it is now."""
        drive = pupil_drives(self.robot, self.silent, self.skills)
        found: list[Facts] = []
        begin = self.first(EXAM * 1000) + 10 * len(self.heard)
        for k in count():
            found += trip(self.robot, begin + k, drive)
            if len(found) >= asked:
                break
        return found[:asked]

    def marks(self, pupil: Pupil, asked: Sequence[Facts], right: Sequence[str]) -> Marks:
        """How a pupil does."""
        actions, _, sure = pupil.decide_all(np.array([VOCABULARY.row(facts) for facts in asked]).T)
        is_right = np.array([self.skills[a] == r for a, r in zip(actions.tolist(), right, strict=True)])
        wrong = float(np.mean(sure & ~is_right))
        rules = len(pupil.lines.rules) + 1
        return Marks(float(np.mean(is_right)), float(np.mean(sure)), wrong, rules, len(self.skills))


@dataclass(frozen=True, slots=True)
class Sitting:
    """An exam of both pupils, and what was asked in it."""

    labels: int
    asked: list[Facts]
    right: list[str]
    silent: Marks
    told: Marks


def taught(school: School) -> Taught:
    """Holds a school: trips that the silent pupil drives, labels in their order, exams on the way."""
    warm_up()
    room = Classroom(
        school, robot_named("go2"), Pupil(VOCABULARY, school.seed), Pupil(VOCABULARY, school.seed)
    )
    wanted, sittings = dict(school.asked), []
    for scene, facts in room.lessons():
        room.hear(scene, facts)
        if len(room.heard) in wanted:
            sittings.append(sitting(room, wanted[len(room.heard)]))
        if len(sittings) == len(wanted):
            break
    shares, missing = others(room.heard, sittings)
    exams = tuple(
        Exam(s.labels, len(s.asked), s.silent, s.told, shares.get(str(s.labels), {})) for s in sittings
    )
    slowest, wall = (max(times) for times in zip(*room.took, strict=True))
    return Taught(school.teacher.name, school.teacher.is_list, school.seed, exams, slowest, wall, missing)


def sitting(room: Classroom, asked: int) -> Sitting:
    """An exam now. What is right is what she meant at her last label: of a mind that changes with the next
    one nobody can know."""
    labels = len(room.heard)
    questions = room.questions(asked)
    right = [room.school.teacher.skill(facts, labels - 1) for facts in questions]
    marks = (room.marks(pupil, questions, right) for pupil in (room.silent, room.told))
    return Sitting(labels, questions, right, *marks)


def timed(pupil: Pupil, lesson: Lesson) -> tuple[float, float]:
    """The time that a lesson takes: of the processor, and by the clock [s]."""
    began, began_wall = thread_time(), perf_counter()
    pupil.hear(lesson)
    return thread_time() - began, perf_counter() - began_wall


@cache
def warm_up() -> None:
    """Compiles what a pupil learns with, or loads it: once in a process, in lessons without sense."""
    rng, pupil = np.random.default_rng(0), Pupil(VOCABULARY)
    for k in range(60):
        row = rng.normal(size=len(VOCABULARY.columns)).round(1)
        action = 0 if k == 0 else 1 if k == 1 else int(rng.integers(2))
        pupil.hear(Lesson(row, action, k % 3 - 1, k // 10))
        pupil.decide(row)


# --- other learners --------------------------------------------------------------------------------
def others(
    heard: Sequence[tuple[Facts, str]], sittings: Sequence[Sitting]
) -> tuple[dict[str, dict[str, float]], str]:
    """Of each exam the share right of each learner of scikit-learn, or why there is none."""
    shown = [facts for facts, _ in heard]
    problem = {
        "shown": rows_of(shown),
        "said": [said for _, said in heard],
        "exams": [{"labels": s.labels, "asked": rows_of(s.asked), "right": s.right} for s in sittings],
    }
    with RulesPeer("sklearn", problem, PEER_TIMEOUT_S) as peer:
        return peer.greeting.get("shares", {}), peer.reason or ""


def rows_of(moments: Sequence[Facts]) -> dict[str, list[list[float]]]:
    """Moments as rows of numbers in two ways: as they were measured, and by all columns of a pupil."""
    plain = [name for name in VOCABULARY.names if name != DOING.name]
    measured = [
        [*(float(facts[name]) for name in plain), *(float(facts["doing"] == leaf) for leaf in DOING.leaves)]
        for facts in moments
    ]
    return {"numbers": measured, "columns": [VOCABULARY.row(facts).tolist() for facts in moments]}
