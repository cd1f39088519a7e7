"""The shortest way of a disc that knows everything, from below and from above.

Around corners a disc's middle goes in arcs. Chords cut through them and tangents go around them: with
polygons whose corners lie on the arcs a shortest way is too short, with polygons whose edges touch the arcs
it is too long, and the truth lies between. In each a shortest way leads over convex corners, along lines that
touch in both ends, so A* over those (Lozano-Pérez and Wesley 1979, tangents only) is exact.
"""

import math
from typing import NamedTuple

import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.bench.unknown_worlds.heap import drop, push
from gaitwright.bench.unknown_worlds.oracle import grown
from gaitwright.bench.unknown_worlds.segments import crosses
from gaitwright.bench.unknown_worlds.world import RADIUS, Point, World, edges_of
from gaitwright.numerics.compiled import kernel

QUARTER = 8
"""Chords of a quarter circle."""
HAIR = 1e-7
"""Lines are tried among obstacles that are smaller by this [m], so that one may run along them."""
TOUCHES = 1e-9
"""A line touches a corner if both its neighbours are on one side, or nearer to the line than this [m]."""


class Optimum(NamedTuple):
    """Length of the shortest way [m]; infinite where there is none."""

    lower: float
    upper: float


def optimum(world: World, start: Point | None = None, goal: Point | None = None) -> Optimum:
    """Bounds of the shortest way of the disc."""
    around = RADIUS / math.cos(math.pi / (4.0 * QUARTER))
    ends = (start or world.start, goal or world.goal)
    return Optimum(*(shortest(world, radius, *ends) for radius in (RADIUS, around)))


def shortest(world: World, radius: float, start: Point, goal: Point) -> float:
    """Length of the shortest way [m] among obstacles grown to polygons with corners on arcs of a radius."""
    edges = edges_of(grown(world, radius - HAIR, QUARTER))
    return way_among(grown(world, radius, QUARTER), edges, start, goal)[0]


def shortest_way(world: World) -> Float[np.ndarray, "m 2"]:
    """Points of the way whose length is the lower bound [m]; none where there is none."""
    edges = edges_of(grown(world, RADIUS - HAIR, QUARTER))
    return way_among(grown(world, RADIUS, QUARTER), edges, world.start, world.goal)[1]


def way_among(
    solid: shapely.Geometry, edges: Float[np.ndarray, "n 4"], start: Point, goal: Point
) -> tuple[float, Float[np.ndarray, "m 2"]]:
    """Length [m] and points of the shortest way over convex corners of what is solid that crosses no edge."""
    ends = np.array([[*start, *start, *start], [*goal, *goal, *goal]])
    nodes = np.vstack([ends, convex_corners(solid)])
    length, before = search(nodes, edges)
    if math.isinf(length):
        return math.inf, np.empty((0, 2))
    along = [1]
    while along[-1]:
        along.append(int(before[along[-1]]))
    return float(length), nodes[along[::-1], :2]


def convex_corners(solid: shapely.Geometry) -> Float[np.ndarray, "n 6"]:
    """Corners of polygons at which they are convex: place, the one before, the one after [m]."""
    found = []
    for part in shapely.get_parts(solid):
        oriented = shapely.orient_polygons(part)
        for ring in (oriented.exterior, *oriented.interiors):
            here = shapely.get_coordinates(ring)[:-1]
            before, after = np.roll(here, 1, axis=0), np.roll(here, -1, axis=0)
            came, goes = here - before, after - here
            convex = came[:, 0] * goes[:, 1] - came[:, 1] * goes[:, 0] > 0.0
            found.append(np.hstack([here, before, after])[convex])
    return np.vstack([np.empty((0, 6)), *found])


# --- compiled --------------------------------------------------------------------------------------
@kernel
def search(nodes, edges):
    """Length of the shortest way from node 0 to node 1 [m], or infinity; the node before each node on it."""
    size = len(nodes)
    g, done, before = np.full(size, math.inf), np.zeros(size, np.bool_), np.zeros(size, np.int64)
    heap, place, f = np.empty(size, np.int64), np.full(size, -1), np.full(size, math.inf)
    g[0] = f[0] = 0.0
    count = push(heap, place, f, f, 0, 0)
    while count > 0:
        here = heap[0]
        count = drop(heap, place, f, f, count, here)
        if here == 1:
            break
        done[here] = True
        for there in range(1, size):
            if done[there]:
                continue
            dx, dy = nodes[there, 0] - nodes[here, 0], nodes[there, 1] - nodes[here, 1]
            away = math.hypot(dx, dy)
            if away == 0.0 or g[here] + away >= g[there]:
                continue
            if not (
                is_touched(nodes, here, dx / away, dy / away)
                and is_touched(nodes, there, dx / away, dy / away)
            ):
                continue
            if not is_free(edges, nodes, here, there):
                continue
            g[there], before[there] = g[here] + away, here
            f[there] = g[there] + math.hypot(nodes[1, 0] - nodes[there, 0], nodes[1, 1] - nodes[there, 1])
            count = push(heap, place, f, f, count, there)
    return g[1], before


@kernel
def is_touched(nodes, node, ux, uy):
    """Whether a line through a corner in a direction leaves both its neighbours on one side."""
    x, y = nodes[node, 0], nodes[node, 1]
    before = ux * (nodes[node, 3] - y) - uy * (nodes[node, 2] - x)
    after = ux * (nodes[node, 5] - y) - uy * (nodes[node, 4] - x)
    return (before <= TOUCHES and after <= TOUCHES) or (before >= -TOUCHES and after >= -TOUCHES)


@kernel
def is_free(edges, nodes, here, there):
    """Whether the line between two nodes crosses no edge."""
    ax, ay, bx, by = nodes[here, 0], nodes[here, 1], nodes[there, 0], nodes[there, 1]
    left, right, low, high = min(ax, bx), max(ax, bx), min(ay, by), max(ay, by)
    for k in range(len(edges)):
        cx, cy, dx, dy = edges[k, 0], edges[k, 1], edges[k, 2], edges[k, 3]
        if max(cx, dx) < left or min(cx, dx) > right or max(cy, dy) < low or min(cy, dy) > high:
            continue
        if crosses(ax, ay, bx, by, cx, cy, dx, dy):
            return False
    return True
