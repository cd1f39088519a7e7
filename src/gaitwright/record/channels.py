"""Lap → row: the channels of a recording, and the numbers of a tick in their order."""

import math
from dataclasses import fields
from itertools import accumulate
from struct import Struct
from typing import Any

import numpy as np

from gaitwright.locomotion import Lap
from gaitwright.signals import MotionTarget, MotorCommand, Route, Scan, Sensed, SkillCall

STATE = (*(column.name for column in Sensed.layout.columns), "tau")
"""The channels that `state_hash` covers."""

ROUTE = {
    "route_next": 2, "route_points": 1, "route_remaining": 1, "route_speed": 1, "route_arrived": 1,
    "route_directions": 2,
}  # fmt: skip
"""Next point of the path, how many are left, the way left [m], the speed wished for, 1 at the goal, and the
directions in which the way begins and ends [rad]; NaN where there is none."""
SCAN = tuple(f"scan_{field.name}" for field in fields(Scan))
"""The ground ahead, a channel for each field of `Scan`; NaN where nobody looked."""
MEMORY, MOST_MEMORIES = "memory", 10_000
"""The channel that says which of its working memories a robot had after its choice, of so many at most; NaN
where that was not told."""
OPERATOR, REACH = "operator", "reach"
"""Which terrain operator each leg was under, as in a `MotionTarget`, and how much of an obstacle it answered
[m]."""
SITUATION = (*ROUTE, *SCAN, MEMORY, OPERATOR, REACH)
"""The channels that older recordings lack, and the only ones in which a number need not be finite."""
Held = tuple[tuple[str, str | float], ...]
"""A working memory: its facts with their names, in the order of these."""


def widths(legs: int) -> dict[str, int]:
    """The channels of a recording and how many numbers each has; those of the situation last."""
    return {
        **{name: where.stop - where.start for name, where in Sensed.layout.slices(legs).items()},
        **{name: where.stop - where.start for name, where in MotorCommand.layout.slices(legs).items()},
        "phase": 1,
        "stance": legs,
        "target_w": 3,
        "command": 3,
        "skill": 1,
        "driver": 1,
        "period": 1,
        "took": 2,
        **ROUTE,
        **dict.fromkeys(SCAN, 1),
        MEMORY: 1,
        OPERATOR: legs,
        REACH: legs,
    }


def shapes(legs: int) -> dict[str, tuple[int, ...]]:
    """The channels of a recording and the shape of each in a row of its file."""
    return {name: (width,) if width > 1 else () for name, width in widths(legs).items()}


def columns_of(legs: int) -> dict[str, slice]:
    """The columns of a row that each channel has."""
    channels = widths(legs)
    ends = list(accumulate(channels.values()))
    return {name: slice(end - channels[name], end) for name, end in zip(channels, ends, strict=True)}


def always(legs: int) -> int:
    """How many numbers come before those of the situation."""
    return sum(width for name, width in widths(legs).items() if name not in SITUATION)


class Packer:
    """Packs laps into the bytes of float64: a third of the time that joining arrays takes.

    Bytes know no type: whether the arrays of a plant are contiguous float64 is looked at in the first lap,
    and where they are not, those of every lap are converted.
    """

    def __init__(self, legs: int) -> None:
        self.size = 8 * sum(widths(legs).values())
        self.skills: dict[str, int] = {}
        self.drivers: dict[str, int] = {}
        self.memories: dict[Held, int] = {}
        self.plain: bool | None = None
        self.route: Route | None = None
        self.situation = b""
        self.call: SkillCall | None = None
        self.numbers, self.memory = (0, 0), b""
        where = MotionTarget.layout.slices(legs)
        self.feet = slice(where["phase"].start, where["stance"].stop)
        self.place, self.command = where["position_w"], where["command"]
        self.operators = slice(where[OPERATOR].start, where[REACH].stop)

    def row(self, lap: Lap) -> bytes:
        """The numbers of a lap, in the order of `widths`."""
        target, call = lap.target.row, lap.call
        if lap.route is not self.route:
            self.route, self.situation = lap.route, SITUATION_OF(*situation_numbers(lap.route))
        if call is not self.call:
            skill = self.skills.setdefault(call.skill, len(self.skills))
            self.call, self.numbers = call, (skill, self.drivers.setdefault(call.driver, len(self.drivers)))
            self.memory = ONE(self.memory_of(call))
        pieces: tuple[Any, ...] = (
            lap.sensed.row,
            lap.command.row,
            target[self.feet],
            target[self.place],
            target[self.command],
            FIVE(*self.numbers, call.gait.period, *lap.took),
            self.situation,
            self.memory,
            target[self.operators],
        )
        if self.plain is None:
            self.plain = all(is_plain(piece) for piece in pieces)
        row = b"".join(pieces if self.plain else map(converted, pieces))
        assert len(row) == self.size, f"a row of {len(row)} bytes, not {self.size}: an array of another shape"
        return row

    def memory_of(self, call: SkillCall) -> float:
        """The number of what a robot remembers; NaN where it has remembered too much to tell."""
        held = tuple(sorted(call.memory.items()))
        if len(self.memories) >= MOST_MEMORIES and held not in self.memories:
            return math.nan
        return float(self.memories.setdefault(held, len(self.memories)))


def situation_numbers(route: Route) -> tuple[float, ...]:
    """The numbers of a route, in the order of `SITUATION`."""
    x, y = route.path[0] if route.path else (math.nan, math.nan)
    speed = math.nan if route.speed is None else route.speed
    scan = [math.nan if route.ahead is None else getattr(route.ahead, field.name) for field in fields(Scan)]
    left = (float(len(route.path)), route.remaining, speed, float(route.arrived))
    ways = (math.nan if way is None else way for way in (route.begins, route.ends))
    return x, y, *left, *ways, *map(float, scan)


def doubles(number: int):
    """So many numbers → bytes."""
    return Struct(f"{number}d").pack


ONE, FIVE = doubles(1), doubles(5)
SITUATION_OF = doubles(sum(ROUTE.values()) + len(SCAN))


def is_plain(piece: bytes | np.ndarray) -> bool:
    """Whether these bytes are those of float64, in order."""
    return isinstance(piece, bytes) or (piece.dtype == np.float64 and piece.flags.c_contiguous)


def converted(piece: bytes | np.ndarray) -> bytes:
    """The bytes of float64, in order."""
    return piece if isinstance(piece, bytes) else np.asarray(piece, dtype=np.float64).tobytes()
