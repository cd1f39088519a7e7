"""The ground under the feet: a plane through their last contact points (row J5; equations.md §2)."""

import math

from gaitwright.compiled import kernel

STEEPEST = 1.0
"""Slopes (tangents) beyond this are not believed."""


@kernel
def fit_plane(points, slope):
    """Least-squares plane through foot centres `(legs, 3)`: ∂z/∂x, ∂z/∂y and the mean point.

    Where the points lie on a line seen from above, the previous `slope` is kept across it.
    """
    n = points.shape[0]
    mx = points[:, 0].sum() / n
    my = points[:, 1].sum() / n
    mz = points[:, 2].sum() / n
    # A weak pull to the previous slope makes the fit regular for feet on a line.
    spread = 0.0
    for k in range(n):
        spread += (points[k, 0] - mx) ** 2 + (points[k, 1] - my) ** 2
    pull = 1e-3 * spread + 1e-12
    xx, yy, xy = pull, pull, 0.0
    xz, yz = pull * slope[0], pull * slope[1]
    for k in range(n):
        x, y, z = points[k, 0] - mx, points[k, 1] - my, points[k, 2] - mz
        xx += x * x
        yy += y * y
        xy += x * y
        xz += x * z
        yz += y * z
    det = xx * yy - xy * xy
    a = min(max((xz * yy - yz * xy) / det, -STEEPEST), STEEPEST)
    b = min(max((yz * xx - xz * xy) / det, -STEEPEST), STEEPEST)
    return a, b, mx, my, mz


@kernel
def advance_ground(slope, contact, position, velocity, lag, dt):
    """Low-passes the plane (changed in place) over `lag` [s]; its height follows the base as it moves."""
    a, b, mx, my, mz = fit_plane(contact, slope)
    k = min(1.0, dt / lag)
    slope[0] += k * (a - slope[0])
    slope[1] += k * (b - slope[1])
    under_base = mz + slope[0] * (position[0] - mx) + slope[1] * (position[1] - my)
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
