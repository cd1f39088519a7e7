"""How far a free spin drifts from its energy and momentum: what integrators and old coefficients cost.

Without gravity a tree keeps energy, momentum and angular momentum; what is lost or made is the
integrator's doing (equations.md §3).
"""

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.tree import Tree
from gaitwright.dynamics.tree_laws import energy, momentum
from gaitwright.plant.armstrong.integrators import advance, method_named
from gaitwright.plant.armstrong.system import System, at_rest, floating, parts, rates_begin, rotations, settle

TOLERANCE = 1e-6
"""What integrator `adaptive` may be off in a step."""
SPIN = 1.0
"""Spread of the angular velocities that a free motion starts with [rad/s]."""


def free_motion_drift(
    tree: Tree, integrator: str, dt: float, seconds: float = 3.0, seed: int = 0
) -> tuple[float, float, float]:
    """What a free spin gains or loses: energy [share of itself], momentum [N·s], angular momentum [share].

    The tree starts from orientations and angular velocities of about 1 rad/s drawn from `seed`. `dt` [s] is
    the first step where the integrator chooses its own.
    """
    system = floating(tree)
    start = any_free_state(system, seed)
    end = integrated(system, start, integrator, dt, seconds)
    before, after = laws_of(system, start), laws_of(system, end)
    turned = np.linalg.norm(after[2] - before[2]) / np.linalg.norm(before[2])
    return after[0] / before[0] - 1.0, float(np.linalg.norm(after[1] - before[1])), float(turned)


def refresh_error(
    tree: Tree, refresh: int, integrator: str = "rk4", dt: float = 0.001, seconds: float = 1.0, seed: int = 0
) -> float:
    """Largest angle [rad] by which a link of a free spin is off after `seconds`.

    Slow coefficients computed at every `refresh`-th step, against those of every evaluation.
    """
    system = floating(tree)
    start = any_free_state(system, seed)
    kept = integrated(system, start, integrator, dt, seconds, refresh)
    exact = integrated(system, start, integrator, dt, seconds, 1)
    return float(angles_between(system, kept, exact).max())


def integrated(
    system: System,
    state: Float[np.ndarray, "numbers"],
    integrator: str,
    dt: float,
    seconds: float,
    refresh: int = 1,
) -> Float[np.ndarray, "numbers"]:
    """The state of an undriven system `seconds` later, in steps of `dt` [s]."""
    y = state.copy()
    advance(system, at_rest(system), y, method_named(integrator), dt, seconds, refresh, TOLERANCE)
    return y


def any_free_state(system: System, seed: int) -> Float[np.ndarray, "numbers"]:
    """Orientations and angular velocities drawn at random, the root at rest in the origin."""
    random = np.random.default_rng(seed)
    y = np.zeros(rates_begin(system) + 3 + 3 * system.tree.mass.size)
    p = parts(system, y)
    p.quaternion[:] = random.normal(size=p.quaternion.shape)
    p.w[:] = SPIN * random.normal(size=p.w.shape)
    settle(system, at_rest(system), y)
    return y


def laws_of(
    system: System, y: Float[np.ndarray, "numbers"]
) -> tuple[float, Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    """Energy [J], momentum [N·s] and angular momentum about the world's origin [N·m·s]."""
    p = parts(system, y)
    R = rotations(p.quaternion)
    linear, angular = momentum(system.tree, R, p.x, p.v, p.w)
    return sum(energy(system.tree, R, p.x, p.v, p.w, system.gravity)), np.array(linear), np.array(angular)


def angles_between(
    system: System, one: Float[np.ndarray, "numbers"], other: Float[np.ndarray, "numbers"]
) -> Float[np.ndarray, "links"]:
    """By how far each link's orientation differs between two states [rad]."""
    a, b = parts(system, one).quaternion, parts(system, other).quaternion
    apart = np.minimum(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    return 4.0 * np.arcsin(np.minimum(0.5 * apart, 1.0))
