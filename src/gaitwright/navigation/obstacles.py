"""What a path keeps clear of, seen from above: boxes grown by the robot's half width, the edge."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import shapely
from shapely import Polygon, STRtree

from gaitwright.model.robot import Robot
from gaitwright.signals import GroundMap

CLEARANCE = 0.15
"""Room beside the robot's feet, in body lengths."""

HAIR = 1e-6
"""Less than this is no room [m]."""


@dataclass(frozen=True)
class PlanView:
    """Grown obstacles and the free field, as plane polygons [m]."""

    obstacles: tuple[Polygon, ...]
    field: Polygon

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """x_min, y_min, x_max, y_max of the field [m]."""
        return self.field.bounds

    def inside(self, point: tuple[float, float]) -> bool:
        """Whether a point lies in the field."""
        return bool(self.field.contains(shapely.Point(point)))

    def blocked(self, point: tuple[float, float]) -> bool:
        """Whether a point lies within a grown obstacle."""
        return len(self._grown.query(shapely.Point(point), predicate="within")) > 0

    def hidden(self, lines: np.ndarray) -> np.ndarray:
        """Which lines enter an obstacle; each of these is shrunk by a hair, so that one may run along it."""
        hidden = np.zeros(len(lines), dtype=bool)
        hidden[self._shrunk.query(lines, predicate="intersects")[0]] = True
        return hidden

    def joined(self, start: tuple[float, float], goal: tuple[float, float]) -> bool:
        """Whether any way leads from one point to another."""
        ends = shapely.points([start, goal])
        return any((shapely.distance(room, ends) < HAIR).all() for room in self._rooms)

    @cached_property
    def _grown(self) -> STRtree:
        return STRtree(self.obstacles)

    @cached_property
    def _shrunk(self) -> STRtree:
        return STRtree([obstacle.buffer(-HAIR) for obstacle in self.obstacles])

    @cached_property
    def _rooms(self) -> tuple[Polygon, ...]:
        """The parts of the field from none of which a way leads to another."""
        free = self.field.difference(shapely.union_all(self._shrunk.geometries))
        return tuple(getattr(free, "geoms", [free]))

    def corners(self) -> list[tuple[float, float]]:
        """Corners of the grown obstacles, inner rings too."""
        rings = [ring for o in self.obstacles for ring in (o.exterior, *o.interiors)]
        return [(x, y) for ring in rings for x, y in ring.coords[:-1]]

    def nearest_free(self, point: tuple[float, float]) -> tuple[float, float]:
        """The place nearest to a blocked point that is just clear of every obstacle [m]."""
        place = shapely.Point(point)
        around = shapely.union_all([o.buffer(1e-3) for o in self.obstacles]).boundary
        free = around.interpolate(around.project(place))
        return free.x, free.y


def half_width(robot: Robot) -> float:
    """Room the robot needs to either side of its path [m]: its feet and a clearance."""
    return float(abs(robot.nominal_feet[:, 1]).max()) + CLEARANCE * robot.body_length


@lru_cache(maxsize=4)
def plan_view(ground: GroundMap, margin: float) -> PlanView:
    """A map as the planner sees it: its obstacles grown by a margin [m]."""
    grown = (
        Polygon(outline).buffer(margin, join_style="mitre", mitre_limit=1.5) for outline in ground.obstacles
    )
    merged = shapely.union_all(list(grown))
    parts = getattr(merged, "geoms", [merged])
    return PlanView(tuple(p for p in parts if not p.is_empty), shapely.box(*ground.bounds))
