"""Which feet make up for a wrench: a table with a map for every set of feet that may be down, made once.

The smallest forces that give a wrench, feet where they are in the nominal stance: so a tick of the learned
controller solves nothing.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.control.forces import FORCE_WEIGHTS, MOMENT_WEIGHTS
from gaitwright.model.robot import Robot

SMALL = 1e-4
"""Price of a force in itself, which bounds the map of few feet."""


def contact_maps(robot: Robot) -> Float[np.ndarray, "sets forces 6"]:
    """The forces of all feet per scaled wrench, by set of feet (bit k: leg k is down), in weights.

    The wrench: forces over the weight, moments about the base origin over weight times height, both times
    the weights of `control.forces`; axes of the base in its nominal stance. Feet that are up have zeros.
    """
    n = robot.n
    below = np.array([0.0, 0.0, 1.0]) * robot.foot_radius[:, None]
    arms = robot.nominal_feet - below
    blocks = []
    for arm in arms:
        moments = np.cross(arm, np.eye(3)).T / robot.height
        rows = np.vstack([np.diag(FORCE_WEIGHTS), np.diag(MOMENT_WEIGHTS) @ moments])
        blocks.append(rows)
    maps = np.zeros((1 << n, 3 * n, 6))
    for feet in range(1, 1 << n):
        down = [k for k in range(n) if feet >> k & 1]
        balance = np.hstack([blocks[k] for k in down])
        smallest = balance.T @ np.linalg.inv(balance @ balance.T + SMALL * np.eye(6))
        for place, k in enumerate(down):
            maps[feet, 3 * k : 3 * k + 3] = smallest[3 * place : 3 * place + 3]
    return maps
