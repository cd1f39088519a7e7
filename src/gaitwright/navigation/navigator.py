"""Mission + Sensed + GroundMap → Route: which way."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from gaitwright.model.robot import Robot
from gaitwright.navigation.obstacles import PlanView, half_width, plan_view
from gaitwright.navigation.visibility import Point, length, shortest_path, visible
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.signals import GroundMap, Mission, Route, Scan, Sensed

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
"""Where a run has been, as cells of a grid: what a navigator remembers."""


@dataclass(frozen=True)
class Navigator:
    """Plans among the obstacles of a map."""

    robot: Robot

    def set_out(
        self,
        mission: Mission,
        sensed: Sensed,
        ground: GroundMap,
        scan: Scan | None = None,
        memory: Travelled | None = None,
    ) -> tuple[Route, Travelled]:
        """The route of a new mission; `no_way` says so where there is none. What was before is forgotten."""
        here, view = place(sensed), self.view(ground)
        path: list[tuple[float, float]] = []
        for point in mission.waypoints:
            if not view.inside(point):
                return nowhere(mission, f"({point[0]:g}, {point[1]:g}) lies outside the scene"), frozenset()
            leg = shortest_path(view, path[-1] if path else here, point)
            if leg is None:
                reason = "stands an obstacle" if view.blocked(point) else "leads no way"
                where = "on" if view.blocked(point) else "to"
                return nowhere(mission, f"{where} ({point[0]:g}, {point[1]:g}) {reason}"), frozenset()
            path.extend(leg)
        begins, ends = directions((here, *path))
        route = Route(tuple(path), length(here, tuple(path)), mission.speed, begins=begins, ends=ends)
        return self.seen(route, sensed, scan, frozenset())

    def plan(
        self, route: Route, sensed: Sensed, ground: GroundMap, scan: Scan | None, memory: Travelled
    ) -> tuple[Route, Travelled]:
        """What is left of `route` from where the robot is now."""
        if not route.path:
            return route, memory
        here, path, view = place(sensed), route.path, self.view(ground)
        unit = self.robot.body_length
        while len(path) > 1 and self.has_passed(view, here, path[0], path[1]):
            path = path[1:]
        left = length(here, path)
        near = ARRIVED if route.arrived else STOP_AT
        arrived = len(path) == 1 and left < near * unit
        return self.seen(replace(route, path=path, remaining=left, arrived=arrived), sensed, scan, memory)

    def view(self, ground: GroundMap) -> PlanView:
        """A map as this robot's planner sees it."""
        return plan_view(ground, half_width(self.robot))

    def seen(
        self, route: Route, sensed: Sensed, scan: Scan | None, travelled: Travelled
    ) -> tuple[Route, Travelled]:
        """The route with what is seen of the ground ahead, and with this place remembered."""
        if scan is None:
            return route, travelled
        here, yaw = place(sensed), heading(rotation(sensed.orientation_wb))
        on = LOOKS_ON * CELL * self.robot.body_length
        ahead = self.cell((here[0] + on * math.cos(yaw), here[1] + on * math.sin(yaw)))
        scan = replace(scan, familiar=ahead in travelled)
        cell = self.cell(here)
        return replace(route, ahead=scan), travelled if cell in travelled else travelled | {cell}

    def cell(self, point: Point) -> tuple[int, int]:
        """The cell of the grid that holds a point."""
        size = CELL * self.robot.body_length
        return math.floor(point[0] / size), math.floor(point[1] / size)

    def has_passed(self, view: PlanView, here: Point, point: Point, onwards: Point) -> bool:
        """Whether the robot may leave a point of its path behind: near it, and free to go on."""
        away = math.dist(here, point) / self.robot.body_length
        return away < STOP_AT or (away < PASSED and bool(visible(view, here, [onwards])))


def directions(points: Sequence[Point]) -> tuple[float, float] | tuple[None, None]:
    """World directions in which a way begins and ends [rad]; none of a way without a point to go to."""
    if len(points) < 2:
        return None, None
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = *points[:2], *points[-2:]
    return math.atan2(y1 - y0, x1 - x0), math.atan2(y3 - y2, x3 - x2)


def nowhere(mission: Mission, sentence: str) -> Route:
    """A route that leads nowhere, and why."""
    return Route((), 0.0, mission.speed, no_way=sentence)


def place(sensed: Sensed) -> tuple[float, float]:
    """Where the robot is, seen from above [m]."""
    return float(sensed.position_w[0]), float(sensed.position_w[1])
