"""How late readings are: swinging legs answer a command, and the command that they answer is the lag.

In the air the torques that a leg's motion needs are those that it was told. Where they are not, the commands
before are tried; the one that fits tells how many ticks ago it was given.
"""

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.perception.watch_memory import LAGS

OFF = 0.01
"""From so much on other lags are tried, in weights times height."""
CLEARLY = (0.02, 0.3)
"""A lag is another one where that fits to the first, and to the second share of how the old one does."""
SAMPLES = 25
"""Ticks of swinging legs that it takes."""
LASTS = 0.02
"""So long it must have been so [s]."""
SHARE = 0.04
"""Of a new value in the means."""


@kernel
def remember(late, tau):
    """Takes the torques of a command into the ring; its place there."""
    place = int(late.ticks[0]) % LAGS
    for k in range(late.told.shape[0]):
        for j in range(3):
            late.told[k, 3 * place + j] = tau[3 * k + j]
    late.ticks[0] += 1.0
    return place


@kernel
def distance(told, place, need):
    """How far the torques in a place of the ring are from those needed [N·m]."""
    p = 3 * place
    return abs(told[p] - need[0]) + abs(told[p + 1] - need[1]) + abs(told[p + 2] - need[2])


@kernel
def compare(late, k, place, need, scale):
    """Compares the torques that a swinging leg needs with those it was told, if need be with earlier ones.

    `scale`: weight times height.
    """
    told, share = late.told[k], SHARE / scale
    at = (place - int(late.lag[0])) % LAGS
    late.off[0] += share * distance(told, at, need) - SHARE * late.off[0]
    if late.off[0] < OFF:
        return
    late.samples[0] += 1.0
    for lag in range(LAGS):
        off = distance(told, (place - lag) % LAGS, need)
        late.scores[lag] += share * off - SHARE * late.scores[lag]


@kernel
def new_lag(late, dt):
    """The lag, where it turns out to be another one, or -1."""
    if late.off[0] < OFF:
        if late.samples[0] > 0.0:
            late.samples[0] = late.better[0] = 0.0
            late.scores[:] = 0.0
        return -1
    lag, best = int(late.lag[0]), int(np.argmin(late.scores))
    fits, did = late.scores[best], late.scores[lag]
    known = late.samples[0] > SAMPLES and 0 <= best < LAGS - 2 and best != lag
    if not (known and fits < min(CLEARLY[0], CLEARLY[1] * did) and did > CLEARLY[0]):
        late.better[0] = 0.0
        return -1
    late.better[0] += dt
    if late.better[0] < LASTS:
        return -1
    late.lag[0], late.off[0], late.better[0] = best, 0.0, 0.0
    return best
