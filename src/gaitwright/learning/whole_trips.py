"""A school over whole trips: the pupil drives, and the teacher says at every moment what is right.

Nothing is left out: no demonstrations picked beforehand, no border within which she is silent, no limit to
how often she corrects.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.knowledge.memory import remembered
from gaitwright.learning.courses import course
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.kinematic import Driver, moments_of
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import Teacher
from gaitwright.learning.trips import SCHOOL, teacher_drives
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.rule_chooser import carry_out
from gaitwright.skills.situation import measured, named

BEFORE_DRIVING = 10
"""Moments that the teacher drives at the very beginning."""
FIRST = 700_000
"""Numbers of the courses begin here: those of other schools and exams lie elsewhere."""


@dataclass(frozen=True, slots=True)
class Attended:
    """What came of a trip: how many moments were labelled so far, and at how many the pupil was wrong."""

    labels: int
    wrong: int


def attend_trips(
    pupil: SkillPupil,
    robot: Robot,
    teacher: Teacher,
    labels: int,
    after: Callable[[int], None] = lambda labels: None,
) -> Attended:
    """Trips until so many moments were labelled; `after` is told each time how many are."""
    done = wrong = 0
    for scene, moments in enumerate(driven_trips(pupil, robot, teacher)):
        for moment in moments:
            shown = teacher.ideal(moment.raw)
            wrong += pupil.choose(moment).action != shown.action
            pupil.hear(moment, shown, f"trip {scene}")
            done += 1
            after(done)
            if done == labels:
                return Attended(done, wrong)
    return Attended(done, wrong)


def driven_trips(pupil: SkillPupil, robot: Robot, teacher: Teacher) -> Iterator[list[DecisionPoint]]:
    """Trips that the pupil drives as far as she has learned, on and on."""
    k = 0
    while True:
        number = (SCHOOL * 1000 + pupil.seed) * 1_000_000 + FIRST + k
        rng = np.random.default_rng([number, 7])
        yield moments_of(course(robot, number), pupil_drives(pupil, robot, teacher), rng)
        k += 1


def pupil_drives(pupil: SkillPupil, robot: Robot, teacher: Teacher) -> Driver:
    """A driver who does what the pupil would; at the very beginning what the teacher would."""
    teachers = teacher_drives(robot, teacher)

    def drive(route: Route, sensed: Sensed, now: SkillCall | None) -> SkillCall:
        raw = measured(robot, route, sensed, now)
        choice = pupil.choose(DecisionPoint("", named(raw, now), raw, {}))
        if choice.action is None or len(pupil.instances) < BEFORE_DRIVING:
            return teachers(route, sensed, now)
        return replace(carry_out(robot, choice.action, route, sensed), memory=remembered({}))

    return drive
