"""Claim: the learned controller plays what it was taught, as fast and as steadily, from standing too."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import both, handed_over, survived
from gaitwright.bench.evidence.played_share import played_shares
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Outcome, Trial
from gaitwright.skills.library import skill_names

STARTS, SECONDS = 20, 20.0
UPRIGHT = 0.98
"""Share of the starts that must go to the end."""
LONG, LONG_SKILLS, LONG_UPRIGHT = 60.0, ("trot", "walk", "turn-left", "gallop"), 0.95
"""A minute [s], and what must last so long; turning left is an arc in trot."""
LOST, OFF = 2.0, 0.01
"""So much of the teacher's speed may be lost [%], and the velocity error may be so much larger [m/s]."""
NOTE = (
    "One profile a skill, taught at the speed that the skill is meant for, on level ground, from two starts. "
    "The numerical controller drives the first two seconds, then the learned one takes over at whatever "
    "phase the seed gives; beside it the numerical one goes on. Gains are the numerical controller's."
)


def measure(context: Context) -> Iterator[Figure]:
    """Every skill, from a hand-over and from standing; a minute of some; what is played."""
    yield from skills(context)
    yield from minutes(context)
    yield from standing_starts(context)
    yield from played_shares(context, skill_names(4))


def skills(context: Context) -> Iterator[Figure]:
    """Every skill from a hand-over: falls, and how far the velocity is from the teacher's."""
    seconds, lost, off = context.seconds(SECONDS, 6.0), {}, {}
    for skill in skill_names(4):
        trials = [handed_over(skill, seed, seconds) for seed in context.seeds(STARTS)]
        found = both(context, skill, trials)
        yield survived(f"go2 {skill}: {seconds:g} s without a fall", found, UPRIGHT)
        held, errors = (
            {driver: mean_of(figure, outcomes) for driver, outcomes in found.items()}
            for figure in (held_of, error_of)
        )
        lost[skill] = 100.0 * abs(1.0 - held["learned"] / held["numerical"])
        off[skill] = errors["learned"] - errors["numerical"]
    for what, values, unit, most in (
        ("share of the teacher's speed that is lost, the worst skill", lost, "%", LOST),
        ("velocity error less the teacher's, the worst skill", off, "m/s", OFF),
    ):
        worst = max(values, key=lambda skill: values[skill])
        yield Figure(what, values[worst], unit, at_most(most), len(values), worst, values)


def held_of(outcome: Outcome) -> float:
    """Share of the velocity asked for that was held."""
    return outcome.held


def error_of(outcome: Outcome) -> float:
    """Velocity error [m/s]."""
    return outcome.report.velocity_error_mps


def mean_of(figure: Callable[[Outcome], float], outcomes: Sequence[Outcome]) -> float:
    """The mean of a figure over the starts that went to the end."""
    return float(np.mean([figure(o) for o in outcomes if o.kept_up] or [float("nan")]))


def minutes(context: Context) -> Iterator[Figure]:
    """A minute of some skills."""
    seconds = context.seconds(LONG, 10.0)
    for skill in LONG_SKILLS:
        trials = [handed_over(skill, seed, seconds) for seed in context.seeds(STARTS)]
        found = both(context, f"{skill}, {seconds:g} s", trials)
        yield survived(f"go2 {skill}: {seconds:g} s without a fall", found, LONG_UPRIGHT)


def standing_starts(context: Context) -> Iterator[Figure]:
    """Every skill from standing, under the learned controller alone."""
    names, seeds = skill_names(4), context.seeds(STARTS)
    trials = [
        Trial("go2", "flat", 6.0, seed, skill, None, None, driver="learned")
        for skill in names
        for seed in seeds
    ]
    outcomes = context.outcomes("from standing", trials)
    fell = [trial.skill for trial, outcome in zip(trials, outcomes, strict=True) if not outcome.kept_up]
    note = ", ".join(f"{skill} {fell.count(skill)} fell" for skill in dict.fromkeys(fell))
    what = "from standing under the learned controller alone, all skills"
    yield count(what, len(trials) - len(fell), len(trials), 0.95, note, {"fell": fell})
