"""Claim: what a person teaches in ten minutes on three scenes drives ten others, and a robot that has fallen
a few times falls no more where it has not been."""

from collections.abc import Iterator, Sequence

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.taught_missions import (
    EXAMS,
    ICE,
    LESSONS,
    OTHER_ICE,
    STARTS,
    Trip,
    driven,
    lesson_from_a_person,
    lessons_from_mistakes,
    starts_of,
)
from gaitwright.bench.measurement import Figure, Wanted, at_least
from gaitwright.bench.trial import robot_named
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher

PUPILS = 5
"""Ten minutes make so many pupils, one a seed: few lessons leave much to chance."""
SCHOOL = 12
"""Trips of the school that the pupil went to who then goes on ice."""
NOTE = (
    "All in physics. Ten minutes: a scripted person looks every half second and steps in at most ten times "
    f"on each of {len(LESSONS)} missions, through the door of `teach --live`; then the rules drive "
    f"{len(EXAMS)} other scenes, {STARTS} starts each, for {PUPILS} pupils. "
    "Own mistakes: a pupil who was taught on ground with a "
    f"good grip drives {len(ICE)} trips on ice and tells herself what went wrong, as `mission --learn` does; "
    "then other ice. Plain rules: what drives where there is no skillbook."
)


def measure(context: Context) -> Iterator[Figure]:
    """Trips that arrive, before and after."""
    yield from ten_minutes(context)
    schooled = SkillPupil(context.seed)
    attend(schooled, robot_named("go2"), ScriptedTeacher(), context.seed, 2 if context.quick else SCHOOL)
    ice = OTHER_ICE[:2] if context.quick else OTHER_ICE
    yield arrived(context, "on ice, before a mistake was made: arrived", ice, schooled.rulebook())
    wise, mistakes = lessons_from_mistakes(context, schooled)
    note = f"learned from {mistakes} mistakes on {len(ICE)} trips"
    what = "on other ice, after own mistakes: arrived"
    yield arrived(context, what, ice, wise.rulebook(), at_least(95.0), note)
    yield arrived(context, "… by the plain rules", ice, None)


def ten_minutes(context: Context) -> Iterator[Figure]:
    """What several pupils arrive at who were taught for ten minutes each."""
    trips = starts_of(EXAMS[:2] if context.quick else EXAMS, 1 if context.quick else STARTS)
    failed, told = [], []
    for seed in context.seeds(PUPILS, quick=1):
        pupil, times = lesson_from_a_person(context, seed)
        missed = failures(context, f"pupil {seed} of ten minutes", trips, pupil.rulebook())
        rules = len(pupil.pupil.lines.rules) + 1
        told.append(f"{len(trips) - len(missed)} ({times} lessons, {rules} rules)")
        failed += missed
    what = f"ten minutes of teaching on three scenes: of {len(trips)} trips elsewhere arrived"
    yield share_of(what, trips * len(told), failed, at_least(95.0), ", ".join(told))
    yield arrived(context, "… by the plain rules", trips, None)


def arrived(
    context: Context,
    what: str,
    trips: Sequence[Trip],
    rulebook: Rulebook | None,
    wanted: Wanted | None = None,
    note: str = "",
) -> Figure:
    """The share of missions that arrive without a fall, and where the others failed."""
    return share_of(what, trips, failures(context, what, trips, rulebook), wanted, note)


def failures(context: Context, what: str, trips: Sequence[Trip], rulebook: Rulebook | None) -> list[str]:
    """Where missions failed that rules drove, and why."""
    failed = []
    for k, trip in enumerate(trips):
        context.voice.say(f"lessons: {what}, trip {k + 1} of {len(trips)}", now=False)
        report = driven(trip, rulebook).report()
        if not report.arrived or report.falls:
            failed.append(f"{trip.scene} at {trip.speed:g} m/s: {report.stopped_because}")
    return failed


def share_of(what: str, trips: Sequence[Trip], failed: list[str], wanted: Wanted | None, note: str) -> Figure:
    """How many of the trips did not fail [%], and examples of those that did."""
    share = 100.0 * (1.0 - len(failed) / len(trips))
    told = "; ".join(part for part in (note, *dict.fromkeys(failed[:3])) if part)
    return Figure(what, share, "%", wanted, len(trips), told, {"failed": failed})
