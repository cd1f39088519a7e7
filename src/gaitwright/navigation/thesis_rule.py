"""The thesis's own rule (6.2): over the map where it is known, along the obstacles' edges where it is blank.

The text says: go towards the goal until an obstacle is faced; go to a vertex of the edge that is faced; go on
from there in the same way; where the map is known take the shortest path on it. Read into it was: of an
edge's two ends the one with the shorter way round is taken, but one that the robot goes alongside is not
turned back on; vertices where this trip has been are left out; where both ends are, the nearest other vertex
comes next (depth first); the whole course over what is known now is said at once; and what ends
is the search, not the walk: where no way is left even if all that is unknown were free, there is none.
"""

import math

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.navigation.lazy_search import NONE
from gaitwright.navigation.own_place import Point
from gaitwright.navigation.path_check import crossed
from gaitwright.navigation.planning import ANYWHERE, Way, best_way, points, shortest
from gaitwright.navigation.raster import Raster
from gaitwright.navigation.roads import RoadMap
from gaitwright.navigation.tolerances import HALF_STEP, LINK, NODE

BEEN = 0.05
"""A vertex nearer than this to where the robot walked was visited [m]."""
BESIDE = 3.0
"""A robot goes alongside an edge that is nearer than so many radii."""
MOST = 400
"""A course has no more vertices than this."""

Trail = tuple[Point, ...]
"""Where this trip has been [m]."""


def thesis_way(road_map: RoadMap, raster: Raster, trail: Trail, start: Point, goal: Point) -> Way | None:
    """The way by the thesis's rule; its length is not the least that there may be."""
    best = best_way(road_map, raster, start, goal)
    if best is None or len(best.path) == 1:
        return best
    length, path = shortest(road_map, start, goal, math.inf, raster, raster.cells)
    if length != NONE:
        return Way(points(path), length, True, best.optimistic)
    course = by_edges(road_map, raster, trail, start, goal)
    if course is None:
        return best
    whole = np.array([start, *course])
    return Way(course, float(np.hypot(*np.diff(whole, axis=0).T).sum()), False, best.optimistic)


def by_edges(
    road_map: RoadMap, raster: Raster, trail: Trail, start: Point, goal: Point
) -> tuple[Point, ...] | None:
    """From vertex to vertex of the edges that are faced, until the goal is; `None` where none is left."""
    nodes = road_map.roads.nodes.at[:, :2]
    been = visited(nodes, np.array([*trail, start]))
    here, course, ahead = start, [], heading_of(trail, start)
    for _ in range(MOST):
        edge = faced(road_map, here, goal)
        if edge is None:
            return (*course, goal)
        leg = leg_on(road_map, raster, here, goal, chosen(road_map, been, edge, here, ahead))
        if leg is None:
            leg = leg_on(road_map, raster, here, goal, by_distance(nodes, been, here), first=True)
        if leg is None:
            return None
        course += leg
        been |= visited(nodes, np.array([here, *leg]))
        ahead = (leg[-1][0] - here[0], leg[-1][1] - here[1])
        here = leg[-1]
    return None


def heading_of(trail: Trail, start: Point) -> Point | None:
    """In which direction the robot came, if it walked."""
    came = [place for place in trail if math.dist(place, start) > BEEN]
    return (start[0] - came[-1][0], start[1] - came[-1][1]) if came else None


def visited(nodes: Float[np.ndarray, "n 2"], trail: Float[np.ndarray, "m 2"]) -> Bool[np.ndarray, " n"]:
    """At which nodes a trip has been."""
    path = trail if len(trail) > 1 else np.vstack([trail, trail])
    return crossed(np.hstack([nodes, nodes]), path, BEEN)


def faced(road_map: RoadMap, here: Point, goal: Point) -> Float[np.ndarray, "4"] | None:
    """The edge that stands first in the straight way to the goal, if one does."""
    pieces = road_map.roads.grid.pieces
    hit = pieces[crossed(pieces, np.array([here, goal]), road_map.radius - LINK)]
    if not len(hit):
        return None
    towards = np.array(goal) - here
    towards /= max(float(np.hypot(*towards)), 1e-12)
    along = (hit.reshape(-1, 2, 2) - here) @ towards
    return hit[np.argmin(np.maximum(along, 0.0).min(axis=1))]


def chosen(
    road_map: RoadMap,
    been: Bool[np.ndarray, " n"],
    edge: Float[np.ndarray, "4"],
    here: Point,
    ahead: Point | None,
) -> Int[np.ndarray, " k"]:
    """Nodes around the ends of an edge where the trip has not been; alongside it only those ahead."""
    nodes = road_map.roads.nodes.at
    away = (road_map.radius + NODE) / math.cos(HALF_STEP) + NODE
    ends = edge.reshape(2, 2)
    around = np.hypot(*np.moveaxis(nodes[:, None, :2] - ends, -1, 0)) <= away
    left = np.flatnonzero(around.any(axis=1) & ~been)
    is_beside = crossed(edge[None], np.array([here, here]), BESIDE * road_map.radius)[0]
    if ahead is None or not is_beside:
        return left
    onwards = left[(nodes[left, :2] - here) @ np.array(ahead) > 0.0]
    return onwards if len(onwards) else left


def by_distance(
    nodes: Float[np.ndarray, "n 2"], been: Bool[np.ndarray, " n"], here: Point
) -> Int[np.ndarray, " k"]:
    """Nodes where the trip has not been, the nearest first."""
    left = np.flatnonzero(~been)
    return left[np.argsort(np.hypot(*(nodes[left] - here).T), kind="stable")]


def leg_on(
    road_map: RoadMap,
    raster: Raster,
    here: Point,
    goal: Point,
    nodes: Int[np.ndarray, " k"],
    first: bool = False,
) -> list[Point] | None:
    """Points of the way to that one of some nodes over which the way to the goal seems shortest, or to the
    `first` that there is a way to."""
    best, leg = math.inf, None
    for x, y in road_map.roads.nodes.at[nodes, :2].tolist():
        length, path = shortest(road_map, here, (x, y), math.inf, raster, ANYWHERE)
        if length != NONE and length + math.dist((x, y), goal) < best and len(path) > 1:
            best, leg = length + math.dist((x, y), goal), list(points(path))
            if first:
                break
    return leg
