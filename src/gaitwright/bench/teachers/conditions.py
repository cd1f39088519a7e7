"""Conditions, ordered lists of rules and honest reasons, for teachers that are written by hand or drawn."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from gaitwright.bench.teachers.met import MET, in_steps, plausible, spread

Facts = Mapping[str, float | str]
INF = float("inf")


@dataclass(frozen=True, slots=True)
class Within:
    """A number, its size, a - factor * b, or the larger of a and b lies in [lo, hi)."""

    a: str
    lo: float = -INF
    hi: float = INF
    kind: Literal["is", "size", "minus", "larger"] = "is"
    b: str = ""
    factor: float = 1.0

    def value(self, facts: Mapping[str, Any]) -> Any:
        """The quantity, in the unit of a (facts may hold arrays)."""
        if self.kind == "is":
            return facts[self.a]
        if self.kind == "size":
            return abs(facts[self.a])
        if self.kind == "minus":
            return facts[self.a] - self.factor * facts[self.b]
        return np.maximum(facts[self.a], facts[self.b])

    def holds(self, facts: Mapping[str, Any]) -> Any:
        """Whether it holds (an array where the facts hold arrays)."""
        value = self.value(facts)
        return (self.lo <= value) & (value < self.hi)

    def distance(self, facts: Facts) -> float:
        """How far the quantity is from the nearest bound, in spreads of a."""
        value = float(self.value(facts))
        return min(abs(value - self.lo), abs(value - self.hi)) / spread(self.a)

    def otherwise(self, facts: Facts, far: bool) -> Iterator[tuple[str, float]]:
        """Other plausible values of its numbers: just across a bound or, `far`, anywhere."""
        for name in self.names():
            bounds = [bound for bound in (self.lo, self.hi) if abs(bound) < INF]
            near = [v for bound in bounds for v in in_steps(name, self._across(name, bound, facts))]
            values = (MET[name][0], *MET[name][2]) if far else near
            yield from ((name, v) for v in values if plausible(name, v))

    def names(self) -> tuple[str, ...]:
        """The numbers it looks at, the main one first."""
        return (self.a, self.b) if self.b else (self.a,)

    def _across(self, name: str, bound: float, facts: Facts) -> tuple[float, ...]:
        """The values of one of its numbers just below and just above a bound."""
        at = bound
        if self.kind == "minus":
            a, b = float(facts[self.a]), float(facts[self.b]) if self.b else 0.0
            at = bound + self.factor * b if name == self.a else (a - bound) / self.factor
        little = 1e-6 * (1.0 + abs(at))
        near = (at - little, at, at + little)
        return (*near, *(-v for v in near)) if self.kind == "size" else near


@dataclass(frozen=True, slots=True)
class Doing:
    """It has been doing one of these kinds of motion."""

    words: tuple[str, ...]

    def holds(self, facts: Mapping[str, Any]) -> Any:
        """Whether it holds."""
        return facts["doing"] in self.words

    def distance(self, facts: Facts) -> float:
        """No number is looked at: as far as can be where it fails."""
        return 0.0 if self.holds(facts) else 10.0

    def otherwise(self, facts: Facts, far: bool) -> Iterator[tuple[str, float]]:
        """No number to change."""
        return iter(())


Condition = Within | Doing


@dataclass(frozen=True, slots=True)
class Rule:
    """A skill where all conditions hold; the first condition is the one a person would name."""

    skill: str
    conditions: tuple[Condition, ...]

    def holds(self, facts: Mapping[str, Any]) -> Any:
        """Whether all conditions hold."""
        return all(c.holds(facts) for c in self.conditions)


def rule(skill: str, *conditions: Condition) -> Rule:
    """A rule in short."""
    return Rule(skill, conditions)


def over(name: str, lo: float) -> Within:
    """The number is lo or more."""
    return Within(name, lo=lo)


def under(name: str, hi: float) -> Within:
    """The number is less than hi."""
    return Within(name, hi=hi)


def between(name: str, lo: float, hi: float) -> Within:
    """The number lies in [lo, hi)."""
    return Within(name, lo, hi)


def size(name: str, lo: float, hi: float = INF) -> Within:
    """The number's size lies in [lo, hi)."""
    return Within(name, lo, hi, "size")


def less_than(a: str, factor: float, b: str, more: float = 0.0) -> Within:
    """Number a is less than factor * b + more."""
    return Within(a, hi=more, kind="minus", b=b, factor=factor)


def at_least(a: str, factor: float, b: str, more: float = 0.0) -> Within:
    """Number a is factor * b + more, or larger."""
    return Within(a, lo=more, kind="minus", b=b, factor=factor)


def deciding(skill: Callable[[Facts], str], facts: Facts, conditions: Iterable[Condition]) -> str:
    """The first number, in the order of the conditions, that changes the skill when it alone is otherwise.

    A number that need only cross its bound comes before one that has to lie somewhere else altogether.
    """
    now, conditions = skill(facts), tuple(conditions)
    for far in (False, True):
        for condition in conditions:
            for name, value in condition.otherwise(facts, far):
                if skill({**facts, name: value}) != now:
                    return name
    return ""
