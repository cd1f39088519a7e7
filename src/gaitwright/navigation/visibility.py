"""Shortest path among polygons: A* over corners that see each other, each corner looked at only when reached.

No graph is stored: on the scenes we plan in, lazy A* re-plans in under a millisecond (row V5).
"""

import heapq
import math

import shapely
from shapely import LineString

from gaitwright.navigation.obstacles import PlanView

Point = tuple[float, float]


def shortest_path(view: PlanView, start: Point, goal: Point) -> tuple[Point, ...] | None:
    """Corner points from `start` (left out) to `goal` (included), or `None` where there is no way.

    A start too near to an obstacle is left first, by the shortest way.
    """
    if view.blocked(start):
        free = view.nearest_free(start)
        onwards = shortest_path(view, free, goal)
        return None if onwards is None else (free, *onwards)
    nodes = [start, goal, *(p for p in view.corners() if view.inside(p))]
    best = {start: 0.0}
    parent: dict[Point, Point] = {}
    queue = [(math.dist(start, goal), start)]
    closed: set[Point] = set()
    while queue:
        _, here = heapq.heappop(queue)
        if here == goal:
            return trace(parent, start, goal)
        if here in closed:
            continue
        closed.add(here)
        for there in visible(view, here, [n for n in nodes if n not in closed]):
            cost = best[here] + math.dist(here, there)
            if cost < best.get(there, math.inf):
                best[there], parent[there] = cost, here
                heapq.heappush(queue, (cost + math.dist(there, goal), there))
    return None


def visible(view: PlanView, here: Point, nodes: list[Point]) -> list[Point]:
    """Those of `nodes` that a straight line from `here` reaches without entering an obstacle."""
    if not nodes:
        return []
    lines = shapely.linestrings([[here, n] for n in nodes])
    hidden = shapely.disjoint(lines, lines)
    for obstacle in view.obstacles:
        # Shrunk by a hair, so that a line may run along an edge.
        hidden |= shapely.intersects(obstacle.buffer(-1e-6), lines)
    return [n for n, h in zip(nodes, hidden, strict=True) if not h]


def trace(parent: dict[Point, Point], start: Point, goal: Point) -> tuple[Point, ...]:
    path = [goal]
    while parent.get(path[-1], start) != start:
        path.append(parent[path[-1]])
    return tuple(reversed(path))


def length(start: Point, path: tuple[Point, ...]) -> float:
    """Length of a path [m]."""
    return float(LineString([start, *path]).length) if path else 0.0
