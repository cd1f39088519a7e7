"""Whole torque profiles of gaits in one call: desired cycles streamed through the numerical controller.

What the thesis draws in figures 6.5 and 6.6, and what rules of type II will play back (row L3).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gaitwright.control.moments import moments_of
from gaitwright.control.stream import Efforts, Job, stream
from gaitwright.gait.desired_cycle import DesiredCycle


def torque_profiles(cycles: Sequence[DesiredCycle], cores: int | None = None) -> list[Efforts]:
    """Torques, foot forces and prices of every sample of every cycle, as of a robot that moves on and on.

    Each cycle is gone through twice and the second time kept, so that the first sample follows the last.
    """
    jobs = [Job(cycle.robot, np.tile(rows_of(cycle), (2, 1))) for cycle in cycles]
    return [second_half(efforts) for efforts in stream(jobs, cores=cores)]


def rows_of(cycle: DesiredCycle) -> np.ndarray:
    """The moments of a cycle, sensed as desired."""
    steps = range(cycle.steps)
    return moments_of([cycle.sensed(i) for i in steps], [cycle.target(i) for i in steps])


def second_half(efforts: Efforts) -> Efforts:
    """The last half of the moments."""
    half = len(efforts.tau) // 2
    return replace(efforts, **{name: getattr(efforts, name)[half:] for name in efforts.__dataclass_fields__})
