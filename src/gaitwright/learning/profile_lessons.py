"""Profiles from the numerical controller: it drives a skill, and what it does is noted, phase by phase."""

from collections.abc import Iterator

import numpy as np

from gaitwright.control.learned.law import note
from gaitwright.control.learned.profile import BINS, ROW, Profile, mean_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import HeldSkill, fixed_skill

SETTLING, SHOWN, STARTS = 3.0, 3.0, 2
"""Time until a gait is steady, time that is noted [s], and how many starts."""


def taught(
    robot: Robot, skill: str, speed: float | None = None, turn: float | None = None, seed: int = 0
) -> Profile:
    """The profile of a skill at a speed along its way [m/s] and a yaw rate [rad/s]; where these are left out,
    at those that it is meant for."""
    chooser = fixed_skill(robot, skill, speed, 0.0, turn, "numerical")
    rows = [noted(robot, driven(robot, chooser, seed + k)) for k in range(STARTS)]
    phases, table = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    call = chooser.skill_call
    stands = call.gait.duty >= 1.0  # its phase does not go on
    cycle = np.tile(table.mean(axis=0), (BINS, 1)) if stands else mean_cycle(phases, table)
    return Profile(call.gait, (*call.velocity, call.turn), cycle)


def driven(robot: Robot, chooser: HeldSkill, seed: int) -> Iterator[Lap]:
    """The laps of a start, from when it is steady on."""
    scene = load_scene("flat", seed)
    brain = Brain.of(robot, scene, chooser, DT, watches=False)
    plant = make_plant("mujoco", robot, scene, DT)
    session = Session(brain, plant, Mission(()), SETTLING + SHOWN, seed)
    for lap in session:
        if lap.sensed.time >= SETTLING:
            yield lap


def noted(robot: Robot, laps: Iterator[Lap]) -> tuple[np.ndarray, np.ndarray]:
    """Phase and `ProfileRow` of each lap."""
    phases, rows = [], []
    for lap in laps:
        row = np.empty(ROW.size(robot.n))
        command = lap.command
        note(robot.packed, lap.sensed.row, lap.target.row, command.tau, command.forces_w, row)
        phases.append(lap.target.phase)
        rows.append(row)
    return np.array(phases), np.array(rows)
