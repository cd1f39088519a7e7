"""Claim: the numerical controller as a stream solves far more moments than one tick at a time (row N5)."""

from collections.abc import Callable, Iterator, Sequence
from time import perf_counter

import numpy as np

from gaitwright.assess.torque_profiles import torque_profiles
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.moments import LiveTrot
from gaitwright.bench.measurement import Figure, at_least, at_most, count
from gaitwright.control.moments import moments_of
from gaitwright.control.numerical import result_of
from gaitwright.control.stream import Efforts, Job, stream
from gaitwright.description.load import load_robot
from gaitwright.dynamics.closed_chain import reuse_errors
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.model.robot import Robot
from gaitwright.skills.library import fastest, find_skill, gait_of

MOMENTS, QUICK_MOMENTS = 4000, 800
"""Recorded moments of a trot."""
JOBS = 16
"""Streams side by side; each goes through all moments."""
REPEATS = 5
HELD = (2, 5, 10, 25)
"""Ticks for which the dynamics are held where they are reused."""
MOVES = (0.01, 0.05, 0.1)
"""Straight moves for which A, B, C, D are reused, in body heights."""
STRAIGHT, INSTANTS = 0.4, 48
"""Speed of the straight move [m/s], and moments of a trot's cycle from which it starts."""
FLEET = ("go2", "hexapod", "thesis")
SPEEDS = 5
NOTE = (
    "Stream: a complete solution is feedback, inverse dynamics with feet and Jacobians, quadratic program "
    "and torques of one moment. Rates are the best of five runs by the wall clock: threads need both cores "
    "to themselves. Held dynamics: accelerations, Jacobians and free torques of a moment serve the next "
    "ones. Reused A, B, C, D: steady straight motion over planted feet, torques of the smallest foot "
    "wrenches that balance the base, with the maps of the start against those of the end; no feedback."
)


def measure(context: Context) -> Iterator[Figure]:
    """Rates, equality with single ticks, what holding the dynamics costs, and whole profiles."""
    context.voice.say("streaming: recording a trot")
    trot = LiveTrot()
    moments = trot.moments(QUICK_MOMENTS if context.quick else MOMENTS)
    rows = moments_of([m.sensed for m in moments], [m.target for m in moments])
    job = Job(trot.brain.robot, rows, result_of(moments[0].memory).forces_w.copy())
    for cores, wanted in ((2, at_least(100_000.0)), (1, None)):
        context.voice.say(f"streaming: {JOBS * len(rows)} moments on {cores} cores")
        rates = [
            JOBS * len(rows) / timed(lambda n=cores: stream([job] * JOBS, cores=n)) for _ in range(REPEATS)
        ]
        what = f"go2 trot, complete solutions a second, {cores} core{'s' if cores > 1 else ''}"
        yield Figure(what, max(rates), "1/s", wanted, REPEATS, "", {"each": rates})
    exact = stream([job])[0]
    yield equality(trot, moments, exact)
    yield from (holding(job, exact, ticks) for ticks in HELD)
    yield from reusing(trot.brain.robot)
    yield fleet(context)


def timed(work: Callable[[], object]) -> float:
    """Seconds that it takes."""
    began = perf_counter()
    work()
    return perf_counter() - began


def equality(trot: LiveTrot, moments: Sequence, exact: Efforts) -> Figure:
    """How many moments come out bit-equal to one tick after another."""
    controller, memory, good = trot.brain.controllers["numerical"], moments[0].memory, 0
    for i, moment in enumerate(moments):
        command, memory = controller.command(moment.target, moment.sensed, memory)
        good += bool((command.tau == exact.tau[i]).all() and (command.forces_w == exact.forces_w[i]).all())
    return count("stream bit-equal to one tick at a time", good, len(moments), 1.0, "", {})


def holding(job: Job, exact: Efforts, ticks: int) -> Figure:
    """What holding the dynamics for some ticks costs."""
    error = stream([job], every=ticks)[0].tau - exact.tau
    size = float(np.sqrt(np.mean(exact.tau**2)))
    what = f"dynamics held for {ticks} ticks ({2 * ticks} ms): torque error, RMS over RMS"
    note = f"largest {float(np.abs(error).max()):.2g} N·m"
    return Figure(what, float(np.sqrt(np.mean(error**2))) / size, "", None, len(error), note)


def reusing(robot: Robot) -> Iterator[Figure]:
    """What it costs to reuse the maps A, B, C, D for a straight move, wherever in a trot it starts."""
    cycle = desired_cycle(robot, gait_of(find_skill("trot", robot), robot), (STRAIGHT, 0.0), steps=INSTANTS)
    moves = robot.height * np.array(MOVES)
    starts = [i for i in range(cycle.steps) if cycle.stance[i].any()]
    errors = np.array([reuse_errors(robot, cycle.sensed(i), cycle.stance[i], moves) for i in starts])
    for move, column in zip(MOVES, errors.T, strict=True):
        what = f"{robot.name}: A, B, C, D reused over {100 * move:g} % of the body height: torque error"
        note = f"largest, as a share of the largest torque; median {np.median(column):.2g}"
        yield Figure(what, float(column.max()), "", None, len(starts), note)


def fleet(context: Context) -> Figure:
    """Torque profiles of several robots at several speeds in one call."""
    cycles = []
    for name in FLEET:
        robot = load_robot(name)
        walk = find_skill("walk", robot)
        gait, most = gait_of(walk, robot), 0.8 * fastest(walk, robot)
        cycles += [desired_cycle(robot, gait, (float(v), 0.0)) for v in np.linspace(0.2, 1.0, SPEEDS) * most]
    torque_profiles(cycles)
    seconds = min(timed(lambda: torque_profiles(cycles)) for _ in range(REPEATS))
    what = f"walking profiles of {len(FLEET)} robots at {SPEEDS} speeds in one call"
    steps = sum(cycle.steps for cycle in cycles)
    return Figure(
        what, 1e3 * seconds, "ms", at_most(1000.0), REPEATS, f"{len(cycles)} profiles, {steps} samples"
    )
