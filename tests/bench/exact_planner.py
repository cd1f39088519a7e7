"""The slow, plain planner that a learned map has to equal: optimistic, over corners of arcs, by shapely."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from gaitwright.bench.unknown_worlds.baselines import GridWay
from gaitwright.bench.unknown_worlds.lattice import SOFT, joined, news
from gaitwright.bench.unknown_worlds.optimum import HAIR, way_among
from gaitwright.bench.unknown_worlds.segments import is_way_clear
from gaitwright.bench.unknown_worlds.world import RADIUS, TOUCH, Point, edges_of
from gaitwright.signals import Sight

QUARTER = 12
ROOM = (RADIUS + 1e-5) / math.cos(math.pi / (4.0 * QUARTER))


@dataclass(frozen=True)
class Exact:
    """What was seen, and nothing else."""

    pieces: np.ndarray = field(default_factory=lambda: np.empty((0, 4)))

    def seen(self, sight: Sight) -> "Exact":
        return self.knows(sight.pieces)

    def knows(self, pieces: np.ndarray) -> "Exact":
        new = news(self.pieces, pieces)
        return replace(self, pieces=joined(self.pieces, new)) if len(new) else self

    def felt(self, place: Point, direction: float) -> "Exact":
        ahead = np.array([math.cos(direction), math.sin(direction)])
        at, across = np.array(place) + (RADIUS - TOUCH) * ahead, 1e-4 * np.array([-ahead[1], ahead[0]])
        return self.knows(np.hstack([at - across, at + across])[None])

    def walked(self, way: np.ndarray) -> "Exact":
        return self

    def is_cut(self, path: np.ndarray) -> bool:
        return not is_way_clear(self.pieces, path, RADIUS - SOFT)

    def way(self, start: Point, goal: Point, facing: float) -> GridWay | None:
        solid = self.grown(ROOM)
        begin, out = start, np.empty((0, 2))
        if solid.intersects(shapely.Point(start)):
            begin = nearest_free(solid, start)
            out = np.array([begin])
        length, points = way_among(solid, edges_of(self.grown(ROOM - HAIR)), begin, goal)
        if math.isinf(length):
            return None
        return GridWay(np.vstack([out, points[1:]]), length + math.dist(start, begin), 0)

    def grown(self, radius: float) -> shapely.Geometry:
        """What the disc's middle is kept out of."""
        lines = shapely.linestrings(self.pieces.reshape(-1, 2, 2))
        return shapely.union_all(shapely.buffer(lines, radius, quad_segs=QUARTER))


def nearest_free(solid: shapely.Geometry, place: Point) -> Point:
    """The place just outside of what is solid."""
    rim = shapely.buffer(solid, 1e-6).boundary
    x, y = rim.interpolate(rim.project(shapely.Point(place))).coords[0]
    return float(x), float(y)
