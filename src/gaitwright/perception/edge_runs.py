"""Points on walls, sector by sector around an eye → pieces of edges and their corners.

Walls of neighbouring sectors that leave no room for a robot between them are one run, which is broken where
it bends: what was hit becomes a piece, nothing is imagined.
"""

import math

import numpy as np

from gaitwright.numerics.compiled import kernel

SECTORS = 120
"""Around the eye; none is narrower than two pixels of a usual camera."""
WALL, FREE, LEVEL, STOPPED = 0, 1, 2, 3
"""Of a sector: distance of its nearest wall, how far it is free, the height there [m]; whether it ended."""
NEAREST, RIGHT, LEFT = 0, 1, 2
"""Its points on the wall: in the middle, and at either end."""


@kernel
def follows(sectors, points, s, narrow):
    """Whether the walls of a sector and of the next one leave no room between them."""
    t = (s + 1) % SECTORS
    if not (sectors[s, WALL] < math.inf and sectors[t, WALL] < math.inf):
        return False
    dx = points[t, RIGHT, 0] - points[s, LEFT, 0]
    dy = points[t, RIGHT, 1] - points[s, LEFT, 1]
    return math.hypot(dx, dy) <= narrow


@kernel
def off_chord(line, a, b, k):
    """Distance of point k of a line from its chord from point a to b."""
    dx, dy = line[b, 0] - line[a, 0], line[b, 1] - line[a, 1]
    px, py = line[k, 0] - line[a, 0], line[k, 1] - line[a, 1]
    along = min(max((px * dx + py * dy) / max(dx * dx + dy * dy, 1e-300), 0.0), 1.0)
    return math.hypot(px - along * dx, py - along * dy)


@kernel
def kept_points(line, count, bent, kept):
    """Marks the points of a line that its chords need to keep within `bent` (Douglas and Peucker 1973)."""
    kept[:count] = False
    kept[0] = kept[count - 1] = True
    stack, top = np.empty((count + 1, 2), np.int64), 1
    stack[0, 0], stack[0, 1] = 0, count - 1
    while top > 0:
        top -= 1
        a, b = stack[top, 0], stack[top, 1]
        worst, most = a, bent
        for k in range(a + 1, b):
            off = off_chord(line, a, b, k)
            if off > most:
                worst, most = k, off
        if worst > a:
            kept[worst] = True
            stack[top, 0], stack[top, 1] = a, worst
            stack[top + 1, 0], stack[top + 1, 1] = worst, b
            top += 2


@kernel
def seen_past(sectors, points, eye, s, end, t):
    """Whether free ground was seen in sector t beyond the end of the wall in sector s beside it."""
    away = math.hypot(points[s, end, 0] - eye[0], points[s, end, 1] - eye[1])
    return min(sectors[t, FREE], sectors[t, WALL]) > away


@kernel
def turns_away(line, a, b, c):
    """Whether a line around the eye bends away from it in b: a corner that stands out."""
    return (line[b, 0] - line[a, 0]) * (line[c, 1] - line[b, 1]) < (line[b, 1] - line[a, 1]) * (
        line[c, 0] - line[b, 0]
    )


@kernel
def join(sectors, points, eye, narrow, bent, pieces, corners):
    """Writes pieces and corners of all walls, anticlockwise around the eye; how many there are."""
    begin = 0  # a sector whose wall does not go on from the one before it
    while begin < SECTORS and follows(sectors, points, (begin - 1) % SECTORS, narrow):
        begin += 1
    found, k = 0, 0
    line, kept = np.empty((3 * SECTORS, 2)), np.empty(3 * SECTORS, np.bool_)
    while k < SECTORS:
        s = first = (begin + k) % SECTORS
        k += 1
        if not sectors[s, WALL] < math.inf:
            continue
        line[0], line[1], line[2], count = points[s, RIGHT], points[s, NEAREST], points[s, LEFT], 3
        while k < SECTORS and follows(sectors, points, s, narrow):
            s = (s + 1) % SECTORS
            for at in (RIGHT, NEAREST, LEFT):
                line[count] = points[s, at]
                count += 1
            k += 1
        kept_points(line, count, bent, kept)
        open_right = seen_past(sectors, points, eye, first, RIGHT, (first - 1) % SECTORS)
        open_left = seen_past(sectors, points, eye, s, LEFT, (s + 1) % SECTORS)
        found = write_run(line, count, kept, (open_right, open_left), pieces, corners, found)
    return found


@kernel
def write_run(line, count, kept, ends, pieces, corners, found):
    """Writes the pieces of one run from place `found` on; the next place."""
    b, corner = 0, ends[0]
    for c in range(1, count):
        if not kept[c]:
            continue
        pieces[found, 0], pieces[found, 1] = line[b, 0], line[b, 1]
        pieces[found, 2], pieces[found, 3] = line[c, 0], line[c, 1]
        following = c + 1
        while following < count and not kept[following]:
            following += 1
        after = ends[1] if following >= count else turns_away(line, b, c, following)
        corners[found, 0], corners[found, 1] = corner, after
        corner, b = after, c
        if pieces[found, 0] != pieces[found, 2] or pieces[found, 1] != pieces[found, 3]:
            found += 1
    return found
