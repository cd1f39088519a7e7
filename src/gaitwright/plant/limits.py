"""Whether a plant can do what it is asked; if not, `WrongUse` with what was asked and what there is."""

import math

from gaitwright.errors import WrongUse

MOST_STEPS = 10_000
"""In a control period. More would be waiting, not accuracy."""


def check_timestep(timestep: float, dt: float) -> None:
    """Refuses a step of the physics that is no share of the control period `dt`, or too small a one [s]."""
    asked = f"a step of {timestep * 1e3:g} ms"
    if not (math.isfinite(timestep) and timestep > 0.0):
        raise WrongUse(f"{asked} is asked; steps are finite and greater than 0")
    least = dt / MOST_STEPS
    if timestep < least * (1.0 - 1e-9):
        raise WrongUse(
            f"{asked} is asked; the least is {least * 1e3:g} ms, a {MOST_STEPS}th of the control period"
        )
    if dt / timestep <= 0.5 or abs(dt / timestep - round(dt / timestep)) >= 1e-6:
        raise WrongUse(f"{asked} does not divide the control period of {dt * 1e3:g} ms")


def check_force(force_w: tuple[float, float, float]) -> None:
    """Refuses a push whose force [N] is not finite."""
    if not all(map(math.isfinite, force_w)):
        x, y, z = force_w
        raise WrongUse(f"a push of ({x:g}, {y:g}, {z:g}) N is asked; forces are finite numbers")
