"""A basis of a priced program: n quantities at kinks of their curves, and what follows for the others.

Every quantity has a price y, with Σ y r = 0: one outside the basis that of the side it counts to be on, one
of the basis any between the prices on both sides of its kink. Beside the program's table `t` the functions
take a table `b` with a column per place of the basis.
"""

import math

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.piecewise_linear import (
    ABOVE,
    CEILING,
    COLUMN,
    END,
    FLOOR,
    HIGH,
    KINK,
    LOW,
    PLACE,
    VALUE,
)

# Rows of the table of the basis: the quantity, its kink, its price, the ends of that, …
WHO, PIECE, Y, LEAST, MOST = 0, 1, 2, 3, 4
# … of a step: what the newcomer is made of, how fast the prices fall, when they end, at the latest when, how
# x moves, and n rows: the inverse.
SHARE, RATE, UNTIL, LATEST, DX, INVERSE = 5, 6, 7, 8, 9, 10

SLACK = 1e-11
"""A price may go this far beyond its end, for the sake of a larger pivot (Harris)."""


@kernel
def set_piece(t, b, i, piece):
    """Puts quantity i of the basis at one of its kinks."""
    q = int(b[WHO, i])
    b[PIECE, i], b[LEAST, i], b[MOST, i] = piece, t[END + piece, q], t[END + piece + 1, q]


@kernel
def set_inside(t, b, i, q, piece):
    """Makes quantity q the one in place i of the basis, at a kink."""
    b[WHO, i], t[PLACE, q] = q, i
    t[FLOOR, q], t[CEILING, q] = -np.inf, np.inf
    set_piece(t, b, i, piece)


@kernel
def set_outside(t, q, above):
    """Puts quantity q outside the basis, below or above its bound."""
    t[PLACE, q], t[ABOVE, q] = -1.0, 1.0 if above else 0.0
    straight = t[LOW, q] == t[HIGH, q]
    t[FLOOR, q] = t[KINK + 1, q] if above and not straight else t[KINK, q]
    t[CEILING, q] = t[KINK + 2, q] if above or straight else t[KINK + 1, q]


@kernel
def outside_price(t, q):
    """The price of quantity q while it is not in the basis."""
    return t[HIGH, q] if t[ABOVE, q] > 0.0 else t[LOW, q]


@kernel
def set_share(t, b, q):
    """Writes how the row of quantity q is made of the rows of the basis."""
    n = b.shape[1]
    for i in range(n):
        b[SHARE, i] = 0.0
    for j in range(n):
        a = t[COLUMN + j, q]
        if a != 0.0:
            for i in range(n):
                b[SHARE, i] += a * b[INVERSE + j, i]


@kernel
def exchange(b, i):
    """The inverse with the row that the share is of in place i of the basis."""
    n = b.shape[1]
    per = 1.0 / b[SHARE, i]
    for j in range(n):
        f = b[INVERSE + j, i] * per
        if f != 0.0:
            for c in range(n):
                b[INVERSE + j, c] -= f * b[SHARE, c]
            b[INVERSE + j, i] = f


@kernel
def build(t, b, hints):
    """The basis of the hinted quantities `3 q + piece`, as far as they fit, and of unknowns for the rest."""
    n, count = b.shape[1], t.shape[1]
    for q in range(count):
        t[PLACE, q] = -1.0
    for i in range(n):
        for j in range(n):
            b[INVERSE + i, j] = 1.0 if i == j else 0.0
        set_inside(t, b, i, i, 1)
        b[RATE, i] = 0.0
    # The rate marks here the places that hold what was hinted.
    for h in hints:
        if 0 <= h < 3 * n:
            b[RATE, h // 3] = 1.0
            set_piece(t, b, h // 3, h % 3)
    for h in hints:
        q = h // 3
        if not n <= q < count or t[PLACE, q] >= 0.0 or not math.isfinite(t[KINK + h % 3, q]):
            continue
        set_share(t, b, q)
        best, largest = -1, 1e-6
        for i in range(n):
            if b[RATE, i] == 0.0 and abs(b[SHARE, i]) > largest:
                best, largest = i, abs(b[SHARE, i])
        if best >= 0:
            t[PLACE, int(b[WHO, best])] = -1.0
            exchange(b, best)
            set_inside(t, b, best, q, h % 3)
            b[RATE, best] = 1.0


@kernel
def move(t, b):
    """Moves x by dx, and all quantities with it."""
    for j in range(b.shape[1]):
        d = b[DX, j]
        if d != 0.0:
            for q in range(t.shape[1]):
                t[VALUE, q] += d * t[COLUMN + j, q]


@kernel
def set_values(t, b):
    """Writes the values of all quantities where those of the basis are at their kinks, refined once."""
    n = b.shape[1]
    for q in range(t.shape[1]):
        t[VALUE, q] = 0.0
    for _ in range(2):
        for j in range(n):
            b[DX, j] = 0.0
        for i in range(n):
            q = int(b[WHO, i])
            off = t[KINK + int(b[PIECE, i]), q] - t[VALUE, q]
            if off != 0.0:
                for j in range(n):
                    b[DX, j] += b[INVERSE + j, i] * off
        move(t, b)


@kernel
def set_prices(t, b):
    """Writes the prices of the basis: those that balance the prices of all others."""
    n = b.shape[1]
    for j in range(n):
        b[DX, j] = b[Y, j] = 0.0
    for q in range(t.shape[1]):
        y = outside_price(t, q)
        if t[PLACE, q] < 0.0 and y != 0.0:
            for j in range(n):
                b[DX, j] += y * t[COLUMN + j, q]
    for j in range(n):
        d = b[DX, j]
        if d != 0.0:
            for i in range(n):
                b[Y, i] -= d * b[INVERSE + j, i]


@kernel
def misfit(t, b, i):
    """How far price i of the basis is from fitting any kink; where it fits one, the quantity goes there."""
    q, y = int(b[WHO, i]), b[Y, i]
    if b[LEAST, i] - SLACK <= y <= b[MOST, i] + SLACK:
        return 0.0
    piece = 0 if y < t[LOW, q] else (2 if y > t[HIGH, q] else 1)
    if not math.isfinite(t[KINK + piece, q]):
        return t[LOW, q] - y if piece == 0 else y - t[HIGH, q]
    set_piece(t, b, i, piece)
    return 0.0


@kernel
def repair(t, b):
    """Takes the quantities out whose prices fit nowhere; an unknown, limited on both sides, always fits."""
    n = b.shape[1]
    for _ in range(n + 1):
        out, most = -1, 0.0
        for i in range(n):
            wrong = misfit(t, b, i)
            if wrong > most:
                out, most = i, wrong
        if out < 0:
            break
        enter, largest = -1, 0.0
        for j in range(n):
            if t[PLACE, j] < 0.0 and abs(b[INVERSE + j, out]) > largest:
                enter, largest = j, abs(b[INVERSE + j, out])
        set_share(t, b, enter)
        q, y = int(b[WHO, out]), outside_price(t, enter)
        above = b[Y, out] > t[HIGH, q]
        d = (b[Y, out] - t[HIGH if above else LOW, q]) / b[SHARE, out]
        for i in range(n):
            b[Y, i] -= d * b[SHARE, i]
        set_outside(t, q, above)
        exchange(b, out)
        set_inside(t, b, out, enter, 1)
        b[Y, out] = y + d
