"""Claim: Go2 climbs and descends steps and ramps, crosses gaps, and walks on rough and slippery ground.

The ground is known ahead of the feet. The seed of a start draws the rough ground as well.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Outcome, Trial

STARTS = 20


@dataclass(frozen=True, slots=True)
class Course:
    """A scene to get across, by a skill at the speed it is meant for."""

    scene: str
    skill: str
    seconds: float
    """Enough to get across [s]."""
    least: float | None
    """Share of the starts that must get to the end; `None` where it is only shown."""
    stops: bool = False
    """Whether it is too much: the robot must stop before it and say so."""


COURSES = (
    Course("stairs:0.10", "climb", 27.0, 0.90),
    Course("stairs:0.10", "trot", 14.0, None),
    Course("stairs:0.14", "climb", 27.0, 0.95, stops=True),
    Course("ramp:20", "climb", 30.0, 0.95),
    Course("ramp:20", "trot", 16.0, 0.95),
    Course("slope:20", "walk", 20.0, 0.95),
    Course("slope:-20", "walk", 20.0, 0.95),
    Course("rough:0.05", "walk", 20.0, 0.95),
    Course("rough:0.05", "trot", 20.0, 0.95),
    Course("gap:0.2", "walk", 20.0, 0.80),
    Course("gap:0.2", "trot", 14.0, None),
    Course("slippery:0.3", "walk", 20.0, 0.95),
    Course("slippery:0.3", "trot", 20.0, 0.95),
)


def measure(context: Context) -> Iterator[Figure]:
    """How many starts got across each course, and how far joints went."""
    beyond = []
    for course in COURSES:
        what = f"go2 {course.skill} over {course.scene}"
        seeds = context.seeds(STARTS)
        trials = [
            Trial("go2", course.scene, course.seconds, seed, course.skill, None, None) for seed in seeds
        ]
        outcomes = context.outcomes(what, trials)
        good = sum(is_good(course, outcome) for outcome in outcomes)
        beyond += [outcome.beyond for outcome in outcomes if outcome.kept_up and course.least]
        every = {"each": [outcome.plain() for outcome in outcomes]}
        bad = [outcome.report for outcome in outcomes if not is_good(course, outcome)]
        note = f"seed {bad[0].seed}: {bad[0].stopped_because}" if bad else f"{course.seconds:g} s each"
        ends = "stops before it and says why" if course.stops else "no fall"
        yield count(f"{what}: {ends}", good, len(outcomes), course.least, note, every)
    what = "farthest any joint went beyond its limits on these courses"
    yield Figure(what, max(beyond), "°", at_most(1.0), len(beyond))


def is_good(course: Course, outcome: Outcome) -> bool:
    """Whether a trial ended as its course asks for."""
    stopped = not outcome.report.falls and "no foothold ahead" in outcome.report.stopped_because
    return stopped if course.stops else outcome.kept_up
