"""A foot's path edited where an obstacle is ahead of its leg: a terrain operator (thesis 5.4.1; row L4)."""

from dataclasses import dataclass, replace

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import Operator
from gaitwright.learning.operator_lessons import RAISED, Edit, learned_from
from gaitwright.studio.curve_checks import Refusal, Rows
from gaitwright.studio.curve_cycle import CycleCurve


@dataclass(frozen=True)
class Obstacle:
    """What is ahead of a leg."""

    kind: str
    """Of `gait.kinds.KINDS`."""
    size: float
    """[m]; of a slope the tangent of its angle."""
    landing: float = 0.0
    """How much farther the foot is to land [m]."""


def operator_from(curve: CycleCurve, points: Rows, obstacle: Obstacle, who: str) -> Operator | Refusal:
    """The operator that an edited path teaches, by what it takes in physics on level ground: about a second.

    Refused are a path that the robot cannot walk, one that is lower than the obstacle, and one with which
    it falls. Raises `WrongUse` for a kind or size that there is not.
    """
    walk = curve.walk
    leg = walk.robot.legs[curve.leg]
    asked = Edit(walk.robot, obstacle.size, walk.skill, leg, (obstacle.kind,), landing=obstacle.landing)
    cycle = curve.edited(points, mirror=False)
    if isinstance(cycle, Refusal):
        return cycle
    low = too_low(cycle, curve.hind, walk.robot.height, obstacle)
    if low:
        return low
    try:
        shown = replace(asked, cycle=replace(cycle, name=f"of {who}"))
        return learned_from(shown, f"over a {obstacle.kind}")
    except WrongUse as error:
        return Refusal(str(error))


def too_low(cycle: LegCycle, hind: bool, height: float, obstacle: Obstacle) -> Refusal | None:
    """The highest point, where it is lower than an obstacle that a foot is raised over. `height`: [m]."""
    if obstacle.kind not in RAISED:
        return None
    heights = np.array(cycle.points_of(hind))[:, 2] * height
    highest = int(heights.argmax())
    if heights[highest] > obstacle.size:
        return None
    where = f"point {highest + 1}, the highest, is {heights[highest]:.3f} m over the ground"
    return Refusal(f"{where}; the {obstacle.kind} is {obstacle.size:.3f} m", highest + 1)
