"""Kinds of test teachers, and what they say."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from zlib import crc32

import numpy as np

from gaitwright.bench.teachers.conditions import Condition, Facts, Rule, deciding
from gaitwright.bench.teachers.met import made_up_moments


@dataclass(frozen=True, slots=True)
class Said:
    """What a teacher says at one moment."""

    skill: str
    about: str = ""
    """The number that decided, by its name; "" where she gives no reason."""


@dataclass(frozen=True)
class BenchTeacher(ABC):
    """A person who teaches: what she means, and what she says (a slip now and then)."""

    name: str
    what: str
    is_list: bool
    """Whether an ordered list of at most about 20 rules can say her policy."""
    seed: int = 0
    slips: float = 0.0
    """Share of lessons at which she says a wrong skill."""

    @property
    @abstractmethod
    def skills(self) -> tuple[str, ...]:
        """The skills she uses."""

    @abstractmethod
    def skill(self, facts: Facts, lesson: int = 0) -> str:
        """The right skill, without the reason (cheap); `lesson` = how many labels she has given before."""

    @abstractmethod
    def reason(self, facts: Facts, lesson: int = 0) -> str:
        """The number whose being otherwise would have changed the skill."""

    def means(self, facts: Facts, lesson: int = 0) -> Said:
        """The truth."""
        return Said(self.skill(facts, lesson), self.reason(facts, lesson))

    def says(self, facts: Facts, lesson: int) -> Said:
        """What she tells the pupil: the truth or, at a slip, a wrong skill with the number she looked at."""
        truth = self.means(facts, lesson)
        chance = self.chance(lesson)
        if chance.random() >= self.slips:
            return truth
        return Said(str(chance.choice([s for s in self.skills if s != truth.skill])), truth.about)

    def chance(self, lesson: int) -> np.random.Generator:
        """The chance at one lesson: the same for the same seed, teacher and lesson."""
        return np.random.default_rng((self.seed, crc32(self.name.encode()), lesson))


@dataclass(frozen=True)
class RuleList(BenchTeacher):
    """The first rule that holds gives the skill; another list may take over from some lesson on."""

    rules: tuple[Rule, ...] = ()
    otherwise: str = "walk"
    nearest: bool = False
    """Whether she names the number nearest to its bound, else the rule's main one."""
    later: tuple[Rule, ...] | None = None
    change: int = 400

    @property
    def skills(self) -> tuple[str, ...]:
        """The skills she uses, in the order of her rules."""
        return tuple(dict.fromkeys([*(r.skill for r in (*self.rules, *(self.later or ()))), self.otherwise]))

    def at(self, lesson: int) -> tuple[Rule, ...]:
        """Her rules at a lesson."""
        return self.rules if self.later is None or lesson < self.change else self.later

    def skill(self, facts: Facts, lesson: int = 0) -> str:
        """The skill of the first rule that holds."""
        return next((r.skill for r in self.at(lesson) if r.holds(facts)), self.otherwise)

    def reason(self, facts: Facts, lesson: int = 0) -> str:
        """The rule's number that decided; beyond all rules, the one that excludes the nearest rule."""
        rules = self.at(lesson)
        fired = next((i for i, r in enumerate(rules) if r.holds(facts)), len(rules))
        own = list(rules[fired].conditions) if fired < len(rules) else []
        if self.nearest:
            own.sort(key=lambda c: c.distance(facts))
        return deciding(lambda f: self.skill(f, lesson), facts, [*own, *excluding(rules[:fired], facts)])


def excluding(rules: tuple[Rule, ...], facts: Facts) -> list[Condition]:
    """The conditions that keep rules from holding, those of the rule nearest to holding first."""
    failing = [[c for c in r.conditions if not c.holds(facts)] for r in rules]
    failing.sort(key=lambda cs: (len(cs), max(c.distance(facts) for c in cs)))
    return [c for cs in failing for c in cs]


@dataclass(frozen=True)
class Counting(BenchTeacher):
    """Some rules first; then the more worries, the slower."""

    rules: tuple[Rule, ...] = ()
    worries: tuple[Condition, ...] = ()
    gaits: tuple[str, ...] = ()
    """The skill by the number of worries; the last one for that many and more."""

    @property
    def skills(self) -> tuple[str, ...]:
        """The skills she uses."""
        return tuple(dict.fromkeys([*(r.skill for r in self.rules), *self.gaits]))

    def skill(self, facts: Facts, lesson: int = 0) -> str:
        """The first rule that holds, else by the number of worries."""
        for r in self.rules:
            if r.holds(facts):
                return r.skill
        return self.gaits[min(sum(bool(w.holds(facts)) for w in self.worries), len(self.gaits) - 1)]

    def reason(self, facts: Facts, lesson: int = 0) -> str:
        """The worry (or, without one, the absent worry) nearest to being otherwise that changes the skill."""
        fired = next((r for r in self.rules if r.holds(facts)), None)
        worries = sorted(self.worries, key=lambda w: (not w.holds(facts), w.distance(facts)))
        own = fired.conditions if fired else ()
        return deciding(
            self.skill,
            facts,
            [*own, *worries, *excluding(tuple(r for r in self.rules if not r.holds(facts)), facts)],
        )


@dataclass(frozen=True)
class Weighing(BenchTeacher):
    """A weighted sum of standardised numbers, cut in bands."""

    weights: tuple[tuple[str, bool, float], ...] = ()
    """(number, whether its size counts, weight)."""
    cuts: tuple[float, ...] = ()
    bands: tuple[str, ...] = ()

    @property
    def skills(self) -> tuple[str, ...]:
        """The skills she uses."""
        return self.bands

    def parts(self, facts: Facts) -> list[float]:
        """What each number adds to the sum [standard deviations]."""
        return [w * standard(name, by_size, float(facts[name])) for name, by_size, w in self.weights]

    def skill(self, facts: Facts, lesson: int = 0) -> str:
        """The band in which the sum lies."""
        return self.bands[int(np.searchsorted(self.cuts, sum(self.parts(facts)), side="right"))]

    def reason(self, facts: Facts, lesson: int = 0) -> str:
        """The number that weighs most here, of those that could change the band."""
        parts, now = self.parts(facts), self.skill(facts)
        for i in np.argsort([-abs(p) for p in parts]):
            name = self.weights[i][0]
            if any(self.skill({**facts, name: v}) != now for v in np.unique(made_up_moments()[name])[::150]):
                return name
        return ""


def standard(name: str, by_size: bool, value: float) -> float:
    """A number (or its size) as standard deviations from its mean over made-up moments."""
    middle, scale = centre(name, by_size)
    return ((abs(value) if by_size else value) - middle) / scale


@lru_cache(maxsize=64)
def centre(name: str, by_size: bool) -> tuple[float, float]:
    """Mean and standard deviation of a number (or its size), in its own unit."""
    column = made_up_moments()[name]
    column = np.abs(column) if by_size else column
    return float(column.mean()), float(column.std())


@dataclass(frozen=True)
class Silent(BenchTeacher):
    """The same teacher without reasons."""

    of: BenchTeacher | None = None

    @property
    def skills(self) -> tuple[str, ...]:
        """Her skills."""
        assert self.of is not None
        return self.of.skills

    def skill(self, facts: Facts, lesson: int = 0) -> str:
        """Her skill."""
        assert self.of is not None
        return self.of.skill(facts, lesson)

    def reason(self, facts: Facts, lesson: int = 0) -> str:
        """None."""
        return ""

    def says(self, facts: Facts, lesson: int) -> Said:
        """The skill she says."""
        assert self.of is not None
        return Said(self.of.says(facts, lesson).skill)
