"""Claim: one tick of the numerical controller is quick, beside peers timed in the same run."""

import gc
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.contenders import Contender, LiveTick, OurTick, PeerTick, Rnea, Times
from gaitwright.bench.evidence.moments import LiveTrot, arrays
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.bench.peers.client import Peer

ROUNDS, TICKS = 60, 200
"""Rounds of every contender, and ticks in each."""
QUICK_ROUNDS, QUICK_TICKS = 8, 50
MOMENTS = 400
"""Recorded ticks that are gone round: two cycles of the trot."""


@dataclass(frozen=True)
class Row:
    """A line of the table: a contender's ticks, by name."""

    name: str
    what: str
    median: Wanted | None = None
    p99: Wanted | None = None


ROWS = (
    Row("tick", "go2 trot, tick from sensed to torques", at_most(100.0), at_most(500.0)),
    Row("controller", "… its controller alone, target to torques"),
    Row("live", "… the whole tick in a running simulation", at_most(40.0)),
    Row("mj_step", "MuJoCo's mj_step, our Go2 world"),
    Row("rnea", "Pinocchio's RNEA"),
    Row("tsid", "TSID, tick"),
    Row("placo", "PlaCo, tick"),
)
RATIOS = (("controller", "tsid", at_most(0.3)), ("controller", "placo", None), ("tick", "tsid", None))
"""Ours over a peer's, and what is wanted of it."""
PEERS = ("tsid", "placo")
NOTE = (
    "Ticks: every round times each contender once, in turns from first to last and from last to first, "
    "so that noise hits all alike; all get the same recorded states and targets, none collects garbage "
    "meanwhile. A ratio is the median over the rounds of the ratio of the round's medians. TSID and "
    "PlaCo solve a richer problem (accelerations and forces together, weighted tasks); all are called "
    "from Python. mj_step is timed in a running simulation, as the plant's step without its sensing."
)


def measure(context: Context) -> Iterator[Figure]:
    """Medians, tails and ratios of all contenders."""
    context.voice.say("tick: recording a trot")
    trot = LiveTrot()
    moments = trot.moments(MOMENTS)
    states = arrays(moments)
    robot = trot.brain.robot
    with ExitStack() as stack:
        context.voice.say("tick: starting the peers (installed at the first run: minutes)")
        peers = {name: stack.enter_context(Peer(name, robot, states)) for name in PEERS}
        contenders: dict[str, Contender] = {
            "ours": OurTick(trot.brain, moments),
            "live": LiveTick(trot),
            "rnea": Rnea(robot, states),
            **{name: PeerTick(peer) for name, peer in peers.items()},
        }
        rounds = run_rounds(context, list(contenders.values()))
        abouts = {name: contender.about() for name, contender in contenders.items()}
    abouts |= {"tick": abouts["ours"], "controller": abouts["ours"], "mj_step": abouts["live"]}
    abouts["live"] = "and the navigator's and chooser's share"
    for row in ROWS:
        yield from figures(row, rounds, abouts[row.name])
    for ours, theirs, wanted in RATIOS:
        yield ratio(ours, theirs, rounds, wanted, abouts[theirs])


def run_rounds(context: Context, contenders: Sequence[Contender]) -> list[Times]:
    """All rounds, each with every contender's ticks; the first one, which warms up, is left out."""
    rounds, ticks = (QUICK_ROUNDS, QUICK_TICKS) if context.quick else (ROUNDS, TICKS)
    found: list[Times] = []
    for number in range(rounds + 1):
        context.voice.say(f"timing: round {number} of {rounds}", now=False)
        times: Times = {}
        gc.collect()
        gc.disable()
        try:
            for contender in contenders[:: 1 if number % 2 else -1]:
                times |= contender.round(ticks)
        finally:
            gc.enable()
        found.append(times)
    return found[1:]


def figures(row: Row, rounds: Sequence[Mapping[str, np.ndarray]], about: str) -> Iterator[Figure]:
    """Median and 99th percentile over all ticks of all rounds."""
    parts = [times[row.name] for times in rounds if row.name in times]
    if not parts:
        yield Figure(f"{row.what}: median", float("nan"), "µs", row.median, 0, about)
        return
    together = np.concatenate(parts)
    medians = [float(np.median(part)) for part in parts]
    numbers = {"ticks": len(together), "median_of_each_round_us": medians, "about": about}
    for name, percent, wanted in (("median", 50, row.median), ("p99", 99, row.p99)):
        measured = float(np.percentile(together, percent))
        yield Figure(f"{row.what}: {name}", measured, "µs", wanted, len(parts), about, numbers)


def ratio(
    ours: str,
    theirs: str,
    rounds: Sequence[Mapping[str, np.ndarray]],
    wanted: Wanted | None,
    about: str,
) -> Figure:
    """How many times as long as the peer's tick ours takes."""
    what = f"our {ours} over {theirs.upper() if theirs == 'tsid' else 'PlaCo'}'s tick"
    each = [float(np.median(t[ours]) / np.median(t[theirs])) for t in rounds if theirs in t]
    if not each:
        return Figure(what, float("nan"), "×", wanted, 0, about)
    low, high = np.percentile(each, [25, 75])
    note = f"middle half of the rounds {low:.2f} to {high:.2f}"
    return Figure(what, float(np.median(each)), "×", wanted, len(each), note, {"each_round": each})
