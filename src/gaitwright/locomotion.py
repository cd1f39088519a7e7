"""The lap: Mission → Route → SkillCall → MotionTarget → Torques → Sensed. Start reading here.

`think` is one lap through the stages and nothing else; `trip` repeats it on a plant until the robot has
arrived or something ends the trip, and says what.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from time import perf_counter_ns
from typing import Protocol, runtime_checkable

import numpy as np

from gaitwright.control.kinematic import KinematicController
from gaitwright.control.numerical import Method, NumericalController, idle
from gaitwright.control.programmed import ProgrammedController
from gaitwright.errors import unknown
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.desired_cycle import Manner, desired_cycle
from gaitwright.gait.state import GaitMemory
from gaitwright.ground.foothold_map import Footing
from gaitwright.ground.scene import Scene
from gaitwright.knowledge.rules import Rulebook
from gaitwright.model.robot import Robot
from gaitwright.navigation.navigator import Navigator
from gaitwright.signals import Gait, Mission, MotionTarget, Route, Sensed, SkillCall, Torques
from gaitwright.skills.chooser import PlainChooser
from gaitwright.skills.foothold_guard import Cautious
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.termination import Verdict, Watch

LOOK_EVERY = 0.1
"""The navigator looks at the route this often [s]."""

MOST_PROGRAMMES = 64
"""Programmed motions kept; on a long way with changing speeds there is no end of them."""


@runtime_checkable
class Controller(Protocol):
    """MotionTarget + Sensed → Torques."""

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques: ...


@runtime_checkable
class Chooser(Protocol):
    """Route + Sensed → SkillCall."""

    def choose(self, route: Route, sensed: Sensed, now: SkillCall | None = None) -> SkillCall: ...


@runtime_checkable
class Mover(Protocol):
    """SkillCall + Sensed → MotionTarget: `gait.coordinator`, or a climb that was planned (`gait.climb`)."""

    def begin(self, sensed: Sensed, phase: float = 0.0) -> GaitMemory: ...

    def move(
        self, memory: GaitMemory, call: SkillCall, sensed: Sensed
    ) -> tuple[MotionTarget, GaitMemory]: ...


@runtime_checkable
class Plant(Protocol):
    """Torques → Sensed: a simulated robot, or a real one."""

    dt: float

    def reset(self, seed: int = 0, vary: bool = True) -> Sensed: ...

    def step(self, torques: Torques) -> Sensed: ...


@dataclass(frozen=True)
class Brain:
    """The stages of one robot: settings only, nothing that changes while it walks."""

    robot: Robot
    navigator: Navigator
    chooser: Chooser
    coordinator: Mover
    controllers: dict[str, Controller]
    programmes: dict[tuple[Gait, tuple[float, float], float], Controller] = field(default_factory=dict)
    """Programmed motions worked out so far, by gait, velocity and yaw rate."""

    @classmethod
    def of(  # noqa: PLR0913 - the door to all settings; most calls name two of these
        cls,
        robot: Robot,
        scene: Scene,
        chooser: Chooser | None = None,
        dt: float = 0.002,
        method: Method = "qp",
        sees: bool = True,
        rulebook: Rulebook | None = None,
    ) -> "Brain":
        """A brain for a robot in a scene it knows, its torques by the numerical controller.

        `chooser`: by default the plain rules of `skills.chooser`; `dt`: control period [s]; `method`: how
        foot forces are shared, `"qp"` or the thesis's `"lp"`; `sees`: whether feet know the ground ahead;
        `rulebook`: rules that choose the skills in the place of a chooser.
        """
        footing = Footing.of(scene, robot) if sees else Footing.blind()
        if chooser is None:
            chooser = PlainChooser(robot) if rulebook is None else RuleChooser(robot, rulebook)
        numerical = NumericalController(robot, method)
        return cls(
            robot,
            Navigator.of(robot, scene, sees),
            Cautious(chooser, robot, footing) if footing.is_known else chooser,
            Coordinator(robot, dt, footing),
            {"numerical": numerical, "hybrid": numerical, "kinematic": KinematicController(robot)},
        )

    def controller(self, call: SkillCall) -> Controller:
        """Who computes the torques of a call; each call has a programmed motion of its own."""
        if call.driver not in (*self.controllers, "programmed"):
            raise unknown("driver", call.driver, [*self.controllers, "programmed"])
        if call.driver != "programmed":
            return self.controllers[call.driver]
        motion = call.gait, call.velocity, call.turn
        if motion not in self.programmes:
            if len(self.programmes) == MOST_PROGRAMMES:
                self.programmes.clear()
            cycle = desired_cycle(self.robot, *motion, Manner(sways=True))
            self.programmes[motion] = ProgrammedController(self.robot, cycle.q, cycle.qd, cycle.stance)
        return self.programmes[motion]

    def begin(self, mission: Mission, sensed: Sensed, phase: float = 0.0) -> "Mind":
        """The mind of a robot that stands as sensed and gets a mission."""
        route = self.navigator.set_out(mission, sensed)
        call = self.chooser.choose(route, sensed)
        return Mind(mission, route, call, self.coordinator.begin(sensed, phase))


@dataclass(frozen=True, slots=True)
class Mind:
    """What a robot remembers from lap to lap."""

    mission: Mission
    route: Route
    call: SkillCall
    gait: GaitMemory
    torques: Torques | None = None
    looked_at: float = -math.inf
    """When the navigator last looked [s]."""
    chosen_at: float = -math.inf
    """When the skill was last chosen [s]."""


@dataclass(frozen=True, slots=True)
class Lap:
    """One tick: what was sensed and what each stage made of it."""

    sensed: Sensed
    route: Route
    call: SkillCall
    target: MotionTarget
    torques: Torques
    took: tuple[float, float]
    """Time for the whole tick and for the controller alone [µs]."""
    stopped_because: str | None = None
    """Why the trip ends with this lap."""
    arrived: bool = False
    fell: bool = False


def think(brain: Brain, mind: Mind, sensed: Sensed) -> tuple[Lap, Mind]:
    """One lap from what is sensed to torques, in the order of the data flow."""
    began = perf_counter_ns()
    mind = plan_and_choose(brain, mind, sensed)
    target, gait = brain.coordinator.move(mind.gait, mind.call, sensed)
    handed = perf_counter_ns()
    torques = brain.controller(mind.call).torques(target, sensed, mind.torques)
    done = perf_counter_ns()
    took = ((done - began) / 1e3, (done - handed) / 1e3)
    lap = Lap(sensed, mind.route, mind.call, target, torques, took)
    return lap, Mind(mind.mission, mind.route, mind.call, gait, torques, mind.looked_at, mind.chosen_at)


def plan_and_choose(brain: Brain, mind: Mind, sensed: Sensed) -> Mind:
    """The slower stages: the navigator looks a few times a second, the chooser at every cycle and event."""
    now, route = sensed.time, mind.route
    looked_at = mind.looked_at
    if now - looked_at >= LOOK_EVERY - 1e-9:
        route, looked_at = brain.navigator.plan(route, sensed), now
    event = route.arrived != mind.route.arrived or len(route.path) != len(mind.route.path)
    if not event and now - mind.chosen_at < mind.call.gait.period - 1e-9:
        return mind if route is mind.route else replace(mind, route=route, looked_at=looked_at)
    call = brain.chooser.choose(route, sensed, mind.call)
    return replace(mind, route=route, call=call, looked_at=looked_at, chosen_at=now)


def trip(
    brain: Brain, plant: Plant, mission: Mission, seconds: float, seed: int = 0, vary: bool = True
) -> Iterator[Lap]:
    """Laps on a plant until the mission ends; the last one says why (`stopped_because`).

    `seed` varies the start: pose, velocity and the phase of the gait.
    """
    sensed = plant.reset(seed, vary)
    phase = float(np.random.default_rng([seed, 1]).uniform()) if vary else 0.0
    mind = brain.begin(mission, sensed, phase)
    watch = Watch(brain.robot, brain.navigator.view.bounds, seconds, sensed.time)
    try:
        while True:
            if not sensed.is_finite():
                yield halted(brain, mind, sensed)
                return
            lap, mind = think(brain, mind, sensed)
            verdict = watch.judge(sensed, lap.route, lap.call, lap.target, lap.torques)
            if verdict:
                yield ended(lap, verdict)
                return
            yield lap
            sensed = plant.step(lap.torques)
    finally:
        # However the trip ends, also where nobody follows it any more: motors off.
        plant.step(idle(brain.robot))


def ended(lap: Lap, verdict: Verdict) -> Lap:
    """The last lap of a trip."""
    return replace(lap, stopped_because=verdict.because, arrived=verdict.arrived, fell=verdict.fell)


def halted(brain: Brain, mind: Mind, sensed: Sensed) -> Lap:
    """The lap of a robot whose state is no longer a number: motors off."""
    target, _ = brain.coordinator.move(mind.gait, mind.call, sensed)
    sentence = f"the sensed state is not a number at {sensed.time:.3f} s: motors stopped"
    return Lap(sensed, mind.route, mind.call, target, idle(brain.robot), (0.0, 0.0), sentence)
