"""Stops before ground on which no foot can stand, and says so (row J8)."""

import math
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.ground.elevation import is_known
from gaitwright.ground.footholds import last_foothold
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, heading, rotation
from gaitwright.signals import GroundMap, Route, Sensed, SkillCall
from gaitwright.skills.library import find_skill, gait_of
from gaitwright.stages import Chooser, Map, Now

WIDEST = 1.1
"""A stretch without a foothold up to this long is stepped over, in body heights."""
ASIDE = 0.15
"""Footholds this far beside a foot's track will do, in body heights."""
BRAKING = 0.1
"""Deceleration that is counted on, as a share of gravity."""
ROOM = 0.3
"""Room to keep before the last foothold, in body heights."""


@dataclass(frozen=True)
class FootholdGuard:
    """Another chooser's choice, unless it leads where no foot can stand."""

    chooser: Chooser
    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The other's choice; `stop`, with a sentence, where it leads where no foot can stand. A person who
        steers may then choose another way."""
        call = self.chooser.choose(route, sensed, now, ground)
        halt = None if ground is None else self.trouble(call, route, sensed, ground)
        if halt is None:
            return call
        gait = gait_of(find_skill("stop", self.robot), self.robot)
        stop = replace(call, skill="stop", gait=gait, velocity=(0.0, 0.0), turn=0.0, because=halt)
        return stop if route.attended else replace(stop, halt=halt)

    def trouble(self, call: SkillCall, route: Route, sensed: Sensed, ground: GroundMap) -> str | None:
        """Why the robot must not go on with a call, or `None`."""
        speed, grid = math.hypot(*call.velocity), ground.footholds
        if speed <= 0.0 or not is_known(grid):
            return None
        height = self.robot.height
        far = speed * call.gait.period + speed**2 / (2.0 * BRAKING * GRAVITY) + (ROOM + WIDEST) * height
        place = sensed.position_w[:2]
        if route.path:
            far = min(far, float(math.dist(place, route.path[0])))
        yaw = heading(rotation(sensed.orientation_wb))
        way = yaw + math.atan2(call.velocity[1], call.velocity[0])
        c, s = math.cos(yaw), math.sin(yaw)
        level = float(sensed.position_w[2]) - height
        for foot in self.robot.nominal_feet[:, :2] @ np.array([[c, s], [-s, c]]):
            stops, last, rise = last_foothold(
                grid, place + foot, level, way, far, ASIDE * height, ground.step, WIDEST * height, height
            )
            if stops:
                what = named(rise, ground.step, height)
                return f"no foothold ahead: {what} begins {last:.2f} m ahead of a foot"
        return None


def named(rise: float, step: float, height: float) -> str:
    """What ground is called that lies so much higher or lower [m] for a robot that steps so high [m]."""
    if abs(rise) <= step:
        return f"broken ground, wider than the {WIDEST * height:.2f} m that are stepped over,"
    what = f"a wall of {rise:.2f} m" if rise > 0.0 else f"a drop of {-rise:.2f} m"
    return f"{what}, more than the {step:.2f} m that this robot steps,"
