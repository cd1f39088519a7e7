"""Stops before ground on which no foot can stand, and says so (row J8)."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.ground.elevation import is_known
from gaitwright.model.robot import Robot
from gaitwright.model.stopping import stopping_distance
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Blocked, GroundMap, Route, Sensed, SkillCall
from gaitwright.skills.library import find_skill, gait_of
from gaitwright.skills.tracks import WIDEST, Track, feet_from
from gaitwright.stages import Chooser, Map, Now

ROOM = 0.3
"""Room to keep before the last foothold, in body heights."""
TURN = "turn-in-place"
"""Who turns in place goes on with that until it looks along its path."""
STANDS = 0.1
"""Who must not go on comes to a stand first: slower than this, in √(g h)."""


class Trouble(NamedTuple):
    """Why a robot must not go on: a foot that finds no place to stand."""

    track: Track
    foot: Float[np.ndarray, "2"]
    """From where it is followed [m]."""
    last: float
    """How far it is to its last foothold [m]."""
    rise: float
    """How much higher the ground is behind that [m]."""

    @property
    def said(self) -> str:
        """The trouble as a sentence."""
        what = named(self.rise, self.track.ground.step, self.track.height)
        return f"no foothold ahead: {what} begins {self.last:.2f} m ahead of a foot"

    @property
    def blocked(self) -> Blocked:
        """What stops the foot, as far as it goes on: found out when it is asked for, it takes some time."""
        return self.track.blocked_by(self.foot, self.last)


@dataclass(frozen=True)
class FootholdGuard:
    """Another chooser's choice, unless it leads where no foot can stand."""

    chooser: Chooser
    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The other's choice; `stop`, with a sentence, where it leads where no foot can stand. A person who
        steers may then choose another way."""
        if now is not None and now.blocked is not None and self.moves(sensed):
            return now
        call = self.chooser.choose(route, sensed, now, ground)
        trouble = None if ground is None else self.trouble(call, route, sensed, ground)
        if trouble is None:
            return call
        if route.path:  # its path may lead elsewhere than its nose
            turning = self.chooser.choose(route, sensed, replace(now or call, skill=TURN), ground)
            if turning.turn and not any(turning.velocity):
                return turning
        gait = gait_of(find_skill("stop", self.robot), self.robot)
        stop = replace(call, skill="stop", gait=gait, velocity=(0.0, 0.0), turn=0.0, because=trouble.said)
        return stop if route.attended else replace(stop, halt=trouble.said, blocked=trouble.blocked)

    def moves(self, sensed: Sensed) -> bool:
        """Whether a robot has not come to a stand yet."""
        fast = math.hypot(*sensed.velocity_w[:2].tolist())
        return fast > STANDS * math.sqrt(GRAVITY * self.robot.height)

    def trouble(self, call: SkillCall, route: Route, sensed: Sensed, ground: GroundMap) -> Trouble | None:
        """Why the robot must not go on with a call, or `None`."""
        speed = math.hypot(*call.velocity)
        if speed <= 0.0 or not is_known(ground.footholds):
            return None
        height = self.robot.height
        far = speed * call.gait.period + stopping_distance(speed) + (ROOM + WIDEST) * height
        place = sensed.position_w[:2]
        if route.path:
            far = min(far, float(math.dist(place, route.path[0])))
        track = Track.of(ground, self.robot, sensed, call.velocity)
        for foot in feet_from(self.robot, sensed):
            stops, last, rise, _ = track.followed(foot, far)
            if stops:
                return Trouble(track, foot, last, rise)
        return None


def named(rise: float, step: float, height: float) -> str:
    """What ground is called that lies so much higher or lower [m] for a robot that steps so high [m]."""
    if abs(rise) <= step:
        return f"broken ground, wider than the {WIDEST * height:.2f} m that are stepped over,"
    what = f"a wall of {rise:.2f} m" if rise > 0.0 else f"a drop of {-rise:.2f} m"
    return f"{what}, more than the {step:.2f} m that this robot steps,"
