"""Schools over whole trips with a teacher who is never silent: how right, how short, how sure."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.exam import held_out
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.learning.whole_trips import attend_trips

SCHOOLS, LABELS, EXAM = 3, (400, 800, 1600, 2400), 1000


@dataclass(frozen=True, slots=True)
class Examined:
    """A pupil after so many labels: shares of an exam, and how many rules (the last line counts)."""

    right: float
    sure: float
    wrong_while_sure: float
    rules: int


def schools(context: Context) -> Iterator[Figure]:
    """What whole schools come to, with the teacher's reasons."""
    labels = LABELS[:1] if context.quick else LABELS
    each = [school(context, seed, labels) for seed in context.seeds(SCHOOLS, quick=1)]
    for k, n in enumerate(labels):
        wanted = at_least(95.5) if n == LABELS[-1] else None
        found = [row[k] for row in each]
        note = (
            f"{told([e.rules for e in found])} rules, sure in {100 * np.mean([e.sure for e in found]):.0f} %"
        )
        right = [100.0 * e.right for e in found]
        what = f"whole trips, no border: right after {n} labels"
        yield Figure(what, float(np.mean(right)), "%", wanted, len(found), note, {"each": right})
    last = [row[-1] for row in each]
    most = float(max(e.rules for e in last))
    yield Figure("whole trips: most rules", most, "", at_most(25.0), len(last))
    worst = 100.0 * max(e.wrong_while_sure for row in each for e in row)
    what = "whole trips: wrong while sure, of all moments, the worst"
    yield Figure(what, worst, "%", at_most(1.0), len(each) * len(labels))


def told(numbers: Sequence[int]) -> str:
    """The least and the largest of some numbers."""
    return f"{min(numbers)}" if min(numbers) == max(numbers) else f"{min(numbers)} to {max(numbers)}"


def school(context: Context, seed: int, labels: Sequence[int]) -> list[Examined]:
    """One pupil, examined after so many labels each time, on scenes that she never saw."""
    robot, teacher = robot_named("go2"), ScriptedTeacher(border=0.0)
    pupil, exam = SkillPupil(seed), held_out(robot, teacher, seed, EXAM)
    found: list[Examined] = []

    def after(done: int) -> None:
        context.voice.say(f"school {seed} over whole trips: {done} of {labels[-1]} labels", now=False)
        if done in labels:
            found.append(examined(pupil, teacher, exam))

    attend_trips(pupil, robot, teacher, labels[-1], after)
    return found


def examined(pupil: SkillPupil, teacher: ScriptedTeacher, exam: Sequence[DecisionPoint]) -> Examined:
    """How a pupil does in an exam."""
    choices = pupil.choose_all(exam)
    truth = [teacher.ideal(moment.raw).action for moment in exam]
    right = np.array([choice.action == action for choice, action in zip(choices, truth, strict=True)])
    sure = np.array([choice.sure for choice in choices])
    return Examined(right.mean(), sure.mean(), (sure & ~right).mean(), len(pupil.pupil.lines.rules) + 1)
