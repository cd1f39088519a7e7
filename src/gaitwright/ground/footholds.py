"""Where a foot may stand on known ground: one judgement, for feet that land and the guard that looks ahead.

A wished foothold that is blocked (an edge, a hole, a wall) gives way to its best neighbour: the nearest
place that is neither, with some preference for the one chosen so far, so that a foot does not waver (row J8).
"""

import math
from typing import NamedTuple

from gaitwright.ground.elevation import height_at, nearest
from gaitwright.numerics.compiled import kernel

SEARCHED = 0.6
"""Farthest neighbour of a wished foothold, in body heights."""
FAITH = 0.5
"""Weight of the distance from the foothold chosen so far, against that from the wished one, as a swing
begins; it grows with the inverse square of what is left of it, as what a foot can do in that falls."""
OFF_PLANE = 1.4
"""Ground this many steps above or below the plane under the robot may be a foothold: a step, and what the
plane lags behind the ground."""
SHANK = 0.6
"""Up to here over the ground the shank needs room, in body heights."""
BONE = 0.08
"""Thickness of the shank and what it should keep clear, in body heights."""


RIM = 0.75
"""Mark of nodes beside what is hidden, among the edges: feet that choose keep off, but it stops nobody."""


NEARLY = 0.3
"""Who finds a foothold so near before where it goes, in body heights, comes there."""


class FootholdRequest(NamedTuple):
    """A foothold that is asked for."""

    x: float
    y: float
    before_x: float
    before_y: float
    """The one chosen so far [m]."""
    level: float
    """Height of the ground expected there [m]."""
    step: float
    """How far above or below that it may lie [m]."""
    lean: tuple
    """How far the shank leans out over the ground per height, world x, y."""
    height: float
    """Of the body [m]."""
    swung: float = 0.0
    """How much of its swing the foot has done, 0 … 1: the farther, the less it can still go elsewhere."""


@kernel
def is_fit(ground, row, column, wish, mark):
    """Whether a foot may stand on a node: no edge near (no mark of `mark` or more), not too high or low, room
    for the shank."""
    z, h = ground.heights[row, column], wish.height
    if ground.edges[row, column] >= mark or abs(z - wish.level) > wish.step:
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
    """The foothold nearest to a wished one: found or not, x, y [m]. One on a rim is better than none."""
    row, column = nearest(ground, wish.x, wish.y)
    if is_fit(ground, row, column, wish, RIM):
        return True, wish.x, wish.y
    for mark in (RIM, 1.0):
        found, x, y = nearest_fit(ground, row, column, wish, mark)
        if found:
            return True, x, y
    return False, wish.x, wish.y


@kernel
def nearest_fit(ground, row, column, wish, mark):
    """The node with no mark of `mark` or more that is the best foothold around a wished one: found or not,
    x, y [m]."""
    rows, columns = ground.heights.shape
    spacing, limit = ground.place[2], (SEARCHED * wish.height) ** 2
    reach = int(SEARCHED * wish.height / spacing)
    least, best_x, best_y = math.inf, wish.x, wish.y
    faith = FAITH / max(1.0 - wish.swung, 0.1) ** 2
    for i in range(max(row - reach, 0), min(row + reach + 1, rows)):
        for j in range(max(column - reach, 0), min(column + reach + 1, columns)):
            x, y = ground.place[0] + j * spacing, ground.place[1] + i * spacing
            far = (x - wish.x) ** 2 + (y - wish.y) ** 2
            cost = far + faith * ((x - wish.before_x) ** 2 + (y - wish.before_y) ** 2)
            if cost < least and far < limit and is_fit(ground, i, j, wish, mark):
                least, best_x, best_y = cost, x, y
    return least < math.inf, best_x, best_y


@kernel
def last_foothold(ground, start, level, way, far, aside, step, stride, height):
    """How far a foot comes that goes straight from place to place, and the rise that stops it.

    `start`: x, y; `level`: of the ground that the robot stands on; `way`: its direction [rad]; `far`: so far
    it goes, or nearly; footholds up to `aside` beside its track will do; a `stride` is the longest stretch
    without one [m]. Gives whether something stops it, how far it is to the last foothold [m], how much higher
    the ground is behind it [m], and the longest stretch that it steps over [m], rims among them.
    """
    ahead_x, ahead_y, spacing = math.cos(way), math.sin(way), ground.place[2]
    last, allowed, firm, longest = 0.0, OFF_PLANE * step, 0.0, 0.0
    for i in range(math.ceil((far + stride) / spacing) + 1):
        at, found = i * spacing, False
        if at > far and last > far - NEARLY * height:
            break
        for k in (0.0, 1.0, -1.0):
            x = start[0] + at * ahead_x - k * aside * ahead_y
            y = start[1] + at * ahead_y + k * aside * ahead_x
            row, column = nearest(ground, x, y)
            wish = FootholdRequest(x, y, x, y, level, allowed, (0.0, 0.0), height, 0.0)
            if is_fit(ground, row, column, wish, 1.0):
                if ground.edges[row, column] < RIM:
                    firm, longest = at, max(longest, at - firm)
                last, level, allowed, found = at, ground.heights[row, column], step, True
                break
        if not found and at - last > stride:
            row, column = nearest(ground, start[0] + at * ahead_x, start[1] + at * ahead_y)
            rise = ground.heights[row, column] - level
            if at <= far or rise < -step:  # a path turns before a wall; a drop is no place to turn at
                return True, last, rise, longest
    return False, last, 0.0, longest
