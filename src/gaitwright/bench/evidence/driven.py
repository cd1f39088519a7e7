"""Trips without physics that a pupil drives, and moments drawn from them."""

from collections.abc import Sequence

import numpy as np

from gaitwright.bench.teachers import Facts
from gaitwright.induction.pupil import Pupil
from gaitwright.knowledge.memory import Action
from gaitwright.learning.courses import course
from gaitwright.learning.kinematic import Driver, moments_of
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.measured import measured
from gaitwright.skills.rule_chooser import carry_out
from gaitwright.skills.situation import doing_of
from gaitwright.skills.vocabulary import VOCABULARY

PER_TRIP = 10
"""Moments drawn from a trip at most."""
STANDING = 10
"""Moments in a row of a robot that stands, after which its trip is over: nothing new would come."""
CARRIED_OUT = {
    "stop": Action("stop"),
    "turn-in-place": Action("turn-in-place"),
    "recover": Action("walk", 0.05, 0.12),
    "creep": Action("walk", 0.05, 0.15),
    "sidestep": Action("walk", 0.1, 0.25),
    "walk": Action("walk", 0.1, 0.3),
    "climb": Action("climb", 0.1, 0.3),
    "descend": Action("descend", 0.1, 0.25),
    "turn-left": Action("turn-left", 0.1, 0.5),
    "turn-right": Action("turn-right", 0.1, 0.5),
    "trot": Action("trot", 0.1, 1.0),
    "pace": Action("pace", 0.1, 1.2),
    "pronk": Action("pronk", 0.1, 1.2),
    "bound": Action("bound", 0.1, 1.6),
    "run": Action("run", 0.1, 2.0),
    "gallop": Action("gallop", 0.1, 2.0),
}
"""What a robot does at a teacher's word: as fast as wished within the skill's speeds [m/s, at 0.29 m]."""


def pupil_drives(robot: Robot, pupil: Pupil, skills: Sequence[str]) -> Driver:
    """A driver who does what the pupil says; `skills` are the words for its actions, none at first, when the
    plain chooser drives."""
    plain = DefaultChooser(robot)

    def drive(route: Route, sensed: Sensed, now: SkillCall | None) -> SkillCall:
        if not skills:
            return plain.choose(route, sensed, now)
        facts = {**measured(robot, route, sensed, now), "doing": doing_of(now)}
        verdict = pupil.decide(VOCABULARY.row(facts))
        return carry_out(robot, CARRIED_OUT[skills[verdict.action]], route, sensed)

    return drive


def trip(robot: Robot, number: int, driver: Driver) -> list[Facts]:
    """Some moments of a trip, drawn by chance, in their order."""
    moments = moments_of(course(robot, number), driver, np.random.default_rng([number, 7]))
    seen = until_it_stands([moment.facts for moment in moments])
    rng = np.random.default_rng([number, 8])
    return [seen[k] for k in sorted(rng.choice(len(seen), min(PER_TRIP, len(seen)), replace=False).tolist())]


def until_it_stands(moments: Sequence[Facts]) -> Sequence[Facts]:
    """The moments until the robot has stood for a while."""
    stood = 0
    for k, facts in enumerate(moments):
        stood = stood + 1 if facts["doing"] == "standing" else 0
        if stood == STANDING:
            return moments[: k + 1]
    return moments
