"""Strides of a foot over the ground: what was in the way, how high the foot went over it, and in which order
it went up, forward and down (thesis 5.4.1, figures 5.2 and 5.3)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.ground.terrain import Surface
from gaitwright.record.metrics import stretches
from gaitwright.reproduce.seen_walk import FootPaths

LEAST = 0.01
"""A foot that rises by less makes no stride [m]."""
MIDDLE = (0.15, 0.85)
"""Part of a stride in which a foot that feels something has hit it."""
UP = 0.9
"""A foot is up as long as it has this share of its greatest height over where it lands."""
FEWEST = 6
"""Moments that a stride has at least."""
BREAK = 0.02
"""Ground that rises or drops by more than this from moment to moment has an edge there [m]."""
OVER, ONTO, OFF, ALONG = "over", "onto", "off", "along"
"""What a stride does: over something between its ends, onto something, down from it, or along the ground."""


@dataclass(frozen=True, eq=False)
class Stride:
    """A foot from where it leaves the ground to where it stands again."""

    leg: int
    x: Float[np.ndarray, " n"]
    """Along the way [m]."""
    z: Float[np.ndarray, " n"]
    """Of its lowest point [m]."""
    ground: Float[np.ndarray, " n"]
    """True height of the ground straight below [m]."""
    raised: bool = False
    """Whether a terrain operator raised it."""
    hit: bool = False
    """Whether it hit something on its way."""

    @property
    def does(self) -> str:
        """`OVER`, `ONTO`, `OFF` or `ALONG`."""
        leaps = np.diff(self.ground)
        rises, drops = leaps.max() > BREAK, leaps.min() < -BREAK
        return OVER if rises and drops else ONTO if rises else OFF if drops else ALONG

    @property
    def is_usual(self) -> bool:
        """Whether nothing was in its way, nor taken for it."""
        return self.does == ALONG and not self.raised

    @property
    def height(self) -> float:
        """How high the foot rises over where it left the ground [m]."""
        return float(self.z.max() - self.z[0])

    @property
    def room(self) -> float:
        """Height of the foot over what it goes over or onto, as it comes over the edge of it [m]; NaN: there
        is none."""
        edges = np.flatnonzero(np.diff(self.ground) > BREAK)
        return float(self.z[edges[0] + 1] - self.ground.max()) if len(edges) else float("nan")

    @property
    def corners(self) -> tuple[int, int]:
        """The moments B, at which the foot is above all that is in its way, and C, at which it begins to come
        down."""
        free = np.flatnonzero(self.z > self.ground.max())
        up = np.flatnonzero(self.z >= self.z[-1] + UP * (self.z.max() - self.z[-1]))
        return int(free[0]) if len(free) else int(self.z.argmax()), int(up[-1])

    @property
    def forward(self) -> tuple[float, float]:
        """Shares of the way forward that are done at B and at C."""
        way = self.x[-1] - self.x[0]
        b, c = ((self.x[k] - self.x[0]) / way if way else 0.0 for k in self.corners)
        return float(b), float(c)


def strides_of(feet: FootPaths, ground: Surface, legs: Sequence[int]) -> list[Stride]:
    """The strides of some legs over a true ground, in the order of the legs and of time."""
    return [stride for leg in legs for stride in strides_of_leg(feet, ground, leg)]


def strides_of_leg(feet: FootPaths, ground: Surface, leg: int) -> Iterator[Stride]:
    """The strides of a leg that were made from beginning to end."""
    swings = feet.swings[:, leg] > 0.5
    for start, end in stretches(swings):
        if not swings[start] or start == 0 or end == len(swings) or end - start < FEWEST:
            continue
        part = slice(start - 1, end + 1)
        x, y, z = feet.place_w[part, leg].T
        if z.max() - z[0] < LEAST:
            continue
        first, last = (start + round(share * (end - start)) for share in MIDDLE)
        yield Stride(
            leg,
            x,
            z,
            np.asarray(ground.height(x, y), dtype=float),
            bool(feet.raised[part, leg].any()),
            bool(feet.touches[first:last, leg].any()),
        )
