"""What a look went through is not there: parts of pieces well inside seen free ground are cut out."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.navigation.piece_rows import FELT, KIND, Rows
from gaitwright.numerics.compiled import kernel

INSIDE = 0.02
"""A piece is unlearned where it lies this far inside seen free ground [m], and 3 times the noise."""
LEAST = 1e-3
"""A shorter rest of a piece is dropped [m]."""
MOST_CUTS = 64
"""A piece has no more parts than this; beyond it the rest stays as it was."""


def unlearned(rows: Rows, free: Float[np.ndarray, "m 2"], noise: float) -> Rows:
    """The rows without what lies well inside a region that was seen to be free; what was felt stays."""
    if len(free) < 3 or not len(rows):
        return rows
    margin = INSIDE + 3.0 * noise
    inside = np.all(
        [
            np.maximum(rows[:, 0], rows[:, 2]) > free[:, 0].min() + margin,
            np.minimum(rows[:, 0], rows[:, 2]) < free[:, 0].max() - margin,
            np.maximum(rows[:, 1], rows[:, 3]) > free[:, 1].min() + margin,
            np.minimum(rows[:, 1], rows[:, 3]) < free[:, 1].max() - margin,
            rows[:, KIND] != FELT,
        ],
        axis=0,
    )
    if not inside.any():
        return rows
    return np.concatenate([rows[~inside], cut_all(rows[inside], np.ascontiguousarray(free), margin)])


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def cut_all(rows, free, margin):
    out, count = np.empty((len(rows) + 64, 8)), 0
    kept = np.empty((65, 2))
    for k in range(len(rows)):
        parts = parts_left(rows[k], free, margin, kept)
        if count + parts > len(out):
            wider = np.empty((2 * len(out) + parts, 8))
            wider[:count] = out[:count]
            out = wider
        for n in range(parts):
            out[count] = rows[k]
            between(out[count], kept[n, 0], kept[n, 1])
            if math.hypot(out[count, 2] - out[count, 0], out[count, 3] - out[count, 1]) >= LEAST:
                count += 1
            elif parts == 1 and kept[n, 0] == 0.0 and kept[n, 1] == 1.0:
                count += 1  # it was that short
    return out[:count].copy()


@kernel
def between(row, t0, t1):
    """Leaves of a piece the part from `t0` to `t1`; ends that were cut are no corners."""
    x, y, dx, dy = row[0], row[1], row[2] - row[0], row[3] - row[1]
    if t0 > 0.0:
        row[0], row[1], row[4] = x + t0 * dx, y + t0 * dy, 0.0
    if t1 < 1.0:
        row[2], row[3], row[5] = x + t1 * dx, y + t1 * dy, 0.0


@kernel
def parts_left(row, free, margin, kept):
    """Writes which parts of a piece, from 0 to 1, are not well inside a region; returns how many."""
    near = np.empty((len(free), 2))
    count = 0
    for k in range(len(free)):
        t0, t1 = part_near(row, free[k - 1], free[k], margin)
        if t0 <= t1 and t1 > 0.0 and t0 < 1.0:
            near[count, 0], near[count, 1] = t0, t1
            count += 1
    order = np.argsort(near[:count, 0])
    parts, begin, at = 0, 0.0, 0.0  # `begin` of what is kept, `at`: so far it was looked at
    for n in range(count + 1):
        t0 = near[order[n], 0] if n < count else 1.0
        if t0 > at and parts < 62:
            middle = (at + t0) / 2.0
            x, y = row[0] + middle * (row[2] - row[0]), row[1] + middle * (row[3] - row[1])
            if is_inside(x, y, free):
                if at > begin:
                    kept[parts, 0], kept[parts, 1] = begin, at
                    parts += 1
                begin = t0
        if n < count:
            at = max(at, near[order[n], 1])
    if begin < 1.0:
        kept[parts, 0], kept[parts, 1] = begin, 1.0
        parts += 1
    return parts


@kernel
def part_near(row, a, b, margin):
    """The part of a piece's line (0 to 1 is the piece) within `margin` of a segment; empty: begin > end."""
    px, py, dx, dy = row[0], row[1], row[2] - row[0], row[3] - row[1]
    ex, ey = b[0] - a[0], b[1] - a[1]
    length = math.hypot(ex, ey)
    begin, end = np.inf, -np.inf
    for cx, cy in ((a[0], a[1]), (b[0], b[1])):
        qx, qy = px - cx, py - cy
        aa, bb = dx * dx + dy * dy, qx * dx + qy * dy
        root = bb * bb - aa * (qx * qx + qy * qy - margin * margin)
        if root >= 0.0 and aa > 0.0:
            begin, end = min(begin, (-bb - math.sqrt(root)) / aa), max(end, (-bb + math.sqrt(root)) / aa)
    if length > 0.0:
        ux, uy = ex / length, ey / length
        along, slope = (px - a[0]) * ux + (py - a[1]) * uy, dx * ux + dy * uy
        side, slant = ux * (py - a[1]) - uy * (px - a[0]), ux * dy - uy * dx
        t0, t1 = where_within(along, slope, 0.0, length)
        s0, s1 = where_within(side, slant, -margin, margin)
        if max(t0, s0) <= min(t1, s1):
            begin, end = min(begin, max(t0, s0)), max(end, min(t1, s1))
    return begin, end


@kernel
def where_within(value, slope, low, high):
    """For which t `value + slope t` is between two bounds."""
    if abs(slope) < 1e-12:
        return (-np.inf, np.inf) if low <= value <= high else (np.inf, -np.inf)
    ta, tb = (low - value) / slope, (high - value) / slope
    return min(ta, tb), max(ta, tb)


@kernel
def is_inside(x, y, ring):
    """Whether a point lies in a polygon (even-odd)."""
    inside = False
    for k in range(len(ring)):
        (xa, ya), (xb, yb) = (ring[k - 1, 0], ring[k - 1, 1]), (ring[k, 0], ring[k, 1])
        if (ya > y) != (yb > y) and x < xa + (y - ya) / (yb - ya) * (xb - xa):
            inside = not inside
    return inside
