"""What is ahead of a swinging leg, and the terrain operator that answers it (row L4).

Obstacles are told apart as the thesis has it (5.3, "reduction to geometric primitives"): by what the ground
does between where a foot left it and where it wants to land.
"""

import math

from gaitwright.gait.clearance import CLEAR, LOW, MOST_LIFT, highest_near
from gaitwright.gait.swing import on_cycle, place_in
from gaitwright.ground.elevation import height_at, is_known
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import scale

BLOCK, STEP_UP, STEP_DOWN, HOLE, SLOPE, NOTHING = 0, 1, 2, 3, 4, -1
"""Places in `kinds.KINDS`."""
LOOKS = 24
"""Places looked at along a way."""
BEYOND = 0.6
"""A hole is one where the ground comes back within this, in body heights, behind the wished foothold."""
BREAK = 0.1
"""A rise or drop by more than this, in body heights, is a step."""
EVEN = 0.03
"""Ground that keeps this near to a straight line, in body heights, is a slope or level."""
GENTLE = 0.02
"""A slope of less than this is none."""
UNTAUGHT = -1.0
"""In the place of an operator's number: there is an obstacle, and none is for it."""
LARGEST, LANDING, DURATION = 5, 6, 7
"""Places in the terms of an operator."""


@kernel
def ahead_of(ground, origin, x, y, radius, height):
    """Kind and size of the obstacle between where a foot left the ground and `(x, y)`.

    `origin`: centre of the foot at lift-off. Size: height [m], depth of a step down, width of a hole, or the
    tangent of a slope.
    """
    if not is_known(ground):
        return NOTHING, 0.0
    way_x, way_y = x - origin[0], y - origin[1]
    length = math.hypot(way_x, way_y)
    if length < ground.place[2]:
        return NOTHING, 0.0
    far = length + BEYOND * height
    level, end = origin[2] - radius, height_at(ground, x, y)
    over, off, low, width, closed = 0.0, 0.0, 0, 0.0, False
    for i in range(1, LOOKS + 1):
        at = i * far / LOOKS
        g = height_at(ground, origin[0] + way_x * at / length, origin[1] + way_y * at / length)
        if at <= length:
            line = level + (end - level) * at / length
            over, off = max(over, g - line), max(off, abs(g - line))
        if g < level - BREAK * height:
            low += 1 if at <= length or low > 0 else 0
        elif low > 0 and not closed:
            width, closed = low * far / LOOKS, True
    rise = end - level
    if off < EVEN * height and (low == 0 or not closed):
        slope = rise / length
        return (SLOPE, abs(slope)) if abs(slope) > GENTLE else (NOTHING, 0.0)
    if closed:
        return HOLE, width
    if rise > BREAK * height:
        return STEP_UP, rise
    if rise < -BREAK * height:
        return STEP_DOWN, -rise
    return (BLOCK, over) if over > EVEN * height else (NOTHING, 0.0)


@kernel
def operator_for(terms, kind, size):
    """Number of the first operator for an obstacle of a kind and size; -1: there is none."""
    for i in range(terms.shape[0]):
        if terms[i, kind] > 0.5 and size <= terms[i, LARGEST]:
            return i
    return -1


@kernel
def height_over(ground, origin, x, y, z, radius, share):
    """How high the ground is over the straight way of a foot from `origin` to (x, y, z), at a share of it."""
    at_x, at_y = origin[0] + share * (x - origin[0]), origin[1] + share * (y - origin[1])
    line = origin[2] + share * (z - origin[2]) - radius
    return highest_near(ground, at_x, at_y, x - origin[0], y - origin[1]) - line


@kernel
def obstacle_over(ground, origin, x, y, z, radius):
    """How high what is in the way of a foot is over that way [m]; 0 where the ground goes along with it."""
    most = 0.0
    if is_known(ground):
        for i in range(1, LOOKS):
            most = max(most, height_over(ground, origin, x, y, z, radius, i / LOOKS))
    return most


@kernel
def reach_needed(ground, origin, x, y, z, radius, lift, cycle, table, height):
    """By how many metres of obstacle an operator must be applied so that a foot clears what is in its way.

    `origin` → (x, y, z): the way of the foot's centre; `cycle`: the leg cycle, raised by `lift`; `table`: of
    the operator.
    """
    peak, most = table[:, 3].max(), 0.0
    if not is_known(ground) or peak <= 0.0:
        return most
    rows = table.shape[0]
    for i in range(1, LOOKS):
        k = (i * (rows - 1)) // LOOKS
        over = height_over(ground, origin, x, y, z, radius, cycle[k, 0])
        if over > EVEN * height and table[k, 3] > LOW * peak:
            most = max(most, (over + (CLEAR - lift * cycle[k, 3]) * height) / table[k, 3])
    return min(most, MOST_LIFT * height / peak)


@kernel
def force_at(table, s):
    """Force of an operator's table at share `s` of the swing, straight in between [N/m]."""
    i, t = place_in(table, s)
    k = 1.0 - t
    return (
        k * table[i, 6] + t * table[i + 1, 6],
        k * table[i, 7] + t * table[i + 1, 7],
        k * table[i, 8] + t * table[i + 1, 8],
    )


@kernel
def enhance(table, reach, s, duration, taught_in, way_x, way_y, out_p, out_v, out_a):
    """Adds an operator to the position, velocity and acceleration of a foot at share `s` of its swing.

    Gives the force that moves it so [N]: of a left leg, heading frame.

    `reach`: metres of obstacle; `duration`, `taught_in`: of this swing and of that one [s], forces go with
    the square of the pace.
    """
    b, db, ddb, u, du, ddu = on_cycle(table, s)  # its first six columns are those of a leg cycle
    for i in range(3):
        way = way_x if i == 0 else way_y
        x, dx, ddx = (u, du, ddu) if i == 2 else (way * b, way * db, way * ddb)
        out_p[i] += reach * x
        out_v[i] += reach * dx / duration
        out_a[i] += reach * ddx / (duration * duration)
    k = reach * (taught_in / duration) ** 2
    return scale(k, force_at(table, s))
