"""SkillCall + Sensed → MotionTarget → MotorCommand in one compiled call, where profiles are played.

The same kernels as `Coordinator.move` and `LearnedController.command`, and the same numbers to the bit: what
is saved is a crossing from Python, the values in between, and joint angles that nobody reads.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.cells import is_among
from gaitwright.control.learned.controller import LearnedController, command_of, is_beyond, tick
from gaitwright.control.learned.law import LAYOUT
from gaitwright.gait.coordinator import Coordinator, lead
from gaitwright.gait.led import Led
from gaitwright.gait.leg_cycles.leg_cycle import BINS as SHARES
from gaitwright.gait.reference import BINS
from gaitwright.gait.state import LAYOUT as GAIT
from gaitwright.gait.state import GaitMemory
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Layout, Row
from gaitwright.numerics.parts import part
from gaitwright.signals import Gait, GroundMap, MotionTarget, MotorCommand, Sensed, SkillCall

TARGET, PLAYED = MotionTarget.layout.length, LAYOUT.length
UNREAD = ()
"""Of a gait that was not met before."""


class Settings(NamedTuple):
    """What the kernel reads of a robot in a gait, but for the profiles: one row, since each array costs."""

    height: float
    stand: float
    """Of the base over the ground and over the foot centres [m]."""
    threshold: float
    """Load of a foot in contact [N]."""
    dt: float
    """Control period [s]."""
    period: float
    duty: float
    """Of the gait: [s] and share."""
    speed_room: float
    turn_room: float
    """So far beyond what was taught a velocity is covered [m/s, rad/s]."""
    way: Float[np.ndarray, "2"]
    """Where the skill goes: unit vector, forward and left."""
    inertia: Float[np.ndarray, "3 3"]
    """Of the whole robot [kg·m²]."""
    table: Float[np.ndarray, "bins 9"]
    """The periodic reference of the gait."""
    offsets: Float[np.ndarray, "legs"]
    imagined: Float[np.ndarray, "legs"]
    """Obstacles that legs take for seen [m]."""
    leans: Float[np.ndarray, "legs 2"]
    cycles: Float[np.ndarray, "legs samples 6"]
    """The leg cycles."""


SETTINGS = Layout.of(Settings, bins=BINS, samples=SHARES + 1)
settings_in = SETTINGS.views(Settings)


@kernel
def lead_and_play(
    numbers, settings, maps, terms, over, speeds, turns, tables, known, place, heights, edges, rise,
    friction, asked, seen, before, out,
):  # fmt: skip
    """One tick: writes the rows of the gait's memory, a `MotionTarget` and a `Played`, one after the other.

    `numbers`: the packed robot; `settings`: the row of its `Settings`; `before`: the gait's memory so far;
    the others as in `gait.coordinator.lead` and the learned controller's `tick`. Returns whether the learned
    controller covers it.
    """
    s = settings_in(settings)
    (a, b), (c, d), n = TARGET, PLAYED, s.offsets.size
    first, second, third = before.size, a + b * n, c + d * n
    memory, target = part(out, 0, (first,)), part(out, first, (second,))
    played = part(out, first + second, (third,))
    memory[:] = before
    target[:] = np.nan
    lead(
        numbers, s.height, s.stand, s.threshold, s.table, (s.period, s.duty), s.offsets, s.cycles, terms,
        over, s.imagined, s.leans, place, heights, edges, rise, friction, asked, seen, s.dt, memory, target,
    )  # fmt: skip
    taught = np.empty(tables.shape[3])
    tick(numbers, s.inertia, maps, s.way, speeds, turns, tables, seen, target, taught, played)
    if is_beyond(target):
        return False
    return is_among(s.way, speeds, turns, known, command_of(target), s.speed_room, s.turn_room)


Tick = tuple[Led, GaitMemory, MotorCommand, Row, bool]
"""What coordinator and learned controller hand back, and whether the latter covers the velocity asked for."""


@dataclass(frozen=True)
class OneCall:
    """A coordinator and a learned controller of one robot."""

    coordinator: Coordinator
    learned: LearnedController
    known: dict[Gait, tuple[Any, ...] | None] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """What the kernel reads of each gait so far; `None` where the teacher drives it."""

    def tick(
        self, memory: GaitMemory, call: SkillCall, sensed: Sensed, ground: GroundMap | None
    ) -> Tick | None:
        """One tick; `None` where there is no profile of the gait that the legs would be in."""
        coordinator = self.coordinator
        gait = coordinator.possible(memory, call, sensed)
        taught = self.known.get(gait, UNREAD)
        if taught is UNREAD:
            taught = self.read(gait)
        if taught is None:
            return None
        (first, second, third, size), (grid, rise, friction) = self.places, coordinator.underfoot(ground)
        out, velocity = np.empty(size), call.velocity
        asked = (velocity[0], velocity[1], call.turn)
        is_known = lead_and_play(*taught, *grid, rise, friction, asked, sensed.row, memory.row, out)
        return (
            Led.of_row(out[first:second], robot=coordinator.robot),
            GaitMemory(out[:first], gait),
            MotorCommand.of_row(out[second:third]),
            out[second:],
            is_known,
        )

    def read(self, gait: Gait) -> tuple[Any, ...] | None:
        """What the kernel reads of a robot in a gait: its settings and its profiles."""
        coordinator, learned = self.coordinator, self.learned
        cells, cycle, robot = learned.cells_of(gait), coordinator.cycle(gait), coordinator.robot
        if cells is None:
            self.known[gait] = None
            return None
        settings = Settings(
            robot.height,
            robot.stand,
            coordinator.threshold,
            coordinator.dt,
            *cycle.clock,
            *learned.room,
            cells.way,
            learned.inertia,
            cycle.table,
            cycle.offsets,
            coordinator.imagined_sizes,
            coordinator.leans,
            cycle.legs,
        )
        row, profiles = SETTINGS.pack(settings), (cells.speeds, cells.turns, cells.tables, cells.taught)
        operators = coordinator.operators_packed
        self.known[gait] = taught = (robot.packed, row, learned.maps, *operators, *profiles)
        return taught

    @cached_property
    def places(self) -> tuple[int, int, int, int]:
        """Where the target, what is played, and what follows its command begin, and where all ends."""
        n = self.coordinator.robot.n
        first = GAIT.size(n)
        second = first + self.coordinator.width
        return first, second, second + self.learned.where.stop, second + LAYOUT.size(n)
