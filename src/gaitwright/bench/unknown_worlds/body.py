"""A disc among obstacles: how far it gets along a straight line before it touches, exactly; compiled."""

import math

from gaitwright.bench.unknown_worlds.segments import point_to_piece
from gaitwright.numerics.compiled import kernel

HAIR = 1e-9
"""A disc that is so near to touching touches [m]."""


@kernel
def advance(edges, x, y, toward, most, room):
    """How far a point gets in a direction [rad] before it is nearer than `room` to an edge [m], at most
    `most`.

    A point that is as near already goes on where that takes it no nearer.
    """
    ux, uy = math.cos(toward), math.sin(toward)
    free = most
    for k in range(len(edges)):
        ax, ay, bx, by = edges[k, 0], edges[k, 1], edges[k, 2], edges[k, 3]
        if min(ax, bx) - room > x + max(most * ux, 0.0) or max(ax, bx) + room < x + min(most * ux, 0.0):
            continue
        if min(ay, by) - room > y + max(most * uy, 0.0) or max(ay, by) + room < y + min(most * uy, 0.0):
            continue
        if point_to_piece(x, y, ax, ay, bx, by) <= room + HAIR:
            if approaches(x, y, ux, uy, ax, ay, bx, by):
                return 0.0
            continue
        dx, dy = bx - ax, by - ay
        long = math.hypot(dx, dy)
        nx, ny = -dy / long, dx / long
        free = min(free, entry(ax - x, ay - y, ux, uy, room))
        free = min(free, entry(bx - x, by - y, ux, uy, room))
        off, speed = (x - ax) * nx + (y - ay) * ny, ux * nx + uy * ny
        if off * speed < 0.0 and abs(off) > room:
            t = (abs(off) - room) / abs(speed)
            along = ((x + t * ux - ax) * dx + (y + t * uy - ay) * dy) / (long * long)
            if 0.0 <= along <= 1.0:
                free = min(free, t)
    return free


@kernel
def entry(cx, cy, ux, uy, room):
    """Where a ray from the origin enters a disc, or infinity."""
    along = cx * ux + cy * uy
    inside = room * room - (cx * cx + cy * cy - along * along)
    if along <= 0.0 or inside <= 0.0:
        return math.inf
    return max(along - math.sqrt(inside), 0.0)


@kernel
def approaches(x, y, ux, uy, ax, ay, bx, by):
    """Whether a step in a direction leads nearer to a piece."""
    dx, dy = bx - ax, by - ay
    t = min(max(((x - ax) * dx + (y - ay) * dy) / max(dx * dx + dy * dy, 1e-300), 0.0), 1.0)
    return (ax + t * dx - x) * ux + (ay + t * dy - y) * uy > HAIR


@kernel
def touched(edges, x, y):
    """The place on the edges that is nearest to a point [m]."""
    best, px, py = math.inf, x, y
    for k in range(len(edges)):
        ax, ay = edges[k, 0], edges[k, 1]
        dx, dy = edges[k, 2] - ax, edges[k, 3] - ay
        t = min(max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0), 1.0)
        away = math.hypot(ax + t * dx - x, ay + t * dy - y)
        if away < best:
            best, px, py = away, ax + t * dx, ay + t * dy
    return px, py
