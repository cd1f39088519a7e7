"""Schools over whole trips with a teacher who is never silent: how right, how short, how sure."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.learning.exam import Result, examined, held_out
from gaitwright.learning.school import SchoolReport, attend
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher

SCHOOLS, TRIPS, EXAM = 3, (5, 10, 20, 40), 1000
"""Pupils, the trips after which they are examined, and the moments of an exam."""


@dataclass
class Schooled:
    """A pupil, what came of her exams, how many lessons she had had and how many rules she had then (the
    last line counts)."""

    pupil: SkillPupil
    results: list[Result] = field(default_factory=list)
    lessons: list[int] = field(default_factory=list)
    corrected: list[int] = field(default_factory=list)
    rules: list[int] = field(default_factory=list)


def schools(context: Context) -> Iterator[Figure]:
    """What whole schools come to, with the teacher's reasons."""
    trips = TRIPS[:1] if context.quick else TRIPS
    each = [school(context, seed, trips) for seed in context.seeds(SCHOOLS, quick=1)]
    for k, n in enumerate(trips):
        wanted = at_least(97.0) if n == TRIPS[-1] else None
        found = [row.results[k] for row in each]
        lessons, corrected, rules = (
            told([getattr(row, name)[k] for row in each]) for name in ("lessons", "corrected", "rules")
        )
        note = (
            f"{lessons} lessons, {corrected} of them corrections; {rules} rules, sure in "
            f"{100 * np.mean([e.sure for e in found]):.0f} %"
        )
        right = [100.0 * e.right for e in found]
        what = f"whole trips: right after {n} trips"
        yield Figure(what, float(np.mean(right)), "%", wanted, len(found), note, {"each": right})
    most = float(max(row.rules[-1] for row in each))
    yield Figure("whole trips: most rules", most, "", at_most(25.0), len(each))
    worst = 100.0 * max(e.wrong_while_sure for row in each for e in row.results)
    what = "whole trips: wrong while sure, of all moments, the worst"
    yield Figure(what, worst, "%", at_most(1.0), len(each) * len(trips))


def told(numbers: Sequence[int]) -> str:
    """The least and the largest of some numbers."""
    return f"{min(numbers)}" if min(numbers) == max(numbers) else f"{min(numbers)} to {max(numbers)}"


def school(context: Context, seed: int, trips: Sequence[int]) -> Schooled:
    """One pupil, examined after so many trips each time, on scenes that she never saw."""
    robot, teacher = robot_named("go2"), ScriptedTeacher()
    taught, exam = Schooled(SkillPupil(seed)), held_out(robot, teacher, seed, EXAM)

    def after(report: SchoolReport) -> None:
        context.voice.say(f"school {seed}: {report.trips} of {trips[-1]} trips", now=False)
        if report.trips in trips:
            taught.results.append(examined(taught.pupil, teacher, exam))
            taught.lessons.append(len(taught.pupil.told))
            taught.corrected.append(report.given["corrected"])
            taught.rules.append(len(taught.pupil.pupil.lines.rules) + 1)

    attend(taught.pupil, robot, teacher, seed, trips[-1], after=after)
    return taught
