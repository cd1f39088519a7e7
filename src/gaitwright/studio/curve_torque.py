"""The torques of a leg over its phase as a curve: a profile's, and a smooth change of it (row S4).

What is drawn is the whole torque of each joint, load and all, so that it can be laid beside what was
measured. What a person moves is added to what the leg takes by itself (`ProfileRow.free`): what the feet
carry goes on following from the ground. The change goes smoothly through the points and never beyond them,
and the profile's own table keeps all that nobody touched.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gaitwright.control.learned.profile import BINS, ROW, Profile, as_kept
from gaitwright.model.kinematics import HINGES, angles
from gaitwright.model.leg_motion import all_velocities
from gaitwright.model.robot import Robot
from gaitwright.studio.curve_checks import (
    Refusal,
    Rows,
    beyond_motors,
    fault_in_change,
    fault_in_phases,
    numbers_in,
)
from gaitwright.studio.curve_periodic import through
from gaitwright.studio.curve_walk import Walk

USUAL, FEWEST, MOST = 12, 8, 16
"""Points at first, and how few or many there may be."""
NEAREST = 0.02
"""Two points are at least this far apart in phase."""
SAME = 1e-3
"""A torque that is moved by less [N·m] is not."""
Points = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class TorqueEdit:
    """A profile that a person changed, and by which points."""

    base: Profile
    """As it was before the first change."""
    profile: Profile
    points: dict[int, Points]
    """Of each leg that was changed, by its number."""


@dataclass(frozen=True)
class TorqueCurve:
    """Points (own phase of the leg, torques of hip 1, hip 2, knee [N·m])."""

    walk: Walk
    edit: TorqueEdit
    leg: int

    @property
    def points(self) -> list[list[float]]:
        kept = self.edit.points.get(self.leg)
        if kept is not None:
            return [list(point) for point in kept]
        own = np.arange(USUAL) / USUAL
        return np.column_stack([own, at(own, self.torques(self.edit.profile, "tau", self.leg))]).tolist()

    def line(self) -> list[list[float]]:
        """Own phase and the three torques over a whole cycle."""
        own = np.arange(BINS + 1) / BINS
        return np.column_stack([own, at(own, self.torques(self.edit.profile, "tau", self.leg))]).tolist()

    def limits(self) -> dict[str, Any]:
        """What a point has to keep to."""
        most = self.walk.robot.tau_max[self.leg].tolist()
        return {
            "columns": ["phase", *HINGES],
            "units": ["", "N·m", "N·m", "N·m"],
            "lower": [0.0, *(-limit for limit in most)],
            "upper": [1.0, *most],
            "fewest": FEWEST,
            "most": MOST,
            "nearest": NEAREST,
            "fixed": [],
            "periodic": True,
            "command": list(self.edit.profile.command),
        }

    def torques(self, profile: Profile, field: str, leg: int) -> np.ndarray:
        """Torques of a leg in a profile at even phases of its own `(bins, 3)` [N·m]."""
        columns = columns_of(self.walk.robot, field, leg)
        rows = (np.arange(BINS) / BINS - self.walk.gait.offsets[leg]) % 1.0
        return at(rows, profile.table[:, columns])

    def edited(self, points: Rows, mirror: bool, who: str) -> TorqueEdit | Refusal:
        """The profile with the torques of this leg through other points; with `mirror` those of all legs,
        each in its own phase, turned as the leg is."""
        rows = numbers_in(points, 4, FEWEST, MOST)
        if isinstance(rows, Refusal):
            return rows
        wrong = fault_in_phases(rows[:, 0], NEAREST) or beyond_motors(self.walk.robot, self.leg, rows)
        if wrong:
            return wrong
        off = rows[:, 1:] - at(rows[:, 0], self.torques(self.edit.base, "tau", self.leg))
        off[np.abs(off) < SAME] = 0.0
        change = through(rows[:, 0], off, np.arange(BINS) / BINS)
        table, kept = self.edit.profile.table.copy(), dict(self.edit.points)
        for leg in range(self.walk.robot.n) if mirror else (self.leg,):
            turned = turns(self.walk.robot, self.leg, leg) * change
            taught = [self.torques(self.edit.base, field, leg) for field in ("tau", "free")]
            wrong = fault_in_change(self.walk.robot, leg, rows[:, 0], turned, taught)
            if wrong:
                return wrong
            own = self.walk.own(np.arange(BINS) / BINS, leg)
            for field in ("tau", "free"):
                columns = columns_of(self.walk.robot, field, leg)
                table[:, columns] = self.edit.base.table[:, columns] + at(own, turned)
            kept[leg] = self.kept_points(rows, off, leg)
        table = as_kept(table)
        if np.array_equal(table, self.edit.profile.table):
            return Refusal(f"no torque of {self.walk.skill} was changed")
        said = self.said(table, who)
        return TorqueEdit(self.edit.base, replace(self.edit.profile, table=table, edited=said), kept)

    def kept_points(self, rows: np.ndarray, off: np.ndarray, leg: int) -> Points:
        """The points of a leg, as they are shown from now on."""
        if leg == self.leg:
            return tuple(tuple(row) for row in rows.tolist())
        own = at(rows[:, 0], self.torques(self.edit.base, "tau", leg))
        moved = own + turns(self.walk.robot, self.leg, leg) * off
        return tuple(tuple(row) for row in np.column_stack([rows[:, 0], moved]).tolist())

    def said(self, table: np.ndarray, who: str) -> str:
        """What was changed in all, and by whom; nothing where the table is as it was."""
        columns = ROW.slices(self.walk.robot.n)["tau"]
        change = table[:, columns] - self.edit.base.table[:, columns]
        row, column = np.unravel_index(int(np.abs(change).argmax()), change.shape)
        leg, joint = self.walk.robot.legs[column // 3], HINGES[column % 3]
        most = f"up to {change[row, column]:+.2f} N·m at {leg} {joint}, phase {row / BINS:.2f}"
        return f"{most}, by {who} in the studio"


def columns_of(robot: Robot, field: str, leg: int) -> slice:
    """The columns of a profile's table that a leg has of a field."""
    start = ROW.slices(robot.n)[field].start
    return slice(start + 3 * leg, start + 3 * leg + 3)


def at(phases: np.ndarray, table: np.ndarray) -> np.ndarray:
    """Rows of a periodic table, straight between them, as the controller reads it."""
    place = np.mod(phases, 1.0) * len(table)
    low = np.floor(place).astype(int) % len(table)
    share = (place - np.floor(place))[:, None]
    return (1.0 - share) * table[low] + share * table[(low + 1) % len(table)]


def turns(robot: Robot, leg: int, other: int) -> np.ndarray:
    """For each joint 1, or −1 where a positive torque moves the foot of another leg the other way; a leg on
    the other side is seen in a mirror."""
    q, _ = angles(robot, robot.nominal_feet)
    side = np.sign(robot.nominal_feet[leg, 1]) * np.sign(robot.nominal_feet[other, 1])
    seen = np.array([1.0, -1.0 if side < 0.0 else 1.0, 1.0])
    out = np.ones(3)
    for joint in range(3):
        rate = np.zeros(q.shape)
        rate[:, joint] = 1.0
        moved = all_velocities(robot.arrays, q, rate)
        out[joint] = -1.0 if (seen * moved[leg]) @ moved[other] < 0.0 else 1.0
    return out
