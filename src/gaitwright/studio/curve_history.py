"""What a person changed, step by step: undone and done again."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeVar

from gaitwright.errors import WrongUse
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import Operator
from gaitwright.studio.curve_torque import TorqueEdit

LONGEST = 100
"""Steps that can be undone."""
Cell = tuple[str, tuple[float, float, float]]
"""A skill, and the velocity of one of its profiles."""
K = TypeVar("K")
V = TypeVar("V")


@dataclass(frozen=True)
class Snapshot:
    """All edits that count."""

    cycles: Mapping[str, LegCycle] = field(default_factory=dict)
    """By the skill."""
    torques: Mapping[Cell, TorqueEdit] = field(default_factory=dict)
    operators: tuple[Operator, ...] = ()
    """In the order in which they are tried, before those that were there."""


def with_one(known: Mapping[K, V], key: K, value: V) -> Mapping[K, V]:
    """A mapping with one more, or another, value; nobody changes it any more."""
    return MappingProxyType({**known, key: value})


class History:
    """Snapshots, and which of them counts; the oldest are forgotten."""

    def __init__(self) -> None:
        self.before: list[Snapshot] = []
        self.now = Snapshot()
        self.behind: list[Snapshot] = []

    def add(self, snapshot: Snapshot) -> None:
        """One more step; what was undone is gone."""
        self.before = [*self.before, self.now][-LONGEST:]
        self.now, self.behind = snapshot, []

    def undo(self) -> Snapshot:
        """One step back. Raises `WrongUse` where there is none."""
        if not self.before:
            raise WrongUse("there is no edit to undo")
        self.behind.append(self.now)
        self.now = self.before.pop()
        return self.now

    def redo(self) -> Snapshot:
        """One step on again. Raises `WrongUse` where none was undone."""
        if not self.behind:
            raise WrongUse("there is no undone edit to do again")
        self.before.append(self.now)
        self.now = self.behind.pop()
        return self.now
