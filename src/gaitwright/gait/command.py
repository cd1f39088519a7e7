"""What the body should do: its command, its lead, its height and attitude (rows J1, J5)."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import wrap

POSITION_LEASH = 0.6
"""How far the wanted position may run ahead of the body, in body heights."""
MAX_YAW_LEAD = 0.3
"""How far the wanted yaw may run ahead [rad]."""
SLEW = 0.15
"""Fastest change of the commanded velocity, as a share of gravity."""
TURN_SLEW = 0.5
"""Fastest change of the commanded yaw rate, times g/h [rad/s²]; about 17 rad/s² for h = 0.29 m."""


@kernel
def slew(command, velocity, turn, gravity, height, dt):
    """Brings the slewed `command` (changed in place) one tick nearer to what is asked."""
    dx, dy = velocity[0] - command[0], velocity[1] - command[1]
    step = SLEW * gravity * dt
    length = math.hypot(dx, dy)
    k = 1.0 if length <= step else step / length
    command[0] += k * dx
    command[1] += k * dy
    most = TURN_SLEW * gravity / height * dt
    command[2] += min(max(turn - command[2], -most), most)


@kernel
def advance_reference(anchor, command, position, yaw, height, dt):
    """Integrates the command into the wanted place and yaw (changed in place), kept on their leashes."""
    anchor[2] += command[2] * dt
    ahead = wrap(anchor[2] - yaw)
    if abs(ahead) > MAX_YAW_LEAD:
        ahead = math.copysign(MAX_YAW_LEAD, ahead)
    anchor[2] = yaw + ahead
    c, s = math.cos(anchor[2]), math.sin(anchor[2])
    anchor[0] += (c * command[0] - s * command[1]) * dt
    anchor[1] += (s * command[0] + c * command[1]) * dt
    dx, dy = anchor[0] - position[0], anchor[1] - position[1]
    length = math.hypot(dx, dy)
    if length > POSITION_LEASH * height:
        k = POSITION_LEASH * height / length
        anchor[0] = position[0] + k * dx
        anchor[1] = position[1] + k * dy


@kernel
def sample(table, phase):
    """Row of a periodic table `(bins, 9)` at `phase`, linearly interpolated, as a tuple."""
    bins = table.shape[0]
    x = phase * bins
    i = int(x) % bins
    j = (i + 1) % bins
    t = x - math.floor(x)
    k = 1.0 - t
    return (
        k * table[i, 0] + t * table[j, 0],
        k * table[i, 1] + t * table[j, 1],
        k * table[i, 2] + t * table[j, 2],
        k * table[i, 3] + t * table[j, 3],
        k * table[i, 4] + t * table[j, 4],
        k * table[i, 5] + t * table[j, 5],
        k * table[i, 6] + t * table[j, 6],
        k * table[i, 7] + t * table[j, 7],
        k * table[i, 8] + t * table[j, 8],
    )


def path(
    command: Float[np.ndarray, "3"], time: Float[np.ndarray, "*n"]
) -> tuple[Float[np.ndarray, "*n 2"], Float[np.ndarray, "*n"]]:
    """Place x, y [m] and yaw [rad] of a body that holds a command from (0, 0) and yaw 0 at time 0: an arc."""
    half = 0.5 * command[2] * time
    along = time * np.sinc(2.0 * half / np.pi)
    aside = time * half * np.sinc(half / np.pi) ** 2
    x = command[0] * along - command[1] * aside
    y = command[0] * aside + command[1] * along
    return np.stack([x, y], axis=-1), command[2] * time
