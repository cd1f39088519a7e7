"""Numerical and learned controller in turn, at random phases of a skill: falls, and steps of torque."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.bench.trial import profile_of, robot_named
from gaitwright.control.handover import LASTS
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill

SWITCHES = 12
FIRST, SHORTEST, LONGEST = 2.0, 0.2, 0.6
"""The first change of driver, and the time from one to the next [s]."""
STEADY = 1.0
"""From then on steps of torque count [s]."""


class Alternated(NamedTuple):
    """What became of a start. Steps: of the joint that changes most in a tick, over its limit [%]."""

    fell: bool
    at_switch: Float[np.ndarray, " switches"]
    """Steps of the ticks in which the driver changes."""
    after: Float[np.ndarray, " ticks"]
    """Steps of those while one driver's torques go over into the other's."""
    else_where: Float[np.ndarray, " rest"]
    """Steps of all others."""


def alternated(asked: tuple[str, int]) -> Alternated:
    """One start of a skill, driven in turn by the numerical and the learned controller."""
    skill, seed = asked
    robot, scene = robot_named("go2"), load_scene("flat", seed)
    waits = np.random.default_rng([seed, 3]).uniform(SHORTEST, LONGEST, SWITCHES)
    times = list(FIRST + np.cumsum(waits))
    chooser = fixed_skill(robot, skill, None, 0.0, None, "")
    brain = Brain.of(robot, scene, chooser, DT).with_profiles({skill: (profile_of("go2", skill),)})
    plant = make_plant("mujoco", robot, scene, DT)
    session = Session(brain, plant, Mission(()), times[-1] + LONGEST, seed)
    torques, drivers, fell = [], [], False
    for lap in session:
        torques.append(lap.command.tau / robot.tau_max)
        drivers.append(lap.call.driver)
        fell = lap.fell
        if times and lap.sensed.time >= times[0]:
            times.pop(0)
            session.drive("learned" if drivers[-1] == "numerical" else "numerical")
    steps = 100.0 * np.abs(np.diff(np.array(torques), axis=0)).max(axis=(1, 2))
    changes = np.array(drivers[1:]) != np.array(drivers[:-1])
    since = np.arange(len(steps)) - np.maximum.accumulate(
        np.where(changes, np.arange(len(steps)), -len(steps))
    )
    amid = (since > 0) & (since <= round(LASTS / DT))
    calm = (since > round(LASTS / DT)) & (np.arange(len(steps)) * DT > STEADY)
    return Alternated(fell, steps[changes], steps[amid], steps[calm])
