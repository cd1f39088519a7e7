"""Loads of real gaits: what the force distribution was asked in simulations from varied starts."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.sharing_oracles import Task
from gaitwright.bench.trial import DT, Trial, brain_for, robot_named
from gaitwright.control.inverse_dynamics import load_of, packed_load
from gaitwright.ground.scene import load_scene
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.plant.registry import make_plant
from gaitwright.session import Session
from gaitwright.signals import Mission

SECONDS = 2.0
STARTS = 5
EVERY = 3
"""Of so many ticks one is taken: neighbours are much alike."""
GAITS = (
    Trial("go2", "flat", SECONDS, 0, "trot", 0.4),
    Trial("go2", "rough:0.03", SECONDS, 0, "walk", 0.25),
    Trial("go2", "rough:0.03", SECONDS, 0, "trot", 0.4, method="lp"),
    Trial("go2", "flat", SECONDS, 0, "turn-in-place", turn=0.8),
    Trial("go2", "flat", SECONDS, 0, "run", 1.0),
    Trial("thesis", "flat", SECONDS, 0, "walk", 0.4),
    Trial("thesis", "flat", SECONDS, 0, "trot", 0.5),
    Trial("hexapod", "flat", SECONDS, 0, "walk", 0.1),
    Trial("hexapod", "rough:0.01", SECONDS, 0, "trot", 0.15),
)


def loads_of_gaits(context: Context, number: int) -> list[Task]:
    """So many loads, evenly from all gaits and starts; every one of them with a foot down."""
    starts, found = context.seeds(STARTS, quick=1), []
    for trial in GAITS:
        context.voice.say(f"recording {trial.robot} {trial.skill}", now=False)
        for seed in starts:
            found += [task for task in loads(replace(trial, seed=seed), EVERY) if task.stance.any()]
    return [found[i] for i in np.linspace(0, len(found) - 1, number).astype(int)]


def loads(trial: Trial, every: int = 1) -> Iterator[Task]:
    """What the distribution was asked at every n-th tick but the first."""
    robot, scene = robot_named(trial.robot), load_scene(trial.scene, trial.seed)
    weight = robot.total_mass * GRAVITY
    plant = make_plant(trial.plant, robot, scene, DT)
    laps = Session(brain_for(trial, robot, scene), plant, Mission(()), trial.seconds, trial.seed)
    for number, (last, lap) in enumerate(pairwise(laps)):
        if number % every == 0:
            target, sensed = lap.target, lap.sensed
            yield Task(
                load_of(packed_load(robot, target, sensed)), target.stance, target.load_scale,
                target.friction, target.normal_w,
                last.command.forces_w, robot.tau_max, sensed.qd, weight, robot.height,
            )  # fmt: skip
