"""Rules of balance: a pattern of what is off → a corrective action, as people read them (row E5)."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from gaitwright.control.comparator import QUANTITIES, Pattern, in_mirror, sentence
from gaitwright.errors import WrongUse, unknown

ACTIONS = {
    "stop": "ask for no velocity, in the same gait",
    "slower": "ask for half the velocity",
    "go-with-it": "ask for a velocity half-way to the one it has",
    "quicker": "step in 0.85 of the period",
    "trot-on-the-spot": "change to a trot that goes nowhere",
}
"""What can be done, each with what it says."""


@dataclass(frozen=True, slots=True)
class BalanceRule:
    """A pattern and its answer."""

    when: Pattern
    """What must be off, and to which side; 0: indifferent. It holds in the mirror too."""
    action: str
    """A name of `ACTIONS`."""
    skills: tuple[str, ...] = ()
    """In these alone; none: in every skill."""
    met: int = 0
    saved: int = 0
    lost: int = 0
    """Of so many pushed runs that it is for, so many fell without it alone, and so many with it alone."""

    def __post_init__(self) -> None:
        """Raises `WrongUse` for an action that there is not, or a pattern of another length."""
        if self.action not in ACTIONS:
            raise unknown("action of balance", self.action, ACTIONS)
        if len(self.when) != len(QUANTITIES) or not set(self.when) <= {-1, 0, 1}:
            raise WrongUse(f"a pattern is −1, 0 or +1 of {', '.join(QUANTITIES)}, not {self.when}")

    @property
    def name(self) -> str:
        """What a person calls it by: no other rule of a list has it."""
        off = [f"{name}{'+' if sign > 0 else '-'}" for name, sign in zip(QUANTITIES, self.when, strict=True)
               if sign]  # fmt: skip
        return ":".join([*self.skills, *(off or ["anything"]), self.action])

    def holds(self, skill: str, pattern: Pattern) -> bool:
        """Whether it is for a pattern, or for its mirror image, in a skill."""
        if self.skills and skill not in self.skills:
            return False
        return any(pattern) and any(includes(seen, self.when) for seen in (pattern, in_mirror(pattern)))

    @property
    def sentence(self) -> str:
        """The rule as it reads."""
        where = f"in {' or '.join(self.skills)} " if self.skills else ""
        off = sentence(self.when) if any(self.when) else "anything is off"
        return (
            f"IF {where}{off} (or the mirror image) THEN {ACTIONS[self.action]} until calm "
            f"(of {self.met} pushed runs saved {self.saved}, lost {self.lost})"
        )


def includes(pattern: Pattern, when: Pattern) -> bool:
    """Whether all is off that a rule names."""
    return all(sign in (0, seen) for seen, sign in zip(pattern, when, strict=True))


@dataclass(frozen=True)
class BalanceRules:
    """Rules in order: the first that holds answers. Bands and rules are learned together."""

    bands: Mapping[str, float]
    """How far each quantity may be off by itself, in the robot's own units."""
    rules: tuple[BalanceRule, ...] = field(default=())

    def __post_init__(self) -> None:
        """Raises `WrongUse` where a band is missing or two rules are one."""
        if set(self.bands) != set(QUANTITIES):
            there = ", ".join(self.bands) or "nothing"
            raise WrongUse(f"bands are of {', '.join(QUANTITIES)}, not of {there}")
        names = [rule.name for rule in self.rules]
        if len(set(names)) < len(names):
            raise WrongUse("two rules of balance have one pattern and one action")

    def answer(self, skill: str, pattern: Pattern) -> BalanceRule | None:
        """The rule for a pattern; `None` where none is better than to go on."""
        return next((rule for rule in self.rules if rule.holds(skill, pattern)), None)

    def without(self, name: str) -> "BalanceRules":
        """The rest. Raises `WrongUse` for a rule that there is not."""
        names = [rule.name for rule in self.rules]
        if name not in names:
            raise unknown("rule of balance", name, names)
        return BalanceRules(self.bands, tuple(rule for rule in self.rules if rule.name != name))

    @property
    def widths(self) -> Float[np.ndarray, "6"]:
        """The bands in the order of `QUANTITIES`."""
        return np.array([self.bands[name] for name in QUANTITIES])
