"""The profiles of one skill, on a grid over speed and turn: straight between four of them (row L9)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.control.learned.profile import Profile, Table
from gaitwright.numerics.compiled import kernel

FORWARD = (1.0, 0.0)
ALIKE = 1e-6
"""Velocities nearer than this are one [m/s, rad/s]."""


@dataclass(frozen=True, eq=False)
class Cells:
    """Tables of a skill at each of some speeds along its way, and of some yaw rates, in ascending order."""

    way: Float[np.ndarray, "2"]
    """Where the skill goes: unit vector, forward and left."""
    speeds: Float[np.ndarray, " speeds"]
    turns: Float[np.ndarray, " turns"]
    tables: Float[np.ndarray, "speeds turns bins width"]
    period: float
    """Of the gait [s]."""
    taught: Bool[np.ndarray, "speeds turns"]
    """Which of them were taught; in the others stands the nearest that was."""

    @classmethod
    def of(cls, profiles: Sequence[Profile]) -> "Cells":
        """The grid of some profiles; of two at one velocity the later one counts."""
        velocity = np.array([profile.command[:2] for profile in profiles])
        farthest = velocity[np.argmax(np.linalg.norm(velocity, axis=1))]
        size = float(np.linalg.norm(farthest))
        way = farthest / size if size > ALIKE else np.array(FORWARD)
        at = [(float(v @ way), profile.command[2]) for v, profile in zip(velocity, profiles, strict=True)]
        speeds, turns = (distinct([place[axis] for place in at]) for axis in (0, 1))
        tables = np.empty((len(speeds), len(turns), *profiles[0].table.shape))
        taught = np.zeros((len(speeds), len(turns)), np.bool_)
        for (speed, turn), profile in zip(at, profiles, strict=True):
            place = int(np.abs(speeds - speed).argmin()), int(np.abs(turns - turn).argmin())
            tables[place], taught[place] = profile.table, True
        for place in np.argwhere(~taught):
            known = np.argwhere(taught)
            tables[tuple(place)] = tables[tuple(known[np.abs(known - place).sum(axis=1).argmin()])]
        return cls(way, speeds, turns, tables, profiles[0].gait.period, taught)

    def at(self, command: tuple[float, float, float]) -> Table:
        """The whole table between the cells at a velocity: forward, left [m/s], yaw rate [rad/s]."""
        i, u = share_of(self.speeds, command[0] * self.way[0] + command[1] * self.way[1])
        j, v = share_of(self.turns, command[2])
        low, high = ((1.0 - v) * self.tables[k, j] + v * self.tables[k, next_of(j, self.turns)]
                     for k in (i, next_of(i, self.speeds)))  # fmt: skip
        return (1.0 - u) * low + u * high

    def covers(self, forward: float, left: float, turn: float, speed_room: float, turn_room: float) -> bool:
        """Whether a velocity [m/s, rad/s] lies among cells that were taught, or hardly beyond them."""
        command = (forward, left, turn)
        return is_among(self.way, self.speeds, self.turns, self.taught, command, speed_room, turn_room)


def distinct(values: Sequence[float]) -> Float[np.ndarray, " values"]:
    """Values in ascending order, each once."""
    ordered = np.sort(np.array(values, dtype=float))
    return ordered[np.diff(ordered, prepend=-np.inf) > ALIKE]


@kernel
def share_of(places, value):
    """The place below a value, and how far the value is on the way to the next; at the ends, the end."""
    last = places.size - 1
    if value <= places[0] or last == 0:
        return 0, 0.0
    if value >= places[last]:
        return last, 0.0
    k = 0
    while places[k + 1] <= value:
        k += 1
    return k, (value - places[k]) / (places[k + 1] - places[k])


@kernel
def next_of(k, places):
    """The place after one, or the last."""
    return min(k + 1, places.size - 1)


@kernel
def is_among(way, speeds, turns, taught, command, speed_room, turn_room):
    """Whether a command lies among cells that were taught, or hardly beyond them (`Cells.covers`)."""
    along = command[0] * way[0] + command[1] * way[1]
    across, turn = command[1] * way[0] - command[0] * way[1], command[2]
    if not (speeds[0] - speed_room <= along <= speeds[-1] + speed_room and abs(across) <= speed_room):
        return False
    if not turns[0] - turn_room <= turn <= turns[-1] + turn_room:
        return False
    i, j = share_of(speeds, along)[0], share_of(turns, turn)[0]
    k, m = next_of(i, speeds), next_of(j, turns)
    return taught[i, j] and taught[k, j] and taught[i, m] and taught[k, m]


@kernel
def row_at(way, speeds, turns, tables, command, phase, out):
    """Writes the row at a phase, straight between two phases of each of four cells."""
    i, u = share_of(speeds, command[0] * way[0] + command[1] * way[1])
    j, v = share_of(turns, command[2])
    bins = tables.shape[2]
    place = (phase % 1.0) * bins
    b, w = int(place) % bins, place - int(place)
    after = (b + 1) % bins
    out[:] = 0.0
    for k, x in ((i, 1.0 - u), (next_of(i, speeds), u)):
        for m, y in ((j, 1.0 - v), (next_of(j, turns), v)):
            share = x * y
            if share > 0.0:
                add_rows(out, tables[k, m, b], share * (1.0 - w), tables[k, m, after], share * w)


@kernel
def add_rows(out, one, weight, other, other_weight):
    """Adds two rows, each with its weight."""
    for c in range(out.size):
        out[c] += weight * one[c] + other_weight * other[c]
