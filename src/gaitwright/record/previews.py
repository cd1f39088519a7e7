"""Lap + Mind → row: what the terrain scanner held some times a second, beside a recording's laps (row V3).

They are made while a run is recorded, since what a robot knew of the ground is known only then.
"""

import math
import zipfile
from collections.abc import Iterator

import numpy as np

from gaitwright.gait.state import GaitMemory
from gaitwright.locomotion import Lap, Mind
from gaitwright.model.robot import Robot
from gaitwright.perception.terrain_preview import LAYOUT, Steps, TerrainPreview, preview, preview_in
from gaitwright.record.checked import BLOWN_UP
from gaitwright.record.npz import holds, read_blocks
from gaitwright.record.rows import Lazy, Table, Writer, parts

EVERY = 0.05
"""From one preview to the next [s]."""
BLOCK = 256
"""Rows that go to the file at once: they are wider than those of laps."""
PREFIX = "scanner_"
"""Of the names that their fields have in a file."""
OPEN = (
    "support_w", "lowered_w", "coming_w", "footholds_w", "margin", "reach_w", "slope", "elevation",
)  # fmt: skip
"""Fields in which there may be nothing, as NaN; so they may be missing in a file."""
TRUTHS = ("supporting", "critical")
Rows = np.ndarray | Table


def preview_of(robot: Robot, lap: Lap, mind: Mind) -> TerrainPreview:
    """What the terrain scanner holds after a lap. `mind`: what the robot knew and remembered after it."""
    memory, target = mind.memories.gait, lap.target
    if not isinstance(memory, GaitMemory) or memory.gait is None:  # a planned climb has no gait
        return preview(robot, lap.sensed, mind.ground)
    steps = Steps(float(target.phase), memory.gait, target.stance, memory.state.foothold)
    return preview(robot, lap.sensed, mind.ground, steps)


class Previewer:
    """Collects previews; the older ones of a long run go to a file, as its laps do."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.writer = Writer(LAYOUT.size(robot.n), BLOCK)
        self.due = -math.inf

    def add(self, lap: Lap, mind: Mind) -> None:
        """Takes a lap where one is due. Raises `NoRoom` where the disk is full; nothing is lost."""
        now = lap.sensed.time
        if now >= self.due - 1e-9 and lap.sensed.is_finite():
            self.due = now + EVERY
            self.writer.add(LAYOUT.pack(preview_of(self.robot, lap, mind)).tobytes())

    def rows(self) -> Rows | None:
        """What was taken so far; `None` where that is nothing."""
        return self.writer.table() if self.writer.newest else None


def preview_at(rows: Rows, time: float) -> TerrainPreview:
    """The preview nearest to a time [s]."""
    nearest = int(np.abs(times_of(rows) - time).argmin())
    return preview_in(np.array(rows[nearest : nearest + 1, :][0]))


def previews_in(rows: Rows) -> Iterator[TerrainPreview]:
    """One after the other."""
    for part in parts(len(rows), BLOCK):
        for row in rows[part, :]:
            yield preview_in(np.array(row))


def times_of(rows: Rows) -> np.ndarray:
    """When each was [s]."""
    return np.array(rows[:, :1][:, 0])


# --- in a file -------------------------------------------------------------------------------------
def shapes(legs: int) -> dict[str, tuple[int, ...]]:
    """The fields by their names in a file, and the shape of each at a moment."""
    return {
        PREFIX + column.name: tuple(legs if length == "legs" else int(length) for length in column.shape)
        for column in LAYOUT.columns
    }


def series_of(rows: Rows, legs: int) -> dict[str, Lazy]:
    """Each field over all moments, by its name in a file."""
    return {
        name: field_of(rows, place, shape)
        for (name, shape), place in zip(shapes(legs).items(), LAYOUT.slices(legs).values(), strict=True)
    }


def field_of(rows: Rows, place: slice, shape: tuple[int, ...]) -> Lazy:
    """The columns of a field, `(moments, *shape)`."""
    return Lazy(len(rows), lambda moments: np.array(rows[moments, place]).reshape(-1, *shape))


def read_previews(archive: zipfile.ZipFile, legs: int) -> Rows | None:
    """The previews in the file of a recording; `None` where there are none. Raises `ValueError` for what no
    terrain scanner held."""
    if not holds(archive, PREFIX + "time"):
        return None
    writer, before = Writer(LAYOUT.size(legs), BLOCK), -math.inf
    for block in read_blocks(archive, shapes(legs), optional=tuple(PREFIX + name for name in OPEN)):
        check_previews(block, legs)
        times = times_of(block)
        if (np.diff([before, *times]) <= 0.0).any():
            raise ValueError(f"{PREFIX}time goes backwards")
        before = times[-1]
        writer.extend(block)
    return writer.table()


def check_previews(rows: np.ndarray, legs: int) -> None:
    """Raises `ValueError` for numbers that mean nothing."""
    for name, place in LAYOUT.slices(legs).items():
        values = rows[:, place]
        if not ((np.abs(values) < BLOWN_UP) | (np.isnan(values) & (name in OPEN))).all():
            raise ValueError(f"{PREFIX}{name} holds what is no number")
        if name in TRUTHS and not np.isin(values, (0.0, 1.0)).all():
            raise ValueError(f"{PREFIX}{name} holds what is neither 0 nor 1")
