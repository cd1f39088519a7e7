"""Moments in, torques out, many at once: the numerical controller as a stream (row N5; thesis 4.5).

Two stages, as in the thesis's pipeline: the dynamics of every moment stand alone and go to all cores in
chunks; the distribution of a moment follows that of the one before it, so each job keeps its order and jobs
go side by side. Jacobians stand in for the thesis's probes. Every answer is the same, bit for bit, as that of
one tick after another.
"""

import os
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from gaitwright.control.forces import LIMITS
from gaitwright.control.inverse_dynamics import AS_WANTED, LOAD, demand
from gaitwright.control.moments import LAYOUT as MOMENT
from gaitwright.control.moments import Moments, moment_of, stance_begins
from gaitwright.control.numerical import (
    LAYOUT,
    PLAIN,
    Method,
    NumericalController,
    distributed,
    distributed_linear,
    result_of,
)
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot, legs_of
from gaitwright.numerics.compiled import kernel_nogil

CHUNK = 512
"""Moments whose dynamics are worked out in one go."""


@dataclass(frozen=True)
class Job:
    """A robot and the moments it goes through, in the order of time."""

    robot: Robot
    moments: Moments
    start: Float[np.ndarray, "legs 3"] | None = None
    """Foot forces before the first moment [N], world axes; none where not given."""
    method: Method = "qp"
    linear: LinearSettings = PLAIN
    """As in `NumericalController`."""


@dataclass(frozen=True)
class Efforts:
    """What a job comes to, moment by moment; as in `MotorCommand`."""

    tau: Float[np.ndarray, "steps legs 3"]
    forces_w: Float[np.ndarray, "steps legs 3"]
    multipliers: Float[np.ndarray, "steps legs limits"]
    residual: Float[np.ndarray, "steps"]
    code: Int[np.ndarray, "steps"]
    """0 where the distribution was solved (`codes.SENTENCES`)."""
    culprit: Int[np.ndarray, "steps"]
    """What was in the way where it was not: `NumericalController.reason` says it in words."""


@kernel_nogil
def work_out(packed, moments, every, out):
    """First stage: the packed loads of some moments, worked out at every `every`-th and held in between.

    A chain that is formed or broken, a foot down or up, is a new load at once.
    """
    first = stance_begins(moments[0])
    last = first + legs_of(packed)
    for i in range(moments.shape[0]):
        if i % every == 0 or (moments[i, first:last] != moments[i - 1, first:last]).any():
            out[i] = demand(packed, moment_of(moments[i]), AS_WANTED)
        else:
            out[i] = out[i - 1]


@kernel_nogil
def share_out(packed, moments, loads, before, out):
    """Second stage: packed results of some moments in turn; `before` (changed in place): the last forces."""
    for i in range(moments.shape[0]):
        distributed(packed, loads[i], moment_of(moments[i]), before, out[i])
        before[:] = result_of(out[i]).forces_w


@kernel_nogil
def share_out_linear(packed, moments, loads, settings, before, hints, out):
    """The second stage by the linear program; `hints` (changed in place): its last basis."""
    for i in range(moments.shape[0]):
        distributed_linear(packed, loads[i], moment_of(moments[i]), before, settings, hints, out[i])
        result = result_of(out[i])
        before[:] = result.forces_w
        hints[:] = result.basis


def stream(jobs: Sequence[Job], every: int = 1, cores: int | None = None) -> list[Efforts]:
    """All torques of all jobs, over all cores.

    `every`: moments between two evaluations of the dynamics; more than 1 holds accelerations, Jacobians and
    free torques in between, which straight-line motion allows (thesis 4.5), at an error the bench shows.
    Raises `WrongUse` for moments that do not fit their robot or are not finite.
    """
    for number, job in enumerate(jobs):
        check(number, job)
    if every < 1:
        raise WrongUse(f"the dynamics are worked out at every n-th moment, n at least 1, not {every}")
    if cores is not None and cores < 1:
        raise WrongUse(f"a stream needs at least 1 core, not {cores}")
    threads = cores or os.cpu_count() or 1
    with ThreadPoolExecutor(threads) as pool:
        # First stages are queued before second ones, so that none of these waits for a place in the queue.
        first = [begin(pool, job, every) for job in jobs]
        second = [pool.submit(finish, job, chunks) for job, chunks in zip(jobs, first, strict=True)]
        return [future.result() for future in second]


Chunk = tuple[slice, Future[Float[np.ndarray, "steps numbers"]]]


def begin(pool: ThreadPoolExecutor, job: Job, every: int) -> list[Chunk]:
    """Starts the first stage of a job, chunk by chunk."""
    length = -(-CHUNK // every) * every  # chunks begin where the dynamics are worked out
    starts = range(0, len(job.moments), length)
    return [(slice(i, i + length), pool.submit(loads, job, slice(i, i + length), every)) for i in starts]


def loads(job: Job, part: slice, every: int) -> Float[np.ndarray, "steps numbers"]:
    """The first stage of some moments."""
    moments = job.moments[part]
    out = np.empty((len(moments), LOAD.size(job.robot.n)))
    work_out(job.robot.packed, moments, every, out)
    return out


def finish(job: Job, chunks: Sequence[Chunk]) -> Efforts:
    """The second stage of a job, each chunk when its first stage is done."""
    n, steps = job.robot.n, len(job.moments)
    before = np.zeros((n, 3)) if job.start is None else job.start.copy()
    hints, settings = np.full(3 * n + 1, -1.0), np.array(job.linear)
    out = np.empty((steps, LAYOUT.size(n)))
    for part, future in chunks:
        task, found = (job.robot.packed, job.moments[part], future.result()), out[part]
        if job.method == "qp":
            share_out(*task, before, found)
        else:
            share_out_linear(*task, settings, before, hints, found)
    where = LAYOUT.slices(n)
    code, culprit = out[:, where["outcome"]].astype(np.int64).T
    return Efforts(
        out[:, where["tau"]].reshape(steps, n, 3),
        out[:, where["forces_w"]].reshape(steps, n, 3),
        out[:, where["multipliers"]].reshape(steps, n, LIMITS),
        out[:, where["residual"]][:, 0],
        code,
        culprit,
    )


def check(number: int, job: Job) -> None:
    """`WrongUse` where a job's moments do not fit its robot, or its settings no robot."""
    robot, shape = job.robot, job.moments.shape
    NumericalController(robot, job.method, job.linear)  # has the checks of method and settings
    width = MOMENT.size(robot.n)
    if shape[1] != width:
        legs = f"{robot.name} has {robot.n} legs, so {width} numbers a moment"
        raise WrongUse(f"job {number}: {legs}, not {shape[1]}")
    bad = ~np.isfinite(job.moments).all(axis=1)
    if bad.any():
        raise WrongUse(f"job {number}: moment {int(bad.argmax())} holds a number that is not finite")
    if job.start is not None and not (job.start.shape == (robot.n, 3) and np.isfinite(job.start).all()):
        raise WrongUse(
            f"job {number}: the forces before the first moment are not {robot.n} × 3 finite numbers"
        )
