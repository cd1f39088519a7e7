"""Claim: an hour of trot, with its report and all its files, stays within the memory that a minute takes."""

from collections.abc import Iterator

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.children import ChildFailed, Children, can_measure
from gaitwright.bench.measurement import Figure, at_most

HOUR, QUICK = 3600.0, 240.0
"""Simulated [s]."""
WANTED = at_most(400.0)
"""[MB]"""
NOTE = (
    "Peak resident memory of a `gaitwright skill --out`: go2 trots in a circle at 500 Hz; then come its "
    "report, recording, export for Foxglove and picture."
)


def measure(context: Context) -> Iterator[Figure]:
    """The peak of one long run."""
    seconds = context.seconds(HOUR, QUICK)
    what = "an hour of trot: peak memory" if seconds == HOUR else f"{seconds:g} s of trot: peak memory"
    if not can_measure():
        yield Figure(what, float("nan"), "MB", WANTED, 0, "this system does not tell what a child took")
        return
    context.voice.say(f"memory: {seconds:g} s of trot, some minutes for an hour")
    with Children() as children:
        try:
            children.gaitwright(*trotting(1.0), "warm")  # compiling takes more than running
            used = children.gaitwright(*trotting(seconds), "long")
        except ChildFailed as failure:
            yield Figure(what, float("nan"), "MB", WANTED, 0, str(failure))
            return
    note = f"{used.wall_s:.0f} s by the wall clock, CPU time {used.cpu_s:.0f} s"
    if seconds < HOUR:
        note += "; an hour without --quick"
    yield Figure(what, used.peak_mb, "MB", WANTED, 1, note, {"seconds": seconds, "wall_s": used.wall_s})


def trotting(seconds: float) -> tuple[str, ...]:
    """The command, up to the name of the folder for its files."""
    return ("skill", "--turn", "0.3", "--seconds", f"{seconds:g}", "--out")
