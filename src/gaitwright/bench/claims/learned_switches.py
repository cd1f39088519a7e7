"""Claim: from skill to skill under the learned controller as under its teacher; from driver to driver at any
phase without a fall and without a leap of torque."""

from collections.abc import Iterator, Sequence

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.alternations import SWITCHES, Alternated, alternated
from gaitwright.bench.evidence.beside_teacher import both, survived
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Then, Trial
from gaitwright.skills.library import skill_names

FIRST, SECOND = 2.5, 3.5
"""How long the first and the second skill last [s]."""
PAIR_STARTS, STARTS = 2, 20
"""Of every pair of skills; of every skill amid which drivers alternate."""
ALTERNATED = ("walk", "trot", "pace", "pronk", "bound", "gallop")
STEP = 2.0
"""Of the torque limit [%]."""
NOTE = (
    "Pairs: both skills at the speeds they are meant for, one profile each, by one driver from standing on; "
    "the second comes at a random moment within 0.6 s. Drivers: numerical and learned in turn, at random "
    f"phases, {SWITCHES} changes a start. Steps are those of the joint that changes most, over its limit."
)


def measure(context: Context) -> Iterator[Figure]:
    """All ordered pairs of skills; then changes of driver."""
    yield pairs(context)
    yield from drivers(context)


def pairs(context: Context) -> Figure:
    """Every skill to every other, beside the teacher."""
    names = skill_names(4)
    asked = [(a, b) for a in names for b in names if a != b]
    trials = []
    for number, (first, second) in list(enumerate(asked))[:: len(asked) // 10 if context.quick else 1]:
        for seed in context.seeds(PAIR_STARTS, quick=1):
            at = FIRST + 0.6 * float(np.random.default_rng([number, seed]).uniform())
            trials.append(Trial("go2", "flat", at + SECOND, seed, first, None, None, then=Then(second, at)))
    found = both(context, "every skill to every other", trials)
    return survived("go2, every skill to every other: no fall", found, beside=0.01)


def drivers(context: Context) -> Iterator[Figure]:
    """Falls amid changes of driver, and how far torques step."""
    skills = ALTERNATED[1:2] if context.quick else ALTERNATED
    seeds, found = context.seeds(STARTS), []
    for skill in skills:
        runs = context.each(f"drivers alternate in {skill}", alternated, [(skill, seed) for seed in seeds])
        found += runs
        good = sum(not run.fell for run in runs)
        what = f"go2 {skill}, {SWITCHES} changes of driver: no fall"
        yield count(what, good, len(runs), 1.0, in_short(runs), {})
    switches = np.concatenate([run.at_switch for run in found])
    what = "torque step of the tick in which the driver changes, the largest"
    yield Figure(what, float(switches.max()), "%", at_most(STEP), switches.size)
    added = {}
    for k, skill in enumerate(skills):
        runs = found[k * len(seeds) :][: len(seeds)]
        added[skill] = most_of(runs, "after") - most_of(runs, "else_where")
    worst = max(added, key=lambda skill: added[skill])
    what = "what a change of driver adds to the steps of the next 50 ms (99 of 100), the worst skill"
    yield Figure(what, added[worst], "%", at_most(STEP), len(found), worst, added)


def in_short(runs: Sequence[Alternated]) -> str:
    """The steps of some runs in words."""
    after, before = most_of(runs, "after"), most_of(runs, "else_where")
    return f"99 of 100 steps within 50 ms after a change ≤ {after:.1f} % of the limit, elsewhere {before:.1f}"


def most_of(runs: Sequence[Alternated], ticks: str) -> float:
    """What 99 of 100 steps of some ticks are at most [%]."""
    return float(np.percentile(np.concatenate([getattr(run, ticks) for run in runs]), 99))
