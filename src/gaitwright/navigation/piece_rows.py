"""Seen pieces of edges as rows, and how pieces of one line become one.

A row is x0, y0, x1, y1 [m], whether each end is a corner (1 or 0), in how many looks it was seen, and what
kind it is. No polygon is ever made of partial sights: obstacles that touch, overlap, cross themselves or have
no area need no case of their own.
"""

import math

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.numerics.compiled import kernel

WIDTH = 8
"""Numbers of a row."""
CORNERS = slice(4, 6)
LOOKS, KIND = 6, 7
"""Columns."""
SEEN, FELT, SUPPOSED = 0.0, 1.0, 2.0
"""Kinds: seen; felt, which no look unlearns; supposed: beside what was felt, or felt on an earlier trip."""
OF_LINE = 1e-4
"""A piece is of another's line when its ends are within this of it [m], and 2.5 times the noise."""
OF_GAP = 1e-3
"""Pieces of one line join across this gap [m], and 2.5 times the noise: no robot goes through there."""
MOST_LOOKS = 20.0
"""So much weight has what was seen before, at most: an outline may shift."""
POINT = 2e-5
"""An obstacle without length gets this one [m]: then it has a direction."""

Rows = Float[np.ndarray, "_ 8"]


def rows_of(
    pieces: Float[np.ndarray, "n 4"], corners: Bool[np.ndarray, "n 2"] | bool, kind: float = SEEN
) -> Rows:
    """Pieces as rows that were seen once."""
    rows = np.ones((len(pieces), WIDTH))
    rows[:, :4], rows[:, CORNERS], rows[:, KIND] = pieces, corners, kind
    points = np.hypot(rows[:, 2] - rows[:, 0], rows[:, 3] - rows[:, 1]) < POINT
    rows[points, 2] = rows[points, 0] + POINT
    return rows


def joined_rows(old: Rows, new: Rows, noise: float) -> Rows:
    """The old rows with the new ones: those of one line that overlap or touch are one row."""
    return joined_all(old, np.ascontiguousarray(new), OF_LINE + 2.5 * noise, OF_GAP + 2.5 * noise)


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def joined_all(old, new, line, gap):
    table = np.empty((len(old) + len(new), 8))
    table[: len(old)] = old
    lives = np.zeros(len(table), np.bool_)
    lives[: len(old)] = True
    count, row = len(old), np.empty(8)
    for k in range(len(new)):
        row[:] = new[k]
        grows = True
        while grows:
            grows = False
            for j in range(count):
                if lives[j] and belongs(table[j], row, line, gap):
                    join(table[j], row, gap)
                    lives[j], grows = False, True
        table[count] = row
        lives[count] = True
        count += 1
    return table[lives]


@kernel
def belongs(a, b, line, gap):
    """Whether two pieces are of one line, and overlap or touch."""
    if a[7] != b[7]:
        return False
    if (
        max(a[0], a[2]) + gap < min(b[0], b[2])
        or max(b[0], b[2]) + gap < min(a[0], a[2])
        or max(a[1], a[3]) + gap < min(b[1], b[3])
        or max(b[1], b[3]) + gap < min(a[1], a[3])
    ):
        return False
    if length_of(a) < length_of(b):
        a, b = b, a
    length = length_of(a)
    ux, uy = (a[2] - a[0]) / length, (a[3] - a[1]) / length
    if max(abs(beside(a, b[0], b[1], ux, uy)), abs(beside(a, b[2], b[3], ux, uy))) > line:
        return False
    s0 = (b[0] - a[0]) * ux + (b[1] - a[1]) * uy
    s1 = (b[2] - a[0]) * ux + (b[3] - a[1]) * uy
    return max(s0, s1) >= -gap and min(s0, s1) <= length + gap


@kernel
def length_of(a):
    return math.hypot(a[2] - a[0], a[3] - a[1])


@kernel
def beside(a, x, y, ux, uy):
    """Distance of a point from the line of a piece, to the left [m]."""
    return ux * (y - a[1]) - uy * (x - a[0])


@kernel
def join(a, b, gap):
    """Writes into `b` the piece that both are: on the principal axis of both, as rods weighed by looks."""
    la, lb = length_of(a), length_of(b)
    ma, mb = a[6] * la, b[6] * lb
    xa, ya, xb, yb = (a[0] + a[2]) / 2.0, (a[1] + a[3]) / 2.0, (b[0] + b[2]) / 2.0, (b[1] + b[3]) / 2.0
    x, y = (ma * xa + mb * xb) / (ma + mb), (ma * ya + mb * yb) / (ma + mb)
    xx = yy = xy = 0.0
    for piece, mass, cx, cy in ((a, ma, xa, ya), (b, mb, xb, yb)):
        dx, dy = piece[2] - piece[0], piece[3] - piece[1]
        xx += mass * ((cx - x) ** 2 + dx * dx / 12.0)
        yy += mass * ((cy - y) ** 2 + dy * dy / 12.0)
        xy += mass * ((cx - x) * (cy - y) + dx * dy / 12.0)
    angle = 0.5 * math.atan2(2.0 * xy, xx - yy)
    ux, uy = math.cos(angle), math.sin(angle)
    a0, a1, fa0, fa1 = along(a, x, y, ux, uy)
    b0, b1, fb0, fb1 = along(b, x, y, ux, uy)
    low, f_low = end_of(-a0, fa0, a[6], -b0, fb0, b[6], gap)
    high, f_high = end_of(a1, fa1, a[6], b1, fb1, b[6], gap)
    b[0], b[1], b[2], b[3] = x - low * ux, y - low * uy, x + high * ux, y + high * uy
    b[4], b[5] = f_low, f_high
    b[6] = min(a[6] + b[6], 20.0)


@kernel
def along(a, x, y, ux, uy):
    """Where a piece begins and ends on an axis [m], and which of these are corners."""
    s0, s1 = (a[0] - x) * ux + (a[1] - y) * uy, (a[2] - x) * ux + (a[3] - y) * uy
    if s0 <= s1:
        return s0, s1, a[4], a[5]
    return s1, s0, a[5], a[4]


@kernel
def end_of(a, a_corner, a_looks, b, b_corner, b_looks, gap):
    """The end of two pieces of a line, and whether it is a corner: a corner is believed, two are averaged, of
    open ends the farther one counts."""
    if abs(a - b) > gap or a_corner + b_corner == 0.0:
        return (a, a_corner) if a > b else (b, b_corner)
    if a_corner == b_corner:
        return (a * a_looks + b * b_looks) / (a_looks + b_looks), 1.0
    return (a, 1.0) if a_corner > b_corner else (b, 1.0)
