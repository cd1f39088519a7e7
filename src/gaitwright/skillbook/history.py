"""What was taught, step by step."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Literal

from gaitwright.knowledge.lessons import Lesson
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.knowledge.told import Told

How = Literal["begun", "taught", "learned", "mended", "edited", "told", "forgotten"]


@dataclass(frozen=True, slots=True)
class Step:
    """One step: its lesson and how that was taken in, and the events that it moved.

    `how`: "begun" with a whole `rulebook`, without its events; "told" to the pupil (`told`), or what she was
    told of that name "forgotten" (`note`). Older books have more, which is read and not made any more: a
    lesson "taught" as a correction or "learned" by one rule, "mended" right after it contradicted earlier
    ones, and rules "edited" (a confirmation, an analogy, a new feature), whole as at the beginning; `note`
    says what they are.
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


def that_count(steps: Iterable[Step]) -> list[Told]:
    """What was told and was not forgotten since, in order."""
    steps = tuple(steps)
    gone = forgotten(steps)
    return [told for told in all_told(steps) if told.id not in gone]


def names_told(steps: Iterable[Step]) -> set[str]:
    """The names of everything that was told, whether it was forgotten since or not."""
    return {told.id for told in all_told(steps)}


def free_name(wanted: str, taken: Collection[str]) -> str:
    """A name for a lesson that none has yet: the wanted one, else that with a number."""
    name, number = wanted, 1
    while name in taken:
        number += 1
        name = f"{wanted} ({number})"
    return name
