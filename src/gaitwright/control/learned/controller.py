"""MotionTarget + Sensed → MotorCommand by torque profiles that were taught: the LC (rows L3, L9)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.cells import Cells, row_at
from gaitwright.control.learned.contact_maps import contact_maps
from gaitwright.control.learned.law import LAYOUT, play
from gaitwright.control.learned.profile import Profile
from gaitwright.control.learned.warp import can_be_warped, warped
from gaitwright.control.numerical import NumericalController
from gaitwright.control.unmet_acceleration import lumped
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Row
from gaitwright.signals import Gait, MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now

command_of = MotionTarget.layout.field("command")
phase_of = MotionTarget.layout.field("phase")
operator_of = MotionTarget.layout.field("operator")
SAME_PERIOD = 1e-9
"""[s]"""
SPEED_ROOM, TURN_ROOM = 0.04, 0.03
"""A velocity is covered so far beyond what was taught, over √(g h) and √(g/h)."""


@kernel
def is_beyond(asked):
    """Whether a leg of a `MotionTarget` has an obstacle ahead that no terrain operator is for."""
    return operator_of(asked).min() < 0.0


@kernel
def tick(packed, inertia, maps, way, speeds, turns, tables, seen, asked, taught, out):
    """One tick: writes the taught row, and what is played of it."""
    row_at(way, speeds, turns, tables, command_of(asked), phase_of(asked), taught)
    play(packed, inertia, maps, taught, seen, asked, out)


@dataclass(frozen=True)
class LearnedController:
    """Plays the profile of the gait in use; where there is none, the teacher drives."""

    robot: Robot
    profiles: Mapping[str, Sequence[Profile]]
    """By the skill."""
    teacher: NumericalController
    paced: dict[Gait, Cells | None] = field(default_factory=dict, init=False, repr=False, compare=False)
    """Profiles at other paces worked out so far: each is a function of its gait."""

    def __post_init__(self) -> None:
        """Raises `WrongUse` for the profiles of a robot with other legs."""
        for skill, cells in self.profiles.items():
            if any(len(profile.gait.offsets) != self.robot.n for profile in cells):
                raise WrongUse(
                    f"the profiles of {skill} are of a robot with other legs than {self.robot.name}"
                )

    def command(
        self,
        target: MotionTarget,
        sensed: Sensed,
        memory: Row | None = None,
        call: Now = None,
        ground: Map = None,
    ) -> tuple[MotorCommand, Row]:
        """Joint torques [N·m] for this tick, and its `Played`."""
        assert call is not None, "a profile belongs to a gait"
        cells = self.cells_of(call.gait)
        if cells is None:
            command, _ = self.teacher.command(target, sensed, None, call, ground)
            return command, self.blank
        out, taught = np.empty(self.blank.size), np.empty(cells.tables.shape[3])
        tick(
            self.robot.packed,
            self.inertia,
            self.maps,
            cells.way,
            cells.speeds,
            cells.turns,
            cells.tables,
            sensed.row,
            target.row,
            taught,
            out,
        )
        return MotorCommand.of_row(out[self.where]), out

    def covers(self, gait: Gait, target: MotionTarget) -> bool:
        """Whether there are profiles of a gait around the velocity that is asked for, and an operator for
        each obstacle that a leg must be raised over, where there are operators at all."""
        cells = self.cells_of(gait)
        if cells is None or is_beyond(target.row):
            return False
        forward, left, turn = target.command.tolist()
        return cells.covers(forward, left, turn, *self.room)

    def cells_of(self, gait: Gait) -> Cells | None:
        """The profiles of a gait, at its own pace; `None` where there are none."""
        cells = self.cells.get(gait.name)
        if cells is None or abs(gait.period - cells.period) < SAME_PERIOD:
            return cells
        if gait not in self.paced:
            ratio = gait.period / cells.period
            profiles = self.profiles[gait.name]
            can = can_be_warped(ratio)
            self.paced[gait] = Cells.of([warped(self.robot, p, ratio) for p in profiles]) if can else None
        return self.paced[gait]

    @cached_property
    def room(self) -> tuple[float, float]:
        """So far beyond what was taught a velocity is covered [m/s, rad/s]."""
        h, w0 = self.robot.height, self.robot.natural_frequency
        return SPEED_ROOM * w0 * h, TURN_ROOM * w0

    @cached_property
    def cells(self) -> dict[str, Cells]:
        return {skill: Cells.of(profiles) for skill, profiles in self.profiles.items() if profiles}

    @cached_property
    def maps(self) -> Float[np.ndarray, "sets forces 6"]:
        return contact_maps(self.robot)

    @cached_property
    def inertia(self) -> Float[np.ndarray, "3 3"]:
        """Inertia of the whole robot about its centre of mass in the nominal stance, base axes [kg·m²]."""
        q, _ = angles(self.robot, self.robot.nominal_feet)
        return np.array(lumped(self.robot.packed, q)[2])

    @cached_property
    def blank(self) -> Row:
        return np.zeros(LAYOUT.size(self.robot.n))

    @cached_property
    def where(self) -> slice:
        """Where the row of the command stands in a `Played`."""
        where = LAYOUT.slices(self.robot.n)
        return slice(where["tau"].start, where["residual"].stop)
