"""Claim: simulation runs well ahead of real time, in little memory, and starts without a wait."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from statistics import median

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.children import ChildFailed, Children, Used, can_measure
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most
from gaitwright.bench.trial import Trial, simulate

RUNS = 5
SECONDS = 20.0
"""Simulated in each run [s]."""
NOTE = (
    "Speed: × real time is simulated seconds per second of CPU time of the whole process (all its "
    "threads), physics and control at 500 Hz; by the wall clock it depends on what else the machine "
    "does. A start is the whole life of a `gaitwright skill` that walks one tick, from process start to "
    "exit, kernels compiled and bytecode kept before. Children: medians by the wall clock."
)


@dataclass(frozen=True)
class Child:
    """A command of ours, what is read off it, and what is wanted of that."""

    what: str
    words: tuple[str, ...]
    read: Callable[[Used], float]
    unit: str
    wanted: Wanted
    runs: int
    quick_runs: int


CHILDREN = (
    Child("gaitwright --help", ("--help",), lambda used: used.wall_s, "s", at_most(0.3), 7, 3),
    Child(
        "warm start to one tick",
        ("skill", "--seconds", "0.002"),
        lambda used: used.wall_s,
        "s",
        at_most(3.0),
        5,
        1,
    ),
    Child(
        "skill, 10 s: peak memory",
        ("skill", "--seconds", "10"),
        lambda used: used.peak_mb,
        "MB",
        at_most(400.0),
        1,
        1,
    ),
)


def measure(context: Context) -> Iterator[Figure]:
    """Speed of the simulation in this process, then children of ours."""
    yield real_time(context)
    if not can_measure():
        why = "this system does not tell what a child took"
        yield from (Figure(child.what, float("nan"), child.unit, child.wanted, 0, why) for child in CHILDREN)
        return
    with Children() as children:
        for child in CHILDREN:
            context.voice.say(f"speed: {child.what}")
            yield of_child(children, child, child.quick_runs if context.quick else child.runs)


def real_time(context: Context) -> Figure:
    """How much faster than real time Go2 trots here, on one core."""
    runs, seconds = (2, 3.0) if context.quick else (RUNS, SECONDS)
    cpu, wall = [], []
    for run in range(runs):
        context.voice.say(f"speed: {seconds:g} s of trot, run {run + 1} of {runs}", now=False)
        outcome = simulate(Trial("go2", "flat", seconds, context.seed, speed=0.4))
        cpu.append(outcome.report.duration_s / outcome.cpu_s)
        wall.append(outcome.report.duration_s / outcome.wall_s)
    what = "go2 trot, simulated on one core: real time"
    note = f"of CPU time; {median(wall):.1f} × by the wall clock"
    return Figure(what, median(cpu), "×", at_least(10.0), runs, note, {"by_cpu": cpu, "by_wall": wall})


def of_child(children: Children, child: Child, runs: int) -> Figure:
    """The median over some runs of a command, after one that fills the caches."""
    try:
        children.gaitwright(*child.words)
        used = [children.gaitwright(*child.words) for _ in range(runs)]
    except ChildFailed as failure:
        return Figure(child.what, float("nan"), child.unit, child.wanted, 0, str(failure))
    values, cpu = [child.read(one) for one in used], [one.cpu_s for one in used]
    numbers = {"each": values, "cpu_s": cpu}
    note = f"CPU time {median(cpu):.2f} s"
    return Figure(child.what, median(values), child.unit, child.wanted, runs, note, numbers)
