"""Where a foot may really stand, and how high it must be swung to get there (row J8).

A wished foothold that is blocked (an edge, a hole, a wall) gives way to its best neighbour: the nearest
place that is neither, with some preference for the one chosen so far, so that a foot does not waver.
"""

import math
from typing import NamedTuple

from gaitwright.ground.elevation import height_at, is_known, nearest
from gaitwright.numerics.compiled import kernel

SEARCHED = 0.6
"""Farthest neighbour of a wished foothold, in body heights."""
FAITH = 0.5
"""Weight of the distance from the foothold chosen so far, against that from the wished one."""
STEP = 0.5
"""Ground farther than this above or below the plane under the robot is no foothold, in body heights."""
SHANK = 0.6
"""Up to here over the ground the shank needs room, in body heights."""
BONE = 0.08
"""Thickness of the shank and what it should keep clear, in body heights."""
CLEAR = 0.1
"""Room under a swinging foot, in body heights."""
MOST_LIFT = 0.45
"""Highest swing over the straight line, in body heights."""
LOOKS = 12
"""Places looked at along the way of a foot."""
LOW = 0.25
"""Where a foot is lifted by less than this share of its highest, it is taken to be at its ends."""


class FootholdRequest(NamedTuple):
    """A foothold that is asked for."""

    x: float
    y: float
    before_x: float
    before_y: float
    """The one chosen so far [m]."""
    plane: float
    """Height of the ground expected there [m]."""
    lean: tuple
    """How far the shank leans out over the ground per height, world x, y."""
    height: float
    """Of the body [m]."""


@kernel
def is_fit(ground, row, column, wish):
    """Whether a foot may stand on a node: no edge near, not too high or low, room for the shank."""
    z, h = ground.heights[row, column], wish.height
    if ground.edges[row, column] > 0.5 or abs(z - wish.plane) > STEP * h:
        return False
    spacing = ground.place[2]
    x, y = ground.place[0] + column * spacing, ground.place[1] + row * spacing
    for i in range(int(2.5 * BONE * h / spacing), int(SHANK * h / spacing) + 1):
        up = i * spacing
        if height_at(ground, x + up * wish.lean[0], y + up * wish.lean[1]) > z + up - BONE * h:
            return False
    return True


@kernel
def choose_foothold(ground, wish):
    """The foothold nearest to a wished one: found or not, x, y [m]."""
    row, column = nearest(ground, wish.x, wish.y)
    if is_fit(ground, row, column, wish):
        return True, wish.x, wish.y
    rows, columns = ground.heights.shape
    spacing, limit = ground.place[2], (SEARCHED * wish.height) ** 2
    reach = int(SEARCHED * wish.height / spacing)
    least, best_x, best_y = math.inf, wish.x, wish.y
    for i in range(max(row - reach, 0), min(row + reach + 1, rows)):
        for j in range(max(column - reach, 0), min(column + reach + 1, columns)):
            x, y = ground.place[0] + j * spacing, ground.place[1] + i * spacing
            far = (x - wish.x) ** 2 + (y - wish.y) ** 2
            cost = far + FAITH * ((x - wish.before_x) ** 2 + (y - wish.before_y) ** 2)
            if cost < least and far < limit and is_fit(ground, i, j, wish):
                least, best_x, best_y = cost, x, y
    return least < math.inf, best_x, best_y


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
