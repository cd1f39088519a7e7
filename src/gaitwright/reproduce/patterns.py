"""What can be seen in torque curves over a cycle: signs, reversals, symmetries, and the static margin.

Curves are (τ_ψ, τ_θ, τ_k) in the thesis's sense, `(steps, legs 1 … 4, 3)` in N·m.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.gait.desired_cycle import DesiredCycle
from gaitwright.numerics.polygon import hull, margins

PSI, THETA, KNEE = 0, 1, 2
MIRRORED = np.array([-1.0, 1.0, 1.0])
"""Signs of ψ, θ_h, θ_k in the leg of the other side."""
NOTICED = 0.01
"""A torque smaller than this has no sign [N·m]."""


def flexed(curve: Float[np.ndarray, "steps legs"], where: Bool[np.ndarray, "steps legs"]) -> float:
    """Share of the samples in `where` at which a torque is in flexion (positive)."""
    return float((curve[where] > 0.0).mean())


def both_signs(curve: Float[np.ndarray, "steps legs"], where: Bool[np.ndarray, "steps legs"]) -> bool:
    """Whether a torque has both signs in every leg's samples in `where`."""
    legs = (curve[where[:, leg], leg] for leg in range(curve.shape[1]))
    return all(leg.min() < -NOTICED and leg.max() > NOTICED for leg in legs)


def stretches(where: Bool[np.ndarray, "steps"]) -> Iterator[np.ndarray]:
    """The samples of each unbroken stretch of a periodic flag that is neither always nor never set."""
    start = int(np.flatnonzero(where & ~np.roll(where, 1))[0])
    turned = (np.arange(len(where)) + start) % len(where)
    edges = np.flatnonzero(np.diff(where[turned].astype(int))) + 1
    return (part for part in np.split(turned, edges) if where[part[0]])


def reversals(curve: Float[np.ndarray, "steps"], where: Bool[np.ndarray, "steps"]) -> int:
    """How often a torque changes its sign within the stretches of `where`."""
    total = 0
    for samples in stretches(where):
        signs = np.sign(curve[samples][np.abs(curve[samples]) > NOTICED])
        total += int(np.count_nonzero(np.diff(signs)))
    return total


def reverses_at_lift_off(curve: Float[np.ndarray, "steps"], stance: Bool[np.ndarray, "steps"]) -> bool:
    """Whether a torque goes from flexion to extension where a foot leaves the ground."""
    lifts = np.flatnonzero(np.roll(stance, 1) & ~stance)
    return bool((curve[lifts - 1] > 0.0).all() and (curve[lifts] < 0.0).all())


def half_cycle_difference(curves: Float[np.ndarray, "steps 4 3"]) -> float:
    """Largest |g₁(t) − mirrored g₂(t + T/2)| of the legs 1, 2 and 3, 4 [N·m]."""
    later = np.roll(curves, -len(curves) // 2, axis=0)
    return float(max(np.abs(curves[:, a] - MIRRORED * later[:, b]).max() for a, b in ((0, 1), (2, 3))))


def same_instant_difference(curves: Float[np.ndarray, "steps 4 3"]) -> Float[np.ndarray, "3"]:
    """Largest |g₁ − mirrored g₄| and |g₂ − mirrored g₃| at the same instant, by joint [N·m]."""
    apart = (np.abs(curves[:, a] - MIRRORED * curves[:, b]).max(axis=0) for a, b in ((0, 3), (1, 2)))
    return np.maximum(*apart)


def time_mirror_difference(curves: Float[np.ndarray, "steps 4 3"], cycle: DesiredCycle) -> float:
    """Largest |g₁(t) − g₄(T_st − t)| within the common stance of legs 1 and 4 [N·m].

    A foot ahead of its hip on one side is a half turn from one behind on the other: nothing is mirrored.
    """
    down = np.flatnonzero(cycle.stance[:, 0])[1:]
    return float(np.abs(curves[down, 0] - curves[down[::-1], 3]).max())


def static_margins(cycle: DesiredCycle) -> Float[np.ndarray, "steps"]:
    """Distance [m] of the body's centre from the edge of the polygon of its feet; negative outside."""
    feet, centres = cycle.feet_w[..., :2], cycle.position_w[:, None, :2]
    return np.array([margins(hull(feet[i, cycle.stance[i]]), centres[i])[0] for i in range(cycle.steps)])
