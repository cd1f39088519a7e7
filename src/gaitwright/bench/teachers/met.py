"""What is met on trips, by number, and moments made up of it. Units as in `skills.situation.measured`."""

import math
from functools import lru_cache

import numpy as np

LEVELS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0)
"""Levels of the quantiles in MET."""

MET: dict[str, tuple[float, float, tuple[float, ...]]] = {
    "feet down": (0.0, 0.0, (0.0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.75, 0.75, 0.75, 0.75, 0.75, 1.0, 1.0)),
    "slope": (
        0.0,
        0.518,
        (-24.6, -15.0, -12.0, -7.88, -3.89, -1.28, 0.52, 1.44, 4.65, 8.3, 12.7, 15.7, 24.7),
    ),
    "roughness": (
        0.0,
        0.647,
        (0.0001, 0.0171, 0.0248, 0.0336, 0.0413, 0.0507, 0.06, 0.0705, 0.0811, 0.0942, 0.123, 0.367, 0.817),
    ),
    "step up": (
        0.0,
        0.647,
        (0.0, 0.00146, 0.00538, 0.0164, 0.0261, 0.0362, 0.0497, 0.0685, 0.0874, 0.113, 0.22, 0.292, 1.73),
    ),
    "step down": (
        0.0,
        0.647,
        (0.0, 0.00174, 0.0063, 0.0179, 0.0279, 0.0384, 0.0535, 0.0709, 0.0911, 0.12, 0.237, 0.3, 1.72),
    ),
    "gap": (0.0, 0.952, (0.28, 0.42, 0.42, 0.56, 0.56, 0.7, 0.7, 0.7, 0.84, 0.84, 0.98, 1.26, 2.24)),
    "remaining": (0.0, 0.0, (0.0, 0.453, 1.88, 6.03, 10.2, 14.5, 19.1, 24.3, 30.5, 38.8, 52.5, 65.8, 124.0)),
    "points left": (0.0, 0.0, (1.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 4.0, 5.0, 6.0, 14.0)),
    "arrived": (0.0, 0.986, (1.0,) * 13),
    "off the path": (
        0.0,
        0.0,
        (-180.0, -76.6, -29.7, -3.5, -1.8, -0.784, 0.0, 0.782, 1.79, 3.59, 32.0, 80.7, 180.0),
    ),
    "wished": (0.0, 0.0, (0.121, 0.152, 0.168, 0.235, 0.289, 0.586, 0.847, 1.09, 1.35, 1.62, 1.8, 1.91, 2.0)),
    "possible": (0.0, 0.0, (0.1, 0.102, 0.143, 0.199, 0.247, 0.34, 0.622, 0.87, 1.14, 1.44, 1.74, 1.86, 2.0)),
    "sway": (
        0.0,
        0.0,
        (0.0, 0.00411, 0.00755, 0.0147, 0.0216, 0.0288, 0.0369, 0.0464, 0.0588, 0.0794, 0.167, 0.291, 1.06),
    ),
    "obstacle": (
        20.0,
        0.901,
        (0.0927, 0.485, 0.71, 1.07, 1.47, 1.9, 2.3, 2.69, 3.08, 3.52, 3.92, 4.87, 6.17),
    ),
    "effort": (
        0.0,
        0.0,
        (0.0, 0.208, 0.24, 0.286, 0.324, 0.362, 0.399, 0.439, 0.488, 0.553, 0.64, 0.715, 2.32),
    ),
    "direction": (
        0.0,
        0.0,
        (-180.0, -171.0, -157.0, -93.7, -30.1, -10.9, -1.96, 8.32, 32.8, 107.0, 163.0, 171.0, 180.0),
    ),
    "familiar": (0.0, 0.898, (1.0,) * 13),
    "turning": (0.0, 0.834, (1.0,) * 13),
    "speed": (
        0.0,
        0.0,
        (0.0, 0.0207, 0.0475, 0.121, 0.17, 0.229, 0.254, 0.299, 0.38, 0.535, 0.874, 1.18, 1.99),
    ),
}
"""By number: its ordinary value, the share of moments at it, and the quantiles over the other moments.

Where that share is 0, the ordinary value means nothing."""

TOGETHER = {
    ("roughness", "step up"): 0.9,
    ("roughness", "step down"): 0.9,
    ("step up", "step down"): 0.85,
    ("remaining", "points left"): 0.82,
    ("speed", "wished"): 0.25,
    ("speed", "turning"): -0.35,
    ("feet down", "effort"): -0.5,
    ("feet down", "speed"): -0.25,
    ("sway", "roughness"): 0.28,
    ("sway", "step up"): 0.27,
    ("sway", "step down"): 0.27,
}
"""Numbers that go together, by the correlation of their ranks."""
STEPS = {"feet down": 0.25, "points left": 1.0, "arrived": 1.0, "familiar": 1.0, "turning": 1.0, "gap": 0.14}
"""Numbers that come in steps."""
HINDERED = 0.15
"""Share of moments at which less speed is possible than wished."""


def met_quantile(name: str, level: float) -> float:
    """The value of a number at a level, 0 to 1, among the moments at which it isn't at its ordinary value."""
    return float(np.interp(level, LEVELS, MET[name][2]))


def spread(name: str) -> float:
    """From the 10th to the 90th percentile of a number (in its own unit), to compare distances by."""
    return max(met_quantile(name, 0.9) - met_quantile(name, 0.1), STEPS.get(name, 1e-6))


def plausible(name: str, value: float) -> bool:
    """Whether a number can have this value at all."""
    ordinary, share, met = MET[name]
    values = (*met, ordinary) if share > 0.0 else met
    return min(values) <= value <= max(values)


def in_steps(name: str, values: tuple[float, ...]) -> tuple[float, ...]:
    """The values, or the steps on both sides of each where the number comes in steps."""
    step = STEPS.get(name)
    if step is None:
        return values
    return tuple(step * f(v / step) for v in values for f in (math.floor, math.ceil))


@lru_cache(maxsize=4)
def made_up_moments(rows: int = 6000, seed: int = 11) -> dict[str, np.ndarray]:
    """Moments drawn from the quantiles and the ranks that go together: one array per number."""
    names = list(MET)
    ranks = np.eye(len(names))
    for (a, b), r in TOGETHER.items():
        i, j = names.index(a), names.index(b)
        ranks[i, j] = ranks[j, i] = r
    size, way = np.linalg.eigh(ranks)
    normal = np.random.default_rng(seed).standard_normal((rows, len(names))) * np.sqrt(np.maximum(size, 0.0))
    level = np.argsort(np.argsort(normal @ way.T, axis=0), axis=0) / rows
    columns = {name: _at_levels(name, level[:, i]) for i, name in enumerate(names)}
    hindered = np.random.default_rng(seed + 1).random(rows) < HINDERED
    slower = columns["wished"] * np.random.default_rng(seed + 2).uniform(0.1, 1.0, rows)
    columns["possible"] = np.where(hindered, slower, columns["wished"])
    return columns


def _at_levels(name: str, level: np.ndarray) -> np.ndarray:
    """The values of a number at levels over all moments."""
    ordinary, share, met = MET[name]
    values = np.interp((level - share) / max(1.0 - share, 1e-9), LEVELS, met)
    values = np.where(level < share, ordinary, values)
    step = STEPS.get(name)
    return values if step is None else np.round(values / step) * step
