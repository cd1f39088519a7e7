"""Claim: trust that grows over trips lets the learned controller drive more, and it falls no more often."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from gaitwright.bench.claims.hybrid import (
    MUCH,
    SCHOOLS,
    Course,
    Driven,
    driven,
    go_on,
    learn_profiles,
    profiles_in,
    share_driven,
)
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import handed_over
from gaitwright.bench.evidence.taught_missions import EXAMS, STARTS, Trip, starts_of
from gaitwright.bench.measurement import Figure, at_least, at_most, count
from gaitwright.bench.trial import Trial, robot_named
from gaitwright.control.takeover import LEARNED
from gaitwright.knowledge.trust import grades_in
from gaitwright.learning.balance_trials import SKILLS, drawn
from gaitwright.learning.practice import practise
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST

PRACTICE = 6
"""Trips of practice after each school."""
PUSHED = 60
LEAST_PUSH = 0.5
"""[N·s/kg]; the rest is drawn as for balance."""
NOTE = (
    "As bench hybrid; but after each school six trips of practice on other courses, on which trust grows, "
    "and then the same thirty missions: a skilled controller drives by rules that are not firm too. Pushed "
    "runs: a third on rough ground of 5 to 9 cm, any direction and phase; the alarm asks for speed 0 in a "
    "stumble."
)


def measure(context: Context) -> Iterator[Figure]:
    """After schools of growing length and practice: who drove, and falls; then the alarm, on and off."""
    schools = SCHOOLS[:1] if context.quick else SCHOOLS
    trips = starts_of(EXAMS[:2] if context.quick else EXAMS, 1 if context.quick else STARTS)
    with TemporaryDirectory() as folder:
        path = Skillbook.new(FOREST, "go2", "a school", context.seed).save(Path(folder) / "book.skills")
        learn_profiles(context, path)
        done, first = 0, 0
        for school in schools:
            go_on(context, path, done, school)
            done = school
            yield practised(context, str(path), first, school)
            first += PRACTICE
            yield from exams(context, str(path), trips, school)
    yield alarm(context)


def practised(context: Context, path: str, first: int, school: int) -> Figure:
    """The share of the ticks that the learned controller had on trips of practice, trip by trip."""
    robot, shares, falls = robot_named("go2"), [], 0
    profiles = profiles_in(path)
    with open_for_learning(path) as ledger:
        for number in range(first, first + PRACTICE):
            context.voice.say(f"practice: trip {number + 1}")
            report = practise(robot, ledger, profiles, context.seed, number).report
            shares.append(100.0 * report.driver_share.get(LEARNED, 0.0))
            falls += report.falls
        grades = grades_in(ledger.book.trust)
    each = ", ".join(f"{share:.0f}" for share in shares)
    lower = ", ".join(f"{skill} {grade}" for skill, grade in grades.items() if grade != "skilled")
    note = f"trip by trip {each}; {falls} falls; not skilled: {lower or 'none'}"
    what = f"after a school of {school} trips: share of the ticks by the learned controller in practice"
    return Figure(
        what, float(np.mean(shares)), "%", None, PRACTICE, note, {"shares": shares, "grades": grades}
    )


def exams(context: Context, path: str, trips: Sequence[Trip], school: int) -> Iterator[Figure]:
    """The figures of the missions after practice."""
    found: dict[bool, list[Driven]] = {}
    for plays in (True, False):
        asked = [Course(trip, path, plays, is_trusted=True) for trip in trips]
        found[plays] = context.each(f"missions after {school} trips and practice", driven, asked)
    hybrid, alone = found[True], found[False]
    what = f"after a school of {school} trips and practice"
    yield share_driven(what, trips, hybrid, alone, at_least(MUCH))
    fell, beside = (100.0 * sum(d.fell for d in some) / len(trips) for some in (hybrid, alone))
    note = f"{fell:.1f} %, numerical alone {beside:.1f} %"
    yield Figure(f"{what}: falls beyond the numerical controller's", fell - beside, "points", at_most(1.0),
                 len(trips), note)  # fmt: skip


def alarm(context: Context) -> Figure:
    """Pushed runs with the alarm, and the same ones without."""
    trials = [pushed(seed) for seed in context.seeds(PUSHED, quick=4)]
    on, off = (
        context.outcomes(f"pushed, alarm {name}", [replace(trial, alarmed=alarmed) for trial in trials])
        for name, alarmed in (("on", True), ("off", False))
    )
    saved = sum(a.kept_up and not b.kept_up for a, b in zip(on, off, strict=True))
    lost = sum(b.kept_up and not a.kept_up for a, b in zip(on, off, strict=True))
    note = f"without it {sum(o.kept_up for o in off)} of {len(off)}; {saved} saved, {lost} lost by it"
    return count("pushed runs survived with the alarm", sum(o.kept_up for o in on), len(on), None, note, {})


def pushed(seed: int) -> Trial:
    """A run that is pushed once, everything drawn from its seed."""
    skill = SKILLS[seed % len(SKILLS)]
    scene, push = drawn(np.random.default_rng([seed, 99]), skill, LEAST_PUSH, 3.0)
    return replace(handed_over(skill, seed, 7.5, scene), push=push)
