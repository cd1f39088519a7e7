"""Force distributions drawn at random, for tests of the quadratic and the linear program alike."""

import numpy as np

from gaitwright.bench.evidence.sharing_oracles import Task
from gaitwright.control.inverse_dynamics import Load
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import GRIP

WEIGHT, HEIGHT = 15.0 * GRAVITY, 0.3
"""[N], [m]"""


def any_task(seed: int, legs: int = 4, feet: int | None = None, calm: bool = False) -> Task:
    """A robot on a slope, asked for any wrench of about its weight (calm: for one that it can well give)."""
    rng = np.random.default_rng(seed)
    stance = np.zeros(legs, dtype=bool)
    stance[rng.permutation(legs)[: feet or rng.integers(1, legs + 1)]] = True
    arm = np.array([[x, 0.14 * side, -0.3] for x in np.linspace(0.2, -0.2, legs // 2) for side in (1, -1)])
    arm += rng.uniform(-0.05, 0.05, (legs, 3))
    turn = rng.normal(size=(legs, 3, 3))
    spread = np.array([0.3, 0.3, 0.4, 0.1, 0.1, 0.1]) * (0.1 if calm else 1.0)
    normal = np.array([*rng.uniform(-0.3, 0.3, 2), 1.0])
    return Task(
        Load(
            WEIGHT * rng.normal([0, 0, 1, 0, 0, 0], spread),
            rng.uniform(-5.0, 5.0, (legs, 3)),
            arm,
            rng.uniform(-0.25, 0.25, (legs, 3, 3)),
            turn / np.linalg.norm(turn, axis=2)[..., None],
        ),
        stance,
        np.where(stance, 1.0 if calm else rng.uniform(0.1, 1.0, legs), 0.0),
        np.full(legs, GRIP) if calm else rng.uniform(0.2, 2.0, legs),
        normal / np.linalg.norm(normal),
        rng.uniform(-0.3, 0.3, (legs, 3)) * WEIGHT * stance[:, None],
        np.full((legs, 3), 40.0 if calm else 20.0),
        rng.normal(0.0, 3.0, (legs, 3)),
        WEIGHT,
        HEIGHT,
    )
