"""What a pupil made of the lessons in a book, so that she goes on as if she had never stopped.

Columns stand by their names and actions by the order in which they were first taught: another version may
have more of either.
"""

from typing import Annotated

from msgspec import Meta

from gaitwright.knowledge.json_form import MAX_INSTANCES, Count, Label, Strict
from gaitwright.knowledge.rules import MAX_RULES

Case = Annotated[int, Meta(ge=0, le=MAX_INSTANCES)]
Marks = Annotated[str, Meta(pattern="^[01]*$", max_length=MAX_INSTANCES)]
"""A yes or no for each lesson."""


HEAVIEST = 100.0
"""A lesson counts for so many others at most."""


class ColumnBound(Strict, frozen=True):
    """One condition: from `low` up to, and without, `high`; open where it is `None`."""

    column: Label
    low: float | None
    high: float | None


class ListedRule(Strict, frozen=True):
    action: Case
    bounds: Annotated[tuple[ColumnBound, ...], Meta(max_length=64)]


class RuleList(Strict, frozen=True):
    """An ordered list of rules, and what is done where none fires."""

    rules: Annotated[tuple[ListedRule, ...], Meta(max_length=MAX_RULES)] = ()
    otherwise: Case = 0


class PupilNotes(Strict, frozen=True):
    """`heard` lessons are in these notes; those taught later are still to be heard."""

    heard: Case
    seed: Annotated[int, Meta(ge=-(1 << 62), le=1 << 62)]
    own: RuleList
    rivals: Annotated[tuple[RuleList, ...], Meta(max_length=64)] = ()
    draft: RuleList | None = None
    age: Count = 0
    drafts: Count = 0
    since: Case = 0
    weights: Annotated[tuple[tuple[Case, float], ...], Meta(max_length=MAX_INSTANCES)] = ()
    """Of the lessons that count for more or less than 1, by their places among those that count."""
    surprises: Marks = ""
    mistakes: Marks = ""


def actions_in(notes: PupilNotes) -> int:
    """How many actions the notes speak of."""
    lists = (notes.own, *notes.rivals, *([notes.draft] if notes.draft else []))
    return 1 + max(max([rules.otherwise, *(rule.action for rule in rules.rules)]) for rules in lists)


def is_sound(notes: PupilNotes) -> bool:
    """Whether every weight is one of a lesson, and up to `HEAVIEST`."""
    return all(case < notes.heard and 0.0 < weight <= HEAVIEST for case, weight in notes.weights)
