"""Things thrown at random over a field, apart from each other and from where they must not lie."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from gaitwright.ground.layout import Bounds

FREE = 0.8
"""Radius of the free place around start and goal [m]."""
TRIES = 30
"""A thing that finds no place in so many tries is left out."""

Free = Callable[[float, float, float], bool]
"""Whether a circle (x, y, radius) may lie somewhere."""


def between(easy: float, hard: float, difficulty: float) -> float:
    """A number that goes with the difficulty."""
    return easy + (hard - easy) * difficulty


def free_of_ends(*ends: tuple[float, float]) -> Free:
    """Keeps start and goal free."""
    return lambda x, y, radius: all(math.hypot(x - a, y - b) >= radius + FREE for a, b in ends)


def scattered(
    rng: np.random.Generator,
    many: int,
    where: Bounds,
    radii: tuple[float, float],
    gap: float,
    may: Free,
    before: Sequence[tuple[float, float, float]] = (),
) -> list[tuple[float, float, float]]:
    """Up to so many circles x, y, radius [m] within bounds, a gap apart from each other and those before."""
    found: list[tuple[float, float, float]] = []
    for _ in range(many):
        for _try in range(TRIES):
            radius = float(rng.uniform(*radii))
            x = float(rng.uniform(where[0] + radius, where[2] - radius))
            y = float(rng.uniform(where[1] + radius, where[3] - radius))
            others = (*before, *found)
            if may(x, y, radius) and all(math.hypot(x - a, y - b) >= radius + r + gap for a, b, r in others):
                found.append((round(x, 3), round(y, 3), round(radius, 3)))
                break
    return found
