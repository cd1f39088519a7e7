"""MotionTarget + Sensed → MotorCommand by torque profiles that were taught: the LC (rows L3, L9)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.contact_maps import contact_maps
from gaitwright.control.learned.law import LAYOUT, play
from gaitwright.control.learned.profile import Profile
from gaitwright.control.numerical import NumericalController
from gaitwright.control.programmed import played
from gaitwright.control.unmet_acceleration import lumped
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Row
from gaitwright.signals import MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now


@dataclass(frozen=True)
class Cells:
    """The profiles of one skill, in the order of the one velocity in which they differ most."""

    axis: int
    """Which part of the command that is: forward, left or yaw rate."""
    places: Float[np.ndarray, " cells"]
    tables: Float[np.ndarray, "cells bins width"]

    @classmethod
    def of(cls, profiles: Sequence[Profile]) -> "Cells":
        commands = np.array([profile.command for profile in profiles])
        axis = int(np.argmax(np.ptp(commands, axis=0)))
        order = np.argsort(commands[:, axis], kind="stable")
        tables = np.array([profiles[k].table for k in order])
        return cls(axis, commands[order, axis], tables)


@kernel
def blended(places, tables, asked, phase):
    """The row at a phase, straight between the two cells next to what is asked for, or the outermost one."""
    last = places.size - 1
    if asked <= places[0] or last == 0:
        return played(tables[0], phase)
    if asked >= places[last]:
        return played(tables[last], phase)
    k = 0
    while places[k + 1] < asked:
        k += 1
    share = (asked - places[k]) / (places[k + 1] - places[k])
    return (1.0 - share) * played(tables[k], phase) + share * played(tables[k + 1], phase)


@kernel
def tick(packed, inertia, maps, places, tables, speed, phase, seen, asked, out):
    """One tick: the taught row, and what is played of it."""
    play(packed, inertia, maps, blended(places, tables, speed, phase), seen, asked, out)


@dataclass(frozen=True)
class LearnedController:
    """Plays the profile of the gait in use; where there is none, the teacher drives."""

    robot: Robot
    profiles: Mapping[str, Sequence[Profile]]
    """By the skill."""
    teacher: NumericalController

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
        cells = self.cells.get(call.gait.name)
        if cells is None:
            command, _ = self.teacher.command(target, sensed, None, call, ground)
            return command, self.blank
        out, speed = np.empty(self.blank.size), float(target.command[cells.axis])
        tick(
            self.robot.packed,
            self.inertia,
            self.maps,
            cells.places,
            cells.tables,
            speed,
            target.phase,
            sensed.row,
            target.row,
            out,
        )
        return MotorCommand.of_row(out[self.where]), out

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
