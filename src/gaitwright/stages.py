"""The stages of the data flow as protocols: what each takes and gives.

Parts hold settings, values hold state: a stage that remembers anything is handed its memory and hands back
the next one, so that a run can be stopped, looked at, changed and gone on with at any tick.
"""

from typing import Any, Protocol, runtime_checkable

from gaitwright.signals import (
    GroundMap,
    Measured,
    Mission,
    MotionTarget,
    MotorCommand,
    Route,
    Scan,
    Sensed,
    SkillCall,
)

Memory = Any
"""What a stage remembers from tick to tick: a value of its own making, that nobody else looks into."""
Now = SkillCall | None
"""The call in use; `None` before the first one."""
Map = GroundMap | None
"""What is known of the ground; `None`: nothing."""


@runtime_checkable
class Perception(Protocol):
    """Measured → Sensed and GroundMap."""

    @property
    def ground(self) -> GroundMap:
        """What is known of the ground before anything was measured."""
        ...

    def perceive(self, measured: Measured, memory: Memory) -> tuple[Sensed, GroundMap, Memory]:
        """What is, and what is known of the ground; `memory` is `None` at the start."""
        ...

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """What the ground ahead is like; `None` where nobody looks."""
        ...

    def told(self, scene: Any, robot: Any) -> "Perception":
        """The same of a world (`ground.scene.Scene`) that was arranged anew, as far as it is told."""
        ...


@runtime_checkable
class Navigation(Protocol):
    """Mission + Sensed + GroundMap → Route."""

    def set_out(
        self,
        mission: Mission,
        sensed: Sensed,
        ground: GroundMap,
        scan: Scan | None = None,
        memory: Memory = None,
    ) -> tuple[Route, Memory]:
        """The route of a new mission; `no_way` says so where there is none. `memory`: of the mission before,
        where it is given on the way."""
        ...

    def plan(
        self, route: Route, sensed: Sensed, ground: GroundMap, scan: Scan | None, memory: Memory
    ) -> tuple[Route, Memory]:
        """What is left of a route from where the robot is now."""
        ...


@runtime_checkable
class Chooser(Protocol):
    """Route + Sensed + GroundMap → SkillCall; what it remembers is the call in use, with the facts in it."""

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The skill for what lies ahead; `now`: the one in use; no `ground`: nothing is known of it."""
        ...


@runtime_checkable
class MotionStage(Protocol):
    """SkillCall + Sensed + GroundMap → MotionTarget: the coordinator, or a planned climb (`gait`)."""

    def begin(self, sensed: Sensed, phase: float = 0.0) -> Memory:
        """The memory of a robot that stands as sensed and will start its first gait at `phase`."""
        ...

    def move(
        self, memory: Memory, call: SkillCall, sensed: Sensed, ground: GroundMap | None = None
    ) -> tuple[MotionTarget, Memory]:
        """What body, feet and joints should do now; no `ground`: feet go blind."""
        ...


@runtime_checkable
class Controller(Protocol):
    """SkillCall + MotionTarget + Sensed + GroundMap → MotorCommand."""

    def command(
        self,
        target: MotionTarget,
        sensed: Sensed,
        memory: Memory = None,
        call: Now = None,
        ground: Map = None,
    ) -> tuple[MotorCommand, Memory]:
        """What every motor is told in this tick; `memory` is `None` at the first one."""
        ...


@runtime_checkable
class Plant(Protocol):
    """MotorCommand → Measured: a simulated robot, or a real one."""

    dt: float
    """Control period [s]."""

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot at its start, varied by `seed` where asked."""
        ...

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command."""
        ...


@runtime_checkable
class SimulatedPlant(Plant, Protocol):
    """A plant in a world that can be interfered with."""

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        ...

    def rearrange(self, scene: Any) -> None:
        """Another arrangement of what stands around the robot, which stays as it is."""
        ...
