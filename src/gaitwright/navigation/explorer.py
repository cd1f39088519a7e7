"""Mission + Sensed + a GroundMap that grows → Route: which way through ground that was never seen (V4, V7).

What was seen is kept in a learned map; what was not is taken for free. The way is planned anew as soon as a
look shows that it is blocked, and the robot says that there is no way when there is none.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from gaitwright.model.robot import Robot
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.navigator import (
    ARRIVED,
    PASSED,
    STOP_AT,
    Navigator,
    Travelled,
    directions,
    nowhere,
    place,
)
from gaitwright.navigation.obstacles import half_width
from gaitwright.navigation.roads import Bounds
from gaitwright.navigation.visibility import Point, length
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import GroundMap, Mission, Route, Scan, Sensed, Sight


class Explored(NamedTuple):
    """What an explorer remembers."""

    known: LearnedMap
    left: tuple[Point, ...]
    """Way-points that were not reached yet [m]."""
    travelled: Travelled
    sight: Sight | None = None
    """The last one that is in the map."""


@dataclass(frozen=True)
class Explorer:
    """Plans in a field of which it knows what it has seen."""

    robot: Robot
    noise: float
    """Standard deviation of where edges of obstacles are seen [m]."""
    strategy: str = "optimistic"
    known: LearnedMap | None = None
    """What was learned on earlier trips; `None`: nothing."""

    def set_out(
        self,
        mission: Mission,
        sensed: Sensed,
        ground: GroundMap,
        scan: Scan | None = None,
        memory: Explored | None = None,
    ) -> tuple[Route, Explored]:
        """The route of a new mission; `no_way` says so where there is none."""
        here, left = place(sensed), mission.waypoints
        known = memory.known if memory is not None else self.known
        if known is None:
            known = self.nothing(ground.bounds)
        sight = memory.sight if memory is not None else None
        explored = looked(Explored(known, left, frozenset(), sight), ground.sight)
        path, no_way = way_over(explored.known, here, left, facing(sensed))
        if no_way:
            return nowhere(mission, no_way), explored
        begins, ends = directions((here, *path))
        route = Route(path, length(here, path), mission.speed, begins=begins, ends=ends)
        return self.seen(route, sensed, scan, explored)

    def plan(
        self, route: Route, sensed: Sensed, ground: GroundMap, scan: Scan | None, memory: Explored
    ) -> tuple[Route, Explored]:
        """What is left of `route` from where the robot is now, or another one where it is blocked."""
        if not route.path:
            return route, memory
        here, unit, path = place(sensed), self.robot.body_length, route.path
        explored = looked(memory, ground.sight)
        known, left = explored.known, explored.left
        while len(path) > 1 and self.has_passed(known, here, path[0], path[1]):
            if len(left) > 1 and path[0] == left[0]:
                left = left[1:]
            path = path[1:]
        explored = explored._replace(left=left)
        if known.is_cut((here, *path)):
            path, no_way = way_over(known, here, left, facing(sensed))
            if no_way:
                return replace(route, path=(), no_way=no_way), explored
        remaining = length(here, path)
        near = ARRIVED if route.arrived else STOP_AT
        arrived = len(path) == 1 and remaining < near * unit
        return self.seen(
            replace(route, path=path, remaining=remaining, arrived=arrived), sensed, scan, explored
        )

    def nothing(self, bounds: Bounds) -> LearnedMap:
        """What it knows of a field where it has never been."""
        return LearnedMap.of(bounds, half_width(self.robot), self.strategy, self.noise)

    def has_passed(self, known: LearnedMap, here: Point, point: Point, onwards: Point) -> bool:
        """Whether the robot may leave a point of its path behind: near it, and free to go on."""
        away = math.dist(here, point) / self.robot.body_length
        return away < STOP_AT or (away < PASSED and not known.is_cut((here, onwards)))

    def seen(
        self, route: Route, sensed: Sensed, scan: Scan | None, explored: Explored
    ) -> tuple[Route, Explored]:
        """The route with what is seen of the ground ahead, and with this place remembered."""
        route, travelled = Navigator(self.robot).seen(route, sensed, scan, explored.travelled)
        return route, explored._replace(travelled=travelled)


def way_over(
    known: LearnedMap, here: Point, points: Sequence[Point], towards: float
) -> tuple[tuple[Point, ...], str | None]:
    """A path from here, where it looks `towards` [rad], over all way-points, or why there is none."""
    path: list[Point] = []
    for point in points:
        leg = known.way(path[-1] if path else here, point, None if path else towards)
        if leg is None:
            return (), f"to ({point[0]:g}, {point[1]:g}) leads no way"
        path.extend(leg.path)
    return tuple(path), None


def facing(sensed: Sensed) -> float:
    """Where the robot's nose points, world [rad]."""
    return heading(rotation(sensed.orientation_wb))


def looked(explored: Explored, sight: Sight | None) -> Explored:
    """With what the newest look showed, if it is not in the map yet."""
    if sight is None or sight is explored.sight:
        return explored
    return explored._replace(known=explored.known.seen(sight), sight=sight)
