"""Small non-linear least squares: Levenberg and Marquardt's way, with numerical derivatives."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

Residuals = Callable[[Float[np.ndarray, "numbers"]], Float[np.ndarray, "n"]]

STEPS, ENOUGH = 30, 1e-6
"""Most steps, and the relative gain by which a step is no longer worth it [-]."""
NUDGE = 1e-4
"""Step of a numerical derivative, in the scale of its number."""


class Fit(NamedTuple):
    """What fits best near where it was begun."""

    numbers: Float[np.ndarray, "numbers"]
    spread: Float[np.ndarray, "numbers"]
    """Standard deviation of each number, if the residuals are noise; inf where nothing fixes it."""
    rms: float
    """Root of the mean square residual."""


def fit(
    residuals: Residuals, start: Float[np.ndarray, "numbers"], scale: Float[np.ndarray, "numbers"]
) -> Fit:
    """Minimises the sum of squares of `residuals` from `start` on; `scale`: noticeable changes of numbers."""
    numbers, r = start.astype(float), residuals(start)
    damping = 1e-2
    for _ in range(STEPS):
        jacobian = derivative(residuals, numbers, r, scale)
        normal, slope = jacobian.T @ jacobian, jacobian.T @ r
        step = np.linalg.solve(
            normal + damping * (np.diag(np.diag(normal)) + 1e-12 * np.eye(len(start))), slope
        )
        trial = numbers - step * scale
        after = residuals(trial)
        gain = float(r @ r - after @ after)
        if gain <= 0.0:
            damping *= 10.0
            if damping > 1e8:
                break
            continue
        small = gain < ENOUGH * float(r @ r) + 1e-18
        numbers, r, damping = trial, after, 0.3 * damping
        if small:
            break
    jacobian = derivative(residuals, numbers, r, scale)
    return Fit(numbers, spread_of(jacobian, r) * scale, float(np.sqrt(np.mean(r * r))))


def derivative(
    residuals: Residuals,
    numbers: Float[np.ndarray, "numbers"],
    r: Float[np.ndarray, "n"],
    scale: Float[np.ndarray, "numbers"],
) -> Float[np.ndarray, "n numbers"]:
    """How residuals change with the numbers, in their scales."""
    columns = []
    for k in range(len(numbers)):
        moved = numbers.copy()
        moved[k] += NUDGE * scale[k]
        columns.append((residuals(moved) - r) / NUDGE)
    return np.stack(columns, axis=1)


def spread_of(
    jacobian: Float[np.ndarray, "n numbers"], r: Float[np.ndarray, "n"]
) -> Float[np.ndarray, "numbers"]:
    """Standard deviations of the numbers, in their scales: the root of the diagonal of s² (J' J)⁻¹."""
    n, count = jacobian.shape
    values, vectors = np.linalg.eigh(jacobian.T @ jacobian)
    noise = float(r @ r) / max(n - count, 1)
    fixed = values > 1e-12 * max(float(values[-1]), 1e-300)
    with np.errstate(divide="ignore"):
        each = np.where(fixed, noise / np.where(fixed, values, 1.0), np.inf)
    weights = vectors**2
    free = (weights[:, ~fixed] > 1e-6).any(axis=1)
    return np.where(free, np.inf, np.sqrt(weights[:, fixed] @ each[fixed]))
