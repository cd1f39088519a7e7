"""Claim: the thesis's robot stands, walks and turns, and the hexapod walks, by the same code and gains.

Not falling is not enough where a speed is asked for: it must be held to a tenth.
"""

from collections.abc import Iterator

from gaitwright.bench.claims.walks import Walk, measure_walks
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure

WALKS = (
    Walk("thesis", "stand", 0.0, seconds=20.0, starts=10),
    Walk("thesis", "walk", 0.5, seconds=20.0, starts=10, velocity=0.05),
    Walk("thesis", "turn-in-place", 0.0, seconds=20.0, starts=10, turn=0.2, yaw_rate=0.02),
    Walk("hexapod", "trot", 0.15, seconds=20.0, starts=10, velocity=0.015),
    Walk("hexapod", "walk", 0.10, seconds=20.0, starts=10, velocity=0.01),
)
"""The hexapod's trot is its tripod gait, its walk a ripple."""


def measure(context: Context) -> Iterator[Figure]:
    """The figures of the other robots' walks."""
    return measure_walks(context, WALKS)
