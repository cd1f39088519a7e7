"""How much the feet may count on: the ground's friction where it is known, and less where they slip.

A foot that is down and moves has been asked for more than there is. What it counts on falls while it slips,
and comes back slowly to what is known of the ground: the ground may get better again.
"""

import math

from gaitwright.gait.state import STANCE
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY

SLIPS = 0.15
"""A foot that is down and moves faster than this share of √(g h) slips."""
SETTLES = 0.03
"""A foot that has just landed may move for this long [s]."""
FALLS, RISES = 4.0, 0.1
"""What the feet count on falls, and rises, by this share of what is known, each second."""
LEAST = 0.1
"""It falls to no less than this coefficient."""


@kernel
def feel_grip(state, felt, feet_w, known, height, dt):
    """Brings the grip of `state` (changed in place) one tick on; `known`: the ground's friction.

    To be called before the contacts of this tick are noted.
    """
    slips = SLIPS * math.sqrt(GRAVITY * height) * dt
    for leg in range(felt.size):
        if state.grip[leg] == 0.0:
            state.grip[leg] = known
        change = RISES
        if felt[leg] and state.mode[leg] == STANCE and state.age[leg] > SETTLES and state.unfelt[leg] == 0.0:
            was = state.contact[leg]
            if math.hypot(feet_w[leg, 0] - was[0], feet_w[leg, 1] - was[1]) > slips:
                change = -FALLS
        grip = state.grip[leg] + change * known * dt
        state.grip[leg] = min(max(grip, LEAST), known)
