"""3×3 matrices inside kernels: tuples of three row 3-vectors, which the compiler keeps in registers.

`mat` and `row` read one from an array of many, by its number: a view `array[k]` would be counted in and
out of memory, which costs more than the arithmetic. `put` and `put_row` write it back.
"""

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub, turn_x, turn_y, vec


# --- arrays of many ------------------------------------------------------------------------------
@kernel
def row(array, k):
    """Row `k` of an `(n, 3)` array as a 3-vector."""
    return (array[k, 0], array[k, 1], array[k, 2])


@kernel
def put_row(array, k, a):
    """Writes a 3-vector into row `k`."""
    array[k, 0], array[k, 1], array[k, 2] = a


@kernel
def add_row(array, k, a):
    """Adds a 3-vector to row `k`."""
    array[k, 0] += a[0]
    array[k, 1] += a[1]
    array[k, 2] += a[2]


@kernel
def mat(array, k):
    """Matrix `k` of an `(n, 3, 3)` array."""
    return (
        (array[k, 0, 0], array[k, 0, 1], array[k, 0, 2]),
        (array[k, 1, 0], array[k, 1, 1], array[k, 1, 2]),
        (array[k, 2, 0], array[k, 2, 1], array[k, 2, 2]),
    )


@kernel
def put(array, k, X):
    """Writes a matrix into place `k`."""
    array[k, 0, 0], array[k, 0, 1], array[k, 0, 2] = X[0]
    array[k, 1, 0], array[k, 1, 1], array[k, 1, 2] = X[1]
    array[k, 2, 0], array[k, 2, 1], array[k, 2, 2] = X[2]


# --- one of several in an array of numbers -------------------------------------------------------
@kernel
def vec_at(numbers, i):
    """The 3-vector that starts at number `i`."""
    return (numbers[i], numbers[i + 1], numbers[i + 2])


@kernel
def rows_at(numbers, i):
    """The three rows that start at number `i`."""
    return (vec_at(numbers, i), vec_at(numbers, i + 3), vec_at(numbers, i + 6))


@kernel
def write(numbers, i, a):
    """Puts a 3-vector at number `i`."""
    numbers[i], numbers[i + 1], numbers[i + 2] = a


@kernel
def rows(matrix):
    """The rows of a 3×3 array."""
    return (vec(matrix[0]), vec(matrix[1]), vec(matrix[2]))


# --- matrices ------------------------------------------------------------------------------------
@kernel
def diagonal(k):
    """k times the identity."""
    return ((k, 0.0, 0.0), (0.0, k, 0.0), (0.0, 0.0, k))


@kernel
def skew(a):
    """~a, the matrix of the cross product: ~a b = a × b."""
    return ((0.0, -a[2], a[1]), (a[2], 0.0, -a[0]), (-a[1], a[0], 0.0))


@kernel
def transpose(X):
    return (
        (X[0][0], X[1][0], X[2][0]),
        (X[0][1], X[1][1], X[2][1]),
        (X[0][2], X[1][2], X[2][2]),
    )


@kernel
def plus(X, Y):
    return (add(X[0], Y[0]), add(X[1], Y[1]), add(X[2], Y[2]))


@kernel
def minus(X, Y):
    return (sub(X[0], Y[0]), sub(X[1], Y[1]), sub(X[2], Y[2]))


@kernel
def apply(X, a):
    """X a."""
    return (dot(X[0], a), dot(X[1], a), dot(X[2], a))


@kernel
def apply_t(X, a):
    """Xᵀ a."""
    return add(scale(a[0], X[0]), add(scale(a[1], X[1]), scale(a[2], X[2])))


@kernel
def product(X, Y):
    """X Y."""
    return (apply_t(Y, X[0]), apply_t(Y, X[1]), apply_t(Y, X[2]))


@kernel
def product_t(X, Y):
    """X Yᵀ."""
    return (apply(Y, X[0]), apply(Y, X[1]), apply(Y, X[2]))


@kernel
def t_product(X, Y):
    """Xᵀ Y."""
    return product(transpose(X), Y)


@kernel
def skewed(a, X):
    """~a X, the cross product of `a` with every column of X, without the zeros of ~a."""
    return (
        sub(scale(a[1], X[2]), scale(a[2], X[1])),
        sub(scale(a[2], X[0]), scale(a[0], X[2])),
        sub(scale(a[0], X[1]), scale(a[1], X[0])),
    )


@kernel
def inverse(X):
    """Inverse of a symmetric definite matrix, by cofactors; exactly symmetric."""
    a, b, c = cross(X[1], X[2]), cross(X[2], X[0]), cross(X[0], X[1])
    k = 1.0 / dot(X[0], a)
    xy, xz, yz = k * a[1], k * a[2], k * b[2]
    return ((k * a[0], xy, xz), (xy, k * b[1], yz), (xz, yz, k * c[2]))


@kernel
def less_outer(X, u, v):
    """`X − u vᵀ`."""
    return (sub(X[0], scale(u[0], v)), sub(X[1], scale(u[1], v)), sub(X[2], scale(u[2], v)))


@kernel
def crossed(r, X):
    """`X r̃ᵀ`: every row becomes r × row."""
    return (cross(r, X[0]), cross(r, X[1]), cross(r, X[2]))


# --- a child's matrix in its parent's axes: R X Rᵀ -----------------------------------------------
@kernel
def seen_past_x(c, s, X):
    """`R X Rᵀ` for the turn R about x: a child's matrix in its parent's axes."""
    X = transpose((turn_x(c, s, X[0]), turn_x(c, s, X[1]), turn_x(c, s, X[2])))
    return transpose((turn_x(c, s, X[0]), turn_x(c, s, X[1]), turn_x(c, s, X[2])))


@kernel
def seen_past_y(c, s, X):
    """The same for a turn about y."""
    X = transpose((turn_y(c, s, X[0]), turn_y(c, s, X[1]), turn_y(c, s, X[2])))
    return transpose((turn_y(c, s, X[0]), turn_y(c, s, X[1]), turn_y(c, s, X[2])))


@kernel
def seen_in_base(frame, X):
    """The same for the leg frame."""
    X = transpose((apply(frame, X[0]), apply(frame, X[1]), apply(frame, X[2])))
    return transpose((apply(frame, X[0]), apply(frame, X[1]), apply(frame, X[2])))
