"""Programmes and a person's commands as files (V6); the numbers as in `missions`.

```csv
x,y,speed,wait
2,0,0.4,
2,1.5,,2
```
A stop: world x, y [m], speed on the way there [m/s], how long the robot waits there [s].

```csv
time,forward,left,turn
0,0.4,0,0
3,0.3,0,0.5
5,0,0,0
```
A command: when it begins [s], velocity forward and left [m/s], yaw rate to the left [rad/s]; what is left out
is 0. The last one stops the robot: then all are over. As JSON: `{"stops": [{"x": 2, "y": 0}]}` and
`{"commands": [{"time": 0, "forward": 0.4}, {"time": 5}]}`.
"""

from itertools import pairwise
from pathlib import Path
from typing import Annotated

from msgspec import Meta, Struct

from gaitwright.errors import BadFile, short
from gaitwright.missions import Programme, Steering, Stop, Velocity
from gaitwright.navigation.tables import LARGEST, Kind, Number, read_rows

LONGEST = 3600.0
"""Nobody waits, and no commands go on, longer than this [s]."""
Time = Annotated[float, Meta(ge=0.0, le=LONGEST)]


class StopRow(Struct, frozen=True, forbid_unknown_fields=True):
    """A stop."""

    x: Number
    y: Number
    speed: Annotated[float, Meta(gt=0.0, le=LARGEST)] | None = None
    wait: Time = 0.0


class StopsEntry(Struct, frozen=True, forbid_unknown_fields=True):
    """A route as JSON."""

    stops: list[StopRow]


class CommandRow(Struct, frozen=True, forbid_unknown_fields=True):
    """A command."""

    time: Time
    forward: Number = 0.0
    left: Number = 0.0
    turn: Number = 0.0


class CommandsEntry(Struct, frozen=True, forbid_unknown_fields=True):
    """Commands as JSON."""

    commands: list[CommandRow]


STOPS = Kind("route file", "stops", StopRow, StopsEntry)
COMMANDS = Kind("velocity file", "commands", CommandRow, CommandsEntry)


def load_programme(path: str | Path) -> Programme:
    """The programme in a file. Raises `BadFile` with one sentence."""
    return Programme(tuple(Stop(row.x, row.y, row.speed, row.wait) for row in read_rows(path, STOPS)))


def load_steering(path: str | Path) -> Steering:
    """The commands in a file. Raises `BadFile` with one sentence."""
    asked, rows = f"{COMMANDS.what} {short(str(path))}", read_rows(path, COMMANDS)
    for number, (before, row) in enumerate(pairwise(rows), start=2):
        if row.time <= before.time:
            raise BadFile(f"{asked}, row {number}: it begins at {row.time:g} s, and not after the one before")
    velocities = tuple(Velocity(row.forward, row.left, row.turn) for row in rows)
    if any(velocities[-1]) or len(rows) < 2:
        raise BadFile(f"{asked}: the last of two rows or more ends it, so its forward, left and turn are 0")
    begins = tuple(row.time for row in rows)
    return Steering(begins[:-1], velocities[:-1], ends=begins[-1])
