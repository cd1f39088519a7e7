"""Vectors, rotations and quaternions: compiled, and as small as they can be.

A 3-vector inside a kernel is a tuple `(x, y, z)`: the compiler keeps it in registers, and the code
reads like the equations. A quaternion is `(w, x, y, z)`; `R_wb` takes body components to world ones.
"""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel

GRAVITY = 9.81
"""Gravity [m/s²], along -z of the world."""


# --- 3-vectors as tuples -------------------------------------------------------------------------
@kernel
def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@kernel
def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@kernel
def scale(k, a):
    return (k * a[0], k * a[1], k * a[2])


@kernel
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def length(a):
    """Of a vector."""
    return math.sqrt(dot(a, a))


@kernel
def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def vec(array):
    """A row of an array as a 3-vector."""
    return (array[0], array[1], array[2])


@kernel
def times(matrix, a):
    """`matrix @ a` for a 3×3 array and a 3-vector."""
    return (
        matrix[0, 0] * a[0] + matrix[0, 1] * a[1] + matrix[0, 2] * a[2],
        matrix[1, 0] * a[0] + matrix[1, 1] * a[1] + matrix[1, 2] * a[2],
        matrix[2, 0] * a[0] + matrix[2, 1] * a[1] + matrix[2, 2] * a[2],
    )


@kernel
def times_t(matrix, a):
    """`matrix.T @ a` for a 3×3 array and a 3-vector."""
    return (
        matrix[0, 0] * a[0] + matrix[1, 0] * a[1] + matrix[2, 0] * a[2],
        matrix[0, 1] * a[0] + matrix[1, 1] * a[1] + matrix[2, 1] * a[2],
        matrix[0, 2] * a[0] + matrix[1, 2] * a[1] + matrix[2, 2] * a[2],
    )


@kernel
def turn_x(c, s, a):
    """`a` turned about x by the angle with cosine `c` and sine `s` (use `-s` to turn back)."""
    return (a[0], c * a[1] - s * a[2], s * a[1] + c * a[2])


@kernel
def turn_y(c, s, a):
    """`a` turned about y by the angle with cosine `c` and sine `s` (use `-s` to turn back)."""
    return (c * a[0] + s * a[2], a[1], c * a[2] - s * a[0])


# --- rotations -----------------------------------------------------------------------------------
@kernel
def rotation(quaternion):
    """Rotation matrix `(3, 3)` of a quaternion `(w, x, y, z)` of any positive length."""
    w, x, y, z = quaternion[0], quaternion[1], quaternion[2], quaternion[3]
    k = 2.0 / (w * w + x * x + y * y + z * z)
    out = np.empty((3, 3))
    out[0, 0], out[0, 1], out[0, 2] = 1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)
    out[1, 0], out[1, 1], out[1, 2] = k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)
    out[2, 0], out[2, 1], out[2, 2] = k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)
    return out


@kernel
def rotations(quaternions):
    """`rotation` of each of many: `(n, 4)` → `(n, 3, 3)`."""
    out = np.empty((quaternions.shape[0], 3, 3))
    for i in range(quaternions.shape[0]):
        out[i] = rotation(quaternions[i])
    return out


@kernel
def between(start, end):
    """The rotation that takes `start` to `end`: `end @ start.T`."""
    out = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            out[i, j] = dot(vec(end[i]), vec(start[j]))
    return out


@kernel
def rotation_vector(matrix):
    """Logarithm of a rotation matrix: axis times angle [rad], angle in [0, π]."""
    x = matrix[2, 1] - matrix[1, 2]
    y = matrix[0, 2] - matrix[2, 0]
    z = matrix[1, 0] - matrix[0, 1]
    sine = 0.5 * math.sqrt(x * x + y * y + z * z)
    cosine = 0.5 * (matrix[0, 0] + matrix[1, 1] + matrix[2, 2] - 1.0)
    angle = math.atan2(sine, cosine)
    if sine > 1e-9:
        return scale(0.5 * angle / sine, (x, y, z))
    if cosine > 0.0:
        return (0.5 * x, 0.5 * y, 0.5 * z)
    # Half a turn: the axis is the longest column of (R + 1)/2, its sign free.
    i = 0
    for j in range(1, 3):
        if matrix[j, j] > matrix[i, i]:
            i = j
    length = math.sqrt(max(0.5 * (matrix[i, i] + 1.0), 1e-12))
    k = math.pi / (2.0 * length)
    return scale(k, (matrix[0, i] + (i == 0), matrix[1, i] + (i == 1), matrix[2, i] + (i == 2)))


@kernel
def heading(matrix):
    """Yaw [rad] of a rotation matrix: the direction of its x axis seen from above."""
    return math.atan2(matrix[1, 0], matrix[0, 0])


@kernel
def upright_rotation(normal, yaw):
    """Rotation `(3, 3)` whose z axis is the unit `normal`, which points up, and whose yaw is `yaw`.

    The x axis lies in the plane, straight above or below the horizontal direction (equations.md §2).
    """
    forward = (math.cos(yaw), math.sin(yaw), 0.0)
    x = (forward[0], forward[1], -dot(forward, normal) / normal[2])
    x = scale(1.0 / length(x), x)
    y = cross(normal, x)
    out = np.empty((3, 3))
    for i in range(3):
        out[i, 0], out[i, 1], out[i, 2] = x[i], y[i], normal[i]
    return out


@kernel
def wrap(angle):
    """`angle` [rad] brought into (-π, π]."""
    return math.atan2(math.sin(angle), math.cos(angle))


# --- for people, not kernels ---------------------------------------------------------------------
def quaternion_of(matrix: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4"]:
    """Unit quaternion `(w, x, y, z)`, w ≥ 0, of a rotation matrix.

    From its largest component (Shepperd 1978), so that it is exact for every turn.
    """
    # Squares of the components, times four, less one: the trace belongs to w.
    squares = np.array([np.trace(matrix), *(2.0 * np.diag(matrix) - np.trace(matrix))])
    largest = int(squares.argmax())
    sums = matrix + matrix.T
    products = np.array(
        [
            [
                1.0 + squares[0],
                matrix[2, 1] - matrix[1, 2],
                matrix[0, 2] - matrix[2, 0],
                matrix[1, 0] - matrix[0, 1],
            ],
            [matrix[2, 1] - matrix[1, 2], 1.0 + squares[1], sums[0, 1], sums[0, 2]],
            [matrix[0, 2] - matrix[2, 0], sums[0, 1], 1.0 + squares[2], sums[1, 2]],
            [matrix[1, 0] - matrix[0, 1], sums[0, 2], sums[1, 2], 1.0 + squares[3]],
        ]
    )
    q = products[largest] / np.linalg.norm(products[largest])
    return q if q[0] >= 0.0 else -q


def yaw_quaternion(yaw: float) -> Float[np.ndarray, "4"]:
    """Unit quaternion of a turn about the vertical [rad]."""
    return np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)])


def roll_pitch_yaw(matrix: Float[np.ndarray, "*batch 3 3"]) -> Float[np.ndarray, "*batch 3"]:
    """Roll, pitch, yaw [rad] (3-2-1, equations.md §1) of rotation matrices `R_wb`.

    At a pitch of ±90°, where only their difference is known, the yaw is 0.
    """
    m = np.moveaxis(matrix, (-2, -1), (0, 1))
    level = np.hypot(m[0, 0], m[1, 0])
    known = level >= 1e-9
    roll = np.where(known, np.arctan2(m[2, 1], m[2, 2]), np.arctan2(-m[1, 2], m[1, 1]))
    yaw = np.where(known, np.arctan2(m[1, 0], m[0, 0]), 0.0)
    return np.stack([roll, np.arctan2(-m[2, 0], level), yaw], axis=-1)


def from_roll_pitch_yaw(angles: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3 3"]:
    """Rotation matrices `R_wb` of roll, pitch, yaw [rad]: about z, then y, then x (eq. 3-1)."""
    (cr, cp, cy), (sr, sp, sy) = (np.moveaxis(f(angles), -1, 0) for f in (np.cos, np.sin))
    rows = (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def about_axis(axis: int, angle: float) -> Float[np.ndarray, "3 3"]:
    """Rotation about x (0), y (1) or z (2) by an angle [rad]."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = np.eye(3)
    out[i, i] = out[j, j] = math.cos(angle)
    out[j, i] = math.sin(angle)
    out[i, j] = -out[j, i]
    return out


def wrapped(angles: Float[np.ndarray, "*batch"]) -> Float[np.ndarray, "*batch"]:
    """`wrap` of many angles [rad]."""
    return np.arctan2(np.sin(angles), np.cos(angles))


FROM_THESIS = np.diag([1.0, -1.0, -1.0])
"""Turns the thesis's axes (x forward, y right, z down) into ours (x forward, y left, z up), and back."""


def from_thesis(vector: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 3"]:
    """A vector given in the thesis's axes, in ours. The same turn takes it back."""
    return vector @ FROM_THESIS
