"""From one driver to another without a leap of torque, at any phase and in either direction.

Whoever takes over begins with the torques that were, and comes to its own within 50 ms: without that, a
change of driver amid a pace steps by a third of the torque limit.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.signals import MotorCommand

LASTS = 0.05
"""Until who took over has its own torques [s]."""


class Handover(NamedTuple):
    """A change of driver that is under way."""

    offset: Float[np.ndarray, "legs 3"]
    """Torques of who went less those of who came, at that moment [N·m]."""
    since: float
    """[s]"""


def begun(last: MotorCommand | None, own: MotorCommand, time: float) -> Handover | None:
    """The change from a last command to another driver's; `None` where either is more than torques: servos
    that hold angles come to them in their own way."""
    if last is None or last.kp is not None or own.kp is not None:
        return None
    return Handover(last.tau - own.tau, time)


def softened(
    command: MotorCommand, change: Handover, time: float, tau_max: Float[np.ndarray, "legs 3"]
) -> tuple[MotorCommand, Handover | None]:
    """A command amid a change of driver, within the torque limits; and the change, while it goes on."""
    left = 1.0 - (time - change.since) / LASTS
    if left <= 0.0 or command.kp is not None:
        return command, None
    tau = np.clip(command.tau + left * change.offset, -tau_max, tau_max)
    return replace(command, tau=tau), change
