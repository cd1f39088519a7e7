"""Whether the numbers of a desired cycle can be those of one."""

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.signals import Gait


def check_numbers(
    gait: Gait, command: Float[np.ndarray, "3"], height: float | None, lift: float | None
) -> None:
    """`WrongUse` for a number that is none, or that no cycle can have."""
    if not np.isfinite(command).all():
        raise WrongUse(
            f"velocity {command[0]:g}, {command[1]:g} m/s and yaw rate {command[2]:g} rad/s: "
            "every number must be finite"
        )
    if not 0.0 < gait.period < np.inf:
        raise WrongUse(f"gait {gait.name!r} has a period of {gait.period:g} s; it must be above 0 and finite")
    if not 0.0 < gait.duty <= 1.0:
        raise WrongUse(
            f"gait {gait.name!r} has a duty factor of {gait.duty:g}; it must be above 0, at most 1"
        )
    if not np.isfinite(gait.offsets).all():
        raise WrongUse(f"gait {gait.name!r} has offsets {gait.offsets}; every one must be finite")
    for what, value in (("height", height), ("lift", lift)):
        if value is not None and not np.isfinite(value):
            raise WrongUse(f"a {what} of {value:g} m was asked for; it must be finite")
