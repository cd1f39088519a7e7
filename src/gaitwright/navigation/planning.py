"""RoadMap + known ground + start + goal → Way."""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.navigation.lazy_search import FULL, NONE, search
from gaitwright.navigation.own_place import Point, pulled, sources
from gaitwright.navigation.piece_grid import clearance
from gaitwright.navigation.raster import Raster, is_known
from gaitwright.navigation.roads import RoadMap
from gaitwright.navigation.tolerances import DEEP, LINK, WORTH
from gaitwright.numerics.compiled import kernel

TURN, TURNING = 3.0, 0.06
"""Turning by a radian is worth as many radii of way as are walked meanwhile (0.5 m/s, 1 rad/s, a Go2), and
turning round at most this share of the straight line to the goal."""
ANYWHERE = np.zeros((0, 0), dtype=bool)
"""For a search that is not kept to known ground."""


class Way(NamedTuple):
    """A path for a disc, and what it is worth."""

    path: tuple[Point, ...]
    """Points [m], the start left out, the goal included."""
    length: float
    """[m]"""
    is_walked: bool
    """Whether it keeps to ground that was seen or walked before; then it is at most `WORTH` × the shortest
    that there is, whatever else may be found."""
    optimistic: float
    """Length of the shortest way if all that is unknown were free [m]: none is shorter."""


def best_way(
    road_map: RoadMap, raster: Raster, start: Point, goal: Point, facing: float | None = None
) -> Way | None:
    """The shortest way if all that is unknown were free, or one over known ground that is nearly as short.

    Of ways through the unknown that are about as short, one that needs less turning is taken by a robot that
    faces `facing` [rad]: else it may turn from side to side as it sees more of a wall before it. A start
    outside the field is left towards it. There is no way to a goal that a disc cannot stand on, unless it
    stands there already.
    """
    if start == goal:
        return Way((goal,), 0.0, True, 0.0)
    if not is_standable(road_map, goal):
        return None
    x_min, y_min, x_max, y_max = road_map.bounds
    inside = (min(max(start[0], x_min), x_max), min(max(start[1], y_min), y_max))
    step = () if inside == start else (inside,)
    length, path = shortest(road_map, inside, goal, math.inf, raster, ANYWHERE)
    if length == NONE:
        return None
    into = math.dist(start, inside)
    if all_known(raster.cells, raster.place, path):
        return Way((*step, *points(path)), into + length, True, into + length)
    longer, known = shortest(road_map, inside, goal, WORTH * length, raster, raster.cells)
    if longer != NONE:
        return Way((*step, *points(known)), into + longer, True, into + length)
    explored = length
    if facing is not None:
        price = min(TURN * road_map.radius, TURNING * math.dist(inside, goal) / math.pi)
        _, path = shortest(road_map, inside, goal, math.inf, raster, ANYWHERE, (facing, price))
        explored = float(np.hypot(*np.diff(path, axis=0).T).sum())
    return Way((*step, *points(path)), into + explored, False, into + length)


def is_standable(road_map: RoadMap, point: Point) -> bool:
    """Whether a disc may stand at a place of the field."""
    x_min, y_min, x_max, y_max = road_map.bounds
    within = x_min <= point[0] <= x_max and y_min <= point[1] <= y_max
    room = road_map.radius
    return within and bool(clearance(road_map.roads.grid, *point, room) >= room - LINK)


def shortest(
    road_map: RoadMap,
    start: Point,
    goal: Point,
    most: float,
    raster: Raster,
    cells: np.ndarray,
    turning: tuple[float, float] = (0.0, 0.0),
) -> tuple[float, np.ndarray]:
    """Length [m] and points of the shortest path of at most `most` [m], or `NONE`.

    What is deep within the disc where the robot stands is not there, where there is no way otherwise.
    """
    ignored, length, path = 0.0, NONE, np.empty((0, 2))
    grid, deep = road_map.roads.grid, DEEP * road_map.radius
    is_deep = clearance(grid, *start, deep) < deep
    for ignored in (0.0, deep) if is_deep else (0.0,):
        begin = sources(grid, start, road_map.radius, ignored)
        length, path = search(road_map.roads, begin, ignored, goal, turning, most, raster.place, cells)
        while length == FULL:
            road_map.widen()
            length, path = search(road_map.roads, begin, ignored, goal, turning, most, raster.place, cells)
        if length != NONE:
            break
    if len(path) and tuple(path[0]) != start:  # it set out from a place aside
        path = np.vstack([start, path])
        if not cells.size:
            path = pulled(grid, path, road_map.radius - LINK, ignored)
            length = float(np.hypot(*np.diff(path, axis=0).T).sum())
    return length, path


def points(path: np.ndarray) -> tuple[Point, ...]:
    """A path as points, without its first."""
    return tuple((x, y) for x, y in path[1:].tolist())


@kernel
def all_known(cells, place, path):
    """Whether a path keeps to known ground."""
    for k in range(len(path) - 1):
        if not is_known(cells, place, path[k, 0], path[k, 1], path[k + 1, 0], path[k + 1, 1]):
            return False
    return True
