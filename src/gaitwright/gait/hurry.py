"""How a gait hurries: pushed off its velocity, a robot steps sooner, not only farther.

Where the next foot lands, a body that falls aside has come farther the longer the step took, by e^(w0 t); a
step of half the time needs half the reach. So the period shrinks with how far the body is off the velocity
that is asked for, beyond what any gait shows by itself, and comes back as the body does.
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY

CALM = 0.2
"""Off by up to this share of √(g h), a gait keeps its period; flying gaits sway by half of it."""
HURRY = 1.0
"""By what the pace grows per share beyond that, which counts up to 1."""


@kernel
def hurried(period, velocity, command, yaw, height):
    """Period [s] of a gait whose base moves at `velocity` (world), asked for `command` along `yaw`."""
    c, s = math.cos(yaw), math.sin(yaw)
    off_x = velocity[0] - c * command[0] + s * command[1]
    off_y = velocity[1] - s * command[0] - c * command[1]
    off = math.hypot(off_x, off_y) / math.sqrt(GRAVITY * height)
    return period / (1.0 + HURRY * min(max(off - CALM, 0.0), 1.0))
