"""How far the learned controller is trusted with a skill: a grade, made of what it went through (row L10).

Trust is a number from 0 to 1 for each skill. Driving without a motion bug makes it grow, a motion bug halves
it, and being handed back takes a fifth; a person may set it. Nothing is kept but the history: trust and grade
are functions of it.
"""

import math
from collections.abc import Iterable
from typing import Annotated, Literal, get_args

import msgspec
from msgspec import Meta

from gaitwright.knowledge.json_form import Facts, Label, Strict, Text

Grade = Literal["apprentice", "assistant", "partner", "skilled"]
GRADES: tuple[Grade, ...] = get_args(Grade)
APPRENTICE, ASSISTANT, PARTNER, SKILLED = GRADES
"""The numerical controller drives and the learned one watches; it drives for short stretches; it drives where
the rule is firm; it drives wherever a rule fires. Always only where its profiles cover the velocity."""
LEAST: dict[Grade, float] = {APPRENTICE: 0.0, ASSISTANT: 0.1, PARTNER: 0.4, SKILLED: 0.8}
"""The least trust of each grade."""
GROWS = 15.0
"""What trust lacks of 1 shrinks by e in so many seconds driven without a motion bug."""
WATCHING = 0.2
"""A second that was watched counts for so much, and makes no more than an assistant."""
FALLS = 0.5
"""What a motion bug leaves of trust."""
RETURNS = 0.8
"""What a trip leaves on which it was handed back for not being the taught situation: nothing went wrong."""
UNTOLD = LEAST[PARTNER]
"""Where a history begins: a skill without one was taught before there was trust, and driven all the same."""
How = Literal["taught", "drove", "watched", "bug", "returned", "set"]


class Experience(Strict, frozen=True, omit_defaults=True):
    """One entry in the history of a skill.

    `how`: its profiles were "taught" (anew: trust begins again), the learned controller "drove" it without a
    motion bug or, an apprentice, "watched" it being driven; there was a "bug", or it was "returned" to the
    numerical controller; a person "set" it to a `grade`.
    """

    skill: Label
    how: How
    seconds: Annotated[float, Meta(ge=0.0, le=1e6)] = 0.0
    """Driven or watched [s]."""
    grade: Grade | None = None
    why: Text = ""
    """On which trip, or what went wrong."""
    facts: Facts = msgspec.field(default_factory=dict)
    """All that was measured where it went wrong."""


History = tuple[Experience, ...]


def moved(trust: float, entry: Experience) -> float:
    """Trust after one more entry."""
    if entry.how == "taught":
        return 0.0
    if entry.how == "bug":
        return FALLS * trust
    if entry.how == "returned":
        return RETURNS * trust
    if entry.how == "set":
        return LEAST[entry.grade or APPRENTICE]
    if entry.how == "watched":
        return max(trust, min(grown(trust, WATCHING * entry.seconds), LEAST[ASSISTANT]))
    return grown(trust, entry.seconds)


def grown(trust: float, seconds: float) -> float:
    """Trust after so many seconds without a motion bug."""
    return 1.0 - (1.0 - trust) * math.exp(-seconds / GROWS)


def grade_of(trust: float) -> Grade:
    """The highest grade that trust is enough for."""
    reached: list[Grade] = [grade for grade in GRADES if trust >= LEAST[grade] - 1e-9]
    return reached[-1]


def trust_in(history: Iterable[Experience]) -> dict[str, float]:
    """How far each skill is trusted that has a history."""
    trust: dict[str, float] = {}
    for entry in history:
        trust[entry.skill] = moved(trust.get(entry.skill, UNTOLD), entry)
    return trust


def grades_in(history: Iterable[Experience]) -> dict[str, Grade]:
    """The grade of each skill that has a history; one without is driven as by a partner."""
    return {skill: grade_of(trust) for skill, trust in trust_in(history).items()}


def fault_in_history(history: History) -> str:
    """Why a book cannot hold this, as a sentence; empty: it can."""
    for entry in history:
        if (entry.grade is not None) != (entry.how == "set"):
            return f"in its history of trust {entry.skill} has a grade that nobody set, or was set to none"
    return ""
