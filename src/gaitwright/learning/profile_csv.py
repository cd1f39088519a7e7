"""A torque profile as a table that a person reads and edits: 32 rows, CSV (row L3).

What is edited are the torques that a leg takes by itself; forces on the feet follow from the ground. Only
what differs from the table that was written out is taken over, straight between the rows, so that the 128
rows of the profile keep what nobody touched.
"""

import csv
import io
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.profile import BINS, ROW, Profile, as_kept
from gaitwright.errors import BadFile, WrongUse
from gaitwright.model.robot import Robot
from gaitwright.plant.names import JOINTS

ROWS = 32
"""Rows of the table: enough to walk by, and few enough to edit by hand."""
LEAP = 0.25
"""An edit may change from one row to the next by this share of the torque limit at most."""
DECIMALS = 3
Torques = Float[np.ndarray, "rows torques"]


def heads(robot: Robot) -> list[str]:
    """What the columns are: phase, then leg by leg stance, torques, angles and forces."""
    columns = ["phase"]
    for leg in robot.legs:
        columns.append(f"{leg} stance")
        columns += [f"{leg} {joint} torque [N·m]" for joint in JOINTS]
        columns += [f"{leg} {joint} angle [rad]" for joint in JOINTS]
        columns += [f"{leg} force {axis} [N]" for axis in "xyz"]
    return columns


def written(robot: Robot, profile: Profile) -> str:
    """The table as text: which profile in the first line, what is what in the second."""
    step, where = BINS // ROWS, ROW.slices(robot.n)
    stance, free, q, force = (profile.table[::step, where[name]] for name in ("stance", "free", "q", "force"))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["profile", profile.skill, *(f"{part:.6f}" for part in profile.command)])
    writer.writerow(heads(robot))
    for row in range(ROWS):
        numbers = [row / ROWS]
        for k in range(robot.n):
            part = slice(3 * k, 3 * k + 3)
            numbers += [stance[row, k], *free[row, part], *q[row, part], *force[row, part]]
        writer.writerow([f"{x + 0.0:.{DECIMALS}f}" if i else f"{x:.5f}" for i, x in enumerate(numbers)])
    return out.getvalue()


def asked_in(content: str, source: str) -> tuple[str, tuple[float, float, float]]:
    """Which profile a table is of: the skill and the velocity. Raises `BadFile`."""
    first = next(csv.reader(io.StringIO(content)), [])
    if len(first) != 5 or first[0] != "profile":
        raise BadFile(f"{source} is no profile: its first line is 'profile', a skill and three numbers")
    forward, left, turn = numbers_in(first[2:], source, 1)
    return first[1], (forward, left, turn)


def edited(robot: Robot, profile: Profile, content: str, source: str) -> Profile:
    """The profile with what a person changed in its table.

    Raises `BadFile` for a table that is none, and `WrongUse` naming the place where a torque leaps or is
    beyond the motor's, or where nothing was changed.
    """
    change = torques_in(robot, content, source) - torques_in(robot, written(robot, profile), source)
    if not change.any():
        raise WrongUse(f"{source} changes no torque of {profile.skill}")
    check(robot, profile, change, source)
    phase, at = np.arange(BINS) / BINS, np.arange(ROWS + 1) / ROWS
    around = np.vstack([change, change[:1]])
    smooth = np.stack([np.interp(phase, at, column) for column in around.T], axis=1)
    table, where = profile.table.copy(), ROW.slices(robot.n)
    for name in ("free", "tau"):
        table[:, where[name]] += smooth
    row, column = np.unravel_index(int(np.abs(change).argmax()), change.shape)
    most = float(change[row, column])
    leg, joint = robot.legs[column // 3], JOINTS[column % 3]
    said = f"up to {most:+.2f} N·m at {leg} {joint}, phase {row / ROWS:.2f}"
    return replace(profile, table=as_kept(table), edited=said)


def torques_in(robot: Robot, content: str, source: str) -> Torques:
    """The torques in a table. Raises `BadFile` naming the line that is wrong."""
    lines = [line for line in csv.reader(io.StringIO(content)) if line]
    wanted = heads(robot)
    if len(lines) != 2 + ROWS or lines[1] != wanted:
        raise BadFile(f"{source} has not the {ROWS} rows and the columns of a profile of {robot.name}")
    places = [k for k, head in enumerate(wanted) if "torque" in head]
    rows = [numbers_in(line, source, count, len(wanted)) for count, line in enumerate(lines[2:], start=3)]
    return np.array(rows)[:, places]


def numbers_in(line: Sequence[str], source: str, count: int, wanted: int | None = None) -> list[float]:
    """The numbers of a line. Raises `BadFile`."""
    try:
        numbers = [float(part) for part in line]
    except ValueError as error:
        raise BadFile(f"{source}, line {count}: {error}") from None
    if not np.isfinite(numbers).all() or (wanted is not None and len(numbers) != wanted):
        raise BadFile(f"{source}, line {count}: {wanted or 3} finite numbers are wanted")
    return numbers


def check(robot: Robot, profile: Profile, change: Torques, source: str) -> None:
    """Raises `WrongUse` for an edit that asks a motor for more than it has, or that leaps."""
    limit = robot.tau_max.ravel()
    leaps = np.abs(np.diff(np.vstack([change, change[:1]]), axis=0)) - LEAP * limit
    step = BINS // ROWS
    beyond = np.abs(profile.table[::step, ROW.slices(robot.n)["free"]] + change) - limit
    for off, what in ((beyond, "is beyond what the motor has"), (leaps, "leaps to the next row")):
        if off.max() > 0.0:
            row, column = np.unravel_index(int(off.argmax()), off.shape)
            leg, joint = robot.legs[column // 3], JOINTS[column % 3]
            raise WrongUse(
                f"{source}, phase {row / ROWS:.3f}: the torque of {leg} {joint} {what} "
                f"({limit[column]:.1f} N·m; a change of up to {LEAP:.0%} of it from row to row is taken)"
            )
