"""A moment at which a skill is chosen."""

from collections.abc import Mapping
from dataclasses import dataclass

from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import Fact
from gaitwright.signals import SkillCall
from gaitwright.skills.situation import named
from gaitwright.skills.vocabulary import IN_USE, RULE_IN_USE


@dataclass(frozen=True, slots=True)
class DecisionPoint:
    """One moment in which a skill is chosen: where the robot was, what was measured, and what came of it.

    `memory` is working memory before the choice, with the skill in use; `id` says where and when.
    """

    id: str
    situation: Situation
    raw: Mapping[str, float]
    memory: Mapping[str, Fact]

    @property
    def facts(self) -> dict[str, Fact]:
        """Everything that a rule or a teacher may go by: the numbers, what the robot has been doing, and
        what working memory holds."""
        kept = {name: fact for name, fact in self.memory.items() if name != RULE_IN_USE}
        return {**kept, **self.raw, "doing": str(self.situation["doing"])}


def decision_point(name: str, raw: Mapping[str, float], now: SkillCall | None) -> DecisionPoint:
    """The moment at which these numbers were measured, while `now` was in use."""
    memory = {} if now is None else {**now.memory, IN_USE: now.skill}
    return DecisionPoint(name, named(raw, now), raw, memory)
