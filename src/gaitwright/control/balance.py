"""Balance maintenance: while profiles are played, what is off is answered by learned rules (row E5).

It acts on what the gait is asked for alone, so no torque leaps. What to do is decided once in a stumble, and
done until the robot is calm.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from gaitwright.control.balance_rules import BalanceRule, BalanceRules
from gaitwright.control.comparator import Comparator, Pattern, coded
from gaitwright.signals import Gait, MotionTarget, Sensed, SkillCall

EVERY = 0.01
"""It looks this often [s]."""
LASTS = 0.05
"""What is off for so long is a stumble [s]: sooner, one quantity alone is."""
CALM, RESTS = 0.6, 0.1
"""It is over where all is within this share of the bands for so long [s]."""
LONGEST = 1.5
"""A rule is followed for so long at most [s], so that it ends where the new aim itself is off the bands."""
HALF, QUICK = 0.5, 0.85
"""Shares of the velocity and of the period that actions ask for."""


class Balanced(NamedTuple):
    """What balance maintenance remembers."""

    rule: BalanceRule | None = None
    """That is followed."""
    pattern: Pattern = ()
    """What was off when it was decided; none: nothing was decided."""
    since: float = -1.0
    """Since when something is off, or, in a stumble, nothing [s]; negative: not now."""
    began: float = 0.0
    """When it was decided [s]."""
    looked_at: float = -1.0
    """[s]"""
    velocity: tuple[float, float] = (0.0, 0.0)
    """Forward and left: what the body does, less the sway of the gait [m/s]."""


STEADY = Balanced()
Answer = Callable[[SkillCall, tuple[float, float]], SkillCall]
"""What a call becomes at a velocity of the body."""


@dataclass(frozen=True)
class Balance:
    """Watches and answers."""

    comparator: Comparator
    rules: BalanceRules

    def watch(self, gait: Gait, target: MotionTarget, sensed: Sensed, was: Balanced) -> Balanced:
        """What is remembered after a tick in a gait."""
        if sensed.time < was.looked_at + EVERY - 1e-9:
            return was
        off = self.comparator.off(gait, target, sensed)
        if off is None:
            return STEADY
        pattern, time, forward_left = coded(off, self.widths), sensed.time, target.command[:2]
        _, _, _, x, y, _ = (off * self.comparator.units).tolist()
        now = was._replace(looked_at=time, velocity=(float(forward_left[0]) + x, float(forward_left[1]) + y))
        if was.pattern:
            return self.in_stumble(now, bool((np.abs(off) < CALM * self.widths).all()), time)
        if not any(pattern):
            return now._replace(since=-1.0)
        if was.since < 0.0:
            return now._replace(since=time)
        if time - was.since < LASTS - 1e-9:
            return now
        rule = self.rules.answer(gait.name, pattern)
        return now._replace(rule=rule, pattern=pattern, since=-1.0, began=time)

    def in_stumble(self, now: Balanced, is_calm: bool, time: float) -> Balanced:
        """The same after another look at a stumble."""
        since = -1.0 if not is_calm else now.since if now.since >= 0.0 else time
        is_over = since >= 0.0 and time - since >= RESTS - 1e-9
        if is_over or time - now.began > LONGEST:
            return STEADY._replace(looked_at=time, velocity=now.velocity)
        return now._replace(since=since)

    def answered(self, call: SkillCall, now: Balanced) -> SkillCall:
        """What the gait is asked for."""
        return call if now.rule is None else self.answers[now.rule.action](call, now.velocity)

    @cached_property
    def widths(self) -> np.ndarray:
        """The bands."""
        return self.rules.widths

    @cached_property
    def answers(self) -> dict[str, Answer]:
        """Of each action what it makes of a call."""
        return {
            "stop": lambda call, _: slowed(call, 0.0),
            "slower": lambda call, _: slowed(call, HALF),
            "go-with-it": lambda call, velocity: towards(call, velocity, HALF),
            "quicker": lambda call, _: hastened(call),
            "trot-on-the-spot": self.trot_on_the_spot,
        }

    def trot_on_the_spot(self, call: SkillCall, _: tuple[float, float]) -> SkillCall:
        """A trot that goes nowhere, where one was taught; else the gait stays, and only the velocity goes."""
        taught = self.comparator.learned.profiles.get("trot")
        still = slowed(call, 0.0)
        return replace(still, skill="trot", gait=taught[0].gait) if taught else still


def slowed(call: SkillCall, share: float) -> SkillCall:
    """A share of the velocity and of the turn."""
    forward, left = call.velocity
    return replace(call, velocity=(share * forward, share * left), turn=share * call.turn)


def towards(call: SkillCall, velocity: tuple[float, float], share: float) -> SkillCall:
    """So far towards the velocity that the body has."""
    (forward, left), (x, y) = call.velocity, velocity
    return replace(call, velocity=(forward + share * (x - forward), left + share * (y - left)))


def hastened(call: SkillCall) -> SkillCall:
    """A shorter period."""
    return replace(call, gait=replace(call.gait, period=QUICK * call.gait.period))
