"""Who drives in a hybrid: the learned controller where it knows the case, the numerical one elsewhere (L10).

It hands back for not being in a taught situation, not for stumbling: handed back in a stumble the robot falls
more often (of 110 pushed runs 55 instead of 40).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from gaitwright.control.learned.controller import LearnedController
from gaitwright.knowledge.trust import APPRENTICE, ASSISTANT, PARTNER, SKILLED, Grade
from gaitwright.numerics.packing import Row
from gaitwright.signals import Gait, MotionTarget, SkillCall

TAKES_OVER = 0.1
"""A case must be known for so long before the learned controller takes over [s]."""
FOREIGN = 0.4
"""Where this share of the torques is not the profile's, over a cycle, the situation is not the taught one."""
STAYS_BACK = 2.0
"""Then the numerical controller drives for so long at least [s]."""
STRETCH = 2.0
"""An assistant drives for so long at a time, and then the numerical controller as long [s]."""
HYBRID, LEARNED, NUMERICAL = "hybrid", "learned", "numerical"


class Drive(NamedTuple):
    """Who drives, and since when what is known."""

    driver: str = NUMERICAL
    asked: SkillCall | None = None
    """What was asked for last, …"""
    call: SkillCall | None = None
    """… and the same with who drives it."""
    known_since: float = 0.0
    """From then on the case is known [s]."""
    foreign: float = 0.0
    """Mean share of the torques that is not the profile's."""
    handed_back: tuple[tuple[float, str], ...] = ()
    """When which skill was handed back for not being the taught situation [s]."""


UNDECIDED = Drive()


@dataclass(frozen=True)
class Takeover:
    """Decides at every tick of a hybrid who drives."""

    learned: LearnedController
    dt: float
    """Control period [s]."""
    grades: Mapping[str, Grade] = field(default_factory=dict)
    """How far the learned controller is trusted with each skill; one without a grade is a partner's."""

    def decide(
        self, asked: SkillCall, gait: Gait, target: MotionTarget, time: float, was: Drive, played: Row | None
    ) -> Drive:
        """Who drives now. `asked`: by whoever chooses the skill; `gait`: that the legs are in; `time` [s];
        `played`: of the tick before, where the learned controller drove it."""
        is_known = self.trusts(asked, gait) and self.learned.covers(gait, target)
        return self.decided(asked, gait, is_known, time, was, played)

    def trusts(self, asked: SkillCall, gait: Gait) -> bool:
        """Whether the learned controller may drive a gait by the rule that asks for it."""
        grade = self.grades.get(gait.name, PARTNER)
        return grade != APPRENTICE and (asked.firm or (grade == SKILLED and asked.ruled))

    def decided(
        self, asked: SkillCall, gait: Gait, is_known: bool, time: float, was: Drive, played: Row | None
    ) -> Drive:
        """Who drives now, where it was found out already whether the case is known."""
        foreign, handed_back = was.foreign, was.handed_back
        if was.driver == LEARNED and played is not None:
            foreign += self.dt / gait.period * (1.0 - float(played[-1]) - foreign)
        since = was.known_since
        if not is_known or was.asked is None:
            since = max(since, time + TAKES_OVER)
        if foreign > FOREIGN:
            since, is_known, foreign = time + STAYS_BACK, False, 0.0
            handed_back = (*handed_back, (time, gait.name))
        is_assistant = self.grades.get(gait.name, PARTNER) == ASSISTANT
        if is_assistant and time - since >= STRETCH - 1e-9:
            since, is_known = time + STRETCH, False
        driver = LEARNED if is_known and time >= since - 1e-9 else NUMERICAL
        is_same = driver == was.driver and asked is was.asked
        call = was.call if is_same else replace(asked, driver=driver)
        return Drive(driver, asked, call, since, foreign, handed_back)

    def kept(self, asked: SkillCall, was: Drive) -> Drive:
        """The same driver as before, whatever is asked for: amid a stumble is no time to change."""
        return (
            was if asked is was.asked else was._replace(asked=asked, call=replace(asked, driver=was.driver))
        )
