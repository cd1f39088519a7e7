"""Programs of quantities with prices: what `simplex.minimise` solves.

A program is `n` unknowns x and `k` rows r. Every unknown, and every r · x, is a quantity with a convex price:
it must stay in [lower, upper], and costs `low` per unit below `bound` and `high` per unit above it, where
low ≤ high. A limit, an equation, a cost, |v| and "cheap up to here, then dear, then no further" are such
curves, so none needs an unknown of its own. Wanted is the least sum of prices.

A program is a table with a column per quantity, unknowns first. Its rows are one array, since a compiled
function is called faster with one array than with twenty.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel

# Rows of the table of quantities: the curve, …
LOWER, BOUND, UPPER, LOW, HIGH = 0, 1, 2, 3, 4
# … its three kinks, the four ends of the prices between them, …
KINK, END = 5, 8
# … the value, between which values the price is right, whether it counts as above its bound, its place in
# the basis or -1, and n rows: the coefficients of each unknown.
VALUE, FLOOR, CEILING, ABOVE, PLACE, COLUMN = 12, 13, 14, 15, 16, 17
FAR = 1e6
"""Stands for the missing limit of an unknown."""


@kernel
def blank(n, k):
    """The table of a program of n unknowns and k rows, all zero; rows from COLUMN on hold coefficients."""
    t = np.zeros((COLUMN + n, n + k))
    for j in range(n):
        t[COLUMN + j, j] = 1.0
    return t


@kernel
def set_price(t, q, lower, bound, upper, low, high):
    """Writes the curve of quantity q; `bound` is finite."""
    t[LOWER, q], t[BOUND, q], t[UPPER, q], t[LOW, q], t[HIGH, q] = lower, bound, upper, low, high


def program(
    rows: Float[np.ndarray, "k n"],
    lower: Float[np.ndarray, "nk"],
    bound: Float[np.ndarray, "nk"],
    upper: Float[np.ndarray, "nk"],
    low: Float[np.ndarray, "nk"],
    high: Float[np.ndarray, "nk"],
) -> Float[np.ndarray, "table nk"]:
    """The table of a program: the rows, and the curves of n unknowns and k rows."""
    k, n = rows.shape
    t = blank(n, k)
    t[: HIGH + 1] = lower, bound, upper, low, high
    t[COLUMN:, n:] = rows.T
    return t


@kernel
def price_of(t, q, value):
    """What quantity q costs at a value within its limits."""
    d = value - t[BOUND, q]
    return t[HIGH, q] * d if d > 0.0 else (t[LOW, q] * d if d < 0.0 else 0.0)


@kernel
def prepare(t):
    """Writes kinks and ends of prices; returns a quantity whose curve is none, or -1."""
    n = t.shape[0] - COLUMN
    bad = -1
    for q in range(t.shape[1]):
        lower, bound, upper = t[LOWER, q], t[BOUND, q], t[UPPER, q]
        if q < n:
            lower, upper = (-FAR if lower < -FAR else lower), (FAR if upper > FAR else upper)
        bound = lower if bound < lower else bound
        bound = upper if bound > upper else bound
        t[KINK, q], t[KINK + 1, q], t[KINK + 2, q] = lower, bound, upper
        t[END, q], t[END + 1, q], t[END + 2, q], t[END + 3, q] = -np.inf, t[LOW, q], t[HIGH, q], np.inf
        if not (lower <= bound <= upper and t[LOW, q] <= t[HIGH, q]):
            bad = q
    return bad
