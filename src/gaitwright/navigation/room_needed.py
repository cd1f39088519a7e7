"""How much room a robot takes, seen from above."""

from gaitwright.model.robot import Robot

CLEARANCE = 0.15
"""Room beside the robot's feet, in body lengths."""


def half_width(robot: Robot) -> float:
    """Room the robot needs to either side of its path [m]: its feet and a clearance."""
    return float(abs(robot.nominal_feet[:, 1]).max()) + CLEARANCE * robot.body_length
