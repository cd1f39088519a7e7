"""The ground under the feet: a plane through their last contact points (row J5; equations.md §2)."""

import math
from typing import NamedTuple

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import dot, scale, sub

STEEPEST = 1.0
"""Slopes (tangents) beyond this are not believed."""
LINE, WIDE = 0.02, 0.1
"""Spread of the feet across the line they lie nearest to, per spread along it, seen from above.

From `WIDE` on least squares alone decide, up to `LINE` the feet count as being on that line, and in
between the answer passes from one to the other, so that errors of their heights never weigh tenfold.
"""
APART = 1e-6
"""Feet with a smaller spread than this [m] are in one place."""


class Plane(NamedTuple):
    """A plane z(x, y), world axes."""

    slope_x: float
    """∂z/∂x."""
    slope_y: float
    """∂z/∂y."""
    x: float
    y: float
    z: float
    """A point of it [m]."""


@kernel
def fit_plane(points, before):
    """The `Plane` of foot centres `(feet, 3)`, and how far they determine it: 1 least squares, 0 the past.

    `before` is the plane so far. Feet on a line keep what they can of its normal, one foot keeps its slope,
    no foot keeps it all (equations.md §2).
    """
    n = points.shape[0]
    if n == 0:
        return Plane(before[0], before[1], before[2], before[3], before[4]), 0.0
    mx, my, mz = points[:, 0].sum() / n, points[:, 1].sum() / n, points[:, 2].sum() / n
    xx = yy = xy = xz = yz = 0.0
    for k in range(n):
        x, y, z = points[k, 0] - mx, points[k, 1] - my, points[k, 2] - mz
        xx += x * x
        yy += y * y
        xy += x * y
        xz += x * z
        yz += y * z
    # Along the principal axes of the feet seen from above, c and s, the two slopes are independent.
    turn = 0.5 * math.atan2(2.0 * xy, xx - yy)
    c, s = math.cos(turn), math.sin(turn)
    long2, wide2 = c * c * xx + 2.0 * c * s * xy + s * s * yy, s * s * xx - 2.0 * c * s * xy + c * c * yy
    if long2 <= n * APART * APART:
        return Plane(before[0], before[1], mx, my, mz), 0.0
    climb = (c * xz + s * yz) / long2
    across = -s * before[0] + c * before[1]
    width = math.sqrt(max(wide2, 0.0) / long2)
    trust = min(max((width - LINE) / (WIDE - LINE), 0.0), 1.0)
    if trust < 1.0:
        across = slope_across(climb, c * before[0] + s * before[1], across)
    if trust > 0.0:
        across += trust * ((c * yz - s * xz) / wide2 - across)
    k = min(1.0, STEEPEST / (math.hypot(climb, across) + 1e-12))
    return Plane(k * (c * climb - s * across), k * (s * climb + c * across), mx, my, mz), trust


@kernel
def slope_across(climb, along, across):
    """Slope across a line that climbs by `climb`, of the plane through it nearest in normal to the past one.

    `along`, `across`: slopes of the past plane. N = N_before − (N_before·u) u, u along the line; where that
    leaves no normal that points up, the slope across stays.
    """
    u = scale(1.0 / math.sqrt(1.0 + climb * climb), (1.0, 0.0, climb))
    past = (-along, -across, 1.0)
    normal = sub(past, scale(dot(past, u), u))
    return -normal[1] / normal[2] if normal[2] > 0.1 else across


@kernel
def advance_ground(slope, contact, position, velocity, lag, dt):
    """Low-passes the plane (changed in place) over `lag` [s]; its height follows the base as it moves."""
    before = Plane(slope[0], slope[1], position[0], position[1], slope[2])
    plane, _ = fit_plane(contact, before)
    k = min(1.0, dt / lag)
    slope[0] += k * (plane.slope_x - slope[0])
    slope[1] += k * (plane.slope_y - slope[1])
    under_base = plane.z + slope[0] * (position[0] - plane.x) + slope[1] * (position[1] - plane.y)
    carried = slope[2] + dt * (slope[0] * velocity[0] + slope[1] * velocity[1])
    slope[2] = carried + min(1.0, 2.0 * k) * (under_base - carried)


@kernel
def plane_height(slope, position, x, y):
    """Height of the plane of foot centres at world `(x, y)` [m]."""
    return slope[2] + slope[0] * (x - position[0]) + slope[1] * (y - position[1])


@kernel
def plane_normal(slope):
    """Upward unit normal of the plane, as a 3-vector."""
    k = 1.0 / math.sqrt(1.0 + slope[0] * slope[0] + slope[1] * slope[1])
    return (-slope[0] * k, -slope[1] * k, k)
