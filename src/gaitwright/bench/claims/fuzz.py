"""Claim: what a file or a command line holds is taken, or refused in a sentence: no traceback, no hang."""

from collections.abc import Iterator

from gaitwright.bench.context import Context
from gaitwright.bench.fuzz.hunt import LONGEST, MOST_MB, Found, hunt
from gaitwright.bench.fuzz.kinds import KINDS
from gaitwright.bench.measurement import Figure, at_most

CASES = {"command": 1000, "mjcf": 3000, "urdf": 3000, "scene": 6000, "recording": 8000}
"""Of each kind; of all others `PLENTY`."""
PLENTY = 7500
QUICK = 100
NOTE = (
    "Sound files damaged by chance (bytes, values, keys, rows under a fitting seal, channels), each read and "
    f"used as a command does; a hang is more than {LONGEST:g} s, greed more than {MOST_MB / 1e3:g} GB."
)


def measure(context: Context) -> Iterator[Figure]:
    """A figure for each kind, and those of all."""
    total = Found("all")
    for kind in KINDS:
        cases = QUICK if context.quick else CASES.get(kind, PLENTY)
        found = hunt(
            kind, context.seed, cases, lambda n, k=kind: context.voice.say(f"fuzz: {n} {k}s", now=False)
        )
        total.cases, total.refused = total.cases + found.cases, total.refused + found.refused
        total.hangs += found.hangs
        total.greedy += found.greedy
        total.tracebacks |= {
            len(total.tracebacks) + k: what for k, what in enumerate(found.tracebacks.values())
        }
        yield figure(f"{kind}: faults", found.faults, found)
    yield figure("tracebacks", len(total.tracebacks), total)
    yield figure(f"hangs over {LONGEST:g} s", len(total.hangs), total)
    yield figure(f"more than {MOST_MB / 1e3:g} GB", len(total.greedy), total)


def figure(what: str, faults: int, found: Found) -> Figure:
    """So many faults of all cases; the first one beside it."""
    first = next(iter(found.tracebacks.items()), None)
    note = f"{found.refused} refused in a sentence"
    if first and faults:
        note += f"; case {first[0]}: {first[1]}"
    numbers = {
        "cases": found.cases,
        "refused": found.refused,
        "tracebacks": found.tracebacks,
        "hangs": found.hangs,
        "greedy": found.greedy,
        "slowest_s": found.slowest_s,
        "peak_mb": found.peak_mb,
    }
    return Figure(what, float(faults), f"of {found.cases}", at_most(0.0), found.cases, note, numbers)
