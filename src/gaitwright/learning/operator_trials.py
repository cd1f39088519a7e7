"""How a leg does under a terrain operator: how high it comes, of what it was asked (row L4)."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED
from gaitwright.gait.foot_references import feet_in_world
from gaitwright.gait.operators import Operator
from gaitwright.gait.state import SWING
from gaitwright.ground.scene import load_scene
from gaitwright.learning.operator_lessons import imagining
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill

HANDED_OVER, LOOKED_AT, SECONDS = 1.0, 2.0, 6.0
"""The teacher drives first, then the pupil; from then on feet are looked at, to the end [s]."""


@dataclass(frozen=True)
class Swung:
    """What is tried: a leg that takes an obstacle for seen, in a skill at what it is meant for."""

    robot: Robot
    skill: str
    leg: int
    size: float
    """Of the obstacle [m]."""
    operators: tuple[Operator, ...] = ()
    profiles: tuple[Profile, ...] = ()
    """Of the skill, for the learned controller; none: the numerical one drives on."""
    seed: int = 0


class Reached(NamedTuple):
    """How high the foot came, mean of its swings [m]."""

    asked: float
    reached: float
    fell: bool = False

    @property
    def share(self) -> float:
        """Of what was asked."""
        return self.reached / self.asked if self.asked > 0.0 else float("nan")


def swung(trial: Swung) -> Reached:
    """Runs a trial on level ground."""
    robot, scene = trial.robot, load_scene("flat", trial.seed)
    chooser = fixed_skill(robot, trial.skill, None, 0.0, None, "")
    brain = imagining(
        Brain.of(robot, scene, chooser, DT, watches=False), trial.operators, trial.leg, trial.size
    )
    if trial.profiles:
        brain = brain.with_profiles({trial.skill: trial.profiles})
    session = Session(brain, make_plant("mujoco", robot, scene, DT), Mission(()), SECONDS, trial.seed)
    swings: list[list[tuple[float, float]]] = []
    is_down = True
    for lap in session:
        if trial.profiles and lap.call.driver != LEARNED and lap.sensed.time >= HANDED_OVER:
            session.drive(LEARNED)
        state = session.mind.memories.gait.state
        was_down, is_down = is_down, state.mode[trial.leg] != SWING
        if is_down or lap.sensed.time < LOOKED_AT:
            continue
        if was_down or not swings:
            swings.append([])
        turn, at = rotation(lap.sensed.orientation_wb), tuple(lap.sensed.position_w)
        foot = feet_in_world(robot.arrays, turn, at, lap.sensed.q)[trial.leg, 2]
        level = state.origin[trial.leg, 2]
        swings[-1].append((lap.target.feet_w[trial.leg, 2] - level, foot - level))
    apexes = [np.max(one, axis=0) for one in swings[1:-1]]  # the first and the last may be cut
    asked, reached = np.mean(apexes or [(0.0, 0.0)], axis=0)
    return Reached(float(asked), float(reached), session.lap is not None and session.lap.fell)
