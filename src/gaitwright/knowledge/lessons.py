"""What the lessons of older books say; they are read for ever and taught no more."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import Action, Fact


@dataclass(frozen=True, slots=True)
class Lesson:
    """A rule was right ("positive"), should have fired ("omission") or should not have ("commission").

    `blame` is the tree that the teacher named as the reason; `action` what an omission's missing rule does;
    `raw` holds whatever else was measured.
    """

    kind: Literal["positive", "omission", "commission"]
    rule: str
    situation: Situation
    id: str = ""
    note: str = ""
    raw: Mapping[str, Fact] = field(default_factory=dict, hash=False)
    blame: str = ""
    action: Action | None = None
