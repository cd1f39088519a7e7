"""How far a robot goes on that is told to stop."""

from gaitwright.numerics.geometry import GRAVITY

BRAKING = 0.1
"""Deceleration that is counted on, as a share of gravity."""


def stopping_distance(speed: float) -> float:
    """How far it goes from a speed [m/s] to a stand [m]."""
    return speed**2 / (2.0 * BRAKING * GRAVITY)


def stopping_time(speed: float) -> float:
    """How long it would take for that way at the speed that it had [s]."""
    return speed / (2.0 * BRAKING * GRAVITY)
