"""Mission + Sensed → Route: which way."""

import math
from dataclasses import dataclass, replace

from gaitwright.ground.scene import BLIND_STEP, SEEN_STEP, Scene
from gaitwright.model.robot import Robot
from gaitwright.navigation.obstacles import PlanView, plan_view
from gaitwright.navigation.visibility import Point, length, shortest_path, visible
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.perception.scanner import Scanner
from gaitwright.signals import Mission, Route, Sensed

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


@dataclass(frozen=True)
class Navigator:
    """Plans among the obstacles of a known scene, and tells of the ground ahead."""

    robot: Robot
    view: PlanView
    scanner: Scanner | None = None

    @classmethod
    def of(cls, robot: Robot, scene: Scene, sees: bool = True) -> "Navigator":
        """`sees`: whether the ground is known, so that it is scanned and higher steps are climbed."""
        step = SEEN_STEP if sees else BLIND_STEP
        return cls(robot, plan_view(scene, robot, step), Scanner(robot, scene, step) if sees else None)

    def set_out(self, mission: Mission, sensed: Sensed) -> Route:
        """The route of a new mission; `no_way` says so where there is none."""
        here = place(sensed)
        path: list[tuple[float, float]] = []
        for point in mission.waypoints:
            if not self.view.inside(point):
                return self.nowhere(mission, f"({point[0]:g}, {point[1]:g}) lies outside the scene")
            leg = shortest_path(self.view, path[-1] if path else here, point)
            if leg is None:
                reason = "stands an obstacle" if self.view.blocked(point) else "leads no way"
                where = "on" if self.view.blocked(point) else "to"
                return self.nowhere(mission, f"{where} ({point[0]:g}, {point[1]:g}) {reason}")
            path.extend(leg)
        route = Route(tuple(path), length(here, tuple(path)), mission.speed, mission.driver)
        return self.looked(route, sensed)

    def plan(self, route: Route, sensed: Sensed) -> Route:
        """What is left of `route` from where the robot is now."""
        if not route.path:
            return route
        here, path = place(sensed), route.path
        unit = self.robot.body_length
        while len(path) > 1 and self.has_passed(here, path[0], path[1]):
            path = path[1:]
        left = length(here, path)
        near = ARRIVED if route.arrived else STOP_AT
        arrived = len(path) == 1 and left < near * unit
        return self.looked(replace(route, path=path, remaining=left, arrived=arrived), sensed)

    def looked(self, route: Route, sensed: Sensed) -> Route:
        """The route with what is seen of the ground ahead, and with this place remembered."""
        if self.scanner is None:
            return route
        here, yaw = place(sensed), heading(rotation(sensed.orientation_wb))
        on = LOOKS_ON * CELL * self.robot.body_length
        ahead = self.cell((here[0] + on * math.cos(yaw), here[1] + on * math.sin(yaw)))
        scan = self.scanner.look(here, yaw, ahead in route.travelled)
        cell, travelled = self.cell(here), route.travelled
        return replace(route, ahead=scan, travelled=travelled if cell in travelled else travelled | {cell})

    def cell(self, point: Point) -> tuple[int, int]:
        """The cell of the grid that holds a point."""
        size = CELL * self.robot.body_length
        return math.floor(point[0] / size), math.floor(point[1] / size)

    def has_passed(self, here: Point, point: Point, onwards: Point) -> bool:
        """Whether the robot may leave a point of its path behind: near it, and free to go on."""
        away = math.dist(here, point) / self.robot.body_length
        return away < STOP_AT or (away < PASSED and bool(visible(self.view, here, [onwards])))

    def nowhere(self, mission: Mission, sentence: str) -> Route:
        return Route((), 0.0, mission.speed, mission.driver, no_way=sentence)


def place(sensed: Sensed) -> tuple[float, float]:
    """Where the robot is, seen from above [m]."""
    return float(sensed.position_w[0]), float(sensed.position_w[1])
