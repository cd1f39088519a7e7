"""Profiles from the numerical controller: it drives a skill, and what it does is noted, phase by phase."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.law import note
from gaitwright.control.learned.profile import BINS, ROW, Profile, Table, as_kept, mean_cycle, torque_error
from gaitwright.control.numerical import NumericalController
from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from gaitwright.skills.library import find_skill, gait_of, skill_names

SETTLING, SHOWN, STARTS = 3.0, 3.0, 2
"""Time until a gait is steady, time that is noted [s], and how many starts."""
PROBES = 8
"""States of a cycle in which the teacher is asked what it would do."""
MEANT = 0.5
"""Of how far the rates of joints of a leg that is down were off, this share goes into a profile. It is most
of a blow at touch-down, and where feet land at other moments than the teacher's it strikes at the wrong one:
with all of it run fell into a limp in which one front foot stays down for less than the other."""
OFF_COURSE = 0.03
"""So much faster than asked for the robot is in them, over √(g h): feedback has something to do."""
OUT_OF_DATE = 0.02
"""A teacher whose answers differ by more than this share teaches other profiles."""


def taught(
    robot: Robot, skill: str, speed: float | None = None, turn: float | None = None, seed: int = 0
) -> Profile:
    """The profile of a skill at a speed along its way [m/s] and a yaw rate [rad/s]; where these are left out,
    at those that it is meant for. Raises `WrongUse` where the robot does not keep it up."""
    chooser = fixed_skill(robot, skill, speed, 0.0, turn, "numerical")
    call = chooser.skill_call
    starts = cycles_of(robot, chooser, seed)
    table = as_kept(np.mean(starts, axis=0))
    repeat = torque_error(starts[1], starts[0], robot.n)
    return Profile(call.gait, (*call.velocity, call.turn), table, repeat, answers_of(robot, call))


def cycles_of(robot: Robot, chooser: HeldSkill, seed: int) -> list[Table]:
    """The mean cycles of a skill from `STARTS` starts; so many may fall before. Raises `WrongUse`."""
    cycles, fell = [], 0
    for start in range(seed, seed + 2 * STARTS):
        try:
            cycles.append(cycle_of(robot, chooser, start))
        except WrongUse:
            fell += 1
            if fell > STARTS or (fell == STARTS and not cycles):
                raise
        if len(cycles) == STARTS:
            break
    return cycles


def cycle_of(robot: Robot, chooser: HeldSkill, seed: int) -> Table:
    """The mean cycle of a skill from one start."""
    phases, rows = noted(robot, driven(robot, chooser, seed))
    if chooser.skill_call.gait.duty >= 1.0:  # its phase does not go on
        return np.tile(rows.mean(axis=0), (BINS, 1))
    return eased(robot, mean_cycle(phases, rows))


def eased(robot: Robot, table: Table) -> Table:
    """A table whose legs on the ground are regulated towards the rates they should have, too."""
    where = ROW.slices(robot.n)
    down = np.repeat(table[:, where["stance"]] >= 0.5, 3, axis=1)
    table[:, where["lag_rate"]] *= np.where(down, MEANT, 1.0)
    return table


def driven(robot: Robot, chooser: HeldSkill, seed: int) -> Iterator[Lap]:
    """The laps of a start, from when it is steady on. Raises `WrongUse` where the robot falls."""
    scene = load_scene("flat", seed)
    brain = Brain.of(robot, scene, chooser, DT, watches=False)
    plant = make_plant("mujoco", robot, scene, DT)
    session = Session(brain, plant, Mission(()), SETTLING + SHOWN, seed)
    for lap in session:
        if lap.fell:
            raise WrongUse(f"{robot.name} does not keep {lap.call.skill} up: {lap.stopped_because}")
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


# --- is it still true ------------------------------------------------------------------------------
def answers_of(robot: Robot, call: SkillCall) -> Float[np.ndarray, "probes torques"]:
    """Torques that coordinator and numerical controller give along a gait on the spot, a little too fast.

    No physics is in them, so they are the same whenever robot, gains and coordination are.
    """
    steps = PROBES * max(1, round(call.gait.period / DT / PROBES))
    cycle = desired_cycle(robot, call.gait, (0.0, 0.0), steps=steps)
    coordinator, controller = Coordinator(robot, DT), NumericalController(robot)
    hurry = OFF_COURSE * robot.natural_frequency * robot.height * np.array([1.0, 0.5, 0.0])
    memory, answers = coordinator.begin(cycle.sensed(0)), []
    for step in range(steps):
        sensed = cycle.sensed(step)
        sensed = replace(sensed, velocity_w=sensed.velocity_w + hurry)
        target, memory = coordinator.move(memory, call, sensed)
        if (step + 1) % (steps // PROBES) == 0:
            answers.append(controller.command(target, sensed, None, call)[0].tau.ravel())
    return as_kept(np.array(answers))


def changed_by(robot: Robot, profile: Profile) -> float:
    """By what share the teacher's answers of today differ from those when the profile was taught."""
    if profile.skill not in skill_names(robot.n):
        return 1.0
    gait = gait_of(find_skill(profile.skill, robot), robot)
    call = SkillCall(profile.skill, gait, profile.command[:2], profile.command[2])
    then, now = profile.answers, answers_of(robot, call)
    if then.shape != now.shape:
        return 1.0
    return float(np.sqrt(np.mean((now - then) ** 2) / np.mean(then**2)))
