"""What an inertial unit on the base feels, from how the base moves: one for all simulated plants."""

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, rotation, times_t


@kernel
def specific_force(orientation, velocity, before, dt):
    """Acceleration less gravity, base axes, mean over a control period `dt` [s], as three numbers [m/s²].

    `orientation`: of the base at its end; `velocity`, `before`: of its origin at end and start, world axes.
    """
    rise = (velocity[2] - before[2]) / dt + GRAVITY
    pull = ((velocity[0] - before[0]) / dt, (velocity[1] - before[1]) / dt, rise)
    return times_t(rotation(orientation), pull)
