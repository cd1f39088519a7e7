"""Mission + Sensed + GroundMap → Route: which way, through ground that is known or seen bit by bit (V4, V7).

Known ground is a map that is full from the start; what was seen of unknown ground is kept in a map that
grows, and what was not seen is taken for free. The way is planned anew where it is found to be blocked, and
the robot says that there is no way when there is none.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from gaitwright.model.robot import Robot
from gaitwright.navigation.known_field import is_on_obstacle, is_within, known_field
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.paths import directions, length
from gaitwright.navigation.planning import Point
from gaitwright.navigation.roads import Bounds
from gaitwright.navigation.room_needed import half_width
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import GroundMap, Mission, Route, Scan, Sensed, Sight

ARRIVED = 0.15
"""The goal is reached within this many body lengths."""
STOP_AT = 0.06
"""The robot begins to stop within this many body lengths, so that it stands within `ARRIVED`."""
PASSED = 0.5
"""A way-point or a corner counts as passed within this many body lengths."""
CELL = 0.5
"""Size of the cells in which a trip remembers where it has been, in body lengths."""
LOOKS_ON = 2
"""Familiar ground is looked for this many cells ahead."""


Travelled = frozenset[tuple[int, int]]
"""Where a trip has been, as cells of a grid."""


class Travel(NamedTuple):
    """What a navigator remembers."""

    known: LearnedMap
    left: tuple[Point, ...] = ()
    """Way-points that were not reached yet [m]."""
    travelled: Travelled = frozenset()
    sight: Sight | None = None
    """The last one that is in the map."""


@dataclass(frozen=True)
class Navigator:
    """Plans in a field that it knows, or of which it knows what it has seen."""

    robot: Robot
    noise: float | None = None
    """Standard deviation of where edges of obstacles are seen [m]; `None`: the ground is known."""
    strategy: str = "optimistic"
    """How a way is chosen where the map is blank."""
    learned: LearnedMap | None = None
    """What was learned on earlier trips; `None`: nothing."""

    def set_out(
        self,
        mission: Mission,
        sensed: Sensed,
        ground: GroundMap,
        scan: Scan | None = None,
        memory: Travel | None = None,
    ) -> tuple[Route, Travel]:
        """The route of a new mission; `no_way` says so where there is none. What was seen before is known
        still, where the robot has been is forgotten."""
        here, left = place(sensed), mission.waypoints
        travel = self.looked(memory or Travel(self.before(ground)), ground)
        travel = travel._replace(left=left, travelled=frozenset())
        path, no_way = way_over(travel.known, ground, (here, nose(sensed)), left)
        if no_way:
            return Route((), 0.0, mission.speed, no_way=no_way), travel
        begins, ends = directions((here, *path))
        route = Route(path, length(here, path), mission.speed, begins=begins, ends=ends)
        return self.seen(route, sensed, scan, travel)

    def plan(
        self, route: Route, sensed: Sensed, ground: GroundMap, scan: Scan | None, memory: Travel
    ) -> tuple[Route, Travel]:
        """What is left of `route` from where the robot is now, or another one where it is blocked."""
        if not route.path:
            return route, memory
        here, path = place(sensed), route.path
        travel = self.looked(memory, ground)
        known, left = travel.known, travel.left
        while len(path) > 1 and self.has_passed(known, here, path[0], path[1]):
            if len(left) > 1 and path[0] == left[0]:
                left = left[1:]
            path = path[1:]
        travel, is_news = travel._replace(left=left), known is not memory.known
        if known.is_cut((here, *path) if is_news else (here, *path[:1])):
            other, no_way = way_over(known, ground, (here, nose(sensed)), left)
            if no_way and is_news:
                return replace(route, path=(), no_way=no_way), travel
            path = other or path  # a robot that was pushed aside goes on as well as it can
        remaining = length(here, path)
        near = ARRIVED if route.arrived else STOP_AT
        arrived = len(path) == 1 and remaining < near * self.robot.body_length
        return self.seen(
            replace(route, path=path, remaining=remaining, arrived=arrived), sensed, scan, travel
        )

    def before(self, ground: GroundMap) -> LearnedMap:
        """What it knows before its first mission."""
        if self.noise is None:
            return known_field(ground, half_width(self.robot))
        return self.nothing(ground.bounds) if self.learned is None else self.learned

    def nothing(self, bounds: Bounds) -> LearnedMap:
        """What it knows of a field where it has never been."""
        return LearnedMap.of(bounds, half_width(self.robot), self.strategy, self.noise or 0.0)

    def looked(self, travel: Travel, ground: GroundMap) -> Travel:
        """With what is known of the ground now."""
        if self.noise is None:
            return travel._replace(known=known_field(ground, half_width(self.robot)))
        if ground.sight is None or ground.sight is travel.sight:
            return travel
        return travel._replace(known=travel.known.seen(ground.sight), sight=ground.sight)

    def seen(self, route: Route, sensed: Sensed, scan: Scan | None, travel: Travel) -> tuple[Route, Travel]:
        """The route with what is seen of the ground ahead, and with this place remembered."""
        if scan is None:
            return route, travel
        here, yaw = place(sensed), nose(sensed)
        on = LOOKS_ON * CELL * self.robot.body_length
        ahead = self.cell((here[0] + on * math.cos(yaw), here[1] + on * math.sin(yaw)))
        scan = replace(scan, familiar=ahead in travel.travelled)
        return replace(route, ahead=scan), self.been(travel, here)

    def been(self, travel: Travel, *places: Point) -> Travel:
        """With places where the robot has been."""
        new = {self.cell(one) for one in places} - travel.travelled
        return travel._replace(travelled=travel.travelled | new) if new else travel

    def cell(self, point: Point) -> tuple[int, int]:
        """The cell of the grid that holds a point."""
        size = CELL * self.robot.body_length
        return math.floor(point[0] / size), math.floor(point[1] / size)

    def has_passed(self, known: LearnedMap, here: Point, point: Point, onwards: Point) -> bool:
        """Whether the robot may leave a point of its path behind: near it, and free to go on."""
        away = math.dist(here, point) / self.robot.body_length
        return away < STOP_AT or (away < PASSED and not known.is_cut((here, onwards)))


def way_over(
    known: LearnedMap, ground: GroundMap, stands: tuple[Point, float], points: Sequence[Point]
) -> tuple[tuple[Point, ...], str | None]:
    """A path from where it `stands` and faces [rad] over all way-points, or why there is none."""
    (here, facing), path = stands, list[Point]()
    for point in points:
        x, y = point
        if not is_within(ground.bounds, point):
            return (), f"({x:g}, {y:g}) lies outside the scene"
        leg = known.way(path[-1], point) if path else known.way(here, point, facing)
        if leg is None:
            return (), why_no_way(known, ground, point)
        path.extend(leg.path)
    return tuple(path), None


def why_no_way(known: LearnedMap, ground: GroundMap, point: Point) -> str:
    """Why there is no way to a place, as a sentence."""
    where = f"({point[0]:g}, {point[1]:g})"
    if known.is_touched(point) or is_on_obstacle(ground, point):
        return f"on {where} stands an obstacle"
    if not is_within(known.bounds, point, known.narrowest):
        return f"{where} lies too near to the edge of the scene"
    return f"to {where} leads no way"


def nose(sensed: Sensed) -> float:
    """Where the robot's nose points, world [rad]."""
    return heading(rotation(sensed.orientation_wb))


def place(sensed: Sensed) -> Point:
    """Where the robot is, seen from above [m]."""
    return float(sensed.position_w[0]), float(sensed.position_w[1])
