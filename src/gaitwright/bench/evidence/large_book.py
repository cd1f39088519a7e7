"""How long a lesson takes a pupil who knows very much already: 200 rules over 40 numbers, 20,000 cases."""

from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.induction.cases import NOBODY, Cases
from gaitwright.induction.columns import SPEED, WAY, Quantity, Vocabulary
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, actions_of, fired
from gaitwright.induction.pupil import Lesson, Pupil

NUMBERS, RULES, CASES, ACTIONS, LESSONS = 40, 200, 20_000, 20, 1000
KINDS = ("height",) * 5 + (WAY,) * 3 + (SPEED,) * 4
"""Kinds of the first numbers: what may be compared with what, as among a robot's."""
SIGNED = 30
"""Numbers from here on have a sign, so that their size is a column too."""
SLIPS = 0.1
"""Share of the lessons that contradict the rules."""
WARM = 5
"""Lessons before the clock counts, all contradictions: the first ones compile."""


def large_book(context: Context) -> Figure:
    """The slowest of many lessons, one in ten of which contradicts the rules."""
    lessons = 50 if context.quick else LESSONS
    rng = np.random.default_rng(context.seed)
    pupil, more, truth = knowing(rng, lessons + WARM)
    took = []
    for k in range(lessons + WARM):
        slips = k < WARM or rng.random() < SLIPS
        said = int(rng.integers(ACTIONS)) if slips else int(truth[k])
        began = perf_counter()
        pupil.hear(Lesson(more[:, k].copy(), said, NOBODY, 60 + k // 10))
        took.append(1e3 * (perf_counter() - began))
        context.voice.say(f"a large book: {k + 1} of {lessons + WARM} lessons", now=False)
    took = took[WARM:]
    note = f"median {np.median(took):.0f} ms; {len(pupil.vocabulary.columns)} columns"
    what = f"slowest lesson at {NUMBERS} numbers, {RULES} rules and {CASES} cases"
    return Figure(what, max(took), "ms", at_most(100.0), lessons, note, {"ms": took})


def knowing(rng: np.random.Generator, more: int) -> tuple[Pupil, np.ndarray, np.ndarray]:
    """A pupil who says 20,000 cases by the list that made them, more moments, and what is right there."""
    facts = tuple(
        Quantity(f"n{k}", "u", KINDS[k] if k < len(KINDS) else "", signed=k >= SIGNED) for k in range(NUMBERS)
    )
    vocabulary = Vocabulary(facts)
    raw = rng.normal(size=(CASES + more, NUMBERS))
    names = vocabulary.names
    x = np.array([vocabulary.row(dict(zip(names, row, strict=True))) for row in raw.tolist()]).T
    lines = Lines(tuple(narrow_rule(rng) for _ in range(RULES)), 0)
    truth = actions_of(lines, fired(lines, x))
    known = np.ascontiguousarray(x[:, :CASES])
    columns = len(vocabulary.columns)
    cases = Cases(
        known,
        np.argsort(known, axis=1, kind="stable"),
        truth[:CASES].copy(),
        np.ones(CASES),
        np.full(CASES, NOBODY),
        vocabulary.reads,
        np.zeros((ACTIONS, columns), np.bool_),
        vocabulary.price,
    )
    pupil = Pupil.who_knows(vocabulary, cases, rng.integers(0, 50, CASES), lines)
    return pupil, x[:, CASES:], truth[CASES:]


def narrow_rule(rng: np.random.Generator) -> RuleLine:
    """A rule of two narrow intervals: some hundred cases."""
    bounds = []
    for column in rng.choice(NUMBERS, 2, replace=False).tolist():
        low = 0.8 * float(rng.normal())
        bounds.append(Bound(column, low, low + 0.22))
    return RuleLine(int(rng.integers(ACTIONS)), tuple(bounds))
