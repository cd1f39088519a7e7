"""What a hit of a camera is on: ground that can be walked on, or a wall.

A wall is what the scanner has for one (`scanner.in_sight`): higher by more than a step than all that is
known up to a gap's width before it.
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.perception.fusing import HEIGHT, HIGH, LOW, VARIANCE, nearest_line, slot

GROUND, UNSURE, RIM, FACE = 0, 1, 2, 3
"""What a hit is on: ground; nothing that can be told yet; a wall, on its upper rim or on its face."""
FOOT = 0.25
"""Hits lower than this share of a step are on the ground before a wall, not on it [-]."""
SEEN_OVER = 0.75
"""What is no higher than where the robot stands is a wall only if the ground before it is known to be lower
over this share of the widest gap: else it may be the far side of one [-]."""
BRINK = 5
"""So many cells around a place where ground ends tell which way it ends."""
AROUND = 2
"""So many cells around a wall tell which way it looks."""


@kernel
def cell_at(first, n, row, column):
    """Where a cell of the world's lattice is kept; -1, -1 outside the window."""
    if first[0] <= row < first[0] + n and first[1] <= column < first[1] + n:
        return slot(row, n), slot(column, n)
    return -1, -1


@kernel
def highest_before(cells, first, spacing, x, y, way_x, way_y, limits):
    """Highest known ground before a place, to one who comes along (way_x, way_y); how far it is known [m].

    -inf where none is known.
    """
    before, known = -math.inf, 0.0
    for k in range(math.ceil(limits[1] / spacing), math.ceil(limits[2] / spacing) + 1):
        row, column = (
            nearest_line(y - k * spacing * way_y, spacing),
            nearest_line(x - k * spacing * way_x, spacing),
        )
        i, j = cell_at(first, cells.shape[0], row, column)
        if i >= 0 and cells[i, j, VARIANCE] < math.inf:
            before, known = max(before, cells[i, j, HEIGHT]), k * spacing
    return before, known


@kernel
def is_ground(cells, first, row, column, least):
    """Whether a cell of the world's lattice is known to be as high as that [m]."""
    i, j = cell_at(first, cells.shape[0], row, column)
    return i >= 0 and cells[i, j, VARIANCE] < math.inf and cells[i, j, HEIGHT] >= least


@kernel
def is_brink(cells, first, spacing, x, y, way_x, way_y, least, gap):
    """Whether ground that ends at a place has no other side, as high as `least` [m], within the widest gap
    [m]: along the look, and straight over the edge. Else it is the bank of a gap."""
    row, column = nearest_line(y, spacing), nearest_line(x, spacing)
    over_x = over_y = 0.0
    for u in range(-BRINK, BRINK + 1):
        for v in range(-BRINK, BRINK + 1):
            if not is_ground(cells, first, row + u, column + v, least):
                over_x, over_y = over_x + v, over_y + u
    length = math.hypot(over_x, over_y)
    straight = (over_x / length, over_y / length) if length > 0.5 else (way_x, way_y)
    for to_x, to_y in ((way_x, way_y), straight):
        is_over = False
        for k in range(1, math.ceil(gap / spacing) + 1):
            row, column = (
                nearest_line(y + k * spacing * to_y, spacing),
                nearest_line(x + k * spacing * to_x, spacing),
            )
            if not is_ground(cells, first, row, column, least):
                is_over = True
            elif is_over:
                return False
    return True


@kernel
def uphill(cells, first, spacing, row, column, level, way_x, way_y):
    """Unit direction to a cell from the ground below `level` around it; where none is known, the way."""
    x = y = 0.0
    for u in range(-AROUND, AROUND + 1):
        for v in range(-AROUND, AROUND + 1):
            i, j = cell_at(first, cells.shape[0], row + u, column + v)
            if i >= 0 and cells[i, j, VARIANCE] < math.inf and cells[i, j, HEIGHT] < level:
                x, y = x - v, y - u
    length = math.hypot(x, y)
    return (x / length, y / length) if length > 0.5 else (way_x, way_y)


@kernel
def kind_of(cells, first, spacing, x, y, z, way_x, way_y, level, limits):
    """What a hit at z in the cell at x, y is on to one who comes along (way_x, way_y).

    `level`: of the ground in view before it [m], for where the map knows none; NaN: there is none.
    """
    row, column, step = nearest_line(y, spacing), nearest_line(x, spacing), limits[0]
    i, j = cell_at(first, cells.shape[0], row, column)
    if i < 0:
        return UNSURE
    top = z
    if cells[i, j, VARIANCE] < math.inf:
        top = max(z, cells[i, j, HEIGHT] - 2.0 * math.sqrt(cells[i, j, VARIANCE]))
    if abs(z - level) < FOOT * step and top - level <= step:  # as level as what was in view before it
        return GROUND
    before, _ = highest_before(cells, first, spacing, x, y, way_x, way_y, limits)
    if before == -math.inf:
        before = cells[i, j, LOW] if math.isnan(level) else level
        if not top - before > step:
            return GROUND if abs(z - level) < FOOT * step else UNSURE
    if not (top - before > step and z - before > FOOT * step):
        return GROUND
    # Straight over it a gap is narrower than along the look.
    up_x, up_y = uphill(cells, first, spacing, row, column, top - step, way_x, way_y)
    straight, known = highest_before(cells, first, spacing, x, y, up_x, up_y, limits)
    if straight >= top - step:
        return GROUND
    if known < SEEN_OVER * limits[2] and top - limits[4] <= step:  # perhaps the far side of a gap
        return UNSURE
    return FACE if cells[i, j, HIGH] - cells[i, j, LOW] > FOOT * step else RIM
