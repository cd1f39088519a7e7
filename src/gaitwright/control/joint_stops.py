"""How a joint keeps off its stops: where it may be asked to be, how fast it may come near, what brakes it.

A stop that is run into gives way in a simulator, by many degrees, and breaks something on a robot. So near
one a joint is asked for no more than the rate from which part of its own torque still stops it in time.
"""

import math

from gaitwright.numerics.compiled import kernel

MARGIN = 0.05
"""Joints are asked to stay this far from their stops [rad], and a quarter of their range at most."""
BRAKING = 0.25
"""Share of a joint's torque that is counted on to stop it."""
FIRM = 30.0
"""Damping of what is faster than that, times w0 I."""


@kernel
def room(low, high):
    """Range [rad] in which a joint with stops at `low` and `high` may be asked to be."""
    margin = min(MARGIN, 0.25 * (high - low))
    return low + margin, high - margin


@kernel
def fastest(way, torque, inertia):
    """Highest rate [rad/s] of a joint of that inertia and torque limit `way` [rad] before its stop."""
    return math.sqrt(2.0 * BRAKING * torque / inertia * max(way, 0.0))


@kernel
def braking(rate, down, up, inertia, w0):
    """Torque [N·m] against a rate beyond the fastest ones, `down` towards the lower stop and `up`."""
    too_fast = max(rate - up, 0.0) - max(-rate - down, 0.0)
    return -FIRM * w0 * inertia * too_fast
