"""Claim: sharing the load over the feet is quick and exact, by quadratic and by linear program (row N3)."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from time import perf_counter_ns

import numpy as np

from gaitwright.bench.claims.jumps import force_jumps
from gaitwright.bench.claims.tick import MOMENTS, PEERS, Row, figures, ratio, run_rounds
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.agreement import ABSOLUTE, THESIS, agreement
from gaitwright.bench.evidence.contenders import PeerTick, Times
from gaitwright.bench.evidence.gaits import loads_of_gaits
from gaitwright.bench.evidence.moments import LiveTrot, Moment, arrays
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.bench.peers.client import Peer
from gaitwright.control.numerical import PLAIN, Method, NumericalController
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.model.robot import Robot
from gaitwright.stages import Memory

LOADS, QUICK_LOADS = 10_000, 300
"""Loads of real gaits that are compared with other solvers."""
JUMPS, QUICK_JUMPS = 5000, 1000
"""Ticks of a trot whose forces are followed."""
NOTE = (
    "Sharing: a tick is the whole controller (dynamics, distribution, torques), called from Python on "
    "recorded moments of a trot, last torques handed on, timed in rounds as those of `tick` are. TSID and "
    "PlaCo solve a richer problem (accelerations and forces together, weighted tasks). The thesis's LP "
    "has signed joint power and the sum of the normal forces as its objective, and no price of change; as "
    "two point feet cannot give every wrench, here what is missing has a price: with an exact balance a "
    "trot on two feet has no solution. Agreement: loads recorded from Go2, the thesis's robot and a "
    "hexapod in walk, trot, turn and run, on flat and rough ground, from varied starts, every other one "
    "on weaker motors; six linear programs by lot, three of them with an exact balance. A jump is the "
    "length of the change of a foot's force from one tick to the next, of feet that are down in both."
)


@dataclass(frozen=True)
class Way:
    """One way to share a load."""

    name: str
    method: Method
    linear: LinearSettings
    wanted: Wanted | None
    """Of a tick's time over a peer's."""

    def controller(self, robot: Robot) -> NumericalController:
        """The controller that shares loads this way."""
        return NumericalController(robot, self.method, self.linear)


QP = Way("QP", "qp", PLAIN, at_most(0.5))
PRINTED = Way("the thesis's LP", "lp", THESIS, at_most(0.5))
MINIMAX = Way("LP of absolute power and peak", "lp", ABSOLUTE, at_most(1.0))
CALM = Way("LP as it walks", "lp", PLAIN, None)
"""With a price of change."""
WAYS = (QP, PRINTED, MINIMAX, CALM)


def measure(context: Context) -> Iterator[Figure]:
    """Times beside the peers', agreement with other solvers, and how forces jump."""
    context.voice.say("sharing: recording a trot")
    trot = LiveTrot()
    robot = trot.brain.robot
    yield from times(context, robot, trot.moments(MOMENTS))
    context.voice.say("sharing: recording gaits")
    yield from agreement(context, loads_of_gaits(context, QUICK_LOADS if context.quick else LOADS))
    context.voice.say("sharing: following the forces of a trot")
    moments = trot.moments(QUICK_JUMPS if context.quick else JUMPS)
    yield from force_jumps(moments, {way.name: way.controller(robot) for way in (QP, CALM, PRINTED)})


# --- times -----------------------------------------------------------------------------------------
class Tick:
    """One way's ticks on recorded moments, each with its own last torques."""

    def __init__(self, way: Way, robot: Robot, moments: Sequence[Moment]) -> None:
        self.name, self.controller, self.moments = name_of(way), way.controller(robot), moments
        self.memory: Memory = None
        self.done = self.failed = 0

    def round(self, ticks: int) -> Times:
        out = np.empty(ticks)
        for tick in range(ticks):
            moment = self.moments[self.done % len(self.moments)]
            began = perf_counter_ns()
            command, self.memory = self.controller.command(moment.target, moment.sensed, self.memory)
            out[tick] = (perf_counter_ns() - began) / 1e3
            self.done += 1
            self.failed += command.status != "solved"
        return {self.name: out}

    def about(self) -> str:
        return f"{self.failed} ticks failed" if self.failed else "every tick solved"


def name_of(way: Way) -> str:
    """What is timed, in words."""
    return f"controller by {way.name}"


def times(context: Context, robot: Robot, moments: Sequence[Moment]) -> Iterator[Figure]:
    """Medians and tails of all ways, and their ratios over the peers."""
    states = arrays(moments)
    with ExitStack() as stack:
        context.voice.say("sharing: starting the peers (installed at the first run: minutes)")
        peers = [PeerTick(stack.enter_context(Peer(name, robot, states))) for name in PEERS]
        ours = [Tick(way, robot, moments) for way in WAYS]
        rounds = run_rounds(context, [*ours, *peers])
        abouts = {peer.peer.name: peer.about() for peer in peers}
    for tick in ours:
        yield from figures(Row(tick.name, f"go2 trot, {tick.name}"), rounds, tick.about())
    for way in WAYS:
        for peer, about in abouts.items():
            yield ratio(name_of(way), peer, rounds, way.wanted, about)
