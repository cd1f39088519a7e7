"""Claim: a tick that plays profiles costs a small part of one that solves, of a policy's and of TSID's."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from time import perf_counter_ns

import numpy as np

from gaitwright.bench.claims.tick import run_rounds
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.contenders import Contender, PeerTick, Times
from gaitwright.bench.evidence.moments import SETTLES, Moment, arrays
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.bench.peers.client import Peer
from gaitwright.bench.trial import profile_of, robot_named
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.numerical import NumericalController
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Mind, think
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import Measured, Mission
from gaitwright.skills.chooser import HeldSkill, fixed_skill

MOMENTS = 400
"""Ticks of a trot that are gone round."""
PEERS = ("policy", "tsid")
NOTE = (
    "Go2, a trot at 0.4 m/s on flat ground; each driver's own states, and a hybrid's in which the learned "
    "controller drives. Every round times each once, in turns from first to last and from last to first; a "
    "ratio is the median over the rounds of the ratio of the round's medians. The whole tick is `think`: "
    "from what is sensed to a command, choosing and navigating included; with the watch, which costs either "
    "driver the same, from what is measured. The peers get the numerical controller's states."
)


@dataclass(frozen=True)
class Ratio:
    """What is set over what."""

    what: str
    ours: str
    theirs: str
    wanted: Wanted | None = None


RATIOS = (
    Ratio("learned tick over the numerical controller's", "learned", "numerical", at_most(0.35)),
    Ratio("… in a hybrid, the rule's decision included", "hybrid", "numerical", at_most(0.35)),
    Ratio("… with the watch, over the numerical controller's with it", "learned, watched", "watched"),
    Ratio("law alone over the numerical controller alone", "law", "controller", at_most(0.4)),
    Ratio("learned tick over an RL policy's in onnxruntime", "learned", "policy", at_most(0.6)),
    Ratio("learned tick over TSID's", "learned", "tsid", at_most(0.4)),
)


class Replayed:
    """The ticks of a trot, each thought anew from the mind and the measurement it began with."""

    def __init__(self, name: str, driver: str, watches: bool = False) -> None:
        robot, scene = robot_named("go2"), load_scene("flat")
        held = fixed_skill(robot, "trot", 0.4, 0.0, None, "").skill_call
        brain = Brain.of(robot, scene, HeldSkill(replace(held, firm=True)), watches=watches)
        self.name, self.brain = name, brain.with_profiles({"trot": (profile_of("go2", "trot"),)})
        self.ticks: list[tuple[Mind, Measured]] = []
        self.moments: list[Moment] = []
        self.cursor = 0
        plant = MujocoPlant(robot, scene)
        measured = plant.reset(0)
        mind = self.brain.begin(Mission((), driver=driver), measured)
        for tick in range(SETTLES + MOMENTS):
            lap, after = think(self.brain, mind, measured)
            if tick >= SETTLES:
                self.ticks.append((mind, measured))
                of = mind.memories
                self.moments.append(
                    Moment(of.gait, lap.call, lap.sensed, of.control, lap.target, mind.ground)
                )
            mind, measured = after, plant.step(lap.command)
        self.driver = next(moment.call.driver for moment in self.moments)

    def round(self, ticks: int) -> Times:
        """The whole tick."""
        out = np.empty(ticks)
        for k in range(ticks):
            mind, measured = self.ticks[self.cursor]
            self.cursor = (self.cursor + 1) % len(self.ticks)
            began = perf_counter_ns()
            think(self.brain, mind, measured)
            out[k] = (perf_counter_ns() - began) / 1e3
        return {self.name: out}

    def about(self) -> str:
        return f"driven by the {self.driver} controller"


class Alone:
    """Both controllers alone, from a target to a command, on the same moments."""

    def __init__(self, of: Replayed) -> None:
        self.moments, self.cursor = of.moments, 0
        learned, numerical = of.brain.controllers["learned"], of.brain.controllers["numerical"]
        assert isinstance(learned, LearnedController) and isinstance(numerical, NumericalController)
        self.controllers = {"law": learned, "controller": numerical}

    def round(self, ticks: int) -> Times:
        """Both, tick by tick."""
        out = {name: np.empty(ticks) for name in self.controllers}
        for k in range(ticks):
            now = self.moments[self.cursor]
            self.cursor = (self.cursor + 1) % len(self.moments)
            for name, controller in self.controllers.items():
                began = perf_counter_ns()
                controller.command(now.target, now.sensed, None, now.call, now.ground)
                out[name][k] = (perf_counter_ns() - began) / 1e3
        return out

    def about(self) -> str:
        return "called from Python, from a target to a command"


def measure(context: Context) -> Iterator[Figure]:
    """Ticks of all drivers and peers, and what they are over each other."""
    context.voice.say("playing: teaching a trot, and recording it under each driver")
    ours = [
        Replayed("numerical", "numerical"),
        Replayed("learned", "learned"),
        Replayed("hybrid", "hybrid"),
        Replayed("watched", "numerical", watches=True),
        Replayed("learned, watched", "learned", watches=True),
    ]
    with ExitStack() as stack:
        context.voice.say("playing: starting the peers (installed at the first run: minutes)")
        states = arrays(ours[0].moments)
        peers = [Peer(name, ours[0].brain.robot, states) for name in PEERS]
        contenders: list[Contender] = [*ours, Alone(ours[0])]
        contenders += [PeerTick(stack.enter_context(peer)) for peer in peers]
        rounds = run_rounds(context, contenders)
        abouts = {peer: contender.about() for peer, contender in zip(PEERS, contenders[-2:], strict=True)}
    abouts |= {one.name: one.about() for one in ours}
    for name in (*(one.name for one in ours), "law", "controller", *PEERS):
        yield tick_of(name, rounds, abouts.get(name, ""))
    for asked in RATIOS:
        yield over(asked, rounds, abouts.get(asked.theirs, ""))


def tick_of(name: str, rounds: Sequence[Mapping[str, np.ndarray]], about: str) -> Figure:
    """The median over the rounds of a round's median."""
    medians = [float(np.median(times[name])) for times in rounds if name in times]
    taken = float(np.median(medians)) if medians else float("nan")
    return Figure(f"go2 trot, tick: {name}", taken, "µs", None, len(medians), about, {"each_round": medians})


def over(asked: Ratio, rounds: Sequence[Mapping[str, np.ndarray]], about: str) -> Figure:
    """One time over another, round by round."""
    both = [times for times in rounds if asked.ours in times and asked.theirs in times]
    each = [float(np.median(times[asked.ours]) / np.median(times[asked.theirs])) for times in both]
    if not each:
        return Figure(asked.what, float("nan"), "×", asked.wanted, 0, about)
    low, high = np.percentile(each, [25, 75])
    note = f"middle half of the rounds {low:.2f} to {high:.2f}"
    return Figure(
        asked.what, float(np.median(each)), "×", asked.wanted, len(each), note, {"each_round": each}
    )
