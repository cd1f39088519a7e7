"""Smooth ground from control points: bicubic Cardinal and Bézier patches (thesis 6.2, figure 6.4).

A net of control heights `N` on a regular grid is a surface z(x, y) = B(y) N B(x)ᵀ, the tensor product of
curves over its rows and columns. It is sampled into the height field that physics collides with, which is
from then on the ground itself.
"""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.ground.terrain import HeightField

SAMPLE = 0.05
"""Greatest distance between the nodes of the height field [m], but for wide nets."""
FINEST = 64
"""Nodes from one control point to the next, at most."""


def cardinal(controls: int, fine: int, tension: float) -> Float[np.ndarray, "samples controls"]:
    """What each control point adds to each sample of a Cardinal spline, `fine` samples to a span.

    The curve goes through its control points; its slope there is (1 − tension) times that of the line from
    the point before to the one after. The line through the last two goes on beyond the end.
    """
    spans = controls - 1
    points = np.eye(controls)
    ends = 2.0 * points[0] - points[1], 2.0 * points[-1] - points[-2]
    points = np.vstack([ends[0], points, ends[1]])
    slope = (1.0 - tension) / 2.0 * (points[2:] - points[:-2])  # at each control point, per span
    t = (np.arange(fine) / fine)[None, :, None]
    start, end = points[1:-2][:, None], points[2:-1][:, None]
    away, arrival = slope[:-1][:, None], slope[1:][:, None]
    curve = (
        (2 * t**3 - 3 * t**2 + 1) * start
        + (t**3 - 2 * t**2 + t) * away
        + (3 * t**2 - 2 * t**3) * end
        + (t**3 - t**2) * arrival
    )
    return np.vstack([curve.reshape(spans * fine, controls), points[-2]])


def bezier(controls: int, fine: int) -> Float[np.ndarray, "samples controls"]:
    """The same of cubic Bézier curves end to end: 3 k + 1 control points make k of them.

    A curve begins and ends in a control point; the two between pull it. It is smooth where they lie on a line
    with the end between them.
    """
    curves = (controls - 1) // 3
    t = np.arange(3 * fine) / (3 * fine)
    bernstein = np.column_stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
    out = np.zeros((3 * fine * curves + 1, controls))
    for k in range(curves):
        out[3 * fine * k : 3 * fine * (k + 1), 3 * k : 3 * k + 4] = bernstein
    out[-1, -1] = 1.0
    return out


def spline_field(
    x_min: float,
    y_min: float,
    spacing: float,
    net: Float[np.ndarray, "rows columns"],
    tension: float | None = 0.0,
) -> HeightField:
    """The surface of a net of control heights [m], rows along y; Bézier patches where `tension` is `None`."""
    fine = fineness(spacing)

    def basis(controls: int) -> Float[np.ndarray, "samples controls"]:
        return bezier(controls, fine) if tension is None else cardinal(controls, fine, tension)

    rows, columns = net.shape
    return HeightField(x_min, y_min, spacing / fine, basis(rows) @ net @ basis(columns).T)


def fineness(spacing: float, sample: float = SAMPLE) -> int:
    """Nodes of the height field from one control point to the next."""
    return min(max(math.ceil(spacing / sample - 1e-9), 1), FINEST)
