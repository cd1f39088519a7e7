"""A foot's path edited where an obstacle is ahead of its leg: a terrain operator (thesis 5.4.1; row L4)."""

import math
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.gait.kinds import KINDS
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.obstacle import NOTHING, SLOPE, ahead_of
from gaitwright.gait.operators import Operator
from gaitwright.ground.elevation import height_at
from gaitwright.learning.operator_lessons import RAISED, Edit, learned_from
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.perception.elevation_map import lowest_points
from gaitwright.session import Session
from gaitwright.studio.curve_checks import Refusal, Rows
from gaitwright.studio.curve_cycle import CycleCurve
from gaitwright.studio.curve_walk import Walk

FAR = 2.5
"""So far ahead is looked for an obstacle [body lengths], …"""
LOOKS = 0.2
"""… from one of a foot's ways to the next, in strides, …"""
LARGER = 1.1
"""What is learned at an obstacle is for such that are so much larger too: a foot may see it so."""
SHORTEST = 0.5
"""… which are at least so long [body heights]."""


@dataclass(frozen=True)
class Obstacle:
    """What is ahead of a leg."""

    kind: str
    """Of `gait.kinds.KINDS`."""
    size: float
    """[m]; of a slope the tangent of its angle."""
    landing: float = 0.0
    """How much farther the foot is to land [m]."""


def next_ahead(walk: Walk, leg: int, session: Session) -> Obstacle | None:
    """The next thing on the way of a leg that its foot would have to get over, as the gait tells such things
    apart, within `FAR` body lengths of where the foot is; `None`: there is none."""
    sensed, ground = session.measured, session.mind.ground
    robot = walk.robot
    foot = lowest_points(robot, sensed)[leg] + [0.0, 0.0, robot.foot_radius[leg]]
    yaw = heading(rotation(sensed.orientation_wb))
    way = np.array([math.cos(yaw), math.sin(yaw)])
    stride = max(walk.stride, SHORTEST * robot.height)
    slope = None  # a thing to get over comes first: what is seen of it in part may look like a slope
    for far in np.arange(0.0, FAR * robot.body_length, LOOKS * stride):
        origin = foot + np.append(far * way, 0.0)
        known = float(height_at(ground.footholds, *origin[:2]))
        origin[2] = known + robot.foot_radius[leg]
        to = origin[:2] + stride * way
        kind, size = ahead_of(ground.footholds, origin, *to, robot.foot_radius[leg], robot.height)
        if kind != NOTHING:
            obstacle = Obstacle(KINDS[kind], min(LARGER * float(size), robot.height))
            if kind != SLOPE:
                return obstacle
            slope = slope or obstacle
    return slope


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
