"""Trips that a teacher drives over courses drawn from a seed, without physics."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from gaitwright.knowledge.memory import applied, remembered
from gaitwright.learning.courses import course
from gaitwright.learning.decision_point import DecisionPoint, decision_point
from gaitwright.learning.kinematic import Driver, moments_of
from gaitwright.learning.teacher import Teacher
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.measured import measured
from gaitwright.skills.rule_chooser import carry_out
from gaitwright.skills.vocabulary import RULE_IN_USE

SCHOOL, EXAM = 1, 2
"""What a seed is put behind to number courses, so that no exam was a lesson."""
MOST_COURSES = 400
"""Courses gone through at most."""


def teacher_drives(robot: Robot, teacher: Teacher) -> Driver:
    """A driver who does what the teacher would."""

    def drive(route: Route, sensed: Sensed, now: SkillCall | None) -> SkillCall:
        shown = teacher.ideal(decision_point("", measured(robot, route, sensed, now), now).facts)
        call = carry_out(robot, shown.action, route, sensed)
        memory = applied(shown.action, now.memory if now else {})
        return replace(call, memory=remembered({**memory, RULE_IN_USE: shown.rule}))

    return drive


def trips(robot: Robot, teacher: Teacher, seed: int, kind: str = "") -> Iterator[list[DecisionPoint]]:
    """Trips that the teacher drives, on and on."""
    for k in range(MOST_COURSES):
        number = seed * 1_000_000 + k
        rng = np.random.default_rng([number, 7])
        yield moments_of(course(robot, number, kind), teacher_drives(robot, teacher), rng)
