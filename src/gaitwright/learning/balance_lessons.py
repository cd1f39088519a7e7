"""Rules of balance, learned by trying: what saves pushed runs becomes a rule (row E5).

Each run is made without an answer, and again with each action from the moment on at which something is off.
Half of the runs find the rules, one by one, the best first; the other half has to confirm each.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import comb

import numpy as np

from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES, Pattern
from gaitwright.control.learned.profile import Profile
from gaitwright.learning.balance_trials import SKILLS, Run, Trial, trial
from gaitwright.model.robot import Robot

RUNS = 160
"""Pushed runs that are tried with every action, unless so many are asked for."""
UNPUSHED = 40
"""Runs without a push from which the bands come."""
WIDER = 1.1
"""A band is so many times as wide as what is off without a push."""
UNSURE = 0.05
"""A rule saves more than it loses: by chance it would look like that less often than this."""
REFUSALS = 5
"""After so many rules that the other half did not confirm no more are looked for: one would by chance."""
MOST_OFF = 2
"""Quantities that a rule names at most."""
ANYTHING: Pattern = (0,) * len(QUANTITIES)


@dataclass(frozen=True)
class Lesson:
    """A pushed run, and what each action made of it."""

    skill: str
    pattern: Pattern
    fell: bool
    """Without an answer."""
    fell_with: Mapping[str, bool]


Side = Callable[[Sequence[Trial]], list[Run]]
"""Who makes runs: side by side, with progress."""


def learned(
    robot: Robot, profiles: Mapping[str, Sequence[Profile]], first: int, runs: int, make: Side
) -> tuple[BalanceRules, list[Lesson]]:
    """Bands and rules from runs that are numbered from `first` on, and what they rest on."""
    still = make([trial(robot, profiles, first + k, None, is_pushed=False) for k in range(UNPUSHED)])
    rules = BalanceRules(bands_of(still))
    lessons = lessons_of(robot, profiles, rules, range(first, first + runs), make)
    return replace(rules, rules=tuple(rules_from(lessons))), lessons


def bands_of(still: Sequence[Run]) -> dict[str, float]:
    """How far each quantity may be off by itself, in the robot's own units."""
    farthest = WIDER * np.max([run.farthest for run in still], axis=0)
    return {name: round(float(width), 3) for name, width in zip(QUANTITIES, farthest, strict=True)}


def lessons_of(
    robot: Robot,
    profiles: Mapping[str, Sequence[Profile]],
    bands: BalanceRules,
    numbers: Sequence[int],
    make: Side,
) -> list[Lesson]:
    """What each action makes of each run in which something was off."""
    plain = make([trial(robot, profiles, number, bands) for number in numbers])
    off = [(number, run) for number, run in zip(numbers, plain, strict=True) if run.pattern]
    tries = {action: replace(bands, rules=(BalanceRule(ANYTHING, action),)) for action in ACTIONS}
    jobs = [trial(robot, profiles, number, rules) for number, _ in off for rules in tries.values()]
    came = iter(make(jobs))
    return [
        Lesson(run.skill, run.pattern, run.fell, {action: next(came).fell for action in tries})
        for _, run in off
    ]


def rules_from(lessons: Sequence[Lesson]) -> list[BalanceRule]:
    """Rules in the order in which they are asked, each found on one half and confirmed on the other."""
    in_turn = sorted(lessons, key=lambda one: one.skill)  # every second one of each skill
    shown, held_out = in_turn[::2], in_turn[1::2]
    found: list[BalanceRule] = []
    refused: set[str] = set()
    while len(refused) < REFUSALS:
        sure = [one for one in candidates(shown) if is_sure(one.saved, one.lost)]
        best = max((one for one in sure if one.name not in refused), key=merit, default=None)
        if best is None:
            break
        again = counted(best, held_out)
        if again.saved <= again.lost:
            refused.add(best.name)
            continue
        found.append(added(best, again))
        shown = [one for one in shown if not best.holds(one.skill, one.pattern)]
        held_out = [one for one in held_out if not best.holds(one.skill, one.pattern)]
    return found


def candidates(lessons: Sequence[Lesson]) -> list[BalanceRule]:
    """All rules of a few quantities, in one skill or in all, with what they would have done."""
    places = [p for size in range(MOST_OFF + 1) for p in combinations(range(len(QUANTITIES)), size)]
    patterns = [
        tuple(dict(zip(place, signs, strict=True)).get(k, 0) for k in range(len(QUANTITIES)))
        for place in places
        for signs in product((-1, 1), repeat=len(place))
    ]
    where = [(), *((skill,) for skill in SKILLS)]
    return [
        counted(BalanceRule(pattern, action, skills), lessons)
        for pattern in patterns
        for skills in where
        for action in ACTIONS
    ]


def counted(rule: BalanceRule, lessons: Sequence[Lesson]) -> BalanceRule:
    """The rule with what it would have done in some runs."""
    met = [one for one in lessons if rule.holds(one.skill, one.pattern)]
    saved = sum(one.fell and not one.fell_with[rule.action] for one in met)
    lost = sum(one.fell_with[rule.action] and not one.fell for one in met)
    return replace(rule, met=len(met), saved=saved, lost=lost)


def added(one: BalanceRule, other: BalanceRule) -> BalanceRule:
    """The rule with what it did in two lots of runs."""
    counts = one.met + other.met, one.saved + other.saved, one.lost + other.lost
    return replace(one, met=counts[0], saved=counts[1], lost=counts[2])


def merit(rule: BalanceRule) -> tuple[int, int, int]:
    """The better rule saves more than it loses by more; of two alike the one that is for fewer runs, which
    leaves the others to another rule, then the one that names less."""
    return rule.saved - rule.lost, -rule.met, -sum(map(abs, rule.when)) - len(rule.skills)


def is_sure(saved: int, lost: int) -> bool:
    """Whether a rule that saves as often as it loses would hardly come out like this (sign test)."""
    n = saved + lost
    return n > 0 and sum(comb(n, k) for k in range(saved, n + 1)) / 2.0**n <= UNSURE
