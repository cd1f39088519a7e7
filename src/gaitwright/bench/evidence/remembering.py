"""Teachers whose word depends on what was: notes in working memory, and what is in use.

Their policies (`bench/teachers/remembering/`) were written by somebody who did not know the learner.
"""

from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import as_file, files

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least
from gaitwright.bench.trial import robot_named
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.rules import Event
from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.learning.exam import held_out, rights
from gaitwright.learning.policy_file import policy_in
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.model.robot import Robot

SEEDS, TRIPS, EXAM = 1, 40, 500
"""Pupils of each teacher, their trips, and the moments of an exam."""
BEFORE = "doing"
"""The fact of the moment that tells what was: what kind of motion is in use."""
FOLDER = files("gaitwright.bench.teachers") / "remembering"


class Forgetful(SkillPupil):
    """A pupil who looks at the moment alone: what is noted or in use is nothing to her."""

    def row(self, facts: Mapping[str, Fact]) -> Float[np.ndarray, " columns"]:
        return super().row({n: fact for n, fact in facts.items() if n not in (*self.notes, BEFORE)})

    def learn_ends(self, lesson: str) -> tuple[Event, ...]:
        return ()


def teachers(robot: Robot) -> dict[str, ScriptedTeacher]:
    """Each teacher by the name of her policy."""
    found = {}
    for entry in sorted(FOLDER.iterdir(), key=lambda one: one.name):
        with as_file(entry) as path:
            if path.suffix == ".toml":
                found[path.stem] = ScriptedTeacher(policy_in(str(path), robot))
    return found


def remembering(context: Context) -> Iterator[Figure]:
    """How right pupils of such teachers are, and how right one who looks at the moment alone."""
    robot, right, past = robot_named("go2"), [], []
    known = teachers(robot)
    names = list(known)[:1] if context.quick else list(known)
    for name in names:
        for seed in context.seeds(SEEDS, quick=1):
            context.voice.say(f"{name}, pupil {seed}")
            exam = held_out(robot, known[name], seed + 300, EXAM)
            matters = what_was_matters(known[name], exam)
            pupils = [kind(seed) for kind in (SkillPupil, Forgetful)]
            for pupil in pupils:
                attend(pupil, robot, known[name], seed, TRIPS)
            found = [rights(pupil, known[name], exam) for pupil in pupils]
            right.append([100.0 * one.mean() for one in found])
            past.append([100.0 * one[matters].mean() for one in found])
    yield from told(names, np.array(right), np.array(past))


def told(
    names: Sequence[str], right: Float[np.ndarray, "runs 2"], past: Float[np.ndarray, "runs 2"]
) -> Iterator[Figure]:
    """The figures of all pupils; the second of each is the one who looks at the moment alone."""
    each = right[:, 0].reshape(len(names), -1).mean(axis=1)
    note = "; ".join(f"{name} {mean:.1f}" for name, mean in zip(names, each.tolist(), strict=True))
    what = f"notes and hysteresis: right after {TRIPS} trips"
    yield Figure(what, float(right[:, 0].mean()), "%", at_least(95.0), len(right), note)
    what = "notes and hysteresis: right where only what was before decides"
    note = f"who looks at the moment alone: {past[:, 1].mean():.1f} %, and {right[:, 1].mean():.1f} % of all"
    yield Figure(what, float(past[:, 0].mean()), "%", at_least(90.0), len(past), note)


def what_was_matters(teacher: ScriptedTeacher, exam: Sequence[DecisionPoint]) -> Bool[np.ndarray, " exam"]:
    """Where the teacher would do something else if nothing had been before."""
    alone = [{**moment.raw, "doing": str(moment.situation["doing"])} for moment in exam]
    return np.array(
        [
            teacher.ideal(moment.facts).action != teacher.ideal(facts).action
            for moment, facts in zip(exam, alone, strict=True)
        ]
    )
