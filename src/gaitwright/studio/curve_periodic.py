"""A curve through points of a cycle that never overshoots them: its end goes over into its beginning.

Cubic between two points, with the slopes of Steffen (1990): a monotone part stays monotone, a turning point
is one of the given points, and moving a point changes the curve up to its second neighbours alone.
"""

import numpy as np
from jaxtyping import Float

Phases = Float[np.ndarray, " points"]
Columns = Float[np.ndarray, "points columns"]


def through(phases: Phases, values: Columns, at: Float[np.ndarray, " n"]) -> Float[np.ndarray, "n columns"]:
    """The curves through `values` at `phases`, which ascend in [0, 1), at other phases."""
    s = np.concatenate([phases[-2:] - 1.0, phases, phases[:2] + 1.0])
    y = np.concatenate([values[-2:], values, values[:2]])
    slope = slopes(s, y)
    x = np.mod(at, 1.0)
    k = np.clip(np.searchsorted(s, x, side="right") - 1, 1, len(s) - 3)
    h = s[k + 1] - s[k]
    t = ((x - s[k]) / h)[:, None]
    h = h[:, None]
    start, end, out, into = y[k], y[k + 1], slope[k] * h, slope[k + 1] * h
    bend = 3.0 * (end - start) - 2.0 * out - into
    twist = 2.0 * (start - end) + out + into
    return start + t * (out + t * (bend + t * twist))


def slopes(s: Phases, y: Columns) -> Columns:
    """Slopes at the points; 0 at the first and the last, which only frame the cycle."""
    h = np.diff(s)[:, None]
    secant = np.diff(y, axis=0) / h
    left, right, before, after = secant[:-1], secant[1:], h[:-1], h[1:]
    parabola = (left * after + right * before) / (before + after)
    least = np.minimum(np.minimum(np.abs(left), np.abs(right)), 0.5 * np.abs(parabola))
    out = np.zeros_like(y)
    out[1:-1] = (np.sign(left) + np.sign(right)) * least
    return out
