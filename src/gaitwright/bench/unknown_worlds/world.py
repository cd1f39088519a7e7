"""A world that nobody has seen: polygons in a walled square, a start, a goal, and the room to pass."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float
from shapely import Polygon

Point = tuple[float, float]
RADIUS = 0.16
"""Of the robot's disc [m]."""
TOUCH = 5e-4
"""It gives so far before it stops [m]."""
WIDER = RADIUS / math.cos(math.radians(15.0))
"""A planner of tangent polygons with six corners on a half circle may ask for this radius [m]."""
SIZE = 20.0
"""Side of the square [m]."""
BORDER = 0.3
"""Thickness of the wall around it [m]: it stands within the square."""
BOUNDS = (0.0, 0.0, SIZE, SIZE)
APART = 9.0
"""Start and goal are at least so far apart [m]."""
FREE = 0.3
"""Room around start and goal [m]."""


@dataclass(frozen=True, eq=False)
class World:
    """One world."""

    name: str
    family: str
    kind: str
    """open, walled (start or goal is shut in), gap (one narrow gap decides)."""
    obstacles: tuple[Polygon, ...]
    """Convex; they may touch, overlap, and stand 1 nm apart; the wall around the square is among them."""
    start: Point
    goal: Point
    gap: float | None = None
    """Width of the gap that decides, less the disc's [m]."""

    @cached_property
    def solid(self) -> shapely.Geometry:
        """All that is solid, as one."""
        return shapely.union_all(list(self.obstacles))

    @cached_property
    def edges(self) -> Float[np.ndarray, "n 4"]:
        """Edges of all that is solid [m]: they meet in their ends only."""
        return edges_of(self.solid)

    def clearance(self, point: Point) -> float:
        """Distance from the nearest obstacle [m]; 0 inside one."""
        return float(shapely.distance(self.solid, shapely.Point(point)))


def edges_of(solid: shapely.Geometry) -> Float[np.ndarray, "n 4"]:
    """Edges of a polygon or of several [m]."""
    rings = [
        shapely.get_coordinates(ring)
        for part in shapely.get_parts(solid)
        for ring in (part.exterior, *part.interiors)
    ]
    edges = np.vstack([np.empty((0, 4)), *(np.hstack([ring[:-1], ring[1:]]) for ring in rings)])
    return np.ascontiguousarray(edges[np.hypot(*(edges[:, 2:] - edges[:, :2]).T) > 0.0])


def border() -> list[Polygon]:
    """The wall around the square: four boxes that overlap in its corners."""
    low, high = BORDER, SIZE - BORDER
    return [
        shapely.box(0.0, 0.0, SIZE, low),
        shapely.box(0.0, high, SIZE, SIZE),
        shapely.box(0.0, 0.0, low, SIZE),
        shapely.box(high, 0.0, SIZE, SIZE),
    ]
