"""Working memory: named facts about the world and the goals, edited by what rules add and delete (row L1)."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from gaitwright.errors import WrongUse
from gaitwright.induction.columns import Fact

Memory = Mapping[str, Fact]
"""Facts by name; never changed in place."""


@dataclass(frozen=True, slots=True)
class Action:
    """The right-hand side: a skill in a speed range until a condition holds, and what that does to memory.

    `deletes` are names of facts, `adds` names with values; what is in both is replaced. `details` are further
    settings, by name, for whoever carries the action out (a torque profile, an operator's size).
    """

    skill: str
    slowest: float = 0.0
    fastest: float = 0.0
    until: str = ""
    adds: tuple[tuple[str, Fact], ...] = ()
    deletes: tuple[str, ...] = ()
    details: tuple[tuple[str, Fact], ...] = ()

    def __post_init__(self) -> None:
        """Raises `WrongUse` for a speed range that is none."""
        if not self.skill.strip():
            raise WrongUse("an action names a skill")
        if not -math.inf < self.slowest <= self.fastest < math.inf:  # NaN is refused too
            raise WrongUse(f"{self.skill}: speeds from {self.slowest} to {self.fastest} are no range")


NOTED, NOT_NOTED = "noted", "not noted"
"""What working memory says of a note that a teacher makes by its name, and of one that is not made."""


def noting(names: Sequence[str]) -> tuple[tuple[str, Fact], ...]:
    """What an action adds that makes these notes."""
    return tuple((name, NOTED) for name in names)


def notes_in(action: Action) -> tuple[str, ...]:
    """The notes that an action makes."""
    return tuple(name for name, fact in action.adds if fact == NOTED)


def read_notes(names: Iterable[str], facts: Memory) -> dict[str, Fact]:
    """Whether each note is made, by what is remembered."""
    return {name: NOTED if facts.get(name) == NOTED else NOT_NOTED for name in names}


def said_of(action: Action) -> str:
    """An action in a few words."""
    text = action.skill
    if action.fastest > 0.0:
        single = action.slowest == action.fastest
        text += f" at {'' if single else f'{action.slowest:g} to '}{action.fastest:g} m/s"
    if action.until:
        text += f" until {action.until}"
    if action.adds:
        text += f", noting {' and '.join(name for name, _ in action.adds)}"
    if action.deletes:
        text += f", forgetting {' and '.join(action.deletes)}"
    return text


def remembered(facts: Mapping[str, Fact]) -> Memory:
    """Working memory that holds these facts."""
    return MappingProxyType(dict(facts))


def applied(action: Action, memory: Memory) -> Memory:
    """Working memory after the action: its deletions first, then its additions."""
    kept = {name: fact for name, fact in memory.items() if name not in action.deletes}
    return MappingProxyType(kept | dict(action.adds))
