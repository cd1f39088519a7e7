"""Things thrown at random over a field, apart from each other and from where they must not lie."""

import math
from collections.abc import Callable, Iterable

import numpy as np

from gaitwright.ground.layout import Bounds

FREE = 0.8
"""Radius of the free place around start and goal [m]."""
TRIES = 30
"""A thing that finds no place in so many tries is left out."""

Circle = tuple[float, float, float]
"""x, y, radius [m]."""
Free = Callable[[float, float, float], bool]
"""Whether a circle may lie somewhere."""


def between(easy: float, hard: float, difficulty: float) -> float:
    """A number that goes with the difficulty."""
    return easy + (hard - easy) * difficulty


def clear_of(circles: Iterable[Circle], gap: float) -> Free:
    """Keeps a gap [m] from circles."""
    taken = list(circles)
    return lambda x, y, radius: all(math.hypot(x - a, y - b) >= radius + r + gap for a, b, r in taken)


def free_of_ends(*ends: tuple[float, float]) -> Free:
    """Keeps start and goal free."""
    return clear_of([(*end, 0.0) for end in ends], FREE)


def scattered(
    rng: np.random.Generator,
    many: int,
    where: Bounds,
    radii: tuple[float, float],
    gap: float,
    *may: Free,
) -> list[Circle]:
    """Up to so many circles within bounds, a gap apart [m], where all of `may` let them lie."""
    found: list[Circle] = []
    for _ in range(many):
        for _try in range(TRIES):
            radius = float(rng.uniform(*radii))
            x = float(rng.uniform(where[0] + radius, where[2] - radius))
            y = float(rng.uniform(where[1] + radius, where[3] - radius))
            if all(is_free(x, y, radius) for is_free in (*may, clear_of(found, gap))):
                found.append((round(x, 3), round(y, 3), round(radius, 3)))
                break
    return found
