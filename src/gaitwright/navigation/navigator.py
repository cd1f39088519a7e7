"""Mission + Sensed + GroundMap → Route: which way, through ground that is known or seen (V4, V6, V7).

Known ground is a map that is full from the start; what was seen of unknown ground is kept in a map that
grows, and what was not seen is taken for free. The way is planned anew where it is found to be blocked, and
the robot says that there is no way when there is none. A programme is gone as it is written, and a person's
commands as they come.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from gaitwright.missions import Programme, Steering
from gaitwright.model.robot import Robot
from gaitwright.navigation.footprint import Footprint, footprint_of
from gaitwright.navigation.known_field import is_on_obstacle, is_within, known_field
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.paths import directions, length
from gaitwright.navigation.planning import Point
from gaitwright.navigation.programme import gone_on_with, set_out_on, stops_of
from gaitwright.navigation.reached import PASSED, STOP_AT, has_arrived
from gaitwright.navigation.roads import Bounds
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.steering import steered
from gaitwright.navigation.travel import Moment, Travel, found_blocked
from gaitwright.navigation.turning_room import come_along, going, room_to_turn
from gaitwright.signals import GroundMap, Mission, Route, Scan, Sensed

CELL = 0.5
"""Size of the cells in which a trip remembers where it has been, in body lengths."""
LOOKS_ON = 2
"""Familiar ground is looked for this many cells ahead."""


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
    makes_room: bool = True
    """Whether the robot goes to where there is room before it turns in place."""

    def set_out(
        self,
        mission: Mission,
        sensed: Sensed,
        ground: GroundMap,
        scan: Scan | None = None,
        memory: Travel | None = None,
    ) -> tuple[Route, Travel]:
        """The route of a new mission; `no_way` says so where there is none. What was seen before is known
        still, where the robot has been is forgotten. The same mission again goes on with what is left of it.
        """
        now, before = Moment.of(sensed, ground), memory or Travel(self.before(ground))
        travel = self.looked(before, ground)
        if before.mission is not mission:
            new = Travel(travel.known, mission.waypoints, mission=mission, begun=now.time)
            travel = new._replace(stops=stops_of(mission), sight=travel.sight)
        if isinstance(mission.guidance, Steering):
            return steered(mission.guidance, travel, now, self.body), travel
        if isinstance(mission.guidance, Programme):
            known = travel.known if self.noise is None else before.known
            return self.seen(set_out_on(travel, known, now), now, scan, travel)
        path, no_way = way_over(travel.known, now, travel.left)
        if no_way:
            return Route((), 0.0, mission.speed, no_way=no_way), travel
        begins, ends = directions((now.place, *path))
        route = Route(path, length(now.place, path), mission.speed, begins=begins, ends=ends)
        return self.seen(route, now, scan, travel)

    def plan(
        self, route: Route, sensed: Sensed, ground: GroundMap, scan: Scan | None, memory: Travel
    ) -> tuple[Route, Travel]:
        """What is left of `route` from where the robot is now, or another one where it is blocked."""
        guidance, now = memory.mission.guidance, Moment.of(sensed, ground)
        if guidance is not None and route.halt:
            return route, memory
        if isinstance(guidance, Steering):
            travel = self.looked(memory, ground)
            return steered(guidance, travel, now, self.body), travel
        if not route.path:
            return route, memory
        travel = found_blocked(self.looked(memory, ground), route.blocked)
        travel = travel._replace(trail=come_along(travel.trail, now.place, self.body))
        path = route.path[len(travel.aside) :]
        own = replace(route, path=path, facing=None, halt=None, blocked=None)
        if guidance is not None:
            own, travel = gone_on_with(own, travel, now, self.robot)
        else:
            own, travel = self.left_of(own, travel, now, memory)
        if self.makes_room and own.path and not (own.arrived or own.pause or own.halt):
            own, travel = self.with_room(own, travel, now)
        return self.seen(own, now, scan, travel)

    # --- the robot's own way --------------------------------------------------------------------------
    def left_of(self, route: Route, travel: Travel, now: Moment, before: Travel) -> tuple[Route, Travel]:
        """What is left of a way that was planned, or another one where it is blocked or the robot went aside.
        `before`: what was known when it was looked at last."""
        here, path, known, left = now.place, route.path, travel.known, travel.left
        while len(path) > 1 and self.has_passed(known, here, path[0], path[1]):
            if len(left) > 1 and path[0] == left[0]:
                left = left[1:]
            path = path[1:]
        if left != travel.left:
            travel = travel._replace(left=left, cramped=())
        is_news, is_stopped = known is not before.known, travel.blocked is not before.blocked
        is_anew = is_stopped or (is_news and self.noise is None)  # what stood in the way may be gone
        is_astray = bool(travel.aside) or self.has_overshot(now, path)
        if is_anew or is_astray or known.is_cut((here, *path) if is_news else (here, *path[:1])):
            other, no_way = way_over(known, now, left)
            if no_way and is_news:
                return replace(route, path=(), no_way=no_way), travel
            path = other or path  # a robot that was pushed aside goes on as well as it can
        route = replace(route, path=path, remaining=length(here, path))
        return replace(route, arrived=has_arrived(route, self.robot)), travel

    def has_passed(self, known: LearnedMap, here: Point, point: Point, onwards: Point) -> bool:
        """Whether the robot may leave a point of its path behind: near it, and free to go on."""
        away = math.dist(here, point) / self.robot.body_length
        return away < STOP_AT or (away < PASSED and not known.is_cut((here, onwards)))

    def has_overshot(self, now: Moment, path: tuple[Point, ...]) -> bool:
        """Whether a corner that is near lies behind the robot, and it may not go on from here."""
        return len(path) > 1 and now.has_gone_by(path[0], PASSED * self.robot.body_length)

    # --- room to turn ---------------------------------------------------------------------------------
    @cached_property
    def body(self) -> Footprint:
        """The robot from above."""
        return footprint_of(self.robot)

    def with_room(self, route: Route, travel: Travel, now: Moment) -> tuple[Route, Travel]:
        """The route with how the robot turns to it where there is no room to turn in place."""
        here, pose, aside = now.place, (*now.place, now.yaw), travel.aside
        while len(aside) > 1 and self.has_passed(travel.known, here, aside[0], aside[1]):
            aside = aside[1:]
        if len(aside) == 1 and math.dist(here, aside[0]) < STOP_AT * self.robot.body_length:
            aside = ()
        if aside:
            turning = going(travel.known, self.body, pose, aside)
        else:
            turning = room_to_turn(travel.known, self.body, pose, route.path, travel.trail)
            is_far = turning is not None and length(here, turning.aside) > self.body.radius
            again = is_far and any(math.dist(here, place) < self.body.radius for place in travel.cramped)
            if turning is None or again:  # whoever comes back without having got round never will
                halt = f"there is no room to turn at ({here[0]:.1f}, {here[1]:.1f})"
                return replace(route, halt=halt), travel._replace(aside=())
            travel = travel._replace(cramped=(*travel.cramped, here)) if is_far else travel
        travel, route = travel._replace(aside=turning.aside), replace(route, facing=turning.facing)
        if not turning.aside:
            return route, travel
        path = (*turning.aside, *route.path)
        return replace(route, path=path, remaining=length(here, path)), travel

    # --- what is known --------------------------------------------------------------------------------
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
            if ground.obstacles is travel.outlines:
                return travel
            return travel._replace(
                known=known_field(ground, half_width(self.robot)), outlines=ground.obstacles
            )
        if ground.sight is None or ground.sight is travel.sight:
            return travel
        return travel._replace(known=travel.known.seen(ground.sight), sight=ground.sight)

    def seen(self, route: Route, now: Moment, scan: Scan | None, travel: Travel) -> tuple[Route, Travel]:
        """The route with what is seen of the ground ahead, and with this place remembered."""
        if scan is None:
            return route, travel
        (x, y), on = now.place, LOOKS_ON * CELL * self.robot.body_length
        ahead = self.cell((x + on * math.cos(now.yaw), y + on * math.sin(now.yaw)))
        scan = replace(scan, familiar=ahead in travel.travelled)
        return replace(route, ahead=scan), self.been(travel, now.place)

    def been(self, travel: Travel, *places: Point) -> Travel:
        """With places where the robot has been."""
        new = {self.cell(one) for one in places} - travel.travelled
        return travel._replace(travelled=travel.travelled | new) if new else travel

    def cell(self, point: Point) -> tuple[int, int]:
        """The cell of the grid that holds a point."""
        size = CELL * self.robot.body_length
        return math.floor(point[0] / size), math.floor(point[1] / size)


def way_over(known: LearnedMap, now: Moment, points: Sequence[Point]) -> tuple[tuple[Point, ...], str | None]:
    """A path from where the robot is now over all way-points, or why there is none."""
    path = list[Point]()
    for point in points:
        if not is_within(now.ground.bounds, point):
            return (), f"({point[0]:g}, {point[1]:g}) lies outside the scene"
        leg = known.way(path[-1], point) if path else known.way(now.place, point, now.yaw)
        if leg is None:
            return (), why_no_way(known, now.ground, point)
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
