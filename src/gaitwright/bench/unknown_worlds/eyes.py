"""World + eye → Sight: exactly what is in view, what is hidden, and where each seen piece ends.

Between two directions in which an edge begins, ends, or leaves the range, one edge is the nearest: it is
asked for once, halfway. Edges meet in their ends only (`World.edges`), so no other direction matters.
"""

import math
from dataclasses import dataclass

import numpy as np

from gaitwright.bench.unknown_worlds.segments import point_to_piece
from gaitwright.bench.unknown_worlds.world import Point, World
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import Sight

SAME_ANGLE = 1e-7
"""No camera tells nearer directions apart [rad]: nothing is seen through a slit of 1 nm."""
SAME_PLACE = 1e-6
"""Ends nearer to each other than this are one [m]."""
ARC = 0.1
"""Where nothing is in range the rim has a point so often [rad]."""
NOTHING, OUT_OF_VIEW = -1, -2
"""In place of an edge's number."""
SIGMA, DROPPED = 0.02, 0.3
"""Noise: pieces are moved so far [m], and such a share of them is not recognised."""


@dataclass(frozen=True)
class Camera:
    """What an eye reaches."""

    range: float = 3.0
    """[m]"""
    view: float = math.pi / 2.0
    """The whole angle [rad]; 2π sees all round."""


def look(world: World, eye: Point, heading: float, camera: Camera) -> Sight:
    """What there is to see from a place in a direction [rad]."""
    half = min(camera.view / 2.0, math.pi)
    pieces, corners, rim = seen_from(world.edges, *map(float, eye), float(heading), half, float(camera.range))
    return Sight(eye, pieces, corners, rim)


def blurred(sight: Sight, rng: np.random.Generator) -> Sight:
    """The same look by a camera with noise: what is not recognised leaves its free ground as it was."""
    kept = rng.random(len(sight.pieces)) >= DROPPED
    moved = sight.pieces[kept] + np.tile(rng.normal(0.0, SIGMA, (int(kept.sum()), 2)), 2)
    return sight._replace(pieces=moved, corners=sight.corners[kept])


# --- compiled --------------------------------------------------------------------------------------
@kernel
def seen_from(edges, x, y, heading, half, reach):
    """Seen pieces, whether their ends are corners, and the rim of the free star."""
    near = edges_near(edges, x, y, reach)
    limits = directions(near, heading, half, reach)
    starts, ends, which = intervals(near, limits, heading, reach, half >= math.pi)
    pieces, corners = pieces_of(near, starts, ends, which, half >= math.pi)
    pieces[:, 0] += x
    pieces[:, 1] += y
    pieces[:, 2] += x
    pieces[:, 3] += y
    return pieces, corners, rim_of(near, starts, ends, which, (x, y, reach, half))


@kernel
def edges_near(edges, x, y, reach):
    """Edges within reach, seen from the eye as origin."""
    near = np.empty((len(edges), 4))
    n = 0
    for k in range(len(edges)):
        if point_to_piece(x, y, edges[k, 0], edges[k, 1], edges[k, 2], edges[k, 3]) < reach:
            near[n, 0], near[n, 1] = edges[k, 0] - x, edges[k, 1] - y
            near[n, 2], near[n, 3] = edges[k, 2] - x, edges[k, 3] - y
            n += 1
    return near[:n]


@kernel
def turned(angle):
    """An angle within −π … π."""
    return angle - 2.0 * math.pi * round(angle / (2.0 * math.pi))


@kernel
def directions(near, heading, half, reach):
    """Directions between which one edge is the nearest, ordered [rad]; from the heading, within view."""
    found = np.empty(4 * len(near) + 2)
    found[0], found[1] = -half, half
    n = 2
    for k in range(len(near)):
        ax, ay = near[k, 0], near[k, 1]
        dx, dy = near[k, 2] - ax, near[k, 3] - ay
        a, b, c = dx * dx + dy * dy, ax * dx + ay * dy, ax * ax + ay * ay - reach * reach
        root = math.sqrt(max(b * b - a * c, 0.0))
        for t in (0.0, 1.0, (-b - root) / a, (-b + root) / a):
            if 0.0 <= t <= 1.0:
                angle = turned(math.atan2(ay + t * dy, ax + t * dx) - heading)
                if abs(angle) < half:
                    found[n] = angle
                    n += 1
    found = np.sort(found[:n])
    kept = 1
    for k in range(1, n):
        if found[k] - found[kept - 1] > SAME_ANGLE:
            found[kept] = found[k]
            kept += 1
    return found[:kept]


@kernel
def nearest(near, angle, reach):
    """The edge that a ray in a direction meets first, or NOTHING."""
    ux, uy = math.cos(angle), math.sin(angle)
    best, which = reach, NOTHING
    for k in range(len(near)):
        ax, ay = near[k, 0], near[k, 1]
        dx, dy = near[k, 2] - ax, near[k, 3] - ay
        across = ux * dy - uy * dx
        if across == 0.0:
            continue
        t = (ax * dy - ay * dx) / across
        s = (ax * uy - ay * ux) / across
        if 0.0 < t < best and 0.0 <= s <= 1.0:
            best, which = t, k
    return which


@kernel
def intervals(near, limits, heading, reach, is_round):
    """First and last direction [rad] of each stretch in which one edge, or NOTHING, is nearest; and which."""
    starts, ends = np.empty(len(limits)), np.empty(len(limits))
    which = np.empty(len(limits), np.int64)
    n = 0
    for k in range(len(limits) - 1):
        a, b = heading + limits[k], heading + limits[k + 1]
        edge = nearest(near, 0.5 * (a + b), reach)
        if n > 0 and which[n - 1] == edge:
            ends[n - 1] = b
        else:
            starts[n], ends[n], which[n] = a, b, edge
            n += 1
    if is_round and n > 1 and which[0] == which[n - 1]:
        n -= 1
        starts[0] = starts[n] - 2.0 * math.pi
    return starts[:n], ends[:n], which[:n]


@kernel
def met(edge, angle):
    """Where a ray in a direction meets an edge [m], and 0, 1 where that is its first or last end, else −1."""
    ax, ay = edge[0], edge[1]
    dx, dy = edge[2] - ax, edge[3] - ay
    ux, uy = math.cos(angle), math.sin(angle)
    across = ux * dy - uy * dx
    s = 0.0 if across == 0.0 else min(max((ax * uy - ay * ux) / across, 0.0), 1.0)
    long = math.hypot(dx, dy)
    if s * long < SAME_PLACE:
        return ax, ay, 0
    if (1.0 - s) * long < SAME_PLACE:
        return edge[2], edge[3], 1
    return ax + s * dx, ay + s * dy, -1


@kernel
def pieces_of(near, starts, ends, which, is_round):
    """The seen pieces, from the eye, and whether their ends are corners."""
    pieces, corners = np.empty((len(which), 4)), np.zeros((len(which), 2), np.bool_)
    last, n = len(which) - 1, 0
    for k in range(len(which)):
        if which[k] < 0:
            continue
        before = which[k - 1] if k > 0 else which[last] if is_round else OUT_OF_VIEW
        after = which[k + 1] if k < last else which[0] if is_round else OUT_OF_VIEW
        ax, ay, first = met(near[which[k]], starts[k])
        bx, by, second = met(near[which[k]], ends[k])
        if math.hypot(bx - ax, by - ay) < SAME_PLACE:
            continue
        pieces[n, 0], pieces[n, 1], pieces[n, 2], pieces[n, 3] = ax, ay, bx, by
        corners[n, 0] = first >= 0 and is_free_beyond(near, before, starts[k], ax, ay, ax - bx, ay - by)
        corners[n, 1] = second >= 0 and is_free_beyond(near, after, ends[k], bx, by, bx - ax, by - ay)
        n += 1
    return pieces[:n], corners[:n]


@kernel
def is_free_beyond(near, other, angle, x, y, ux, uy):
    """Whether free ground is seen where a piece that ends in (x, y) would go on, along (ux, uy)."""
    if other == OUT_OF_VIEW:
        return False
    if other == NOTHING:
        return True
    px, py, end = met(near[other], angle)
    farther = math.hypot(px, py) - math.hypot(x, y)
    if abs(farther) > SAME_PLACE or end < 0:
        return farther > 0.0
    vx, vy = near[other, 2] - near[other, 0], near[other, 3] - near[other, 1]
    if end == 1:
        vx, vy = -vx, -vy
    beyond = (vx * uy - vy * ux) / (math.hypot(vx, vy) * math.hypot(ux, uy))
    return abs(beyond) > SAME_PLACE and (beyond > 0.0) == (vy * px - vx * py > 0.0)


@kernel
def rim_of(near, starts, ends, which, place):
    """Rim of the star that is seen to be free [m]; chords of the range's circle lie within it."""
    x, y, reach, half = place
    rim = np.empty((2 * len(which) + int(2.0 * half / ARC) + len(which) + 2, 2))
    n = 0
    if half < math.pi:
        rim[0, 0], rim[0, 1] = x, y
        n = 1
    for k in range(len(which)):
        parts = 1 if which[k] >= 0 else int((ends[k] - starts[k]) / ARC) + 1
        for part in range(parts + 1):
            angle = starts[k] + (ends[k] - starts[k]) * part / parts
            px, py = x + reach * math.cos(angle), y + reach * math.sin(angle)
            if which[k] >= 0:
                px, py, _ = met(near[which[k]], angle)
                px, py = x + px, y + py
            if n == 0 or math.hypot(px - rim[n - 1, 0], py - rim[n - 1, 1]) > SAME_PLACE:
                rim[n, 0], rim[n, 1] = px, py
                n += 1
    if math.hypot(rim[n - 1, 0] - rim[0, 0], rim[n - 1, 1] - rim[0, 1]) < SAME_PLACE:
        n -= 1
    return rim[:n]
