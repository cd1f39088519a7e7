"""Claim: between profiles that were taught, and at another pace, torques are those that would be taught."""

from collections.abc import Iterator
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.control.learned.cells import Cells
from gaitwright.control.learned.profile import Profile, torque_error
from gaitwright.control.learned.warp import warped
from gaitwright.learning.profile_cells import cells_for
from gaitwright.learning.profile_lessons import cycle_of, taught
from gaitwright.signals import SkillCall
from gaitwright.skills.chooser import HeldSkill

SKILLS = ("walk", "trot", "climb", "rack", "pronk", "bound", "run")
PLACES = 12
"""Velocities at which a skill is taught anew, drawn evenly over what its profiles cover."""
PACES = (0.85, 1.15)
PACED = ("walk", "trot")
LARGE = 10.0
NOTE = (
    "A skill is taught by need over speed and turn, then at velocities drawn at random between: RMS of the "
    "difference of the torques over the RMS of those taught there. Repeat: the same between two starts of "
    "the teacher. Pace: the profile at another period, beside one taught with that period."
)


def measure(context: Context) -> Iterator[Figure]:
    """Torque errors between cells and at other paces, and how long teaching takes."""
    skills = SKILLS[1:2] if context.quick else SKILLS
    began = perf_counter()
    rows = context.each("profiles between cells", between, [(skill, context.seed) for skill in skills])
    for skill, (errors, repeats, cells) in zip(skills, rows, strict=True):
        what = f"go2 {skill}: torque error between {cells} profiles, median of {len(errors)}"
        note = f"worst {max(errors):.1f} %, repeat {np.median(repeats):.1f} %"
        median = float(np.median(errors))
        yield Figure(what, median, "%", at_most(LARGE), len(errors), note, {"errors": errors})
    paces = [(skill, pace) for skill in PACED for pace in PACES]
    for (skill, pace), error in zip(paces, context.each("paces", at_pace, paces), strict=True):
        what = f"go2 {skill} at {pace:g} times its period: torque error"
        yield Figure(what, error, "%", at_most(LARGE), 1)
    yield Figure("all of this took", perf_counter() - began, "s", None, 1)


def between(asked: tuple[str, int]) -> tuple[list[float], list[float], int]:
    """Torque errors and repeat errors [%] between the cells of a skill, and how many cells these are."""
    skill, seed = asked
    robot, rng = robot_named("go2"), np.random.default_rng([seed, 7])
    profiles = cells_for(robot, skill, seed)
    cells, errors, repeats = Cells.of(profiles), [], []
    for _ in range(PLACES):
        speed, turn = (float(rng.uniform(axis[0], axis[-1])) for axis in (cells.speeds, cells.turns))
        fresh = taught(robot, skill, speed, turn, seed + 50)
        errors.append(100.0 * torque_error(cells.at(fresh.command), fresh.table, robot.n))
        repeats.append(100.0 * fresh.repeat)
    return errors, repeats, len(profiles)


def at_pace(asked: tuple[str, float]) -> float:
    """Torque error [%] of a profile that is played at another pace, beside one taught there."""
    skill, pace = asked
    robot = robot_named("go2")
    played = warped(robot, taught(robot, skill), pace)
    fresh = cycle_of(robot, held_at(played), 50)
    return 100.0 * torque_error(played.table, fresh, robot.n)


def held_at(profile: Profile) -> HeldSkill:
    """A chooser that holds the velocity and the gait of a profile."""
    forward, left, turn = profile.command
    return HeldSkill(SkillCall(profile.skill, profile.gait, (forward, left), turn, "numerical", "asked for"))
