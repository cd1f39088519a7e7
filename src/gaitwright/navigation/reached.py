"""When a goal, a way-point or a corner counts as reached."""

from gaitwright.model.robot import Robot
from gaitwright.signals import Route

ARRIVED = 0.15
"""The goal is reached within this many body lengths."""
STOP_AT = 0.06
"""The robot begins to stop within this many body lengths, so that it stands within `ARRIVED`."""
PASSED = 0.5
"""A way-point or a corner counts as passed within this many body lengths."""


def has_arrived(route: Route, robot: Robot) -> bool:
    """Whether a robot is at the last point of its way: once there, it stays so until it is pushed off."""
    near = ARRIVED if route.arrived else STOP_AT
    return len(route.path) == 1 and route.remaining < near * robot.body_length
