"""How high a foot must be swung to clear the ground on its way, and whether it has come down (row J8)."""

import math

from gaitwright.ground.elevation import height_at, is_known
from gaitwright.numerics.compiled import kernel

CLEAR = 0.1
"""Room under a swinging foot, in body heights."""
MOST_LIFT = 0.45
"""Highest swing over the straight line, in body heights."""
LOOKS = 12
"""Places looked at along the way of a foot."""
LOW = 0.25
"""Where a foot is lifted by less than this share of its highest, it is taken to be at its ends."""


@kernel
def lift_needed(ground, origin, x, y, z, radius, table, height):
    """By what factor a leg cycle must be raised so that a foot clears the ground on its way.

    `origin` → (x, y, z): the way of the foot's centre; `table`: the leg cycle (`gait.leg_cycles.leg_cycle`).
    """
    most, peak = 1.0, table[:, 3].max()
    if not is_known(ground) or peak <= 0.0:
        return most
    rows = table.shape[0]
    for i in range(1, LOOKS):
        k = (i * (rows - 1)) // LOOKS
        share, up = table[k, 0], table[k, 3]
        if up < LOW * peak:
            continue
        at_x, at_y = origin[0] + share * (x - origin[0]), origin[1] + share * (y - origin[1])
        line = origin[2] + share * (z - origin[2])
        under = highest_near(ground, at_x, at_y, x - origin[0], y - origin[1])
        most = max(most, (under + radius + CLEAR * height - line) / (up * height))
    return min(most, MOST_LIFT / peak)


@kernel
def highest_near(ground, x, y, way_x, way_y):
    """Highest ground within two nodes of a place, along the way [m]."""
    k = 2.0 * ground.place[2] / (math.hypot(way_x, way_y) + 1e-9)
    dx, dy = k * way_x, k * way_y
    ends = max(height_at(ground, x + dx, y + dy), height_at(ground, x - dx, y - dy))
    return max(ends, height_at(ground, x, y))


@kernel
def is_on_ground(ground, foot, radius, height):
    """Whether a foot that feels something is where ground is known to be: an edge on the way is none."""
    if not is_known(ground):
        return True
    return foot[2] - radius - height_at(ground, foot[0], foot[1]) < CLEAR * height
