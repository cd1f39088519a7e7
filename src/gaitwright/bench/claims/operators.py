"""Claim: a terrain operator learned from one edit on one leg in one skill serves every leg and skill."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from gaitwright.bench.claims.learned_courses import COURSES, HANDED_OVER, Course
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import driven_by, handed_over
from gaitwright.bench.measurement import Figure, at_least, at_most, count
from gaitwright.bench.trial import operators_of, profile_of, robot_named
from gaitwright.gait.contacts import swing_time
from gaitwright.learning.operator_lessons import Edit, force_as_torque, swings
from gaitwright.learning.operator_trials import Swung, swung
from gaitwright.skills.chooser import fixed_skill

SKILLS = ("trot", "walk", "pace", "run")
SIZES = (0.04, 0.08)
"""Obstacles [m]; it is taught at 0.065 m, on the left front leg in a trot."""
STARTS, TRIED = 20, 3
LOW, HIGH = 95.0, 102.0
"""Share of the height asked for [%]."""
NOTE = (
    "The numerical controller raises one leg in a trot once; what that takes beyond the usual is applied by "
    "the learned controller to every leg, for lower and higher obstacles, in other skills. Height: mean of "
    "the highest places of swings, of that asked for. Torque: RMS of what is predicted less what the "
    "numerical controller takes there, over the latter."
)


def measure(context: Context) -> Iterator[Figure]:
    """How high every leg comes, how well torques are predicted, and courses with and without."""
    skills = SKILLS[:1] if context.quick else SKILLS
    for skill in skills:
        yield from heights(context, skill)
    for skill, off in zip(skills, context.each("torques of raised legs", predicted, skills), strict=True):
        yield Figure(
            f"go2 {skill}: torque of a raised leg, predicted", float(np.mean(off)), "%", None, len(off),
            f"worst {max(off):.0f} %", {"errors": off},
        )  # fmt: skip
    for course in COURSES if not context.quick else ():
        if course.end:
            yield across(context, course)


def heights(context: Context, skill: str) -> Iterator[Figure]:
    """The least and the most that a leg comes up to."""
    legs, seeds = range(4), context.seeds(TRIED, quick=1)
    asked = [(skill, leg, size, seed) for leg in legs for size in SIZES for seed in seeds]
    found = context.each(f"{skill}: raised legs", raised, asked)
    shares = np.array([100.0 * share for share, _ in found]).reshape(len(legs) * len(SIZES), len(seeds))
    mean, without = shares.mean(axis=1), 100.0 * np.mean([plain for _, plain in found])
    note = f"mean {mean.mean():.1f} %, without the operator's force {without:.1f} %"
    every = {"shares": shares.tolist()}
    low, high = float(mean.min()), float(mean.max())
    what = f"go2 {skill}: height of a raised leg, of that asked for"
    yield Figure(f"{what}, the lowest", low, "%", at_least(LOW), shares.size, note, every)
    yield Figure(f"{what}, the highest", high, "%", at_most(HIGH), shares.size, "", {})


def raised(asked: tuple[str, int, float, int]) -> tuple[float, float]:
    """How high a leg comes, of what was asked for, with operators and without its force."""
    skill, leg, size, seed = asked
    one = operators_of("go2")[0]
    trial = Swung(robot_named("go2"), skill, leg, size, (one,), (profile_of("go2", skill),), seed)
    found, plain = (
        swung(replace(trial, operators=(other,))) for other in (one, replace(one, force=0.0 * one.force))
    )
    return (0.0 if found.fell else found.share), (0.0 if plain.fell else plain.share)


def predicted(skill: str) -> list[float]:
    """How far the operator's torques are from those that a teacher takes, leg by leg and size by size [%]."""
    robot, one, off = robot_named("go2"), operators_of("go2")[0], []
    gait = fixed_skill(robot, skill, None, 0.0, None, "").skill_call.gait
    pace = (one.duration / swing_time(gait.period, gait.duty)) ** 2
    for leg in range(robot.n):
        edit = Edit(robot, SIZES[0], skill, robot.legs[leg])
        plain = swings(edit, one, 0.0, 50)
        for size in SIZES:
            other = swings(edit, one, size, 50)
            true, told = other.free - plain.free, size * pace * force_as_torque(robot, leg, one, other)
            off.append(100.0 * float(np.sqrt(np.mean((told - true) ** 2) / np.mean(true**2))))
    return off


def across(context: Context, course: Course) -> Figure:
    """A course by the learned controller, with operators and without."""
    trials = [
        handed_over(course.skill, seed, course.seconds, course.scene, HANDED_OVER)
        for seed in context.seeds(STARTS)
    ]
    what = f"go2 {course.skill} over {course.scene}"
    found = {
        name: context.outcomes(f"{what}, {name}", [replace(trial, operators=is_on) for trial in trials])
        for name, is_on in (("with operators", True), ("without", False))
    }
    teacher = context.outcomes(f"{what}, numerical", [driven_by("numerical", trial) for trial in trials])
    good = {name: sum(map(course.is_across, outcomes)) for name, outcomes in found.items()}
    note = f"without it {good['without']}, numerical {sum(map(course.is_across, teacher))}"
    what = f"{what}: across with operators"
    return count(what, good["with operators"], len(trials), course.least, note, {})
