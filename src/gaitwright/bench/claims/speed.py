"""Claim: simulation runs well ahead of real time, in little memory, and starts without a wait."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from statistics import median
from time import perf_counter, perf_counter_ns, process_time
from typing import Any

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.children import ChildFailed, Children, Used, can_measure
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most
from gaitwright.bench.trial import Trial, brain_for, robot_named
from gaitwright.ground.scene import load_scene
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Session, record
from gaitwright.signals import Mission

RUNS = 5
SECONDS = 20.0
"""Simulated in each run [s]."""
TROT = Trial("go2", "flat", SECONDS, 0, speed=0.4)
NOTE = (
    "Speed: × real time is simulated seconds per second of CPU time of the whole process (all its "
    "threads), physics and control at 500 Hz, control and recording included; by the wall clock it depends "
    "on what else the machine does. The physics' part is the time within mj_step in those very runs. "
    "Replayed, mj_step gets the recorded torques with nothing in between, so that the processor's caches "
    "hold nothing else, which is why it is quicker than in the run. A start is the whole life of a "
    "`gaitwright skill` that walks one tick, from process start to exit, kernels compiled and bytecode kept "
    "before. Children: medians by the wall clock."
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
    yield from real_time(context)
    if not can_measure():
        why = "this system does not tell what a child took"
        yield from (Figure(child.what, float("nan"), child.unit, child.wanted, 0, why) for child in CHILDREN)
        return
    with Children() as children:
        for child in CHILDREN:
            context.voice.say(f"speed: {child.what}")
            yield of_child(children, child, child.quick_runs if context.quick else child.runs)


def real_time(context: Context) -> Iterator[Figure]:
    """How much faster than real time Go2 trots here, on one core, and how much of that is physics."""
    runs, trial = (2, replace(TROT, seconds=3.0)) if context.quick else (RUNS, TROT)
    taken = []
    for run in range(runs):
        context.voice.say(f"speed: {trial.seconds:g} s of trot, run {run + 1} of {runs}", now=False)
        taken.append(timed(replace(trial, seed=context.seed)))
    cpu, wall = ([trial.seconds / getattr(t, name) for t in taken] for name in ("cpu_s", "wall_s"))
    note = f"of CPU time; {median(wall):.1f} × by the wall clock"
    what = "go2 trot, simulated on one core: real time"
    yield Figure(what, median(cpu), "×", at_least(10.0), runs, note, {"by_cpu": cpu, "by_wall": wall})
    for what, name, wanted in PARTS:
        parts = [getattr(t, name) / t.wall_s for t in taken]
        speed = median(trial.seconds / getattr(t, name) for t in taken)
        yield Figure(what, median(parts), "", wanted, runs, f"{speed:.0f} × real time", {"each": parts})


PARTS = (
    ("… its speed over that of the physics in it", "physics_s", at_least(0.4)),
    ("… its speed over that of the physics, replayed alone", "replayed_s", None),
)


@dataclass(frozen=True)
class Taken:
    """What a run took [s]."""

    cpu_s: float
    wall_s: float
    physics_s: float
    """Within mj_step, by the wall clock, as below."""
    replayed_s: float
    """mj_step with the same torques and nothing in between."""


def timed(trial: Trial) -> Taken:
    """Runs a trial of a skill with a stopwatch at the physics; then the physics once more, alone."""
    robot, scene = robot_named(trial.robot), load_scene(trial.scene)
    plant, brain = MujocoPlant(robot, scene, DT), brain_for(trial, robot, scene)
    plant.world.mj_step = watch = Stopwatch(plant.world.mj_step)
    cpu, wall = process_time(), perf_counter()
    session = Session(brain, plant, Mission((), driver=trial.driver), trial.seconds, trial.seed)
    tau = record(session, trial.seed, scene.name)["tau"]
    cpu, wall = process_time() - cpu, perf_counter() - wall
    plant = MujocoPlant(robot, scene, DT)
    plant.reset(trial.seed)
    began = perf_counter()
    for row in tau:
        plant.data.ctrl[:] = row
        plant.world.mj_step(plant.model, plant.data)
    return Taken(cpu, wall, watch.ns / 1e9, perf_counter() - began)


class Stopwatch:
    """A function that also counts the time spent in it."""

    def __init__(self, function: Callable[..., None]) -> None:
        self.function, self.ns = function, 0

    def __call__(self, *args: Any) -> None:
        began = perf_counter_ns()
        self.function(*args)
        self.ns += perf_counter_ns() - began


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
