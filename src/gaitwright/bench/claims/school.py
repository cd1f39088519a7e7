"""Claim: a pupil of skills is right where nobody taught her, with few rules, and one correction mends a fault
wherever it occurs, breaks next to nothing, and is on the disk at once."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.remembering import remembering
from gaitwright.bench.evidence.whole_trip_schools import schools
from gaitwright.bench.measurement import Figure, at_least, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.knowledge.told import Told
from gaitwright.learning.exam import Trial, faults, held_out, trial
from gaitwright.learning.notes import pupil_of, settle
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST

PUPILS, HALF = 5, 12
"""Pupils whose faults are corrected, and trips of a pupil who is still learning."""
HELD_OUT = 200
FAULTS = 12
"""Faults of each pupil that are corrected."""
NOTE = (
    "The school is one of situations along trips, without physics; the pupil drives from the first moments "
    "on, hears what is right wherever she is wrong or not sure, and the teacher is never silent. Right: the "
    "same skill at the same speed range as the teacher, on scenes that no school has seen. Faults are those "
    f"of pupils after {HALF} trips; to be stored, a lesson, the rules and all that the pupil keeps in mind "
    "are written to a book. Six further teachers make notes and drop them, or go on with a skill where they "
    "would not begin it; their exams are driven by themselves."
)


def measure(context: Context) -> Iterator[Figure]:
    """The exams of whole schools, what one correction does, and teachers whose word depends on what was."""
    yield from schools(context)
    yield from corrections(context)
    yield from remembering(context)


def corrections(context: Context) -> Iterator[Figure]:
    """Faults of pupils that are still learning, each corrected once."""
    robot, teacher = robot_named("go2"), ScriptedTeacher()
    trials: list[Trial] = []
    took: list[float] = []
    for seed in context.seeds(PUPILS, quick=1):
        context.voice.say(f"corrections of pupil {seed}")
        pupil = SkillPupil(seed)
        attend(pupil, robot, teacher, seed, HALF)
        pool = held_out(robot, teacher, seed + 5000, HELD_OUT)
        rng = np.random.default_rng([seed, 3])
        found = faults(pupil, teacher, held_out(robot, teacher, seed + 9000, 4 * HELD_OUT))
        with TemporaryDirectory() as folder:
            path = stored(pupil, Path(folder) / "pupil.skills")
            for fault in found[:FAULTS]:
                trials.append(trial(pupil, teacher, fault, pool, rng))
                took.append(stored_in(path, told_at(fault, teacher.ideal(fault.facts), "a fault")))
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


def stored(pupil: SkillPupil, path: Path) -> Path:
    """A pupil with all that she was told, in a book."""
    Skillbook.new(FOREST, seed=pupil.seed).save(path)
    with open_for_learning(path) as ledger:
        for told in pupil.told:
            ledger.tell(told)
        settle(ledger, pupil)
    return path


def stored_in(path: Path, told: Told) -> float:
    """Time from a correction until lesson, rules and notes are durable in a skillbook [s]; the faults of one
    pupil come one after the other."""
    with open_for_learning(path) as ledger:
        pupil = pupil_of(ledger.book)
        began = perf_counter()
        ledger.tell(told, pupil.hear(told).events)
        settle(ledger, pupil)
        return perf_counter() - began
