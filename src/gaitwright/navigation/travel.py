"""What a navigator remembers, and what it goes by at a moment."""

import math
from typing import NamedTuple

from gaitwright.missions import Mission, Stop
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.planning import Point
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import Blocked, GroundMap, Sensed, Sight

Travelled = frozenset[tuple[int, int]]
"""Where a trip has been, as cells of a grid."""


class Travel(NamedTuple):
    """What a navigator remembers of a mission, and of the ground."""

    known: LearnedMap
    left: tuple[Point, ...] = ()
    """Way-points that were not reached yet [m]."""
    travelled: Travelled = frozenset()
    sight: Sight | None = None
    """The last one that is in the map."""
    outlines: tuple[object, ...] | None = None
    """Those of known ground that are in the map."""
    blocked: Blocked | None = None
    """What is in the map since feet could not go on over it."""
    mission: Mission = Mission(())
    begun: float = 0.0
    """When it was given [s]."""
    stops: tuple[Stop, ...] = ()
    """Of a programme, those that were not reached yet, and the one where the robot waits."""
    waits_until: float | None = None
    """[s]"""
    trail: tuple[Point, ...] = ()
    """Places that it came along, without loops [m]."""
    aside: tuple[Point, ...] = ()
    """Where it goes first, to have room to turn [m]."""
    cramped: tuple[Point, ...] = ()
    """Places from which it went far aside on its way to the next way-point [m]."""


class Moment(NamedTuple):
    """Where a robot is and what is known there."""

    place: Point
    """Seen from above [m]."""
    yaw: float
    """[rad]"""
    time: float
    """[s]"""
    ground: GroundMap

    @classmethod
    def of(cls, sensed: Sensed, ground: GroundMap) -> "Moment":
        """As it is sensed."""
        x, y, _ = sensed.position_w.tolist()
        return cls((x, y), float(heading(rotation(sensed.orientation_wb))), sensed.time, ground)

    def has_gone_by(self, point: Point, near: float) -> bool:
        """Whether a place lies behind the robot, and so near to it [m]."""
        dx, dy = self.place[0] - point[0], self.place[1] - point[1]
        behind = dx * math.cos(self.yaw) + dy * math.sin(self.yaw)
        return math.dist(self.place, point) < near and behind > 0.0


def found_blocked(travel: Travel, blocked: Blocked | None) -> Travel:
    """With what feet could not go on over in the map."""
    if blocked is None or blocked == travel.blocked:
        return travel
    known, (x, y), way = travel.known, blocked.rim[0], blocked.direction
    if len(blocked.rim) > 1:
        known = known.barred(blocked.rim)
    else:  # as felt by a disc that is come to it
        stands = x - known.narrowest * math.cos(way), y - known.narrowest * math.sin(way)
        known = known.felt(stands, way, is_sure=blocked.is_seen)
    return travel._replace(known=known, blocked=blocked)
