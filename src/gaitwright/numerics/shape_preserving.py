"""A smooth curve through points, at rest at both ends, that never overshoots them (row J3).

Between two points a polynomial of degree five takes over value, slope and curvature of both, so the second
derivative is continuous everywhere: torques follow it. Slopes and curvatures are those of the quintic spline
(four continuous derivatives); where that would swing beyond two neighbouring points, theirs are limited as
far as it takes, in the way of Fritsch and Carlson (1980). Through (0, 0) and (1, 1) alone the curve is
10s³ − 15s⁴ + 6s⁵.
"""

from math import comb

import numpy as np
from jaxtyping import Bool, Float

ROUNDING = 1e-9
"""A slope this little against the way of its part, as a share of the steepest, is none."""

BERNSTEIN = np.array([[comb(i, k) / comb(4, k) for k in range(5)] for i in range(5)])
"""From coefficients of a polynomial of degree four to its Bernstein coefficients over [0, 1]."""

Points = Float[np.ndarray, "points"]


def curve(s: Points, y: Points, at: Float[np.ndarray, "n"]) -> Float[np.ndarray, "n 3"]:
    """Value, first and second derivative at `at` of the curve through `(s, y)`; `s` ascends."""
    slope, curvature = shape_preserving(s, y)
    part = np.clip(np.searchsorted(s, at, side="right") - 1, 0, len(s) - 2)
    c0, c1, c2, c3, c4, c5 = polynomials(s, y, slope, curvature)[part].T
    h = np.diff(s)[part]
    t = (at - s[part]) / h
    value = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))))
    first = c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)))
    second = 2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))
    return np.stack([value, first / h, second / (h * h)], axis=1)


def shape_preserving(s: Points, y: Points) -> tuple[Points, Points]:
    """First and second derivative at every point: the spline's, limited beside parts that swing too far."""
    slope, curvature = spline(s, y)
    least, most = limited(s, y, slope, curvature)
    while True:
        swings = ~monotone(s, y, slope, curvature)
        beside = np.zeros(len(s), dtype=bool)
        beside[:-1] |= swings
        beside[1:] |= swings
        if not (swings.any() and ((slope != least) | (curvature != most))[beside].any()):
            return slope, curvature
        slope, curvature = np.where(beside, least, slope), np.where(beside, most, curvature)


def polynomials(s: Points, y: Points, slope: Points, curvature: Points) -> Float[np.ndarray, "parts 6"]:
    """Coefficients of each part by its own share t, the constant first."""
    h = np.diff(s)
    c0, c1, c2 = y[:-1], h * slope[:-1], 0.5 * h * h * curvature[:-1]
    rise = y[1:] - c0 - c1 - c2
    lean = h * slope[1:] - c1 - 2.0 * c2
    bend = h * h * curvature[1:] - 2.0 * c2
    c3 = 10.0 * rise - 4.0 * lean + 0.5 * bend
    c4 = -15.0 * rise + 7.0 * lean - bend
    c5 = 6.0 * rise - 3.0 * lean + 0.5 * bend
    return np.stack([c0, c1, c2, c3, c4, c5], axis=1)


def spline(s: Points, y: Points) -> tuple[Points, Points]:
    """Slope and curvature of the quintic spline, zero at both ends; level at turning points.

    At an inner point third and fourth derivatives agree on both sides. Where the points turn, the slope is
    zero in place of the fourth; beside a level part the curvature too, in place of the third.
    """
    n = len(s)
    h, secant = np.diff(s), np.diff(y) / np.diff(s)
    rows, right = np.eye(2 * n), np.zeros(2 * n)  # of (slope, curvature) at every point in turn
    for k in range(1, n - 1):
        a, b, rise, fall = h[k - 1], h[k], secant[k - 1], secant[k]
        around = slice(2 * k - 2, 2 * k + 4)
        if rise * fall > 0.0:
            fourth = -168 / a**3, -24 / a**2, -192 / a**3 - 192 / b**3, 36 / a**2 - 36 / b**2
            rows[2 * k, around] = (*fourth, -168 / b**3, 24 / b**2)
            right[2 * k] = -360 * (rise / a**3 + fall / b**3)
        if rise * fall != 0.0:
            third = -24 / a**2, -3 / a, 36 / b**2 - 36 / a**2, 9 / a + 9 / b
            rows[2 * k + 1, around] = (*third, 24 / b**2, -3 / b)
            right[2 * k + 1] = 60 * (fall / b**2 - rise / a**2)
    answer = np.linalg.solve(rows, right)
    answer[:2] = answer[-2:] = 0.0  # but for rounding they are
    return answer[::2], answer[1::2]


def limited(s: Points, y: Points, slope: Points, curvature: Points) -> tuple[Points, Points]:
    """Slopes and curvatures kept to where every part is monotone, whatever the others are.

    In Bernstein form a part of width h and secant Δ > 0 that starts with slope d and curvature a begins
    with y, y + hd/5, y + 2hd/5 + h²a/20; it is monotone if these ascend and stay below y + hΔ/2, and its
    end likewise: −d/5 ≤ ha/20 ≤ Δ/2 − 2d/5. Some `a` does so on both sides of a point if d is at most 2.5
    times the flatter secant and 1.25 times the parabola's slope.
    """
    h, secant = np.diff(s), np.diff(y) / np.diff(s)
    left, right, rise, fall = h[:-1], h[1:], secant[:-1], secant[1:]
    parabola = (right * rise + left * fall) / (left + right)
    most = np.minimum(1.25 * np.abs(parabola), 2.5 * np.minimum(np.abs(rise), np.abs(fall)))
    most = np.where(rise * fall > 0.0, most, 0.0)
    d = np.sign(rise) * np.clip(np.sign(rise) * slope[1:-1], 0.0, most)
    fifth = 0.2 * np.abs(d)
    out = 20.0 * np.sign(fall) / right * np.stack([-fifth, 0.5 * np.abs(fall) - 2.0 * fifth])
    into = 20.0 * np.sign(rise) / left * np.stack([2.0 * fifth - 0.5 * np.abs(rise), fifth])
    low = np.maximum(out.min(axis=0), into.min(axis=0))
    high = np.minimum(out.max(axis=0), into.max(axis=0))
    return np.pad(d, 1), np.pad(np.clip(curvature[1:-1], low, high), 1)


def monotone(s: Points, y: Points, slope: Points, curvature: Points) -> Bool[np.ndarray, "parts"]:
    """Which parts never turn back: their slope is looked at where it is least and greatest."""
    parts = polynomials(s, y, slope, curvature)
    return np.array([goes_one_way(part[1:] * np.arange(1, 6)) for part in parts])


def goes_one_way(rate: Float[np.ndarray, "5"]) -> bool:
    """Whether a polynomial of degree four, the constant first, has one sign over [0, 1]."""
    corners = BERNSTEIN @ rate  # it stays between the least and the greatest of these
    if (corners >= 0.0).all() or (corners <= 0.0).all():
        return True
    turns = np.roots((rate[1:] * np.arange(1, 5))[::-1])
    inside = turns.real[(np.abs(turns.imag) < ROUNDING) & (turns.real > 0.0) & (turns.real < 1.0)]
    rates = np.polyval(rate[::-1], np.concatenate([[0.0, 1.0], inside]))
    return bool(min(rates.max(), -rates.min()) <= ROUNDING * np.abs(rates).max())
