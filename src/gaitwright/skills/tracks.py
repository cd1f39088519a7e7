"""Which way feet go over a ground, and where they find no place to stand any more (row J8)."""

import math
from typing import NamedTuple

import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.ground.footholds import BONE, last_foothold
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import Blocked, GroundMap, Sensed

WIDEST = 1.1
"""A stretch without a foothold up to this long is stepped over, in body heights."""
ASIDE = 0.15
"""Footholds this far beside a foot's track will do, in body heights."""
LOOKED_AT, UNSEEN = 23, 0.5
"""At so many places behind the last foothold it is asked what was seen; and at most so much may be hidden."""
BESIDE, APART = 5.0, 0.2
"""So far to either side, and so often, it is looked how far what stops a foot goes on, in body heights."""


class Track(NamedTuple):
    """Which way feet go over a ground."""

    ground: GroundMap
    height: float
    """Of the body [m]."""
    level: float
    """Of the ground that the robot stands on [m]."""
    way: float
    """World direction [rad]."""

    @classmethod
    def of(cls, ground: GroundMap, robot: Robot, sensed: Sensed, velocity: tuple[float, float]) -> "Track":
        """Those of a robot that goes forward and left at a velocity [m/s]."""
        way = heading(rotation(sensed.orientation_wb)) + math.atan2(velocity[1], velocity[0])
        return cls(ground, robot.height, float(sensed.position_w[2]) - robot.height, way)

    @property
    def ahead(self) -> Float[np.ndarray, "2"]:
        """Its direction."""
        return np.array([math.cos(self.way), math.sin(self.way)])

    def followed(self, start: Float[np.ndarray, "2"], far: float) -> tuple[bool, float, float, float]:
        """How far a foot comes that goes from a place [m] so far (`last_foothold`)."""
        aside, stride = ASIDE * self.height, WIDEST * self.height
        ground, step = self.ground.footholds, self.ground.step
        return last_foothold(ground, start, self.level, self.way, far, aside, step, stride, self.height)

    def blocked_by(self, foot: Float[np.ndarray, "2"], last: float) -> Blocked:
        """What begins behind the last foothold of a foot [m], as far as it is seen to go on to both sides."""
        if not self.is_seen(foot, last):
            x, y = (foot + last * self.ahead).tolist()
            return Blocked(((x, y),), self.way, is_seen=False)
        right, left = (self.beside(foot, last, side) for side in (-1.0, 1.0))
        rim = np.array([*right[::-1], foot + last * self.ahead, *left])
        line = shapely.LineString(rim).simplify(BONE * self.height).coords if len(rim) > 1 else rim
        return Blocked(tuple((float(x), float(y)) for x, y in line), self.way, is_seen=True)

    def beside(self, foot: Float[np.ndarray, "2"], last: float, side: float) -> list[np.ndarray]:
        """Points at which it begins to one side, outwards."""
        apart, points = APART * self.height, []
        across = side * np.array([-self.ahead[1], self.ahead[0]])
        for k in range(1, round(BESIDE / APART) + 1):
            start, before = foot + k * apart * across, last
            stops, last, *_ = self.followed(start, before + 3.0 * apart + WIDEST * self.height)
            if not stops or abs(last - before) > 2.0 * apart or not self.is_seen(start, last):
                break
            points.append(start + last * self.ahead)
        return points

    def is_seen(self, foot: Float[np.ndarray, "2"], last: float) -> bool:
        """Whether what is behind the last foothold of a foot was seen."""
        if self.ground.elevation is None:
            return False
        away = np.linspace(last, last + WIDEST * self.height, LOOKED_AT)
        heights = self.ground.elevation.height(*(foot + away[:, None] * self.ahead).T)
        return bool(np.isnan(heights).mean() <= UNSEEN)


def feet_from(robot: Robot, sensed: Sensed) -> Float[np.ndarray, "legs 2"]:
    """From where the feet of a robot set out: under their hips, seen from above, world [m]."""
    yaw = heading(rotation(sensed.orientation_wb))
    c, s = math.cos(yaw), math.sin(yaw)
    return sensed.position_w[:2] + robot.nominal_feet[:, :2] @ np.array([[c, s], [-s, c]])
