"""A run, set up in one place and stepped from outside: what CLI, bench, suitability and people go through.

A `Session` is a brain on a plant with a mission. Between two steps it can be given another mission or driver,
pushed, or find its world rearranged; `walk` is a loop over it that keeps a recording.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.control.numerical import idle
from gaitwright.descent import can_descend, descent
from gaitwright.errors import NoRoom, WrongUse, is_interrupt
from gaitwright.ground.scene import Scene
from gaitwright.locomotion import Brain, Lap, Mind, think
from gaitwright.missions import Steering, Velocity
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.perception.fault_words import ends_trip
from gaitwright.perception.told_things import with_things
from gaitwright.record.recording import Recorder, Recording
from gaitwright.record.scene_of import scene_for, scene_scale  # noqa: F401 - found here by all who set up runs
from gaitwright.signals import Measured, Mission
from gaitwright.skills.commanded import check_velocity
from gaitwright.stages import Chooser, Plant, SimulatedPlant
from gaitwright.termination import Ending, Termination

DT = 0.002
"""Control period [s]: 500 Hz."""
PUSH_LASTS = 0.1
"""How long a push lasts where nothing else is said [s]."""


@dataclass(frozen=True, slots=True)
class Push:
    """A force on the body for a moment."""

    impulse: float
    """Per mass of the robot [N·s/kg]."""
    direction: float
    """From straight ahead, counter-clockwise [°]."""
    at: float
    """Earliest time [s]."""
    phase: float | None = None
    """Phase of the gait, in [0, 1), that it waits for; `None`: it waits for none."""
    lasts: float = PUSH_LASTS
    """[s]"""

    def __post_init__(self) -> None:
        if self.impulse < 0.0:
            raise WrongUse(
                f"the impulse of a push is not negative, as {self.impulse:g} is; turn its direction instead"
            )

    def is_due(self, lap: Lap, dt: float) -> bool:
        """Whether it begins with this lap."""
        if lap.sensed.time < self.at - 1e-9:
            return False
        return self.phase is None or (lap.target.phase - self.phase) % 1.0 < 1.5 * dt / lap.call.gait.period

    def force(self, robot: Robot, lap: Lap) -> tuple[float, float, float]:
        """The force [N], world axes, turned with the robot's heading as it begins."""
        size = self.impulse * robot.total_mass / self.lasts
        towards = heading(rotation(lap.sensed.orientation_wb)) + math.radians(self.direction)
        return size * math.cos(towards), size * math.sin(towards), 0.0


class Session:
    """One robot's run from its start to its end.

    `seed` varies the start where `vary`: pose, velocity and the phase of the gait. After the last step, or
    `close`, the motors are off; where it `lowers`, they go on until `lower` has let the robot down. Where a
    person attends to it (`attended`), a mission that ended with the robot on its feet does not end the run:
    the robot stands, `outcome` says what became of it, and another one may be given.
    """

    def __init__(  # noqa: PLR0913 - the door to a run
        self,
        brain: Brain,
        plant: Plant,
        mission: Mission,
        seconds: float = 60.0,
        seed: int = 0,
        vary: bool = True,
        lowers: bool = False,
        attended: bool = False,
    ) -> None:
        if not getattr(plant, "has_mechanics", True):
            brain, lowers = replace(brain, watch=None), False
        self.lowers, self.attended = lowers, attended
        self.brain, self.plant = brain, plant
        self.measured: Measured = plant.reset(seed, vary)
        phase = float(np.random.default_rng([seed, 1]).uniform()) if vary else 0.0
        self.mind: Mind = brain.begin(mission, self.measured, phase)
        self.termination = Termination(brain.robot, self.mind.ground.bounds, seconds, self.measured.time)
        self.lap: Lap | None = None
        """The last lap; `None` before the first step."""
        self.outcome: Ending | None = None
        """What became of the last mission, where the run goes on after it."""
        self.paused = False
        self.closed = False
        self.pushes: list[Push] = []
        self.pushing_until: float | None = None

    @property
    def is_over(self) -> bool:
        """Whether the last lap was the last."""
        return self.lap is not None and self.lap.stopped_because is not None

    # --- going on ----------------------------------------------------------------------------------
    def step(self) -> Lap | None:
        """One lap: think, judge, and, unless the run is over, one control period on the plant.

        `None` where it is paused or over.
        """
        if self.paused or self.is_over or self.closed:
            return None
        if not self.measured.is_finite():
            self.lap = self.halted()
        else:
            lap, self.mind = think(self.brain, self.mind, self.measured)
            ending = self.termination.judge(lap.sensed, lap.route, lap.call, lap.target, lap.command)
            if ends_trip(lap.faults) and not (ending and ending.fell):
                ending = Ending(lap.faults[-1].sentence)
            if ending and ending.may_wait and self.attended:
                self.steer(0.0)
                self.outcome, ending = ending, None
            self.lap = ended(lap, ending) if ending else lap
        if not self.is_over:
            self.push_if_due(self.lap)
            self.measured = self.plant.step(self.lap.command)
        elif not self.can_lower:
            self.close()
        return self.lap

    @property
    def can_lower(self) -> bool:
        """Whether there is a robot that can be let down, and somebody to do it."""
        return (
            self.lowers and not self.closed and self.lap is not None and can_descend(self.lap, self.measured)
        )

    def lower(self) -> Iterator[Lap]:
        """Lets the robot down after a trip that is over or cut off: laps of no trip, then motors off."""
        try:
            if self.pushing_until is not None:
                self.simulated().push((0.0, 0.0, 0.0))
            if self.can_lower and self.lap is not None:
                yield from descent(self.brain, self.plant, self.mind, self.lap, self.measured)
        finally:
            self.close()

    def __iter__(self) -> Iterator[Lap]:
        """Laps until the run is over or paused; motors off however that comes about."""
        try:
            while (lap := self.step()) is not None:
                yield lap
        finally:
            if not self.paused and not self.can_lower:
                self.close()

    def close(self) -> None:
        """Motors off; the run is over."""
        if self.closed:
            return
        self.closed = True
        self.plant.step(idle(self.brain.robot))

    def halted(self) -> Lap:
        """The lap of a robot whose state is no longer a number: motors off."""
        mind, measured = self.mind, self.measured
        target, _ = self.brain.coordinator.move(mind.memories.gait, mind.call, measured, mind.ground)
        sentence = f"the sensed state is not a number at {measured.time:.3f} s: motors stopped"
        return Lap(measured, mind.route, mind.call, target, idle(self.brain.robot), (0.0, 0.0), sentence)

    # --- steering ----------------------------------------------------------------------------------
    def give(self, mission: Mission) -> None:
        """Another mission from the next step on; the gait goes on, the new way is planned from here."""
        self.brain.controller(mission.driver)
        self.outcome = None
        self.mind = self.brain.begin(mission, self.measured, before=self.mind)
        self.termination.set_out(self.measured.time)

    def steer(self, forward: float, left: float = 0.0, turn: float = 0.0) -> None:
        """A person's velocity from the next step on, in the robot's heading frame [m/s, m/s, rad/s]; it holds
        until another one, or a mission, is given.

        Where there is no room for it the robot stands (`mind.route.pause` says why) and the run goes on.
        Raises `WrongUse` for one that is beyond the robot's skills.
        """
        velocity = Velocity(forward, left, turn)
        check_velocity(self.brain.robot, velocity)
        now = Steering((0.0,), (velocity,))
        self.give(Mission((), driver=self.mind.mission.driver, guidance=now))

    def drive(self, driver: str) -> None:
        """Another driver from the next step on."""
        self.brain.controller(driver)
        mission, call = replace(self.mind.mission, driver=driver), replace(self.mind.call, driver=driver)
        self.mind = self.mind._replace(mission=mission, call=call)

    def choose_by(self, chooser: Chooser) -> None:
        """Another chooser of skills: it is asked at the next step."""
        self.brain = self.brain.with_chooser(chooser)
        self.mind = self.mind._replace(chosen_at=-math.inf)

    def push(self, push: Push) -> None:
        """A push that waits for its time."""
        self.simulated()
        self.pushes.append(push)

    def push_if_due(self, lap: Lap) -> None:
        """Begins and ends pushes when their time has come."""
        if not self.pushes and self.pushing_until is None:
            return
        if self.pushing_until is not None and lap.sensed.time >= self.pushing_until - 1e-9:
            self.simulated().push((0.0, 0.0, 0.0))
            self.pushing_until = None
        due = next((push for push in self.pushes if push.is_due(lap, self.plant.dt)), None)
        if due is not None and self.pushing_until is None:
            self.pushes.remove(due)
            self.simulated().push(due.force(self.brain.robot, lap))
            self.pushing_until = lap.sensed.time + due.lasts

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of the world from the next step on: an obstacle moved, say. Who knows the
        ground is told; who sees it finds out."""
        self.simulated().rearrange(scene)
        before = self.brain.perception
        perception = with_things(before.told(scene, self.brain.robot), scene, self.brain.robot)
        if perception is not before:
            self.brain = replace(self.brain, perception=perception)
            self.give(self.mind.mission)

    def simulated(self) -> SimulatedPlant:
        """The plant, where its world can be interfered with; `WrongUse` where it is a real one."""
        if not isinstance(self.plant, SimulatedPlant):
            raise WrongUse(f"a {type(self.plant).__name__} is no simulation: nothing can be pushed or moved")
        return self.plant


def ended(lap: Lap, ending: Ending) -> Lap:
    """The last lap of a run."""
    return lap._replace(stopped_because=ending.because, arrived=ending.arrived, fell=ending.fell)


def walk(  # noqa: PLR0913 - the door to everything; most calls name three of these
    brain: Brain,
    plant: Plant,
    mission: Mission,
    seconds: float = 60.0,
    seed: int = 0,
    vary: bool = True,
    scene: str = "",
    watch: Callable[[Lap], None] | None = None,
    lowers: bool = False,
    previews: bool = False,
) -> Recording:
    """Takes a robot through a mission; an interrupt (Ctrl-C) keeps what was recorded.

    `watch`, where given, is called with every lap; `lowers`: whether the robot is let down at the end;
    `previews`: as in `record`.
    """
    return record(Session(brain, plant, mission, seconds, seed, vary, lowers), seed, scene, watch, previews)


def record(
    session: Session,
    seed: int = 0,
    scene: str = "",
    watch: Callable[[Lap], None] | None = None,
    previews: bool = False,
) -> Recording:
    """Steps a session to its end and keeps every lap; an interrupt or a full disk keeps what was recorded.

    `previews`: whether what the terrain scanner holds is kept too (`record.previews`).
    """
    movers = getattr(getattr(session.plant, "scene", None), "movers", ())  # a real plant has no scene
    recorder = Recorder(session.brain.robot, scene, seed, session.plant.dt, movers)
    try:
        for lap in session:
            recorder.add(lap, session.mind if previews else None)
            if watch is not None:
                watch(lap)
    except NoRoom:
        pass
    except (KeyboardInterrupt, SystemError) as error:
        if not is_interrupt(error):
            raise
    recorder.end_trip()
    keep_lowering(session, recorder)
    return recorder.finish()


def keep_lowering(session: Session, recorder: Recorder) -> None:
    """Lets the robot down and keeps that; another interrupt, or a full disk, ends it."""
    try:
        for lap in session.lower():
            recorder.add(lap)
    except NoRoom:
        pass
    except (KeyboardInterrupt, SystemError) as error:
        if not is_interrupt(error):
            raise
    finally:
        session.close()
