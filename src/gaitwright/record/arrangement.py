"""Boxes that a person moved while it was recorded → what stood there all the time, and what came and went."""

from collections import Counter
from collections.abc import Iterable

from gaitwright.ground.moving import Mover
from gaitwright.ground.moving_entries import MOST_MOVERS
from gaitwright.ground.terrain import Box

PASSING = 0.2
"""A box that stood somewhere for less than this was on its way [s]."""


class Arrangement:
    """The boxes of a scene over a recording's time [s]."""

    def __init__(self, boxes: Iterable[Box], time: float, most: int = MOST_MOVERS) -> None:
        """`most`: so many may come and go."""
        self.begun, self.most = time, most
        self.standing: list[tuple[Box, float]] = [(box, time) for box in boxes]
        """Those that are there, and since when."""
        self.gone: list[Mover] = []

    def rearranged(self, boxes: Iterable[Box], time: float) -> None:
        """From a time on these are there."""
        wanted, passed = Counter(boxes), time
        kept: list[tuple[Box, float]] = []
        for box, since in self.standing:
            if wanted[box] > 0:
                wanted[box] -= 1
                kept.append((box, since))
            elif self.begun < since > time - PASSING:
                passed = since  # it was dragged on: the next place counts from when it came here
            elif since < time:
                self.gone.append(Mover(box, appears=since, vanishes=time))
        self.standing = [*kept, *((box, passed) for box in wanted.elements())]

    @property
    def still(self) -> tuple[Box, ...]:
        """Those that stood there from the beginning to the end."""
        return tuple(box for box, since in self.standing if since == self.begun)

    @property
    def movers(self) -> tuple[Mover, ...]:
        """Those that came or went; what went first is left out where there are too many."""
        came = [Mover(box, appears=since) for box, since in self.standing if since > self.begun]
        came = came[max(0, len(came) - self.most) :]
        left = min(self.most - len(came), len(self.gone))
        return (*self.gone[len(self.gone) - left :], *came)
