"""A plane world for tests: polygons, exact sights by casting rays, a disc that walks, and oracles by shapely.

It shares no code with the map: rays in NumPy, free space and shortest paths by shapely and scipy.
"""

import math
from dataclasses import dataclass, field

import numpy as np
import shapely
from scipy.sparse.csgraph import dijkstra
from shapely import LineString, Point, Polygon

from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.signals import Sight

RADIUS = 0.16
WIDER = RADIUS / math.cos(math.radians(15.0))
ALL_ROUND = 2.0 * math.pi


def ring_edges(polygons) -> np.ndarray:
    """x0, y0, x1, y1 of every edge."""
    rings = [np.array(ring, dtype=float) for ring in polygons]
    return np.concatenate([np.empty((0, 4)), *(np.hstack([r, np.roll(r, -1, axis=0)]) for r in rings)])


def fence_edges(bounds) -> np.ndarray:
    x0, y0, x1, y1 = bounds
    return ring_edges([[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]])


def look(edges: np.ndarray, eye, heading=0.0, view=ALL_ROUND, reach=3.0) -> Sight:
    """What is truly seen of edges from a place: rays every 2° and to both sides of every edge's end."""
    eye = np.array(eye, dtype=float)
    edges = edges[points_apart(eye[None], edges)[0] < reach]
    ends = edges.reshape(-1, 2) - eye
    at = np.arctan2(ends[:, 1], ends[:, 0])
    angles = np.concatenate(
        [at - 1e-7, at, at + 1e-7, heading + np.arange(-view / 2, view / 2, math.radians(2))]
    )
    off = np.sort((angles - heading + math.pi) % (2 * math.pi) - math.pi)
    off = off[np.abs(off) <= view / 2]
    if view < ALL_ROUND:
        off = np.concatenate([[-view / 2], off, [view / 2]])
    rays = np.stack([np.cos(heading + off), np.sin(heading + off)], axis=1)
    far, hit = cast(edges, eye, rays, reach)
    rim = eye + far[:, None] * rays
    pieces, corners = seen_pieces(edges, rim, hit)
    if view < ALL_ROUND:
        rim = np.vstack([eye, rim])
    return Sight((float(eye[0]), float(eye[1])), pieces, corners, rim)


def cast(edges, eye, rays, reach):
    """Distance of the first edge along each ray, and which; -1: none within reach."""
    if not len(edges):
        return np.full(len(rays), reach), np.full(len(rays), -1)
    a, d = edges[:, :2] - eye, edges[:, 2:] - edges[:, :2]
    cross = rays[:, None, 0] * d[None, :, 1] - rays[:, None, 1] * d[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (a[:, 0] * d[:, 1] - a[:, 1] * d[:, 0])[None] / cross
        t = (a[None, :, 0] * rays[:, None, 1] - a[None, :, 1] * rays[:, None, 0]) / cross
    s = np.where((np.abs(cross) > 1e-15) & (t >= -1e-9) & (t <= 1 + 1e-9) & (s >= 0.0), s, np.inf)
    hit = s.argmin(axis=1)
    far = s[np.arange(len(rays)), hit]
    return np.minimum(far, reach), np.where(far < reach, hit, -1)


def seen_pieces(edges, rim, hit):
    """Runs of neighbouring rays that hit one edge; an end near the edge's end is that corner."""
    pieces, corners = [], []
    first = 0
    for k in range(1, len(hit) + 1):
        if k == len(hit) or hit[k] != hit[first]:
            if hit[first] >= 0 and k - first > 1:
                piece = np.concatenate([rim[first], rim[k - 1]])
                is_corner = [False, False]
                for end in (0, 1):
                    for true in (edges[hit[first], :2], edges[hit[first], 2:]):
                        if math.dist(piece[2 * end : 2 * end + 2], true) < 1e-4:
                            piece[2 * end : 2 * end + 2], is_corner[end] = true, True
                if math.dist(piece[:2], piece[2:]) > 1e-6:
                    pieces.append(piece)
                    corners.append(is_corner)
            first = k
    return np.array(pieces).reshape(-1, 4), np.array(corners, dtype=bool).reshape(-1, 2)


# --- a disc that walks -----------------------------------------------------------------------------
@dataclass
class Trip:
    """What came of a trip."""

    arrived: bool
    learned: LearnedMap
    walked: list = field(default_factory=list)
    plans: int = 0
    ways: list = field(default_factory=list)
    contacts: int = 0

    @property
    def length(self) -> float:
        return float(LineString(self.walked).length) if len(self.walked) > 1 else 0.0


def walk(edges, learned: LearnedMap, start, goal, view=ALL_ROUND, reach=3.0, step=0.3, noise=None) -> Trip:
    """Walks by a map: looks every `step` [m], feels what it touches; ends at the goal or at `None`."""
    here, heading = np.array(start, dtype=float), math.atan2(goal[1] - start[1], goal[0] - start[0])
    trip = Trip(False, learned, [tuple(start)])
    path: tuple = ()
    for _ in range(4000):
        sight = look(edges, here, heading, view, reach)
        if noise is not None:
            sight = sight._replace(
                pieces=sight.pieces + noise.normal(0.0, 0.01, sight.pieces.shape).clip(-0.02, 0.02)
            )
        trip.learned = trip.learned.seen(sight)
        place = (float(here[0]), float(here[1]))
        if not path or trip.learned.is_cut((place, *path)):
            way = trip.learned.way(place, goal)
            trip.plans += 1
            trip.ways.append((place, way))
            if way is None:
                return trip
            path = way.path
        target = np.array(path[0])
        leg = target - here
        far = math.hypot(*leg)
        if far > 1e-12:
            heading = math.atan2(leg[1], leg[0])
            free = room_ahead(edges, here, leg / far, min(step, far))
            here = here + leg / far * free
            trip.walked.append((float(here[0]), float(here[1])))
            if free < min(step, far) - 1e-9:
                trip.contacts += 1
                touched = nearest_on(edges, here + leg / far * 1e-3)
                direction = math.atan2(touched[1] - here[1], touched[0] - here[0])
                trip.learned = trip.learned.felt((float(here[0]), float(here[1])), direction)
                path = ()
                continue
        if math.dist(here, target) < 1e-9:
            path = path[1:]
            if not path:
                trip.arrived = True
                trip.learned = trip.learned.walked(trip.walked)
                return trip
    raise AssertionError("it walks for ever")


def room_ahead(edges, here, direction, most) -> float:
    """How far a disc may go before it is nearer than r - 0.5 mm to an edge, and nearer than it began."""
    own = points_apart(here[None], edges)[0]
    near = own < most + RADIUS
    edges, room = edges[near], np.minimum(RADIUS - 5e-4, own[near] - 1e-9)

    def is_free(far: float) -> bool:
        return bool((lines_apart(here, here + direction * far, edges) >= room).all())

    if is_free(most):
        return most
    low, high = 0.0, most
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_free(middle) else (low, middle)
    return low


def points_apart(points, edges) -> np.ndarray:
    """Distance of every point from every edge."""
    a, d = edges[None, :, :2], edges[None, :, 2:] - edges[None, :, :2]
    away = points[:, None] - a
    t = np.clip((away * d).sum(-1) / np.maximum((d * d).sum(-1), 1e-300), 0.0, 1.0)
    return np.hypot(*np.moveaxis(away - t[..., None] * d, -1, 0))


def lines_apart(a, b, edges) -> np.ndarray:
    """Distance of a line from every edge; 0 where they cross."""
    line = np.concatenate([a, b])[None]
    ends = points_apart(np.stack([a, b]), edges).min(axis=0)
    theirs = points_apart(edges.reshape(-1, 2), line).reshape(-1, 2).min(axis=1)

    def side(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (
            r[..., 0] - p[..., 0]
        )

    p, q = edges[:, :2], edges[:, 2:]
    crosses = (side(a, b, p) * side(a, b, q) < 0.0) & (side(p, q, a) * side(p, q, b) < 0.0)
    return np.where(crosses, 0.0, np.minimum(ends, theirs))


def nearest_on(edges, place):
    """The point of the edges that is nearest to a place."""
    lines = shapely.linestrings(edges.reshape(-1, 2, 2))
    line = np.atleast_1d(lines)[int(np.argmin(shapely.distance(lines, Point(place))))]
    point = line.interpolate(line.project(Point(place)))
    return (point.x, point.y)


# --- oracles ---------------------------------------------------------------------------------------
def free_space(edges, bounds, radius):
    """Where the centre of a disc may be."""
    lines = shapely.linestrings(np.vstack([edges, fence_edges(bounds)]).reshape(-1, 2, 2))
    return shapely.box(*bounds).difference(shapely.union_all(shapely.buffer(lines, radius, quad_segs=64)))


def exists(edges, bounds, start, goal, radius) -> bool:
    """Whether one free space holds both places."""
    free = free_space(edges, bounds, radius)
    parts = getattr(free, "geoms", [free])
    return any(part.covers(Point(start)) and part.covers(Point(goal)) for part in parts)


def shortest(edges, bounds, start, goal, radius, quad_segs=12) -> float:
    """Length of a disc's shortest path by all pairs of the outline's vertices; a little below (chords)."""
    lines = shapely.linestrings(np.vstack([edges, fence_edges(bounds)]).reshape(-1, 2, 2))
    solid = shapely.union_all(shapely.buffer(lines, radius, quad_segs=quad_segs))
    rings = [r for p in getattr(solid, "geoms", [solid]) for r in (p.exterior, *p.interiors)]
    nodes = np.array([start, goal, *(c for ring in rings for c in ring.coords[:-1])])
    shrunk = shapely.union_all(shapely.buffer(lines, radius - 1e-6, quad_segs=quad_segs))
    inside = shapely.contains_xy(shapely.box(*bounds), nodes[:, 0], nodes[:, 1])
    inside[:2] = True
    return over_pairs(nodes[inside], shrunk)


def by_mitred_corners(polygons, bounds, radius, start, goal) -> float:
    """Length of the shortest path by all pairs of corners of outlines that were grown without rounding them
    (beyond 1.5 radii they are cut off): none of a disc is longer. `bounds`: of its middle."""
    mitred = {"join_style": "mitre", "mitre_limit": 1.5}
    grown = shapely.union_all([Polygon(polygon).buffer(radius, **mitred) for polygon in polygons])
    parts = [part for part in getattr(grown, "geoms", [grown]) if not part.is_empty]
    rings = [ring for part in parts for ring in (part.exterior, *part.interiors)]
    nodes = np.array([start, goal, *(corner for ring in rings for corner in ring.coords[:-1])])
    inside = shapely.contains_xy(shapely.box(*bounds), nodes[:, 0], nodes[:, 1])
    return over_pairs(nodes[inside], shapely.union_all([part.buffer(-1e-6) for part in parts]))


def over_pairs(nodes, solid) -> float:
    """Length of the shortest path from the first to the second of some nodes by straight lines that do not
    enter what is solid; every pair is tried."""
    shapely.prepare(solid)
    i, j = np.triu_indices(len(nodes), 1)
    links = np.atleast_1d(shapely.linestrings(np.stack([nodes[i], nodes[j]], axis=1)))
    clear = ~shapely.intersects(solid, links)
    graph = np.zeros((len(nodes), len(nodes)))
    graph[i[clear], j[clear]] = np.maximum(shapely.length(links[clear]), 1e-12)
    return float(dijkstra(graph, directed=False, indices=0)[1])


def clearance_of(edges, points) -> float:
    """Least distance of a path from edges."""
    lines = shapely.linestrings(edges.reshape(-1, 2, 2))
    return float(shapely.distance(lines, LineString(points)).min())


def random_polygons(rng, count, bounds, size=(0.3, 1.2), away=(), room=0.5):
    """Polygons of 3 to 8 corners, some crossing themselves, none near the places to keep away from."""
    out = []
    while len(out) < count:
        k = int(rng.integers(3, 9))
        centre = rng.uniform(bounds[:2], bounds[2:])
        angles = rng.uniform(0.0, 2 * math.pi, k)
        if rng.random() < 0.8:
            angles = np.sort(angles)
        corners = centre + rng.uniform(*size, (k, 1)) * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        hull = Polygon(corners).convex_hull
        if all(hull.distance(Point(place)) > room for place in away):
            out.append([tuple(map(float, c)) for c in corners])
    return out


def maze(rng, cells, room=1.0, thick=0.1, doors=0):
    """Walls of a random maze of `cells` × `cells` rooms, each wall a box that touches others edge to edge;
    so many further walls are left out."""
    open_, seen, stack = set(), {(0, 0)}, [(0, 0)]
    while stack:
        x, y = stack[-1]
        around = [(x + dx, y + dy) for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        new = [c for c in around if min(c) >= 0 and max(c) < cells and c not in seen]
        if not new:
            stack.pop()
            continue
        there = new[int(rng.integers(len(new)))]
        open_.add(frozenset([(x, y), there]))
        seen.add(there)
        stack.append(there)
    pairs = [
        frozenset([(x, y), (x + dx, y + dy)])
        for x in range(cells)
        for y in range(cells)
        for dx, dy in ((1, 0), (0, 1))
        if x + dx < cells and y + dy < cells
    ]
    walls = [pair for pair in pairs if pair not in open_]
    for k in rng.permutation(len(walls))[: len(walls) - doors]:
        (xa, ya), (xb, yb) = sorted(walls[k])
        if xa == xb:
            yield [
                (room * xa, room * yb - thick / 2),
                (room * (xa + 1), room * yb - thick / 2),
                (room * (xa + 1), room * yb + thick / 2),
                (room * xa, room * yb + thick / 2),
            ]
        else:
            yield [
                (room * xb - thick / 2, room * ya),
                (room * xb + thick / 2, room * ya),
                (room * xb + thick / 2, room * (ya + 1)),
                (room * xb - thick / 2, room * (ya + 1)),
            ]


def box_at(x, y, lx, ly, yaw=0.0):
    """Corners of a box by its centre, sides and angle."""
    c, s = math.cos(yaw), math.sin(yaw)
    corners = [(-lx / 2, -ly / 2), (lx / 2, -ly / 2), (lx / 2, ly / 2), (-lx / 2, ly / 2)]
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in corners]


def turned(points, angle, about=(0.0, 0.0)):
    """Points turned about a place."""
    c, s = math.cos(angle), math.sin(angle)
    return [
        (
            about[0] + c * (x - about[0]) - s * (y - about[1]),
            about[1] + s * (x - about[0]) + c * (y - about[1]),
        )
        for x, y in points
    ]
