"""The critic: an ideal trace against the rules' own, up to where they first differ (algorithm B, §5.4.2)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import Action


@dataclass(frozen=True, slots=True)
class DecisionPoint:
    """One moment in which a skill is chosen: where the robot was, what was measured, and what came of it.

    `memory` is working memory before the choice; `id` says where and when.
    """

    id: str
    situation: Situation
    raw: Mapping[str, float]
    memory: Mapping[str, str | float]


@dataclass(frozen=True, slots=True)
class TraceStep:
    """What was done at a moment: the action, by which rule (empty where no rule did it)."""

    moment: DecisionPoint
    action: Action | None
    rule: str = ""


@dataclass(frozen=True, slots=True)
class Criticism:
    """What the critic found.

    `right` are the steps of the rules that were as in the ideal trace, up to the first that was not: there
    `wrong` is what the rules did (`None`: no difference) and `ideal` what should have been done. A rule that
    fired there erred by commission; the rule that should have fired, by omission.
    """

    right: tuple[TraceStep, ...]
    wrong: TraceStep | None = None
    ideal: TraceStep | None = None

    @property
    def at(self) -> int:
        """The place of the first difference."""
        return len(self.right)


def criticise(ideal: Sequence[TraceStep], done: Sequence[TraceStep]) -> Criticism:
    """The rules' trace against the ideal one. Both are over the same moments."""
    right: list[TraceStep] = []
    for wanted, step in zip(ideal, done, strict=True):
        if step.action != wanted.action:
            return Criticism(tuple(right), step, wanted)
        right.append(step)
    return Criticism(tuple(right))
