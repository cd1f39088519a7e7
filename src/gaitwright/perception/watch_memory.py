"""What the watch remembers from tick to tick: three tables, one after the other in one row of numbers."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Layout
from gaitwright.numerics.parts import part

LAGS = 32
"""So many commands are remembered [ticks]."""
HYPOTHESES = 8
"""What may be wrong with a leg: motor 1, 2, 3 dead, all dead, joint 1, 2, 3 stuck, the foot's sensor lies."""
DEAD_LEG, STUCK, SENSOR = 3, 4, 7
"""Where these begin among them."""


class ReadingMemory(NamedTuple):
    """Of the readings by themselves."""

    same: Float[np.ndarray, "2"]
    """Ticks since all readings, and those of the body, were others."""
    stirred: Float[np.ndarray, "1"]
    """How far joints turned while those of the body stayed [rad]."""
    turned: Float[np.ndarray, "6"]
    """By how much the attitude turned more than its rates say [rad], and its mean."""
    same_joint: Float[np.ndarray, "legs 3"]
    """Ticks since the angle was another one."""
    others: Float[np.ndarray, "legs 3"]
    """How far the other joints of the leg turned in the meantime [rad]."""
    drift: Float[np.ndarray, "legs 3"]
    """By how much the angle went farther than its rates say [rad]."""
    drift_mean: Float[np.ndarray, "legs 3"]
    still: Float[np.ndarray, "legs 3"]
    """Time since the joint turned [s]."""
    calm: Float[np.ndarray, "legs 3"]
    """Mean size of its rate [rad/s]."""
    same_load: Float[np.ndarray, "legs"]
    """Ticks since the foot felt another load."""


class ForceMemory(NamedTuple):
    """Of the forces at the feet; means over `FILTER` seconds, base axes."""

    mean: Float[np.ndarray, "legs 16"]
    """Force that the torques stand for [N], velocity of the contact point [m/s], what each motor adds to the
    force [N] (9), load felt [N]."""
    now: Float[np.ndarray, "legs 12"]
    """Force per torque of each joint [1/m] (9), and the contact point [m]."""
    lack: Float[np.ndarray, "6"]
    """Force and moment that move the robot and are in no foot, in weights, and weights times height."""
    usual: Float[np.ndarray, "6"]
    """What of it is always so: a load on the back."""
    noise: Float[np.ndarray, "1"]
    """How far it jumps about."""
    suspicion: Float[np.ndarray, "legs 8"]
    """How much better a hypothesis explains what is seen than a leg in order does [s]."""
    since: Float[np.ndarray, "legs 8"]
    """From when on [s]."""
    amiss: Float[np.ndarray, "legs 8"]
    """What a hypothesis leaves unexplained since the leg is suspected [s]."""
    worst: Float[np.ndarray, "legs"]
    """The largest suspicion of a leg [s]."""
    waited: Float[np.ndarray, "legs"]
    """For how long it is large enough [s]."""
    distrusted: Float[np.ndarray, "legs"]
    """1 where the foot's sensor lies."""
    believed: Float[np.ndarray, "legs"]
    """Load of the foot by torques [N]."""


class LateMemory(NamedTuple):
    """Of commands and of how late the answer to them is seen."""

    ticks: Float[np.ndarray, "1"]
    """Since the start."""
    lag: Float[np.ndarray, "1"]
    """Ticks from a command to the reading that answers it, less one."""
    dark: Float[np.ndarray, "1"]
    """So long nothing is concluded from torques [s]."""
    off: Float[np.ndarray, "1"]
    """How far swinging legs are from what they were told, at that lag."""
    samples: Float[np.ndarray, "1"]
    """Ticks since other lags are tried."""
    better: Float[np.ndarray, "1"]
    """For how long another one has been better [s]."""
    scores: Float[np.ndarray, "32"]
    """As `off`, for every lag."""
    told: Float[np.ndarray, "legs 96"]
    """Torques of the last commands, three a tick, in a ring [N·m]."""


READINGS, FORCES, LATE = Layout.of(ReadingMemory), Layout.of(ForceMemory), Layout.of(LateMemory)
readings_in, forces_in, late_in = (
    READINGS.views(ReadingMemory),
    FORCES.views(ForceMemory),
    LATE.views(LateMemory),
)
SIZES = (READINGS.length, FORCES.length, LATE.length)


def size_of(legs: int) -> int:
    """Numbers in the row of a robot with so many legs."""
    return READINGS.size(legs) + FORCES.size(legs) + LATE.size(legs)


@kernel
def tables(row, n):
    """The three tables in a row."""
    (a, b), (c, d), (e, f) = SIZES
    first, second, third = a + b * n, c + d * n, e + f * n
    return (
        readings_in(part(row, 0, (first,))),
        forces_in(part(row, first, (second,))),
        late_in(part(row, first + second, (third,))),
    )
