"""The alarm of the learned controller: a robot that stumbles is asked to go no farther until it is calm.

It is not handed back: in a stumble the numerical controller fell more often. The same gait goes on at
speed 0. It is off unless somebody asks for it: measured, it saves as many robots as it costs.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import MotionTarget, Sensed, SkillCall

LOUD, LASTS = 0.58, 0.01
"""It rings where the capture distance is beyond this many heights for so long [s]."""
CALM, RESTS = 0.45, 0.1
"""It falls silent where it is within this for so long [s]: by itself a gait sways less."""
LONGEST = 3.0
"""It rings for so long at most [s]."""
position_of, velocity_of = Sensed.layout.field("position_w"), Sensed.layout.field("velocity_w")
feet_of, command_of = MotionTarget.layout.field("feet_w"), MotionTarget.layout.field("command")
axes_of = MotionTarget.layout.field("rotation_wb")


@kernel
def capture_distance(seen, asked, w0, height):
    """How far the feet are, in their mean, from where the body would come to rest over them [heights].

    `seen`, `asked`: the rows of a `Sensed` and a `MotionTarget`; the body's velocity counts as far as it is
    not what is asked for. Seen from above.
    """
    position, velocity, feet = position_of(seen), velocity_of(seen), feet_of(asked)
    command, axes = command_of(asked), axes_of(asked)
    yaw = math.atan2(axes[1, 0], axes[0, 0])
    c, s = math.cos(yaw), math.sin(yaw)
    x = position[0] + (velocity[0] - c * command[0] + s * command[1]) / w0
    y = position[1] + (velocity[1] - s * command[0] - c * command[1]) / w0
    n = feet.shape[0]
    for k in range(n):
        x -= feet[k, 0] / n
        y -= feet[k, 1] / n
    return math.hypot(x, y) / height


class Heard(NamedTuple):
    """What the alarm remembers."""

    rings: bool = False
    since: float = -1.0
    """Since when it rings, or what would change that holds [s]; negative: nothing does."""
    began: float = 0.0
    """When it began to ring [s]."""


QUIET = Heard()


@dataclass(frozen=True)
class Alarm:
    """Listens while the learned controller drives."""

    robot: Robot

    @cached_property
    def clock(self) -> tuple[float, float]:
        """√(g/h) [1/s] and h [m]."""
        return self.robot.natural_frequency, self.robot.height

    def listen(self, target: MotionTarget, sensed: Sensed, was: Heard) -> Heard:
        """Whether it rings after this tick."""
        distance, time = capture_distance(sensed.row, target.row, *self.clock), sensed.time
        if not (distance < CALM if was.rings else distance > LOUD):
            is_over = was.rings and time - was.began > LONGEST
            return QUIET if is_over else was if was.since < 0.0 else was._replace(since=-1.0)
        since = time if was.since < 0.0 else was.since
        if time - since < (RESTS if was.rings else LASTS) - 1e-9:
            return was._replace(since=since)
        return QUIET if was.rings else Heard(True, -1.0, time)

    def calmed(self, call: SkillCall, heard: Heard) -> SkillCall:
        """What the gait is asked for: while the alarm rings, no velocity."""
        return replace(call, velocity=(0.0, 0.0), turn=0.0) if heard.rings else call
