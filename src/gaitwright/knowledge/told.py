"""What a teacher said at one moment: the unit in which rules are taught, and which a book keeps for ever."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from types import MappingProxyType
from typing import Literal

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Action, Fact

Given = Literal["shown", "confirmed", "corrected", "by itself", "by analogy"]
"""How it came: the teacher drove, the rules did the right thing, she stepped in, the robot noticed a mistake
of its own, or it is another lesson the other way round."""


@dataclass(frozen=True, slots=True)
class Told:
    """A moment, and what is right there.

    `id` says where and when; `facts` are what was measured; `rule` is what the teacher calls the rule,
    `action` what is right; `because` is her reason in words, `about` the fact that decided her; `scene` where
    it was: a rule seen right in several is believed more.
    """

    id: str
    facts: Mapping[str, Fact] = field(hash=False)
    rule: str
    action: Action
    because: str = ""
    about: str = ""
    scene: str = ""
    given: Given = "corrected"

    def __post_init__(self) -> None:
        """Copies the facts; one that is not finite counts as not measured. Raises `WrongUse` for a name that
        is none."""
        for name in (self.id, self.rule):
            if not name.strip() or not name.isprintable():
                raise WrongUse(f"a lesson and its rule have names that can be read, not {name!r}")
        taken = {name: fact if isinstance(fact, str) else float(fact) for name, fact in self.facts.items()}
        kept = {name: fact for name, fact in taken.items() if isinstance(fact, str) or isfinite(fact)}
        object.__setattr__(self, "facts", MappingProxyType(kept))
