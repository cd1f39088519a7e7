"""When a run is over, and why, in one sentence: an arrival, a fall, a fault, or the end of the time."""

import math
from dataclasses import dataclass

import numpy as np

from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import MotionTarget, MotorCommand, Route, Sensed, SkillCall
from gaitwright.skills.library import REFERENCE_HEIGHT

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
PROGRESS = 0.02
"""What counts as progress, in body lengths."""
ANEW = 0.25
"""A way that grows by more than this from a tick to the next, in body lengths, is another one."""
STILL = 0.03
"""A body slower than this share of √(g h) stands still."""
REST = 0.3
"""A robot that has stood still at its goal for this long [s] has arrived."""
HALTED = 2.0
"""One that must not go on, and stands, is given this long [s]: with a few more looks it may."""


sensed_fields = Sensed.layout.views()
tau_of = MotorCommand.layout.field("tau")
normal_of, feet_of, stance_of = (MotionTarget.layout.field(name) for name in ("normal_w", "feet_w", "stance"))


@dataclass(frozen=True, slots=True)
class Ending:
    """Why a run ends."""

    because: str
    arrived: bool = False
    fell: bool = False
    may_wait: bool = False
    """Whether the robot stands, or can: where somebody attends to it, it may wait for another mission."""


@kernel
def vital_signs(seen, asked, told, bounds):
    """What decides whether a run goes on, as plain numbers.

    `seen`, `asked`, `told`: the rows of a `Sensed`, a `MotionTarget` and a `MotorCommand`. They are:

    Cosine of the lean from the ground's normal; height over the lowest foot [m]; whether it is within
    `bounds`; speed over ground [m/s]; whether a foot is loaded; whether all feet are down; whether every
    torque is a number.
    """
    _, position, orientation, velocity, _, _, _, load = sensed_fields(seen)
    w, x, y, z = orientation
    normal, feet_w = normal_of(asked), feet_of(asked)
    up_x, up_y, up_z = 2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)
    lean = up_x * normal[0] + up_y * normal[1] + up_z * normal[2]
    return (
        lean,
        position[2] - feet_w[:, 2].min(),
        bounds[0] <= position[0] <= bounds[2] and bounds[1] <= position[1] <= bounds[3],
        math.hypot(velocity[0], velocity[1]),
        load.max() > 0.0,
        stance_of(asked).all(),
        math.isfinite(tau_of(told).sum()),
    )


class Termination:
    """Follows one run of a robot in a scene with `bounds` (x_min, y_min, x_max, y_max) [m].

    The run begins at time `begins` and may last `seconds`.
    """

    def __init__(
        self,
        robot: Robot,
        bounds: tuple[float, float, float, float],
        seconds: float,
        begins: float = 0.0,
    ) -> None:
        self.robot, self.seconds, self.ends = robot, seconds, begins + seconds
        self.field = np.array(bounds, dtype=float)
        self.pace = math.sqrt(GRAVITY * robot.height)
        self.patience = STUCK * math.sqrt(robot.height / REFERENCE_HEIGHT)
        self.air_limit = AIRBORNE / robot.natural_frequency
        self.grounded_at = self.fed_at = begins
        self.set_out(begins)

    def set_out(self, now: float) -> None:
        """A mission begins: neither progress nor rest was seen yet."""
        self.standing_since = self.progress_at = now
        self.nearest = self.left = math.inf

    def judge(
        self, sensed: Sensed, route: Route, call: SkillCall, target: MotionTarget, command: MotorCommand
    ) -> Ending | None:
        """Why the run ends with this tick, or `None` where it goes on."""
        lean, over_feet, inside, speed, grounded, all_down, finite = vital_signs(
            sensed.row, target.row, command.row, self.field
        )
        now = sensed.time
        if not finite:
            return Ending(f"a torque is not a number at {now:.3f} s: motors stopped")
        fault = (
            self.fallen(now, lean, over_feet)
            or (None if inside else self.outside(sensed))
            or self.unsupported(now, grounded, command.status)
            or self.stuck(route, sensed, call)
        )
        if fault:
            return fault
        if route.no_way:
            return Ending(f"there is no way to the goal: {route.no_way}", may_wait=True)
        if not ((route.arrived or call.halt) and all_down and speed < STILL * self.pace):
            self.standing_since = now
        stood = now - self.standing_since
        if stood > (REST if route.arrived else HALTED):
            arrival = Ending("arrived at the goal", arrived=True, may_wait=True)
            return arrival if route.arrived else Ending(f"stopped: {call.halt}", may_wait=True)
        return self.out_of_time(route) if now >= self.ends - 1e-9 else None

    def fallen(self, now: float, lean: float, over_feet: float) -> Ending | None:
        """A body that leans too far or lies too low."""
        if lean < TIPPED:
            degrees = math.degrees(math.acos(max(-1.0, lean)))
            return Ending(f"fell: the body leaned {degrees:.0f}° at {now:.2f} s", fell=True)
        if over_feet < SUNK * self.robot.stand:
            sentence = f"fell: the body sank to {over_feet:.2f} m over its feet at {now:.2f} s"
            return Ending(sentence, fell=True)
        return None

    def outside(self, sensed: Sensed) -> Ending:
        """A robot that has left the scene."""
        x, y, _ = sensed.position_w
        return Ending(f"left the scene at ({x:.2f}, {y:.2f}) after {sensed.time:.2f} s")

    def unsupported(self, now: float, grounded: bool, status: str) -> Ending | None:
        """A lost contact, or forces that could not be found for too long."""
        if grounded:
            self.grounded_at = now
        if status.startswith("solved"):
            self.fed_at = now
        if now - self.grounded_at > self.air_limit:
            return Ending(f"lost contact: no foot has touched the ground since {self.grounded_at:.2f} s")
        if now - self.fed_at > OVERLOADED:
            return Ending(f"{status} (since {self.fed_at:.2f} s)")
        return None

    def stuck(self, route: Route, sensed: Sensed, call: SkillCall) -> Ending | None:
        """A mission that makes no progress; it begins anew on another way, since this one is blocked, and
        after it gave way."""
        if not route.path or route.arrived or route.pause:
            self.progress_at = sensed.time
            return None
        if call.yields or route.remaining > self.left + ANEW * self.robot.body_length:
            self.nearest = math.inf
        self.left = route.remaining
        if route.remaining < self.nearest - PROGRESS * self.robot.body_length:
            self.nearest, self.progress_at = route.remaining, sensed.time
        if sensed.time - self.progress_at <= self.patience:
            return None
        x, y = sensed.position_w[:2]
        sentence = f"stuck: no progress for {self.patience:.0f} s at ({x:.2f}, {y:.2f})"
        return Ending(sentence, may_wait=True)

    def out_of_time(self, route: Route) -> Ending:
        """The end of the time, and how far it is still."""
        if not route.path:
            return Ending(f"the {self.seconds:g} s asked for are over")
        return Ending(f"out of time after {self.seconds:g} s, {route.remaining:.2f} m before the goal")
