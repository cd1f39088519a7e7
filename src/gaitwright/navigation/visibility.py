"""Shortest path among polygons: A* over corners that see each other, each corner looked at only when reached.

No graph is stored: on the scenes we plan in, lazy A* re-plans in under a millisecond (row V5).
"""

import heapq
import math

import numpy as np
import shapely
from shapely import LineString

from gaitwright.navigation.obstacles import PlanView

Point = tuple[float, float]
MANY = 400
"""Among more corners than this a corner looks at those near to it first: the path is then short, if not
always the shortest."""
NEAREST = 48
"""So many."""


def shortest_path(view: PlanView, start: Point, goal: Point) -> tuple[Point, ...] | None:
    """Corner points from `start` (left out) to `goal` (included), or `None` where there is no way.

    A start too near to an obstacle is left first, by the shortest way.
    """
    if view.blocked(start):
        free = view.nearest_free(start)
        onwards = shortest_path(view, free, goal)
        return None if onwards is None else (free, *onwards)
    corners = view.corners()
    inside = shapely.contains_xy(view.field, np.array(corners).reshape(-1, 2))
    nodes = [start, goal, *(corner for corner, kept in zip(corners, inside, strict=True) if kept)]
    if not view.joined(start, goal):
        return None
    most = len(nodes) if len(nodes) <= MANY else NEAREST
    path = search(view, nodes, most)
    while path is None and most < len(nodes):
        most *= 4
        path = search(view, nodes, most)
    return path if path is None or most >= len(nodes) else pulled(view, start, path)


def search(view: PlanView, nodes: list[Point], most: int) -> tuple[Point, ...] | None:
    """The shortest path from the first to the second node, each looking only at the `most` nearest."""
    start, goal = nodes[:2]
    places = np.array(nodes)
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
        for there in visible(view, here, near(nodes, places, here, most, closed)):
            cost = best[here] + math.dist(here, there)
            if cost < best.get(there, math.inf):
                best[there], parent[there] = cost, here
                heapq.heappush(queue, (cost + math.dist(there, goal), there))
    return None


def near(nodes: list[Point], places: np.ndarray, here: Point, most: int, closed: set[Point]) -> list[Point]:
    """The nodes that are not closed: all, or the `most` nearest of all, and the goal."""
    if most >= len(nodes):
        return [node for node in nodes if node not in closed]
    away = np.hypot(*(places - here).T)
    nearest = [1, *np.argpartition(away, most)[:most]]
    return [nodes[k] for k in dict.fromkeys(nearest) if nodes[k] not in closed]


def pulled(view: PlanView, start: Point, path: tuple[Point, ...]) -> tuple[Point, ...]:
    """A path without the points that a straight line leaves out."""
    out, here, left = [], start, list(path)
    while left:
        seen = visible(view, here, left)
        last = max((k for k, point in enumerate(left) if point in seen), default=0)
        here, left = left[last], left[last + 1 :]
        out.append(here)
    return tuple(out)


def visible(view: PlanView, here: Point, nodes: list[Point]) -> list[Point]:
    """Those of `nodes` that a straight line from `here` reaches without entering an obstacle."""
    if not nodes:
        return []
    hidden = view.hidden(shapely.linestrings([[here, n] for n in nodes]))
    return [n for n, h in zip(nodes, hidden, strict=True) if not h]


def trace(parent: dict[Point, Point], start: Point, goal: Point) -> tuple[Point, ...]:
    path = [goal]
    while parent.get(path[-1], start) != start:
        path.append(parent[path[-1]])
    return tuple(reversed(path))


def length(start: Point, path: tuple[Point, ...]) -> float:
    """Length of a path [m]."""
    return float(LineString([start, *path]).length) if path else 0.0
