"""The learned controller with parts of its law left out, by rows that are altered before they are played.

What is regulated is what differs from the errors in the row. A row that holds the errors of this very moment
leaves that part of the regulation nothing to do, so the law itself has no switches.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gaitwright.control.learned.cells import row_at
from gaitwright.control.learned.controller import LearnedController, command_of, phase_of
from gaitwright.control.learned.law import ground_frame, note, play
from gaitwright.control.learned.profile import ROW, row_of
from gaitwright.control.moments import moment_between
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.numerics.packing import Row
from gaitwright.signals import MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now


class LeftOut(NamedTuple):
    """What is left out."""

    forces: bool = False
    """The taught forces of the feet."""
    free: bool = False
    """The taught torque without them."""
    errors: bool = False
    """The errors that the teacher had herself."""
    stance: bool = False
    """What pulls the joints of legs that are down, …"""
    swing: bool = False
    """… and of legs in the air."""
    linear: bool = False
    """What brings the body back to its place and velocity, …"""
    angular: bool = False
    """… and to its attitude and turn."""
    slope: bool = False
    """The weight along a slope."""


@kernel
def leave_out(packed, seen, asked, left_out, now, row):
    """Alters the row of a `ProfileRow` for one tick; `now`: room for another one."""
    n = row_of(row).stance.size
    nothing = np.zeros((n, 3))
    note(packed, seen, asked, nothing, nothing, now)
    moment, taught, present = moment_between(seen, asked), row_of(row), row_of(now)
    if left_out.forces:
        taught.force[:] = 0.0
    if left_out.free:
        taught.free[:] = 0.0
    if left_out.errors:
        taught.lag[:], taught.lag_rate[:], taught.feedback[:] = 0.0, 0.0, 0.0
    for k in range(n):
        if left_out.stance if moment.stance[k] else left_out.swing:
            taught.lag[k], taught.lag_rate[k] = present.lag[k], present.lag_rate[k]
    if left_out.linear:
        taught.feedback[:3] = present.feedback[:3]
    if left_out.angular:
        taught.feedback[3:] = present.feedback[3:]
    if left_out.slope:
        G = ground_frame(moment, rotation(moment.orientation))
        for i in range(3):
            taught.feedback[i] += GRAVITY * (G[2, i] - (1.0 if i == 2 else 0.0))


@kernel
def tick_without(  # noqa: PLR0913 - a kernel
    packed, inertia, maps, way, speeds, turns, tables, seen, asked, left_out, now, row, out
):
    """One tick as `controller.tick` makes it, of an altered row."""
    row_at(way, speeds, turns, tables, command_of(asked), phase_of(asked), row)
    leave_out(packed, seen, asked, left_out, now, row)
    play(packed, inertia, maps, row, seen, asked, out)


@dataclass(frozen=True)
class PlayedWithout:
    """Plays profiles without some parts."""

    learned: LearnedController
    left_out: LeftOut

    def command(
        self,
        target: MotionTarget,
        sensed: Sensed,
        memory: Row | None = None,
        call: Now = None,
        ground: Map = None,
    ) -> tuple[MotorCommand, Row]:
        """Joint torques [N·m] for this tick, and its `Played`."""
        assert call is not None
        learned = self.learned
        cells = learned.cells_of(call.gait)
        if cells is None:
            return learned.command(target, sensed, memory, call, ground)
        size = ROW.size(learned.robot.n)
        row, now, out = np.empty(size), np.empty(size), np.empty(learned.blank.size)
        body = learned.robot.packed, learned.inertia, learned.maps
        grid = cells.way, cells.speeds, cells.turns, cells.tables
        tick_without(*body, *grid, sensed.row, target.row, self.left_out, now, row, out)
        return MotorCommand.of_row(out[learned.where]), out
