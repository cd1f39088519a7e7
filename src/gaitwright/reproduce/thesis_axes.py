"""Joint angles and torques as the thesis counts them, in and out of ours (equations.md §0, §1).

The thesis's body axes are x forward, y right, z down (`geometry.from_thesis`). Its leg has the azimuth ψ
about z, counted from straight ahead, the elevation θ_h, positive with the knee up, and the knee θ_k from
the perpendicular of the upper limb. Our robots `thesis` and `thesis-table` count yaw from straight
sideways, about the axis that points up; the other two angles are the same.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.geometry import wrapped

SIDEWAYS = np.array([1.5, 0.5, 1.5, 0.5]) * np.pi
"""ψ of a leg that points straight sideways: legs 1 … 4 of the thesis, our FL FR RL RR."""
SENSE = np.array([-1.0, 1.0, 1.0])
"""Sense of ψ, θ_h, θ_k against our three angles."""
UPPER, LOWER = 2.0, 3.0
"""l₁, l₂: lengths of the limbs [m]."""


def angles_to_thesis(q: Float[np.ndarray, "*batch 4 3"]) -> Float[np.ndarray, "*batch 4 3"]:
    """(ψ, θ_h, θ_k) [rad] of the four legs for our joint angles; ψ in [0, 2π)."""
    out = q * SENSE
    out[..., 0] = (out[..., 0] + SIDEWAYS) % (2.0 * np.pi)
    return out


def angles_from_thesis(angles: Float[np.ndarray, "*batch 4 3"]) -> Float[np.ndarray, "*batch 4 3"]:
    """Our joint angles [rad] for (ψ, θ_h, θ_k) of the four legs."""
    out = np.array(angles, dtype=float)
    out[..., 0] = wrapped(out[..., 0] - SIDEWAYS)
    return out * SENSE


def torques_to_thesis(tau: Float[np.ndarray, "*batch 4 3"]) -> Float[np.ndarray, "*batch 4 3"]:
    """The thesis's (τ_ψ, τ_θ, τ_k) [N·m] for our motor torques.

    The thesis prints the component along the joint's axis of the torque that the outer link gives the
    inner one: the motor's torque against the sense of the angle. So τ_θ > 0 ("flexion") presses the foot
    on the ground.
    """
    return -tau * SENSE


def foot_below_hip(angles: Float[np.ndarray, "*batch 3"]) -> Float[np.ndarray, "*batch 2"]:
    """Reach R and depth Z [m] of the foot from its hip for (ψ, θ_h, θ_k) of one leg (eq. 3-8)."""
    elevation, knee = angles[..., 1], angles[..., 2]
    reach = UPPER * np.cos(elevation) + LOWER * np.sin(elevation + knee)
    depth = -UPPER * np.sin(elevation) + LOWER * np.cos(elevation + knee)
    return np.stack([reach, depth], axis=-1)


def vertical_force(
    angles: Float[np.ndarray, "*batch 3"], torques: Float[np.ndarray, "*batch 3"]
) -> Float[np.ndarray, "*batch"]:
    """Vertical force [N] on the foot of a leg without mass that gives its torques (τ_ψ, τ_θ, τ_k).

    Solves (τ_θ, τ_k) = [Z R; l₂c₁₂ l₂s₁₂] (h, f) for f (equations.md §6).
    """
    reach, depth = np.moveaxis(foot_below_hip(angles), -1, 0)
    both = angles[..., 1] + angles[..., 2]
    c, s = LOWER * np.cos(both), LOWER * np.sin(both)
    return np.asarray((depth * torques[..., 2] - c * torques[..., 1]) / (depth * s - reach * c))
