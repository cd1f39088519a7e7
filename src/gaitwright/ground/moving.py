"""Things that move while robots walk: where each is at a time, told by its script alone.

A thing goes along straight stretches at one speed and does not turn. World frame, metres, seconds from the
start of a run.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any, final

from gaitwright.ground.solids import Prism
from gaitwright.ground.terrain import Solid

Point = tuple[float, float]


@final
@dataclass(frozen=True)
class Mover:
    """A solid that goes along a way, or is there for a time alone."""

    solid: Solid
    """Where it is before it sets out."""
    along: tuple[Point, ...] = ()
    """Where its centre goes to from there, point by point [m]."""
    speed: float = 0.0
    """[m/s]"""
    begins: float = 0.0
    """When it sets out [s]."""
    loop: bool = False
    """Whether it goes back to where it was and round again; else it stays at its last point."""
    appears: float = 0.0
    """It is not there before [s]."""
    vanishes: float = math.inf
    """Nor from then on [s]."""

    @cached_property
    def path(self) -> tuple[Point, ...]:
        """All points that its centre goes through, the first and, in a loop, the last one where it began."""
        start = self.solid.centre
        return (start, *self.along, start) if self.loop else (start, *self.along)

    @cached_property
    def gone_at(self) -> tuple[float, ...]:
        """How far it has gone at each point of its path [m]."""
        return tuple(accumulate((math.dist(a, b) for a, b in pairwise(self.path)), initial=0.0))

    def is_there(self, time: float) -> bool:
        """Whether it is there at a time [s]."""
        return self.appears <= time < self.vanishes

    def place(self, time: float) -> Point:
        """Where its centre is at a time, were it there [m]."""
        k, gone = self.stretch(time)
        if k is None:
            return self.path[-1] if gone > 0.0 else self.path[0]
        (x0, y0), (x1, y1) = self.path[k], self.path[k + 1]
        share = gone / (self.gone_at[k + 1] - self.gone_at[k])
        return x0 + share * (x1 - x0), y0 + share * (y1 - y0)

    def velocity(self, time: float) -> Point:
        """How it goes from a time on, were it there [m/s]."""
        k, _ = self.stretch(time)
        if k is None:
            return 0.0, 0.0
        (x0, y0), (x1, y1) = self.path[k], self.path[k + 1]
        pace = self.speed / (self.gone_at[k + 1] - self.gone_at[k])
        return pace * (x1 - x0), pace * (y1 - y0)

    def stretch(self, time: float) -> tuple[int | None, float]:
        """The stretch of its path that it is on at a time, and how far [m]; none where it stands, and then
        whether it has gone at all."""
        gone, length = self.speed * (time - self.begins), self.gone_at[-1]
        if gone < 0.0 or length == 0.0:
            return None, 0.0
        if self.loop:
            gone %= length
        elif gone >= length:
            return None, gone
        k = bisect_right(self.gone_at, gone) - 1
        return k, gone - self.gone_at[k]

    def at(self, time: float) -> Solid | None:
        """It where it is at a time [s]; `None` while it is not there."""
        if not self.is_there(time):
            return None
        (x, y), (x0, y0) = self.place(time), self.path[0]
        return moved(self.solid, (x - x0, y - y0))


def moved(solid: Any, by: Point) -> Solid:
    """A solid somewhere else: so far away along x and y [m]."""
    dx, dy = by
    if isinstance(solid, Prism):
        return replace(solid, outline=tuple((x + dx, y + dy) for x, y in solid.outline))
    return replace(solid, x=solid.x + dx, y=solid.y + dy)
