"""Closed chains: what a foot's wrench does to the base and to the motors (row N2; equations.md §5).

For a prescribed motion every leg k gives two affine maps of the wrench w_k that the ground exerts on its
foot (force first, then moment about the contact point, world axes):

    wrench on the base   A_k w_k + B_k          joint torques   τ_k = C_k w_k + D_k

and the base moves as prescribed where Σ(A_k w_k + B_k) is what its own mass asks for. A leg in the air is
an open chain: it has no w_k, only B_k and D_k.

Moments on the base are about its *origin*, in world axes. The thesis and equations.md §5 take them about
the centre of mass of the base: `about` converts. Two ways lead to the same maps: *probing* as in the
thesis, with seven inverse dynamics of each leg, and closed forms with *Jacobians*.
"""

from dataclasses import replace
from typing import Literal, NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.dynamics.articulated import NOTHING, Accelerations, foot_load
from gaitwright.dynamics.newton_euler import (
    NO_LOAD,
    joint_accelerations,
    leg_load,
    link_load,
    links_motion,
    solve_columns,
)
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.leg import base_at, foot_and_columns, hinge_axes, leg_at, leg_turns
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, add, cross, rotation, scale, times, times_t, vec
from gaitwright.numerics.matrices import apply, apply_t, write
from gaitwright.signals import Sensed

UP = np.array([0.0, 0.0, 1.0])
ChainMethod = Literal["jacobians", "probing"]


class ClosedChain(NamedTuple):
    """The maps of all legs for one motion; see the head of this file. Zero A and C: a leg in the air."""

    A: np.ndarray
    """`(legs, 6, 6)` foot wrench → wrench on the base."""
    B: np.ndarray
    """`(legs, 6)` wrench on the base by the motion and the weight of the leg."""
    C: np.ndarray
    """`(legs, 3, 6)` foot wrench → joint torques."""
    D: np.ndarray
    """`(legs, 3)` joint torques with an unloaded foot [N·m]."""
    own: np.ndarray
    """`(6,)` wrench that the motion and the weight of the base itself ask for: w0 of the thesis."""


# --- kernels -------------------------------------------------------------------------------------
@kernel
def empty_chain(n):
    """A chain without any load."""
    return ClosedChain(
        np.zeros((n, 6, 6)), np.zeros((n, 6)), np.zeros((n, 3, 6)), np.zeros((n, 3)), np.zeros(6)
    )


@kernel
def open_chain(leg, turns, R, motion, qdd, ground):
    """Wrench of a leg on the base (force, moment; world axes) and its torques; `ground` as in `leg_load`."""
    force, moment, tau = leg_load(turns, qdd, leg, motion, ground)
    return scale(-1.0, times(R, force)), scale(-1.0, times(R, moment)), tau


@kernel
def close_by_jacobians(A, C, leg, turns, R, below_w):
    """Writes A = [1 0; p̃ 1] and C = −[Jvᵀ Jwᵀ]; `below_w`: foot centre → contact point."""
    foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
    z1, z2, z3 = hinge_axes(turns, leg.sign)
    p = add(times(R, add(leg.hip, apply(leg.frame, foot))), below_w)
    below = apply_t(leg.frame, times_t(R, below_w))
    for i in range(6):
        A[i, i] = 1.0
    A[3, 1], A[3, 2] = -p[2], p[1]
    A[4, 0], A[4, 2] = p[2], -p[0]
    A[5, 0], A[5, 1] = -p[1], p[0]
    columns, axes = (c1, c2, c3), (z1, z2, z3)
    for j in range(3):
        moves = add(columns[j], cross(axes[j], below))
        write(C[j], 0, scale(-1.0, times(R, apply(leg.frame, moves))))
        write(C[j], 3, scale(-1.0, times(R, apply(leg.frame, axes[j]))))


@kernel
def close_by_probing(A, C, leg, turns, R, below_w, motion, qdd, unloaded):
    """Writes A and C by what each of six unit wrenches changes."""
    foot = foot_and_columns(turns, leg.offset, leg.sign)[0]
    arm = add(add(leg.hip, apply(leg.frame, foot)), times_t(R, below_w))
    force0, moment0, tau0 = unloaded
    for i in range(6):
        unit = (1.0 * (i % 3 == 0), 1.0 * (i % 3 == 1), 1.0 * (i % 3 == 2))
        pull, twist = (unit, NOTHING) if i < 3 else (NOTHING, unit)
        ground = foot_load(leg, turns, arm, times_t(R, pull), times_t(R, twist))
        force, moment, tau = open_chain(leg, turns, R, motion, qdd, ground)
        for row in range(3):
            A[row, i] = force[row] - force0[row]
            A[3 + row, i] = moment[row] - moment0[row]
            C[row, i] = tau[row] - tau0[row]


@kernel
def close_chain(packed, R, w, wd, a, q, qd, qdd, stance, normal, probing):
    """The `ClosedChain` of a packed robot; `w`, `wd`, `a` as in `inverse_dynamics`, `normal` a 3-vector."""
    n = q.shape[0]
    chain = empty_chain(n)
    mass, com, inertia = base_at(packed)
    force, moment = link_load((w, wd, a), mass, com, inertia)
    write(chain.own, 0, times(R, force))
    write(chain.own, 3, times(R, moment))
    for k in range(n):
        leg = leg_at(packed, k)
        turns, pull = leg_turns(q[k], leg.sign), vec(qdd[k])
        motion = links_motion(leg, turns, w, wd, a, vec(qd[k]), pull)
        unloaded = open_chain(leg, turns, R, motion, pull, NO_LOAD)
        write(chain.B[k], 0, unloaded[0])
        write(chain.B[k], 3, unloaded[1])
        write(chain.D[k], 0, unloaded[2])
        below_w = scale(-leg.foot_radius, normal)
        if stance[k] and probing:
            close_by_probing(chain.A[k], chain.C[k], leg, turns, R, below_w, motion, pull, unloaded)
        elif stance[k]:
            close_by_jacobians(chain.A[k], chain.C[k], leg, turns, R, below_w)
    return chain


@kernel
def planted_rates(packed, q, velocity):
    """Joint rates that keep the feet in place below a base that moves (base axes) but does not turn."""
    n = q.shape[0]
    qd = np.empty((n, 3))
    for k in range(n):
        leg = leg_at(packed, k)
        _, c1, c2, c3 = foot_and_columns(leg_turns(q[k], leg.sign), leg.offset, leg.sign)
        write(qd[k], 0, solve_columns(c1, c2, c3, apply_t(leg.frame, scale(-1.0, velocity))))
    return qd


# --- for people, not kernels ---------------------------------------------------------------------
def closed_chain(
    robot: Robot,
    sensed: Sensed,
    wanted: Accelerations,
    stance: Bool[np.ndarray, "legs"],
    normal_w: Float[np.ndarray, "3"],
    method: ChainMethod = "jacobians",
) -> ClosedChain:
    """The maps of a robot that in a sensed state shall accelerate as wanted, on the feet in `stance`.

    `normal_w`: unit normal of the ground; the contact points lie a foot's radius below the foot centres.
    """
    R = rotation(sensed.orientation_wb)
    a = R.T @ (wanted.linear_w + GRAVITY * UP)
    w, wd = tuple(sensed.angular_velocity_b), tuple(wanted.angular_b)
    return close_chain(
        robot.packed, R, w, wd, tuple(a), sensed.q, sensed.qd, wanted.qdd, stance, tuple(normal_w),
        method == "probing",
    )  # fmt: skip


def joint_torques(chain: ClosedChain, w: Float[np.ndarray, "legs 6"]) -> Float[np.ndarray, "legs 3"]:
    """Torques [N·m] with the wrenches `w` on the feet: C w + D."""
    return np.einsum("kij,kj->ki", chain.C, w) + chain.D


def imbalance(chain: ClosedChain, w: Float[np.ndarray, "legs 6"]) -> Float[np.ndarray, "6"]:
    """What the wrenches `w` on the feet leave unmet on the base: own − Σ(A w + B)."""
    return chain.own - np.einsum("kij,kj->i", chain.A, w) - chain.B.sum(axis=0)


def least_wrenches(chain: ClosedChain) -> Float[np.ndarray, "legs 6"]:
    """The smallest foot wrenches that balance the base (least squares): no friction, no limits."""
    legs = len(chain.A)
    across = np.concatenate(list(chain.A), axis=1)
    w = np.linalg.lstsq(across, imbalance(chain, np.zeros((legs, 6))), rcond=None)[0]
    return w.reshape(legs, 6)


def about(chain: ClosedChain, point_w: Float[np.ndarray, "3"]) -> ClosedChain:
    """The same with the moments on the base about another point, given from its origin, world axes [m].

    With the base's centre of mass these are the maps of the thesis.
    """
    x, y, z = point_w
    shift = np.eye(6)
    shift[3:, :3] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    return chain._replace(A=shift @ chain.A, B=chain.B @ shift.T, own=shift @ chain.own)


def reuse_error(old: ClosedChain, new: ClosedChain) -> float:
    """Error of torques found with the maps of another moment, as a share of the largest right one.

    Row N5 lets straight motion reuse A, B, C, D: this is what that costs.
    """
    right = joint_torques(new, least_wrenches(new))
    reused = joint_torques(old, least_wrenches(old))
    return float(np.abs(reused - right).max() / np.abs(right).max())


def straight_chain(
    robot: Robot, sensed: Sensed, stance: Bool[np.ndarray, "legs"], distance: float
) -> ClosedChain:
    """The maps after the base has moved on by `distance` [m] at its velocity, level ground, feet planted.

    The base neither turns nor accelerates; legs in the air hang still.
    Raises `WrongUse` where a foot gets out of reach, or where the base does not move.
    """
    speed = float(np.linalg.norm(sensed.velocity_w))
    if speed == 0.0:
        raise WrongUse("straight motion was asked of a base whose velocity is zero: it has no direction")
    velocity_b = rotation(sensed.orientation_wb).T @ sensed.velocity_w
    q, reached = angles(robot, feet(robot, sensed.q) - distance / speed * velocity_b)
    for leg in np.flatnonzero(stance & ~reached):
        raise WrongUse(f"leg {robot.legs[leg]} does not reach its foothold after {distance:g} m straight on")
    down = stance[:, None]
    q = np.where(down, q, sensed.q)
    qd = planted_rates(robot.packed, q, tuple(velocity_b))
    qdd = joint_accelerations(robot.packed, NOTHING, NOTHING, NOTHING, q, qd, np.zeros_like(q))
    at = replace(sensed, angular_velocity_b=np.zeros(3), q=q, qd=np.where(down, qd, 0.0))
    steady = Accelerations(np.zeros(3), np.zeros(3), np.where(down, qdd, 0.0))
    return closed_chain(robot, at, steady, stance, UP)


def reuse_errors(
    robot: Robot,
    sensed: Sensed,
    stance: Bool[np.ndarray, "legs"],
    distances: Float[np.ndarray, "distances"],
) -> Float[np.ndarray, "distances"]:
    """`reuse_error` of the maps of `sensed` after each of the distances [m] of straight motion."""
    old = straight_chain(robot, sensed, stance, 0.0)
    return np.array([reuse_error(old, straight_chain(robot, sensed, stance, float(d))) for d in distances])
