"""Distances between points and straight pieces in the plane, compiled; a piece is x0, y0, x1, y1 [m]."""

import math

from gaitwright.numerics.compiled import kernel


@kernel
def point_to_piece(x, y, ax, ay, bx, by):
    """Distance of a point from a piece [m]."""
    dx, dy = bx - ax, by - ay
    long = dx * dx + dy * dy
    t = 0.0
    if long > 0.0:
        t = min(max(((x - ax) * dx + (y - ay) * dy) / long, 0.0), 1.0)
    return math.hypot(x - ax - t * dx, y - ay - t * dy)


@kernel
def crosses(ax, ay, bx, by, cx, cy, dx, dy):
    """Whether two pieces cross, each properly inside the other."""
    a = (dx - cx) * (ay - cy) - (dy - cy) * (ax - cx)
    b = (dx - cx) * (by - cy) - (dy - cy) * (bx - cx)
    c = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    d = (bx - ax) * (dy - ay) - (by - ay) * (dx - ax)
    return ((a > 0.0) != (b > 0.0)) and ((c > 0.0) != (d > 0.0))


@kernel
def piece_to_piece(ax, ay, bx, by, cx, cy, dx, dy):
    """Distance between two pieces [m]."""
    if crosses(ax, ay, bx, by, cx, cy, dx, dy):
        return 0.0
    return min(
        point_to_piece(ax, ay, cx, cy, dx, dy),
        point_to_piece(bx, by, cx, cy, dx, dy),
        point_to_piece(cx, cy, ax, ay, bx, by),
        point_to_piece(dx, dy, ax, ay, bx, by),
    )


@kernel
def clearance(pieces, x, y):
    """Distance of a point from the nearest piece [m]."""
    nearest = math.inf
    for k in range(len(pieces)):
        nearest = min(nearest, point_to_piece(x, y, pieces[k, 0], pieces[k, 1], pieces[k, 2], pieces[k, 3]))
    return nearest


@kernel
def is_clear(pieces, ax, ay, bx, by, room):
    """Whether a straight line keeps at least `room` [m] from every piece."""
    left, right = min(ax, bx) - room, max(ax, bx) + room
    low, high = min(ay, by) - room, max(ay, by) + room
    for k in range(len(pieces)):
        cx, cy, dx, dy = pieces[k, 0], pieces[k, 1], pieces[k, 2], pieces[k, 3]
        if max(cx, dx) < left or min(cx, dx) > right or max(cy, dy) < low or min(cy, dy) > high:
            continue
        if piece_to_piece(ax, ay, bx, by, cx, cy, dx, dy) < room:
            return False
    return True


@kernel
def is_way_clear(pieces, points, room):
    """Whether the line through all points keeps at least `room` [m] from every piece."""
    for k in range(len(points) - 1):
        if not is_clear(pieces, points[k, 0], points[k, 1], points[k + 1, 0], points[k + 1, 1], room):
            return False
    return True
