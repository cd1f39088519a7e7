"""The leg cycle of a skill as a curve: the closed path of a foot in side view (thesis 3.2; row S4)."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.gait.leg_cycles.leg_cycle import FEWEST, HIGHEST, MOST, NEAREST, LegCycle, Point, is_hind
from gaitwright.studio.curve_checks import Refusal, Rows, cannot_walk, fault_in_path
from gaitwright.studio.curve_walk import Walk

DRAWN = 96
"""Places of a drawn line."""


@dataclass(frozen=True)
class CycleCurve:
    """Points (share of the swing, forward over the ground [strides], height [body heights]) of front or hind
    legs. Left and right legs always have the same path.

    Raises `WrongUse` for a gait that lifts no foot.
    """

    walk: Walk
    cycle: LegCycle
    leg: int

    def __post_init__(self) -> None:
        if self.walk.gait.duty >= 1.0:
            raise WrongUse(f"{self.walk.skill} lifts no foot: it has no leg cycle")

    @property
    def hind(self) -> bool:
        """Whether the leg goes by the path of the hind legs."""
        return is_hind(self.leg, self.walk.robot.n)

    @property
    def points(self) -> list[list[float]]:
        return [list(point) for point in self.cycle.points_of(self.hind)]

    def line(self) -> list[list[float]]:
        """The closed path as the hip sees it: own phase, forward [strides], height [body heights]."""
        own = np.linspace(0.0, 1.0, DRAWN + 1)
        return np.column_stack([own, self.walk.path(self.cycle, self.leg, own)]).tolist()

    def limits(self) -> dict[str, Any]:
        """What a point has to keep to. Seen from the hip a point is at forward − `drift` · (share − 0.5)."""
        return {
            "columns": ["share", "forward", "height"],
            "units": ["", "strides", "body heights"],
            "lower": [0.0, -0.5, 0.0],
            "upper": [1.0, 0.5, HIGHEST],
            "fewest": FEWEST,
            "most": MOST,
            "nearest": NEAREST,
            "fixed": [1, len(self.points)],
            "periodic": False,
            "drift": 1.0 - self.walk.gait.duty,
            "stride": self.walk.stride,
            "height": self.walk.robot.height,
        }

    def edited(self, points: Rows, mirror: bool) -> LegCycle | Refusal:
        """The cycle with other points of these legs, front or hind; with `mirror` of all of them."""
        wrong = fault_in_path(points, self.walk.skill)
        if wrong:
            return wrong
        new: tuple[Point, ...] = tuple((float(s), float(x), float(z)) for s, x, z in points)
        front, hind = self.cycle.points_of(False), self.cycle.points_of(True)
        front, hind = (new, new) if mirror else (front, new) if self.hind else (new, hind)
        if (front, hind) == (self.cycle.points_of(False), self.cycle.points_of(True)):
            return Refusal(f"no point of {self.walk.skill} was moved")
        about = f"from {self.cycle.name}, edited in the studio"
        cycle = LegCycle(self.walk.skill, front, None if hind == front else hind, about)
        return cannot_walk(self.walk, cycle, self.cycle) or cycle
