"""What is, beside what a profile says should be at this phase: each quantity coded −1, 0 or +1 (row E5).

Hock's comparator (thesis 2.5): ideal traces come from a machine that walks on level ground, here from the
teacher, with the profile. A deviation counts once it is over a band.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.cells import row_at
from gaitwright.control.learned.controller import LearnedController, command_of, phase_of
from gaitwright.control.learned.law import note
from gaitwright.control.learned.profile import row_of
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import Gait, MotionTarget, Sensed

WORDS = {
    "height": ("it is low", "it is high"),
    "roll": ("it is over to the left", "it is over to the right"),
    "pitch": ("its head is up", "its head is down"),
    "forward": ("it is too slow", "it is too fast"),
    "left": ("it drifts right", "it drifts left"),
    "turn": ("it turns too far right", "it turns too far left"),
}
"""What is compared, and how −1 and +1 of it read."""
QUANTITIES = tuple(WORDS)
MIRRORED = (1, -1, 1, 1, -1, -1)
"""Signs of the same pattern seen in a mirror: left for right."""
Pattern = tuple[int, ...]
"""−1, 0 or +1 of each quantity; none where nothing was compared."""


@kernel
def deviations(packed, way, speeds, turns, tables, seen, asked, taught, noted, out):
    """Writes how far each of `QUANTITIES` is off the taught row of this phase [m, rad, rad, m/s, m/s, rad/s].

    `packed`: the robot; `way`, `speeds`, `turns`, `tables`: its profiles of the gait, as in `Cells`; `seen`,
    `asked`: the rows of a `Sensed` and a `MotionTarget`; `taught`, `noted`: room for two rows of a profile.
    Ground frame, as in a profile.
    """
    row_at(way, speeds, turns, tables, command_of(asked), phase_of(asked), taught)
    ideal, now = row_of(taught), row_of(noted)
    nothing = np.zeros(now.free.shape)  # torques and forces are not compared
    note(packed, seen, asked, nothing, nothing, noted)
    for i in range(3):
        out[i] = now.pose[i] - ideal.pose[i]
    out[3], out[4] = now.velocity[0] - ideal.velocity[0], now.velocity[1] - ideal.velocity[1]
    out[5] = now.omega[2] - ideal.omega[2]


@dataclass(frozen=True)
class Comparator:
    """Compares what a robot does with its own profiles."""

    robot: Robot
    learned: LearnedController

    def off(self, gait: Gait, target: MotionTarget, sensed: Sensed) -> Float[np.ndarray, "6"] | None:
        """How far each quantity is off its ideal, in the robot's own units: over its height, √(g h) and
        √(g/h), angles in radians. `None` where there is no profile of the gait."""
        cells = self.learned.cells_of(gait)
        if cells is None:
            return None
        out, width = np.empty(len(QUANTITIES)), cells.tables.shape[3]
        room = np.empty(width), np.empty(width)
        grid = cells.way, cells.speeds, cells.turns, cells.tables
        deviations(self.robot.packed, *grid, sensed.row, target.row, *room, out)
        return out / self.units

    @cached_property
    def units(self) -> Float[np.ndarray, "6"]:
        """One of each quantity in its own unit [m, rad, rad, m/s, m/s, rad/s]."""
        height, w0 = self.robot.height, self.robot.natural_frequency
        return np.array([height, 1.0, 1.0, w0 * height, w0 * height, w0])


def coded(off: Float[np.ndarray, "6"], bands: Float[np.ndarray, "6"]) -> Pattern:
    """The pattern of some deviations; both in the robot's own units."""
    return tuple(np.where(np.abs(off) > bands, np.sign(off), 0.0).astype(int).tolist())


def in_mirror(pattern: Pattern) -> Pattern:
    """The pattern of the mirrored robot."""
    return tuple(sign * side for sign, side in zip(pattern, MIRRORED, strict=True))


def sentence(pattern: Pattern) -> str:
    """A pattern in words."""
    said = [WORDS[name][sign > 0] for name, sign in zip(QUANTITIES, pattern, strict=True) if sign]
    return " and ".join(said) or "all is as taught"
