"""How to follow a path, whatever skill is used: how far off it is, how fast to turn, how fast to go."""

import math

from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation, wrap
from gaitwright.signals import Route, Sensed
from gaitwright.skills.library import LIBRARY, speed_scale

CREEP = 0.1
"""Slowest approach [m/s], at h = 0.29 m."""
TURN_GAIN = 2.0
"""Yaw rate per heading error [1/s]."""
MOST_TURN = 0.8
"""Fastest turn [rad/s], at h = 0.29 m."""
BRAKING = 0.6
"""Speed allowed per metre that is left [1/s], at h = 0.29 m."""


def bearing(route: Route, sensed: Sensed) -> float:
    """World direction of the next point of the path [rad]."""
    dx = route.path[0][0] - float(sensed.position_w[0])
    dy = route.path[0][1] - float(sensed.position_w[1])
    return math.atan2(dy, dx)


def heading_error(route: Route, sensed: Sensed) -> float:
    """How far to the left of the robot's nose the next point of the path lies [rad]."""
    return float(wrap(bearing(route, sensed) - heading(rotation(sensed.orientation_wb))))


def turn_rate(robot: Robot, error: float) -> float:
    """Yaw rate [rad/s] that takes away a heading error [rad], within what the feet can step."""
    most = MOST_TURN / speed_scale(robot)
    return max(-most, min(most, TURN_GAIN / speed_scale(robot) * error))


def wished_speed(robot: Robot, route: Route) -> float:
    """The speed of the mission [m/s]; that of a trot where it leaves it to the skill."""
    return route.speed if route.speed is not None else LIBRARY["trot"].speed * speed_scale(robot)


def approach_speed(robot: Robot, route: Route) -> float:
    """The wished speed [m/s], no more than leaves time to stop at the goal."""
    scale = speed_scale(robot)
    return min(wished_speed(robot, route), max(CREEP * scale, BRAKING / scale * route.remaining))
