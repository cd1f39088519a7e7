"""What a robot is asked to do: to go somewhere, to go as was written beforehand, or to go as a person steers.

The three strategies of navigation (thesis 6.2): robot-controlled, pre-programmed and animator-controlled.
"""

from dataclasses import dataclass
from typing import NamedTuple

from gaitwright.errors import WrongUse


class Stop(NamedTuple):
    """A place of a programme."""

    x: float
    y: float
    """World [m]."""
    speed: float | None = None
    """Wished speed on the way there [m/s]; `None`: the mission's."""
    wait: float = 0.0
    """How long the robot stands there [s]; 0: it goes on without a stop."""


class Programme(NamedTuple):
    """A way that was written beforehand: it is gone as it is written, or not."""

    stops: tuple[Stop, ...]


class Velocity(NamedTuple):
    """What a person asks for, in the robot's heading frame."""

    forward: float
    left: float = 0.0
    """[m/s]"""
    turn: float = 0.0
    """Yaw rate, to the left [rad/s]."""


class Steering(NamedTuple):
    """A person's commands: each holds until the next one begins, and the robot stands until the first."""

    begins: tuple[float, ...]
    """When each begins, since the mission was given [s]."""
    velocities: tuple[Velocity, ...]
    ends: float | None = None
    """When all are over [s]; `None`: another one may be given at any time."""

    def at(self, time: float) -> Velocity:
        """What is asked for at a time since the mission was given [s]."""
        began = sum(begin <= time + 1e-9 for begin in self.begins)
        is_over = self.ends is not None and time >= self.ends - 1e-9
        return self.velocities[began - 1] if began and not is_over else Velocity(0.0)


@dataclass(frozen=True, slots=True)
class Mission:
    """Where to go: way-points in order, the last one is the goal. Or how: as was written, or as a person
    steers (thesis 6.2: the robot, a programme and an animator may navigate)."""

    waypoints: tuple[tuple[float, float], ...]
    """World x, y [m]."""
    speed: float | None = None
    """Wished speed [m/s]; `None` leaves it to the skill."""
    driver: str = "numerical"
    """Who computes the torques."""
    guidance: Programme | Steering | None = None
    """Who finds the way in place of the robot; then there are no way-points."""

    def __post_init__(self) -> None:
        if self.waypoints and self.guidance is not None:
            raise WrongUse("a mission has way-points, a programme or somebody who steers: one of these")
