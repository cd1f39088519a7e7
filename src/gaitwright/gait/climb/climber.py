"""SkillCall + Sensed → MotionTarget along a planned climb: a coordinator that plays an `Ascent`."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.gait.climb.motion import SHIFT, Motion
from gaitwright.gait.climb.plan import Ascent, order_of
from gaitwright.numerics.geometry import between, rotation_vector
from gaitwright.signals import GRIP, Gait, GroundMap, MotionTarget, Sensed, SkillCall

UP = np.array([0.0, 0.0, 1.0])
"""Normal of every tread."""
TICK = 1e-3
"""Time between the poses that velocities are taken from [s]."""


@dataclass(frozen=True)
class Climber:
    """Goes through a climb by the clock, whatever is sensed: for a plant that cannot lag."""

    ascent: Ascent
    dt: float
    """Control period [s]."""

    def begin(self, sensed: Sensed, phase: float = 0.0) -> float:
        """The memory of a robot at the start of its climb: the time since then [s]."""
        return 0.0

    def move(
        self, memory: float, call: SkillCall, sensed: Sensed, ground: GroundMap | None = None
    ) -> tuple[MotionTarget, float]:
        """What body, feet and joints should do now, and the memory for the next tick."""
        time = memory + self.dt
        made = self.ascent.at(np.maximum(time + TICK * np.array([-1.0, 0.0, 1.0]), 0.0))
        over = time >= len(self.ascent.steps) * self.ascent.seconds
        stance, (omega, omega_rate) = made.stance[1], turning(made)
        target = MotionTarget(
            phase=time / call.gait.period % 1.0,
            stance=stance,
            load_scale=stance.astype(float),
            friction=np.full(len(stance), GRIP if ground is None else ground.friction),
            normal_w=UP.copy(),
            position_w=made.position_w[1],
            velocity_w=rate(made.position_w),
            acceleration_w=rate_of_rate(made.position_w),
            rotation_wb=made.rotation_wb[1],
            angular_velocity_w=omega,
            angular_acceleration_w=omega_rate,
            feet_w=made.feet_w[1],
            feet_velocity_w=rate(made.feet_w),
            feet_acceleration_w=rate_of_rate(made.feet_w),
            q=made.q[1],
            command=np.array([0.0 if over else call.velocity[0], 0.0, 0.0]),
            operator=np.zeros(len(stance)),
            reach=np.zeros(len(stance)),
            extra_force_w=np.zeros((len(stance), 3)),
        )
        return target, time


def climb_call(ascent: Ascent, driver: str) -> SkillCall:
    """The climb as a call of a skill: a step of every leg is a cycle, its velocity the mean of the climb."""
    n = ascent.robot.n
    place = {leg: k for k, leg in enumerate(order_of(n))}
    offsets = tuple((1.0 - (place[leg] + 1) / n) % 1.0 for leg in range(n))
    gait = Gait("climb", n * ascent.seconds, 1.0 - (1.0 - SHIFT) / n, offsets)
    first, last = ascent.motion.position_w[[0, -1], 0]
    speed = float(last - first) / (len(ascent.steps) * ascent.seconds)
    return SkillCall("climb", gait, (speed, 0.0), 0.0, driver, "asked for")


def rate(three: Float[np.ndarray, "3 ..."]) -> Float[np.ndarray, "..."]:
    """Velocity in the middle of three moments `TICK` apart."""
    return (three[2] - three[0]) / (2.0 * TICK)


def rate_of_rate(three: Float[np.ndarray, "3 ..."]) -> Float[np.ndarray, "..."]:
    """Acceleration in the middle of three moments."""
    return (three[2] - 2.0 * three[1] + three[0]) / TICK**2


def turning(made: Motion) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    """Angular velocity and acceleration of the body in the middle of three moments, world axes."""
    R = made.rotation_wb
    first, second = (np.array(rotation_vector(between(R[i], R[i + 1]))) / TICK for i in range(2))
    return 0.5 * (first + second), (second - first) / TICK
