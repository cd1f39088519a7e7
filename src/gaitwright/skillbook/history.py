"""What was taught, step by step: enough to make the rulebook again from nothing."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal

from gaitwright.errors import WrongUse
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.modifier import Inconsistency, Lesson, learn
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Event, Instance, Rulebook
from gaitwright.knowledge.told import Told

How = Literal["begun", "taught", "learned", "mended", "edited", "told", "forgotten"]


@dataclass(frozen=True, slots=True)
class Step:
    """One step: its lesson and how that was taken in, and the events that it moved.

    `how`: "told" to a pupil who finds her own bounds (`told`), or what she was told of that name "forgotten"
    (`note`); in older books "taught" by `teach`, "learned" by `learn`, "mended" by `mend` right after a step
    that ended in a contradiction. "begun" and "edited" (a confirmation, an analogy, a new feature, a person's
    change) hold the whole `rulebook` after them, without its events, and say in `note` what they are.
    """

    how: How
    lesson: Lesson | None = None
    rulebook: Rulebook | None = None
    note: str = ""
    events: tuple[Event, ...] = ()
    told: Told | None = None


@dataclass(frozen=True, slots=True)
class Ancestor:
    """A book that this one came from: its name and the hash of all it held then."""

    how: Literal["forked", "merged"]
    name: str
    digest: str


def all_told(steps: Iterable[Step]) -> list[Told]:
    """Everything that was told, in order, whether it was forgotten since or not."""
    return [step.told for step in steps if step.told is not None]


def forgotten(steps: Iterable[Step]) -> set[str]:
    """The names of what was told and does not count any more."""
    return {step.note for step in steps if step.how == "forgotten"}


def number_lesson(lesson: Lesson, lessons: int) -> Lesson:
    """A lesson as a file keeps it: numbered, and without measurements that are not finite."""
    name = lesson.id or f"lesson {lessons + 1}"
    kept = Instance(name, lesson.kind, lesson.situation, lesson.raw).raw
    return replace(lesson, id=name, raw=dict(kept))


def replayed(steps: Iterable[Step]) -> Rulebook:
    """The rulebook that the steps of an older book make when they are taken again.

    Raises `WrongUse` where they cannot be.
    """
    rulebook: Rulebook | None = None
    trouble: Inconsistency | None = None
    for step in steps:
        if step.rulebook is not None:
            events = (*(rulebook.events if rulebook else ()), *step.events)
            rulebook, trouble = replace(step.rulebook, events=events), None
        elif rulebook is None or step.lesson is None:
            raise WrongUse(f"a history begins with a rulebook, and a step {step.how!r} has a lesson")
        else:
            rulebook, trouble = take_lesson(rulebook, step.how, step.lesson, trouble)
    if rulebook is None:
        raise WrongUse("a history has at least the step that began it")
    return rulebook


def take_lesson(
    rulebook: Rulebook, how: How, lesson: Lesson, trouble: Inconsistency | None
) -> tuple[Rulebook, Inconsistency | None]:
    """The rulebook after one lesson, and the contradiction that it ended in."""
    if how == "mended":
        if trouble is None:
            raise WrongUse(f"{lesson.id} was mended, but nothing contradicted it")
        return mend(rulebook, trouble, lesson.blame).rulebook, None
    learned = teach(rulebook, lesson) if how == "taught" else learn(rulebook, lesson)
    return learned.rulebook, learned.trouble
