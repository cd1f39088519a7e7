"""A check that runs: the recursion of inverse dynamics against a closed form (row N8).

The closed form has nothing in common with the recursion but the robot's numbers: positions and axes of all
hinges by forward kinematics, then sums over bodies,

    M = Σ m Jvᵀ Jv + Jwᵀ I Jw       h = Σ m Jvᵀ (J̇v ν + g) + Jwᵀ (I J̇w ν + Ω × I Ω)

with J̇ν from the second derivatives of a chain, ∂²c/∂qᵢ∂qⱼ = zᵢ × (zⱼ × (c − pⱼ)) for i ≤ j. It is slow
(some milliseconds) and meant to be believed. Everything is in base axes; velocities ν are those of the
base origin, of the base's turning, and of the joints leg by leg.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.articulated import Accelerations
from gaitwright.dynamics.newton_euler import dynamics_of, state_numbers
from gaitwright.dynamics.tree_laws import crossing
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, about_axis, rotation
from gaitwright.signals import Sensed

UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True)
class Check:
    """How well two ways to the same numbers agree."""

    what: str
    """The two ways."""
    worst: float
    """Largest difference, as a share of the size of its kind."""
    where: str
    """The number that differs most."""

    @property
    def sentence(self) -> str:
        """The check in words."""
        return f"{self.what} agree to {self.worst:.1e}, worst at {self.where}"


# --- the closed form -----------------------------------------------------------------------------
class Body(NamedTuple):
    """One rigid body: mass, place, and how it moves with ν; base axes."""

    mass: float
    inertia: np.ndarray
    """`(3, 3)` about the centre of mass."""
    Jv: np.ndarray
    """`(3, 6 + 3 legs)` velocity of the centre of mass."""
    Jw: np.ndarray
    """`(3, 6 + 3 legs)` angular velocity."""
    bias: np.ndarray
    """`(3,)` acceleration of the centre of mass at constant ν."""
    turning_bias: np.ndarray
    """`(3,)` angular acceleration at constant ν."""


def bodies(
    robot: Robot,
    w: Float[np.ndarray, "3"],
    q: Float[np.ndarray, "legs 3"],
    qd: Float[np.ndarray, "legs 3"],
) -> Iterator[Body]:
    """The base and all links, for angles `q`, rates `qd` and angular velocity `w` of the base."""
    nothing = np.empty((0, 3))
    yield body(
        robot, robot.base_mass, robot.base_com, robot.base_inertia, nothing, nothing, w, nothing[:, 0], 6
    )
    for k in range(robot.n):
        R, p = robot.leg_frame[k], robot.hip[k]
        axes, points = nothing, nothing
        for i in range(3):
            own = (0, 1, 1)[i]
            sense = robot.sign[k] if i == 2 else 1.0
            axes, points = np.vstack([axes, sense * R[:, own]]), np.vstack([points, p])
            R = R @ about_axis(own, sense * q[k, i])
            centre, inertia = p + R @ robot.com[k, i], R @ robot.inertia[k, i] @ R.T
            yield body(robot, robot.mass[k, i], centre, inertia, axes, points, w, qd[k, : i + 1], 6 + 3 * k)
            p = p + R @ robot.offset[k, i]


def body(robot: Robot, mass, centre, inertia, axes, points, w, qd, first: int) -> Body:
    """A body behind hinges with `axes` through `points`, whose columns start at `first`."""
    Jv, Jw = np.zeros((2, 3, 6 + 3 * robot.n))
    Jv[:, :3], Jv[:, 3:6], Jw[:, 3:6] = np.eye(3), -crossing(centre), np.eye(3)
    sweep = np.cross(axes, centre - points)
    here = slice(first, first + len(axes))
    Jv[:, here], Jw[:, here] = sweep.T, axes.T
    bias = np.cross(w, np.cross(w, centre)) + 2.0 * np.cross(w, qd @ sweep)
    turning = np.cross(w, qd @ axes)
    for i, z in enumerate(axes):
        for j in range(i, len(axes)):
            both = qd[i] * qd[j]
            bias = bias + (1.0 if i == j else 2.0) * both * np.cross(z, sweep[j])
            turning = turning + both * np.cross(z, axes[j])
    return Body(mass, inertia, Jv, Jw, bias, turning)


def mass_matrix(robot: Robot, q: Float[np.ndarray, "legs 3"]) -> Float[np.ndarray, "dofs dofs"]:
    """M of the floating robot, armatures included."""
    M = np.diag(np.concatenate([np.zeros(6), robot.armature.ravel()]))
    for b in bodies(robot, np.zeros(3), q, np.zeros_like(q)):
        M += b.mass * b.Jv.T @ b.Jv + b.Jw.T @ b.inertia @ b.Jw
    return M


def bias_forces(
    robot: Robot,
    up_b: Float[np.ndarray, "3"],
    w: Float[np.ndarray, "3"],
    q: Float[np.ndarray, "legs 3"],
    qd: Float[np.ndarray, "legs 3"],
) -> Float[np.ndarray, "dofs"]:
    """h: forces that hold the weight and the centrifugal loads; `up_b`: upward g in base axes [m/s²]."""
    rates = np.concatenate([np.zeros(3), w, qd.ravel()])
    h = np.zeros(6 + 3 * robot.n)
    for b in bodies(robot, w, q, qd):
        spin = b.Jw @ rates
        gyration = np.cross(spin, b.inertia @ spin)
        h += b.mass * b.Jv.T @ (b.bias + up_b) + b.Jw.T @ (b.inertia @ b.turning_bias + gyration)
    return h


# --- the check ------------------------------------------------------------------------------------
def recursion_check(robot: Robot, sensed: Sensed, wanted: Accelerations) -> Check:
    """Inverse dynamics by recursion against M q̈ + h by sums, for one motion."""
    R = rotation(sensed.orientation_wb)
    up, a = R.T @ (GRAVITY * UP), R.T @ wanted.linear_w
    w, q, qd = sensed.angular_velocity_b, sensed.q, sensed.qd
    numbers = state_numbers(w, wanted.angular_b, a + up, q, qd, wanted.qdd)
    recursive = dynamics_of(robot.packed, numbers)[: 6 + 3 * robot.n]
    pull = np.concatenate([a, wanted.angular_b, wanted.qdd.ravel()])
    summed = mass_matrix(robot, q) @ pull + bias_forces(robot, up, w, q, qd)
    sizes = [np.abs(part).max() for part in (summed[:3], summed[3:6], summed[6:])]
    return worst_of("recursion and closed form", robot, recursive - summed, np.array(sizes))


def worst_of(
    what: str, robot: Robot, difference: Float[np.ndarray, "dofs"], sizes: Float[np.ndarray, "3"]
) -> Check:
    """The check that names the largest of the differences; sizes: base, base's turning, joints."""
    share = np.abs(difference) / np.repeat(sizes, [3, 3, 3 * robot.n])
    worst = int(np.argmax(share))
    names = [f"base {kind}{axis}" for kind in ("", "about ") for axis in "xyz"]
    names += [f"{leg} {joint}" for leg in robot.legs for joint in ("hip 1", "hip 2", "knee")]
    return Check(what, float(share[worst]), names[worst])
