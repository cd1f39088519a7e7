"""The school: the pupil drives trip after trip, and a teacher says what is right where she errs or is unsure.

Everything here runs on kinematic trips (`learning.kinematic`), so that a whole school takes a minute; what
was learned then drives real ones.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import count
from types import MappingProxyType

import numpy as np

from gaitwright.knowledge.memory import applied
from gaitwright.knowledge.rules import Event
from gaitwright.knowledge.told import Given, Told
from gaitwright.learning.courses import course
from gaitwright.learning.decision_point import DecisionPoint, decision_point
from gaitwright.learning.kinematic import Driver, moments_of
from gaitwright.learning.skill_pupil import Choice, SkillPupil, told_at
from gaitwright.learning.teacher import Shown, Teacher, teacher_for
from gaitwright.learning.trips import SCHOOL, teacher_drives
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.measured import measured
from gaitwright.skills.rule_chooser import carry_out

BEFORE_DRIVING = 10
"""Moments that the teacher drives at the very beginning."""
FIRST = 700_000
"""Numbers of the courses begin here: those of exams lie elsewhere."""
MOST_TRIPS = 100_000
"""Trips of one seed."""


@dataclass
class SchoolReport:
    """What came of a school, each count apart: moments, and lessons by who drove and who was right."""

    trips: int = 0
    moments: int = 0
    """Moments of decision on these trips."""
    given: Counter[Given] = field(default_factory=Counter)
    """Lessons by how they came: the teacher drove ("shown"), the pupil was right but unsure and asked
    ("confirmed"), the pupil was wrong ("corrected")."""
    corrected: list[int] = field(default_factory=list)
    """How often she was corrected, trip by trip."""


NOTHING: Mapping[str, Told] = MappingProxyType({})
Keep = Callable[[Told, tuple[Event, ...]], object]
"""Who puts a lesson away before anything else is learned."""


def attend(  # noqa: PLR0913 - a whole school; every setting has its default
    pupil: SkillPupil,
    robot: Robot,
    teacher: Teacher | None = None,
    seed: int = 0,
    trips: int = 40,
    first: int = 0,
    keep: Keep = lambda told, events: None,
    after: Callable[[SchoolReport], None] = lambda report: None,
    asks_always: bool = False,
    known: Mapping[str, Told] = NOTHING,
) -> SchoolReport:
    """So many trips drawn from a seed, from the `first` on: the pupil drives, and hears what is right
    wherever she is wrong or not sure; where `asks_always`, at every moment.

    `keep` gets each lesson and what it moved; `after` is told what came so far, after each trip. `known` is
    what she was told on the first of the trips, by its names, by a school that was interrupted there.
    """
    teacher, report = teacher or teacher_for(robot), SchoolReport(first)
    driven = driven_trips(pupil, robot, teacher, seed, first)
    for number, moments in zip(range(first, trips), driven, strict=False):
        before = report.given["corrected"]
        for lesson in lessons_on(pupil, teacher, moments, f"trip {number}", asks_always):
            told = known.get(lesson.id, lesson)
            events = pupil.hear(told).events
            report.given[told.given] += 1
            if told.id not in known:
                keep(told, events)
        report.trips, report.moments = number + 1, report.moments + len(moments)
        report.corrected.append(report.given["corrected"] - before)
        after(report)
    return report


def lessons_on(
    pupil: SkillPupil, teacher: Teacher, moments: Sequence[DecisionPoint], scene: str, asks_always: bool
) -> Iterator[Told]:
    """What a trip teaches, moment by moment; each is to be heard before the next is asked for."""
    for moment in moments:
        shown, choice = teacher.ideal(moment.facts), pupil.choose(moment)
        given = how_given(pupil, choice, shown)
        if asks_always or given != "confirmed" or not choice.sure:
            yield told_at(moment, shown, scene, given)


def how_given(pupil: SkillPupil, choice: Choice, shown: Shown) -> Given:
    """Why something is said at a moment."""
    if drives_not_yet(pupil):
        return "shown"
    return "confirmed" if choice.action == pupil.learned(shown.action) else "corrected"


# --- trips -----------------------------------------------------------------------------------------
def driven_trips(
    pupil: SkillPupil, robot: Robot, teacher: Teacher, seed: int, first: int = 0
) -> Iterator[list[DecisionPoint]]:
    """Trips that the pupil drives as far as she has learned, on and on."""
    for k in count(first):
        number = first_course(seed) + k
        rng = np.random.default_rng([number, 7])
        yield moments_of(course(robot, number), pupil_drives(pupil, robot, teacher), rng)


def pupil_drives(pupil: SkillPupil, robot: Robot, teacher: Teacher) -> Driver:
    """A driver who does what the pupil would; at the very beginning what the teacher would."""
    teachers = teacher_drives(robot, teacher)

    def drive(route: Route, sensed: Sensed, now: SkillCall | None) -> SkillCall:
        choice = pupil.choose(decision_point("", measured(robot, route, sensed, now), now))
        if choice.action is None or drives_not_yet(pupil):
            return teachers(route, sensed, now)
        memory = applied(choice.action, now.memory if now else {})
        return replace(carry_out(robot, choice.action, route, sensed), memory=memory)

    return drive


def drives_not_yet(pupil: SkillPupil) -> bool:
    """Whether the teacher still drives."""
    return len(pupil.told) < BEFORE_DRIVING


def first_course(seed: int) -> int:
    """The number of the course of a school's first trip."""
    return (SCHOOL * 1000 + seed) * 1_000_000 + FIRST


def trip_of(told: Told, seed: int) -> int | None:
    """The trip of a school of this seed that something was told on; `None` where it was none."""
    found = re.search(r"\(seed (\d+)\), moment \d+$", told.id)
    trip = int(found[1]) - first_course(seed) if found else -1
    return trip if 0 <= trip < MOST_TRIPS else None
