"""How stiff the restorative springs may be, and how long a step they stand (row N7).

Both are asked of the recursion itself. The *rows* of a pose are all the motions that a spring or damper
works on: the forbidden turns, the hinges at their limits, the feet on the ground. A unit load on one row,
and the accelerations of all rows, give the mobility Y; with stiffness K and damping D of the rows, small
motions obey s'' = -Y (K s + D s'), and a step of `h` is stable where it makes none of them grow. The
stiff ones are twists of slender links (equations.md §3).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.armstrong import fast_accelerations, slow_coefficients
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub
from gaitwright.numerics.matrices import add_row, apply, apply_t, mat, put_row, row
from gaitwright.plant.armstrong.integrators import Method
from gaitwright.plant.armstrong.joints import BOTH, CREEP, guides, hinge_axes, relative
from gaitwright.plant.armstrong.rotors import newton_matrix
from gaitwright.plant.armstrong.system import System, parts, rotations

MARGIN = 0.8
"""Steps stay below this share of the longest that is stable: motions are not quite small."""
GROWTH = 1e-7
"""What counts as growth in one step, above rounding [-]."""


# --- mobility ------------------------------------------------------------------------------------
@kernel
def joint_rows(system, R):
    """Joint and axis `(joint number, x, y, z)` of every row in the joints, joint axes: guides, then hinges.

    Four per joint, in this order: guide 1, guide 2, hinge 1, hinge 2; zero axes where there is none.
    """
    joints = system.joints
    out = np.zeros((4 * joints.link.size, 4))
    for j in range(joints.link.size):
        B = relative(system.tree, joints, j, R)
        _, n1, _, n2 = guides(joints.kind[j], B)
        a1, a2 = hinge_axes(joints.kind[j], joints.sign[j], B)
        for i in range(4):
            axis = (n1, n2, a1, a2)[i]
            out[4 * j + i, 0] = j
            out[4 * j + i, 1], out[4 * j + i, 2], out[4 * j + i, 3] = axis
    return out


@kernel
def mobility(system, y):
    """Y `(rows, rows)` in a pose: accelerations of all rows under a unit load on one.

    Rows: four per joint (`joint_rows`), then three per foot, world axes.
    """
    tree, joints, feet = system.tree, system.joints, system.feet
    R = rotations(parts(system, y).quaternion)
    slow = slow_coefficients(tree, R)
    axes = joint_rows(system, R)
    n, m = tree.mass.size, axes.shape[0]
    out = np.zeros((m + 3 * feet.link.size, m + 3 * feet.link.size))
    none = np.zeros((n, 3))
    for i in range(out.shape[0]):
        torque, force, moment = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))
        if i < m:
            j = int(axes[i, 0])
            B = relative(tree, joints, j, R)
            put_row(torque, joints.link[j], apply_t(B, (axes[i, 1], axes[i, 2], axes[i, 3])))
        else:
            f, k = (i - m) // 3, feet.link[(i - m) // 3]
            force[k, (i - m) % 3] = 1.0
            put_row(moment, k, cross(apply(mat(R, k), row(feet.at, f)), row(force, k)))
        a = fast_accelerations(tree, slow, R, none, torque, force, moment, np.zeros(3))
        write_response(system, R, axes, a, out[i])
    return out


@kernel
def write_response(system, R, axes, a, out):
    """Writes the accelerations of all rows, from those of a system that was at rest."""
    tree, joints, feet = system.tree, system.joints, system.feet
    m = axes.shape[0]
    for i in range(m):
        j = int(axes[i, 0])
        k = joints.link[j]
        B = relative(tree, joints, j, R)
        turning = sub(apply(B, row(a, 1 + k)), apply_t(mat(joints.frame, j), row(a, 1 + tree.parent[k])))
        out[i] = dot(turning, (axes[i, 1], axes[i, 2], axes[i, 3]))
    at = np.zeros((tree.mass.size, 3))
    put_row(at, 0, row(a, 0))
    for k in range(1, tree.mass.size):
        p = tree.parent[k]
        add_row(at, k, add(row(at, p), apply(mat(R, p), cross(row(a, 1 + p), row(tree.hinge, k)))))
    for f in range(feet.link.size):
        k = feet.link[f]
        foot = add(row(at, k), apply(mat(R, k), cross(row(a, 1 + k), row(feet.at, f))))
        out[m + 3 * f], out[m + 3 * f + 1], out[m + 3 * f + 2] = scale(1.0, foot)


def row_mobility(system: System, y: Float[np.ndarray, "numbers"]) -> Float[np.ndarray, "rows rows"]:
    """`mobility` with the rotors, which are held by their hinges."""
    Y, joints = mobility(system, y), system.joints
    hinges = np.empty(len(joints.lower), dtype=int)
    for j, h in enumerate(joints.hinge):
        for i in range(2 if joints.kind[j] == BOTH else 1):
            hinges[h + i] = 4 * j + 2 + i
    among = newton_matrix(Y[np.ix_(hinges, hinges)], joints.rotor) * joints.rotor
    return Y - Y[:, hinges] @ among @ Y[hinges]


# --- springs of the rows -------------------------------------------------------------------------
def row_springs(system: System) -> tuple[Float[np.ndarray, "rows"], Float[np.ndarray, "rows"]]:
    """Stiffness and damping of all rows, each spring pulling and each foot down at once."""
    joints, feet = system.joints, system.feet
    stiffness, damping = np.zeros((len(joints.link), 4)), np.zeros((len(joints.link), 4))
    stiffness[:, :2], damping[:, :2] = joints.guide, joints.guide_damping
    for j, h in enumerate(joints.hinge):
        for i in range(2 if joints.kind[j] == BOTH else 1):
            stiffness[j, 2 + i] = joints.stop[h + i]
            damping[j, 2 + i] = joints.stop_damping[h + i] + joints.viscous[h + i] + joints.dry[h + i] / CREEP
    return (
        np.concatenate([stiffness.ravel(), np.repeat(feet.stiffness, 3)]),
        np.concatenate([damping.ravel(), np.repeat(feet.damping, 3)]),
    )


# --- the longest step ----------------------------------------------------------------------------
@dataclass(frozen=True)
class StiffestMode:
    """The fastest small motion that a system's springs allow, over some poses."""

    mobility: Float[np.ndarray, "rows rows"]
    """Y in the pose that has it, of the rows that have a spring."""
    stiffness: Float[np.ndarray, "rows"]
    damping: Float[np.ndarray, "rows"]
    row: int
    """Which spring holds most of its energy; the number of a row as `mobility` counts them."""
    frequency: float
    """Size of its eigenvalue [rad/s]."""

    def longest_step(self, method: Method, most: float) -> float:
        """The longest step [s], up to `most`, with which no small motion grows under a method."""
        if not self.grows(method, most):
            return most
        low, high = 0.0, most
        while high - low > 0.02 * high:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.grows(method, middle) else (middle, high)
        return low

    def grows(self, method: Method, h: float) -> bool:
        """Whether some small motion grows in a step of `h` seconds."""
        return bool(np.abs(np.linalg.eigvals(self.step_matrix(method, h))).max() > 1.0 + GROWTH)

    def step_matrix(self, method: Method, h: float) -> Float[np.ndarray, "twice twice"]:
        """What one step makes of (s, s')."""
        n = len(self.stiffness)
        A = np.block(
            [
                [np.zeros((n, n)), np.eye(n)],
                [-self.mobility * self.stiffness, -self.mobility * self.damping],
            ]
        )
        if method.velocities_first:
            kick = np.eye(2 * n) + h * np.vstack([np.zeros((n, 2 * n)), A[n:]])
            drift = np.eye(2 * n)
            drift[:n, n:] += h * np.eye(n)
            return drift @ kick
        rates = []
        for share in method.stages:
            rates.append(
                A @ (np.eye(2 * n) + h * sum(a * k for a, k in zip(share, rates, strict=False) if a))
            )
        return np.eye(2 * n) + h * sum(b * k for b, k in zip(method.weights, rates, strict=True))


def stiffest_mode(system: System, poses: list[Float[np.ndarray, "numbers"]]) -> StiffestMode:
    """The stiffest mode of a system over some states of it."""
    stiffness, damping = row_springs(system)
    sprung = np.flatnonzero((stiffness > 0.0) | (damping > 0.0))
    k, d = stiffness[sprung], damping[sprung]
    modes = []
    for y in poses:
        Y = row_mobility(system, y)[np.ix_(sprung, sprung)]
        values, vectors = np.linalg.eig(np.block([[np.zeros_like(Y), np.eye(len(k))], [-Y * k, -Y * d]]))
        fastest = int(np.abs(values).argmax())
        share = np.abs(vectors[: len(k), fastest]) ** 2 * (k + np.abs(values[fastest]) * d)
        modes.append(StiffestMode(Y, k, d, int(sprung[share.argmax()]), float(np.abs(values[fastest]))))
    return max(modes, key=lambda mode: mode.frequency)
