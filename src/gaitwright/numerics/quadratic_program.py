"""Quadratic programs of a dozen unknowns inside kernels: the dual active-set method of Goldfarb and Idnani.

D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic programs",
Mathematical Programming 27 (1983). It starts at the minimum without limits and takes in one violated limit
after the other. Our own because a call out of a kernel costs more than the solution; quadprog is what tests
and bench compare it with.
"""

import math

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.status import INFEASIBLE, NOT_FINITE, SOLVED, TOO_MANY_STEPS

TOLERANCE = 1e-10
"""A limit violated by less than this, in the units of its row, is kept."""
VANISHED = 1e-13
"""A direction whose share left outside the active limits is smaller than this is spanned by them."""


@kernel
def minimise(hessian, gradient, rows, lower, upper):
    """Minimises ½ xᵀHx + gᵀx with `lower` ≤ (x, `rows` @ x) ≤ `upper`; H is positive definite.

    Returns x `(n,)`, prices `(k,)` with H x + g = Σ prices · rows (positive at a lower bound, negative
    at an upper one, 0 where a limit is not felt), a code, and the limit that no
    x can keep beside the others where it is infeasible, else −1; the prices are then those of the others.
    """
    n, k = gradient.size, lower.size
    basis = inverse_factor(hessian)
    x = unbounded_minimum(basis, gradient)
    triangle = np.zeros((n, n))
    active, side = np.empty(n, dtype=np.int64), np.empty(n)
    price, d, towards = np.zeros(n + 1), np.empty(n), np.empty(n)
    prices = np.zeros(k)
    q = 0
    for _ in range(1 + 20 * (n + k)):
        worst, sign, short = most_violated(rows, lower, upper, x)
        if worst < 0:
            write_prices(prices, active, side, price, q)
            return x, prices, SOLVED if math.isfinite(x.sum()) else NOT_FINITE, -1
        price[q] = 0.0
        while short > 0.0:
            project(basis, rows, worst, sign, d)
            size = through(basis, d, q, towards)
            whole = short / size if size > VANISHED * (1.0 + length2(d, q)) else math.inf
            back_substitute(triangle, d, q)
            part, leaving = first_to_vanish(price, d, q)
            step = min(part, whole)
            if step == math.inf:
                write_prices(prices, active, side, price, q)
                return x, prices, INFEASIBLE, worst
            for i in range(q):
                price[i] -= step * d[i]
            price[q] += step
            if whole < math.inf:
                for i in range(n):
                    x[i] += step * towards[i]
                short -= step * size
            if part < whole:
                q = leave(basis, triangle, active, side, price, q, leaving)
                continue
            project(basis, rows, worst, sign, d)
            enter(basis, triangle, d, q)
            active[q], side[q] = worst, sign
            q += 1
            break
    return x, prices, TOO_MANY_STEPS, -1


@kernel
def write_prices(prices, active, side, price, q):
    for i in range(q):
        prices[active[i]] += side[i] * price[i]


@kernel
def inverse_factor(hessian):
    """J with J Jᵀ = H⁻¹: the inverse of Cholesky's factor, transposed."""
    n = hessian.shape[0]
    factor = np.empty((n, n))
    for i in range(n):
        for j in range(i + 1):
            total = hessian[i, j]
            for m in range(j):
                total -= factor[i, m] * factor[j, m]
            factor[i, j] = math.sqrt(total) if i == j else total / factor[j, j]
    out = np.zeros((n, n))
    for j in range(n):
        out[j, j] = 1.0 / factor[j, j]
        for i in range(j + 1, n):
            total = 0.0
            for m in range(j, i):
                total -= factor[i, m] * out[j, m]
            out[j, i] = total / factor[i, i]
    return out


@kernel
def unbounded_minimum(basis, gradient):
    """−H⁻¹ g."""
    n = gradient.size
    x = np.zeros(n)
    for j in range(n):
        total = 0.0
        for i in range(j + 1):
            total += basis[i, j] * gradient[i]
        for i in range(j + 1):
            x[i] -= total * basis[i, j]
    return x


@kernel
def most_violated(rows, lower, upper, x):
    """The limit that x violates most, +1 below its lower bound or −1 above its upper one, and by how much."""
    n = x.size
    worst, sign, short = -1, 0.0, TOLERANCE
    for k in range(lower.size):
        value = x[k] if k < n else 0.0
        if k >= n:
            for i in range(n):
                value += rows[k - n, i] * x[i]
        if lower[k] - value > short:
            worst, sign, short = k, 1.0, lower[k] - value
        if value - upper[k] > short:
            worst, sign, short = k, -1.0, value - upper[k]
    return worst, sign, short


@kernel
def project(basis, rows, limit, sign, d):
    """Writes d = Jᵀ n for the inward normal n of a limit."""
    n = d.size
    for j in range(n):
        if limit < n:
            d[j] = sign * basis[limit, j]
        else:
            total = 0.0
            for i in range(n):
                total += basis[i, j] * rows[limit - n, i]
            d[j] = sign * total


@kernel
def length2(d, q):
    """Square of the part of d that lies in the active limits."""
    total = 0.0
    for j in range(q):
        total += d[j] * d[j]
    return total


@kernel
def through(basis, d, q, towards):
    """Writes the step direction z = J₂ d₂, along which active limits stay tight; returns its slope zᵀn."""
    n = d.size
    size = 0.0
    for j in range(q, n):
        size += d[j] * d[j]
    for i in range(n):
        total = 0.0
        for j in range(q, n):
            total += basis[i, j] * d[j]
        towards[i] = total
    return size


@kernel
def back_substitute(triangle, d, q):
    """Turns the first q numbers of d into r = R⁻¹ d₁: how the active prices give way."""
    for i in range(q - 1, -1, -1):
        total = d[i]
        for j in range(i + 1, q):
            total -= triangle[i, j] * d[j]
        d[i] = total / triangle[i, i]


@kernel
def first_to_vanish(price, r, q):
    """The longest step that keeps every active price ≥ 0, and whose price it is that ends it."""
    part, leaving = math.inf, -1
    for i in range(q):
        if r[i] > VANISHED and price[i] < part * r[i]:
            part, leaving = price[i] / r[i], i
    return part, leaving


@kernel
def enter(basis, triangle, d, q):
    """Takes the limit with projection d in: turns of J's columns gather d₂ in one number, R's new column."""
    n = d.size
    for j in range(n - 1, q, -1):
        c, s, d[j - 1] = turn(d[j - 1], d[j])
        for i in range(n):
            a, b = basis[i, j - 1], basis[i, j]
            basis[i, j - 1], basis[i, j] = c * a + s * b, c * b - s * a
    for i in range(q + 1):
        triangle[i, q] = d[i]


@kernel
def leave(basis, triangle, active, side, price, q, leaving):
    """Lets an active limit go: shifts the others up, makes R triangular again; returns how many are left."""
    n = basis.shape[0]
    for j in range(leaving, q - 1):
        active[j], side[j], price[j] = active[j + 1], side[j + 1], price[j + 1]
        for i in range(j + 2):
            triangle[i, j] = triangle[i, j + 1]
    price[q - 1] = price[q]
    for j in range(leaving, q - 1):
        c, s, triangle[j, j] = turn(triangle[j, j], triangle[j + 1, j])
        for m in range(j + 1, q - 1):
            a, b = triangle[j, m], triangle[j + 1, m]
            triangle[j, m], triangle[j + 1, m] = c * a + s * b, c * b - s * a
        for i in range(n):
            a, b = basis[i, j], basis[i, j + 1]
            basis[i, j], basis[i, j + 1] = c * a + s * b, c * b - s * a
    return q - 1


@kernel
def turn(a, b):
    """Cosine and sine of the plane turn that takes (a, b) to (length, 0), and the length."""
    length = math.hypot(a, b)
    if length == 0.0:
        return 1.0, 0.0, 0.0
    return a / length, b / length, length
