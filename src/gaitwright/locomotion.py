"""The lap: Mission → Route → SkillCall → MotionTarget → Torques → Sensed. Start reading here.

`think` is one lap through the stages and nothing else; `trip` repeats it on a plant until the robot has
arrived or something ends the trip, and says what.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import perf_counter_ns
from typing import Protocol, runtime_checkable

import numpy as np

from gaitwright.control.numerical import Method, NumericalController, idle
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.state import GaitState
from gaitwright.geometry import GRAVITY, rotation
from gaitwright.model.robot import Robot
from gaitwright.model.scene import Scene
from gaitwright.navigation.navigator import Navigator
from gaitwright.signals import Mission, MotionTarget, Route, Sensed, SkillCall, Torques
from gaitwright.skills.chooser import PlainChooser

LOOK_EVERY = 0.1
"""The navigator looks at the route this often [s]."""
TIPPED = math.cos(math.radians(60))
"""A body whose up axis leans more than 60° from the ground's normal has fallen."""
SUNK = 0.35
"""A body lower than this share of its standing height over its feet has fallen."""
AIRBORNE = 1.5
"""No foot on the ground for this long, times √(h/g) [s], is a lost contact; flying gaits stay far below."""
OVERLOADED = 0.2
"""The force distribution may fail for this long [s]."""
STUCK = 15.0
"""A mission without progress for this long, times √(h/0.29 m) [s], has got stuck."""


@runtime_checkable
class Controller(Protocol):
    """MotionTarget + Sensed → Torques."""

    def torques(self, target: MotionTarget, sensed: Sensed, previous: Torques | None = None) -> Torques: ...


@runtime_checkable
class Chooser(Protocol):
    """Route + Sensed → SkillCall."""

    def choose(self, route: Route, sensed: Sensed, now: SkillCall | None = None) -> SkillCall: ...


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
    coordinator: Coordinator
    controllers: dict[str, Controller]

    @classmethod
    def of(
        cls,
        robot: Robot,
        scene: Scene,
        chooser: Chooser | None = None,
        dt: float = 0.002,
        method: Method = "qp",
    ) -> "Brain":
        """A brain for a robot in a scene it knows, its torques by the numerical controller.

        `chooser`: by default the plain rules of `skills.chooser`; `dt`: control period [s]; `method`: how
        foot forces are shared, `"qp"` or the thesis's `"lp"`.
        """
        return cls(
            robot,
            Navigator.of(robot, scene),
            chooser or PlainChooser(robot),
            Coordinator(robot, dt),
            {"numerical": NumericalController(robot, method)},
        )

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
    gait: GaitState
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
    torques = brain.controllers[mind.call.driver].torques(target, sensed, mind.torques)
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
    watch = Watch(brain, mission, seconds)
    while True:
        if not sensed.is_finite():
            yield halted(brain, mind, sensed)
            return
        lap, mind = think(brain, mind, sensed)
        lap = watch.judge(lap)
        yield lap
        if lap.stopped_because:
            plant.step(idle(brain.robot))
            return
        sensed = plant.step(lap.torques)


def halted(brain: Brain, mind: Mind, sensed: Sensed) -> Lap:
    """The lap of a robot whose state is no longer a number: motors off."""
    target, _ = brain.coordinator.move(mind.gait, mind.call, sensed)
    sentence = f"the sensed state is not a number at {sensed.time:.3f} s: motors stopped"
    return Lap(sensed, mind.route, mind.call, target, idle(brain.robot), (0.0, 0.0), sentence)


class Watch:
    """Decides when a trip is over, and says why in one sentence."""

    def __init__(self, brain: Brain, mission: Mission, seconds: float) -> None:
        self.brain, self.mission, self.seconds = brain, mission, seconds
        robot = brain.robot
        self.stand = robot.stand
        self.pace = math.sqrt(GRAVITY * robot.height)
        self.patience = STUCK * math.sqrt(robot.height / 0.29)
        self.air_limit = AIRBORNE * math.sqrt(robot.height / GRAVITY)
        self.standing_since = self.grounded_at = self.fed_at = self.progress_at = 0.0
        self.nearest = math.inf

    def judge(self, lap: Lap) -> Lap:
        """The lap, marked as the last one where the trip is over."""
        now = lap.sensed.time
        if not np.isfinite(lap.torques.tau).all():
            off = idle(self.brain.robot)
            return replace(
                lap, torques=off, stopped_because=f"a torque is not a number at {now:.3f} s: motors stopped"
            )
        if fallen := self.fallen(lap):
            return replace(lap, stopped_because=fallen, fell=True)
        if fault := self.fault(lap):
            return replace(lap, stopped_because=fault)
        if lap.route.no_way:
            return replace(lap, stopped_because=f"there is no way to the goal: {lap.route.no_way}")
        if self.stands_at_goal(lap):
            return replace(lap, stopped_because="arrived at the goal", arrived=True)
        if now >= self.seconds - 1e-9:
            return replace(lap, stopped_because=self.out_of_time(lap))
        return lap

    def fallen(self, lap: Lap) -> str | None:
        """Why the robot counts as fallen, if it does."""
        up = rotation(lap.sensed.orientation_wb)[:, 2]
        lean = float(up @ lap.target.normal_w)
        now = lap.sensed.time
        if lean < TIPPED:
            return f"fell: the body leaned {math.degrees(math.acos(max(-1.0, lean))):.0f}° at {now:.2f} s"
        over_feet = float(lap.sensed.position_w[2]) - float(np.min(lap.target.feet_w[:, 2]))
        if over_feet < SUNK * self.stand:
            return f"fell: the body sank to {over_feet:.2f} m over its feet at {now:.2f} s"
        return None

    def fault(self, lap: Lap) -> str | None:
        """A lost contact, an overload or no progress, as a sentence."""
        now = lap.sensed.time
        if (lap.sensed.load > 0.0).any():
            self.grounded_at = now
        if lap.torques.status.startswith("solved"):
            self.fed_at = now
        if now - self.grounded_at > self.air_limit:
            return f"lost contact: no foot has touched the ground since {self.grounded_at:.2f} s"
        if now - self.fed_at > OVERLOADED:
            return f"{lap.torques.status} (since {self.fed_at:.2f} s)"
        if lap.route.path and not lap.route.arrived:
            if lap.route.remaining < self.nearest - 0.02 * self.brain.robot.body_length:
                self.nearest, self.progress_at = lap.route.remaining, now
            if now - self.progress_at > self.patience:
                x, y = lap.sensed.position_w[:2]
                return f"stuck: no progress for {self.patience:.0f} s at ({x:.2f}, {y:.2f})"
        return None

    def stands_at_goal(self, lap: Lap) -> bool:
        """Whether the robot has stood still at its goal for a moment."""
        now = lap.sensed.time
        speed = float(np.hypot(*lap.sensed.velocity_w[:2]))
        still = lap.route.arrived and speed < 0.03 * self.pace and bool(lap.target.stance.all())
        if not (still and self.brain.navigator.at_goal(self.mission, lap.sensed)):
            self.standing_since = now
        return now - self.standing_since > 0.3

    def out_of_time(self, lap: Lap) -> str:
        if not lap.route.path:
            return f"the {self.seconds:g} s asked for are over"
        return f"out of time after {self.seconds:g} s, {lap.route.remaining:.2f} m before the goal"
