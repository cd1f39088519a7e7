"""Claim: Go2 passes from any skill to any other without a stop and without a fall."""

from collections.abc import Iterator

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Then, Trial
from gaitwright.skills.library import skill_names

UPRIGHT = 0.98
FIRST, SECOND = 2.5, 3.5
"""How long the first and the second skill last [s]."""
STARTS = 2
"""Of every pair; each switches at another moment of the gait."""
NOTE = (
    "Each skill at the speed it is meant for; the switch comes at a random moment within 0.6 s. A gait that "
    "cannot step at the present speed begins when the one before has slowed the robot down."
)


def measure(context: Context) -> Iterator[Figure]:
    """All ordered pairs of the skills of four legs."""
    names = skill_names(4)
    pairs = [(a, b) for a in names for b in names if a != b]
    if context.quick:
        pairs = pairs[:: len(pairs) // 10]
    trials = []
    for number, (first, second) in enumerate(pairs):
        for seed in context.seeds(STARTS, quick=1):
            at = FIRST + 0.6 * float(np.random.default_rng([number, seed]).uniform())
            trials.append(Trial("go2", "flat", at + SECOND, seed, first, None, None, then=Then(second, at)))
    outcomes = context.outcomes("go2 transitions", trials)
    pairs_failed = [
        f"{trial.skill} → {trial.then.skill}"
        for trial, outcome in zip(trials, outcomes, strict=True)
        if trial.then and not outcome.kept_up
    ]
    good = len(trials) - len(pairs_failed)
    note = f"fell: {', '.join(pairs_failed[:6])}" if pairs_failed else f"{len(pairs)} ordered pairs"
    every = {"fell": pairs_failed}
    yield count("go2, every skill to every other: no fall", good, len(trials), UPRIGHT, note, every)
