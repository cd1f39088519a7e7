"""Lap → a row of numbers, and rows → a frame: what the page draws sixty times a second.

A frame is a header and one row of 32-bit floats for each robot, little-endian. The page learns the columns of
a row from `columns_of`; whoever reads a recording of rows does so too.
"""

import struct
import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.driving import Memories
from gaitwright.gait.state import GaitMemory
from gaitwright.locomotion import Lap
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.numerics.packing import Layout
from gaitwright.studio.setup import who_drives

KIND, PAUSED = 1, 1
HEADER = struct.Struct("<BBHIdd")
"""Kind, flags, number of robots, sequence number, when it was made (Unix) [s], 0."""


class FrameRow(NamedTuple):
    """One robot at a moment; names as in `signals`, world axes, legs in the robot's order."""

    time: float
    position_w: Float[np.ndarray, "3"]
    orientation_wb: Float[np.ndarray, "4"]
    velocity_w: Float[np.ndarray, "3"]
    angular_velocity_b: Float[np.ndarray, "3"]
    q: Float[np.ndarray, "legs 3"]
    tau: Float[np.ndarray, "legs 3"]
    load: Float[np.ndarray, "legs"]
    stance: Float[np.ndarray, "legs"]
    """1 where a leg is to carry."""
    forces_w: Float[np.ndarray, "legs 3"]
    """Intended forces of the ground [N]."""
    feet_target_w: Float[np.ndarray, "legs 3"]
    """Where the feet should be now [m]."""
    footholds_w: Float[np.ndarray, "legs 3"]
    """Where swings are to end [m]; NaN where nobody knows."""
    command: Float[np.ndarray, "3"]
    reference_position_w: Float[np.ndarray, "3"]
    reference_orientation_wb: Float[np.ndarray, "4"]
    q_reference: Float[np.ndarray, "legs 3"]
    phase: float
    driver: float
    """Place of who drives in a list of names."""
    power: float
    """Σ|τ q̇| [W]."""


LAYOUT = Layout.of(FrameRow)


def columns_of(legs: int) -> list[dict[str, str | int]]:
    """Names and sizes of a row's columns, in order."""
    return [{"name": name, "size": at.stop - at.start} for name, at in LAYOUT.slices(legs).items()]


def row_of(lap: Lap, memories: Memories, drivers: Sequence[str]) -> Float[np.ndarray, "numbers"]:
    """What is drawn of a lap. `memories`: what the robot remembers after it."""
    sensed, target, command = lap.sensed, lap.target, lap.command
    gait, who = memories.gait, who_drives(lap.call.driver)
    footholds = gait.state.foothold if isinstance(gait, GaitMemory) else np.full_like(target.feet_w, np.nan)
    return LAYOUT.pack(
        FrameRow(
            sensed.time,
            sensed.position_w,
            sensed.orientation_wb,
            sensed.velocity_w,
            sensed.angular_velocity_b,
            sensed.q,
            command.tau,
            sensed.load,
            target.stance.astype(float),
            command.forces_w,
            target.feet_w,
            footholds,
            target.command,
            target.position_w,
            quaternion_of(target.rotation_wb),
            target.q,
            target.phase,
            float(drivers.index(who)) if who in drivers else -1.0,
            float(np.abs(command.tau * sensed.qd).sum()),
        )
    )


def frame_of(rows: Sequence[np.ndarray], sequence: int, paused: bool) -> bytes:
    """A frame of one row for each robot."""
    header = HEADER.pack(KIND, PAUSED if paused else 0, len(rows), sequence % 2**32, time.time(), 0.0)
    return header + b"".join(row.astype("<f4").tobytes() for row in rows)
