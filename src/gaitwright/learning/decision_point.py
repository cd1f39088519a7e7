"""A moment at which a skill is chosen."""

from collections.abc import Mapping
from dataclasses import dataclass

from gaitwright.knowledge.forest import Situation


@dataclass(frozen=True, slots=True)
class DecisionPoint:
    """One moment in which a skill is chosen: where the robot was, what was measured, and what came of it.

    `memory` is working memory before the choice; `id` says where and when.
    """

    id: str
    situation: Situation
    raw: Mapping[str, float]
    memory: Mapping[str, str | float]
