"""Claim: Go2's rules are right where nobody taught them, after five demonstrations of each skill or fewer.

And one correction mends a fault wherever it occurs, breaks next to nothing, and is on the disk at once.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.whole_trip_schools import schools
from gaitwright.bench.measurement import Figure, at_least, at_most
from gaitwright.bench.peers.rules_client import RulesPeer
from gaitwright.bench.trial import robot_named
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.apprentice import corrected, step_of
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.exam import Trial, faults, held_out, right_share, trial
from gaitwright.learning.school import Schooled, attend, demonstrate, demonstrations, keep
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST

SCHOOLS, PER_SKILL, TRIPS, HALF = 5, 5, 60, 12
"""Pupils, demonstrations of each use of a skill, trips watched, and trips of a pupil still learning."""
HELD_OUT = 200
FAULTS = 12
"""Faults of each pupil that are corrected."""
NOTE = (
    "The school is one of situations along trips, without physics. A demonstration is a stretch of a trip in "
    "which the teacher uses a skill, at first or where rules went wrong; walk has four uses, each a rule. "
    "Right: the same skill at the same speed range as the teacher. CART and k-NN get the same demonstrated "
    "moments as our rules beside them, but cannot be told the teacher's reason. Faults are those of pupils "
    f"after {HALF} trips. Whole trips: a pupil of `induction` drives from the first moments on, each moment "
    "is labelled, and the teacher has no border within which she is silent."
)


def measure(context: Context) -> Iterator[Figure]:
    """The exam of whole schools, the same beside scikit-learn, and what one correction does."""
    robot, teacher, seeds = robot_named("go2"), ScriptedTeacher(), context.seeds(SCHOOLS, quick=1)
    whole: list[Schooled] = []
    right = []
    for seed in seeds:
        context.voice.say(f"school {seed}")
        whole.append(attend(robot, teacher, seed, PER_SKILL, 20 if context.quick else TRIPS))
        right.append(right_share(whole[-1].rulebook, teacher, held_out(robot, teacher, seed, HELD_OUT)))
    yield share(f"go2's rules: right on {HELD_OUT} held-out situations", right, at_least(95.0))
    yield share("go2's rules: trees that are firm", [s.report.firm for s in whole], at_least(80.0))
    yield from beside(context, seeds)
    yield from corrections(context, seeds)
    yield from schools(context)


def share(what: str, each: Sequence[float], wanted=None, note: str = "") -> Figure:
    """The mean of shares [%]."""
    told = f"{100 * min(each):.1f} to {100 * max(each):.1f} %" + (f"; {note}" if note else "")
    return Figure(what, 100.0 * float(np.mean(each)), "%", wanted, len(each), told, {"each": list(each)})


# --- beside other learners -------------------------------------------------------------------------
def beside(context: Context, seeds: Sequence[int]) -> Iterator[Figure]:
    """Demonstrations alone: our rules, CART and k-NN on the same moments."""
    robot, teacher, ours, problem = robot_named("go2"), ScriptedTeacher(), [], []
    for seed in seeds:
        shown = demonstrations(robot, teacher, seed, PER_SKILL)
        book = demonstrate(Rulebook(FOREST), teacher, shown).rulebook
        asked = held_out(robot, teacher, seed, HELD_OUT)
        ours.append(right_share(book, teacher, asked))
        problem.append(as_rows(teacher, [m for one in shown for m in one.moments], asked))
    yield share("go2's rules from demonstrations alone: right", ours)
    what = "the same less the best of CART and k-NN"
    with RulesPeer("sklearn", {"schools": problem}) as peer:
        if peer.reason is not None:
            yield Figure(what, float("nan"), "%", at_least(0.0), 0, peer.reason)
            return
        theirs = {name: list(shares) for name, shares in peer.greeting["shares"].items()}
    for name, shares in theirs.items():
        yield share(f"{name} on the same demonstrations: right", shares)
    best = max(theirs, key=lambda name: float(np.mean(theirs[name])))
    more = [a - b for a, b in zip(ours, theirs[best], strict=True)]
    yield share(what, more, at_least(0.0), f"the best is {best}")


def as_rows(teacher: ScriptedTeacher, shown: Sequence[DecisionPoint], asked: Sequence[DecisionPoint]) -> dict:
    """Situations as numbers, and the teacher's action in each as a word."""
    return {
        "shown": [row_of(moment) for moment in shown],
        "skills": [str(teacher.ideal(moment.raw).action) for moment in shown],
        "asked": [row_of(moment) for moment in asked],
        "right": [str(teacher.ideal(moment.raw).action) for moment in asked],
    }


def row_of(moment: DecisionPoint) -> list[int]:
    """A 1 for each value that the situation is below: with the groups of the trees, not only the leaves."""
    pairs = zip(FOREST.trees, moment.situation.values, strict=True)
    return [int(tree.is_below(str(leaf), value)) for tree, leaf in pairs for value in tree.values[1:]]


# --- one correction --------------------------------------------------------------------------------
def corrections(context: Context, seeds: Sequence[int]) -> Iterator[Figure]:
    """Faults of pupils that are still learning, each corrected once."""
    robot, teacher = robot_named("go2"), ScriptedTeacher()
    trials: list[Trial] = []
    took: list[float] = []
    for seed in seeds:
        context.voice.say(f"corrections of pupil {seed}")
        book = attend(robot, teacher, seed, PER_SKILL, HALF).rulebook
        pool = held_out(robot, teacher, seed + 5000, HELD_OUT)
        rng = np.random.default_rng([seed, 3])
        for fault in faults(book, teacher, held_out(robot, teacher, seed + 9000, 4 * HELD_OUT))[:FAULTS]:
            trials.append(trial(book, teacher, fault, pool, rng))
            took.append(stored(book, teacher, fault))
    variants, mended = sum(t.variants for t in trials), sum(t.mended for t in trials)
    earlier, broken = sum(t.earlier for t in trials), sum(t.broken for t in trials)
    note = f"{len(trials)} faults, {variants} variants"
    what = "one correction: unseen variants of the fault mended"
    yield Figure(what, 100.0 * mended / max(variants, 1), "%", at_least(95.0), len(trials), note)
    what = f"one correction: earlier right decisions broken, of {HELD_OUT} situations"
    worst = max((t.broken / max(t.earlier, 1) for t in trials), default=0.0)
    note = f"worst single correction {100 * worst:.1f} %"
    yield Figure(what, 100.0 * broken / max(earlier, 1), "%", at_most(1.0), len(trials), note)
    slowest = 1e3 * max(took, default=float("nan"))
    note = f"median {1e3 * float(np.median(took)):.1f} ms" if took else ""
    yield Figure("from correction to stored rule, slowest", slowest, "ms", at_most(100.0), len(took), note)


def stored(book: Rulebook, teacher: ScriptedTeacher, fault: DecisionPoint) -> float:
    """Time from a correction until the rule is durable in a skillbook [s]."""
    correction = teacher.judge(step_of(book, fault).action, fault.raw)
    assert correction is not None
    with TemporaryDirectory() as folder:
        path = Path(folder) / "pupil.skills"
        Skillbook.new(book).save(path)
        with open_for_learning(path) as ledger:
            began = perf_counter()
            keep(ledger, corrected(ledger.book.rulebook, fault, correction))
            return perf_counter() - began
