"""What a navigator remembers, and what it goes by at a moment."""

from typing import NamedTuple

from gaitwright.missions import Mission, Stop
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.planning import Point
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import GroundMap, Sensed, Sight

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
