"""Claim: after a school the learned controller drives most of the way on courses it has never seen."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.taught_missions import EXAMS, STARTS, Trip, session_of, starts_of
from gaitwright.bench.measurement import Figure, Wanted, at_least, count
from gaitwright.bench.trial import robot_named
from gaitwright.control.learned.profile import Profile
from gaitwright.knowledge.trust import grades_in
from gaitwright.learning.notes import pupil_of, settle
from gaitwright.learning.profile_books import playable
from gaitwright.learning.profile_school import Task, learn, lived
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.session import record
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.library import skill_names
from gaitwright.skills.situation import FOREST

SCHOOLS = (10, 40, 80)
"""Trips of the school after which the courses are driven."""
MUCH = 90.0
NOTE = (
    "A school makes the rules, the numerical controller the profiles of all 18 skills; then missions with "
    "driver hybrid on ten scenes, three starts each, none of them seen before. Beside it the same rules with "
    "the numerical controller alone. The learned controller drives where the rule is firm and its profiles "
    "cover the velocity."
)


class Course(NamedTuple):
    """A mission by a book; with its profiles, or by the numerical controller alone."""

    trip: Trip
    book: str
    plays: bool
    is_trusted: bool = False
    """Whether it plays as far as its book says that it is trusted; else as a partner."""


class Driven(NamedTuple):
    """What became of it."""

    arrived: bool
    fell: bool
    learned: float
    """Share of the time that the learned controller drove."""
    seconds: float
    why: str


def measure(context: Context) -> Iterator[Figure]:
    """After schools of growing length: arrivals, falls, and who drove."""
    schools = SCHOOLS[:1] if context.quick else SCHOOLS
    trips = starts_of(EXAMS[:2] if context.quick else EXAMS, 1 if context.quick else STARTS)
    with TemporaryDirectory() as folder:
        path = Skillbook.new(FOREST, "go2", "a school", context.seed).save(Path(folder) / "book.skills")
        learn_profiles(context, path)
        done = 0
        for school in schools:
            go_on(context, path, done, school)
            done = school
            yield from courses(context, str(path), trips, school, school == schools[-1])


def learn_profiles(context: Context, path: Path) -> None:
    """Puts the profiles of all skills into a book."""
    skills = skill_names(4) if not context.quick else ("stand", "stop", "turn-in-place", "trot", "walk")
    robot = robot_named("go2")
    found = context.each("profiles", learn, [Task(robot, skill, context.seed) for skill in skills])
    with open_for_learning(path) as ledger:
        profiles = [notes for learned in found for notes in learned.profiles]
        ledger.keep_profiles(profiles, [entry for learned in found for entry in lived(learned)])


def go_on(context: Context, path: Path, done: int, trips: int) -> None:
    """More trips of the same school."""
    context.voice.say(f"school: trips {done + 1} to {trips}")
    with open_for_learning(path) as ledger:
        pupil = pupil_of(ledger.book) if done else SkillPupil(context.seed)
        robot, teacher = robot_named("go2"), ScriptedTeacher()
        attend(pupil, robot, teacher, context.seed, trips, done, ledger.tell)
        settle(ledger, pupil)


def courses(context: Context, path: str, trips: list[Trip], school: int, is_last: bool) -> Iterator[Figure]:
    """The figures after a school of so many trips."""
    found = {
        plays: context.each(f"courses after {school} trips", driven, [Course(t, path, plays) for t in trips])
        for plays in (True, False)
    }
    hybrid, alone = found[True], found[False]
    what = f"after a school of {school} trips"
    yield share_driven(what, trips, hybrid, alone, at_least(MUCH) if is_last else None)
    good, beside = (sum(d.arrived and not d.fell for d in some) for some in (hybrid, alone))
    note = f"numerical alone {beside} of {len(trips)}"
    note += "".join(f"; {t.scene}: {d.why}" for t, d in zip(trips, hybrid, strict=True) if not d.arrived)
    yield count(f"{what}: arrived without a fall", good, len(trips), None, note, {})


def share_driven(
    what: str, trips: Sequence[Trip], hybrid: list[Driven], alone: list[Driven], wanted: Wanted | None
) -> Figure:
    """The share of the time that the learned controller drove, and the missions on which it drove least."""
    share = 100.0 * sum(d.learned * d.seconds for d in hybrid) / sum(d.seconds for d in hybrid)
    in_order = sorted(zip(trips, hybrid, strict=True), key=lambda pair: pair[1].learned)
    worst = ", ".join(f"{trip.scene} {d.learned:.0%}" for trip, d in in_order[:3])
    every = {"each": [d._asdict() for d in hybrid], "alone": [d._asdict() for d in alone]}
    return Figure(f"{what}: share of the time driven by the learned controller", share, "%", wanted,
                  len(trips), f"least: {worst}", every)  # fmt: skip


def driven(course: Course) -> Driven:
    """One mission."""
    book = Skillbook.load(course.book)
    session = session_of(course.trip, book.rulebook)
    if course.plays:
        grades = grades_in(book.trust) if course.is_trusted else {}
        session.brain = session.brain.with_profiles(profiles_in(course.book), grades)
    report = record(session, course.trip.seed, course.trip.scene).report()
    learned = report.driver_share.get("learned", 0.0)
    return Driven(report.arrived, report.falls > 0, learned, report.duration_s, report.stopped_because)


@lru_cache(maxsize=1)
def profiles_in(path: str) -> dict[str, list[Profile]]:
    """The profiles of a book, read once in a process: a school changes none of them."""
    return playable(Skillbook.load(path), robot_named("go2"), path).profiles
