"""The two gaits of figures 6.5 and 6.6, and the motion they ask of the thesis's robot."""

from gaitwright.gait.desired_cycle import DesiredCycle, Manner, desired_cycle
from gaitwright.model.robot import Robot
from gaitwright.signals import Gait

STRIDE = 3.0
"""λ_x [m]."""
SPEED = 1.0 / 6.0
"""[m/s]; the scan has 1/8 in places (section 6.3)."""
EVERY = 0.125
"""The thesis's curves have a value every 1/8 s."""
STEPS = round(STRIDE / SPEED / EVERY)
LIFT = 0.5
"""How high the feet are swung [m]; ours: the thesis prints none."""
WALK_DUTY, TROT_DUTY = 0.8, 0.5
LATERAL, DIAGONAL = (3, 1, 4, 2), (3, 2, 4, 1)
"""Orders of lifting the legs: the one in which a hind foot makes way for the fore foot of its side, which
keeps the body over its feet, and the one that the thesis names."""


def walk(order: tuple[int, ...], speed: float = SPEED) -> Gait:
    """The walk that lifts the legs 1 … 4 in this order, a quarter of a cycle apart, beginning at phase 0."""
    lifts = {leg: k / 4 for k, leg in enumerate(order)}
    offsets = tuple((WALK_DUTY - lifts[leg]) % 1.0 for leg in (1, 2, 3, 4))
    return Gait("walk", STRIDE / speed, WALK_DUTY, offsets)


def trot(speed: float = SPEED) -> Gait:
    """The trot: legs 1 and 4 down for half a cycle, then 2 and 3."""
    return Gait("trot", STRIDE / speed, TROT_DUTY, (0.0, 0.5, 0.5, 0.0))


def cycle_of(robot: Robot, gait: Gait, steps: int = STEPS) -> DesiredCycle:
    """The motion of a gait with the thesis's stride, body level."""
    return desired_cycle(robot, gait, (STRIDE / gait.period, 0.0), manner=Manner(lift=LIFT), steps=steps)


def on_all_fours(robot: Robot, steps: int) -> DesiredCycle:
    """The body carried over four planted feet, straight beside their hips at the first sample.

    A cycle with a long common stance, of which only the first samples are of use.
    """
    gait = Gait("support", STRIDE / SPEED, 0.9, (0.45,) * 4)
    return cycle_of(robot, gait, steps)
