"""How far the readings of a robot in order are from the truth: noise, bias and delay."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Imperfections:
    """How far readings are from the truth all the time; the noise is drawn evenly from ± its bound."""

    angle: float = 0.0
    """Noise of joint angles [rad]."""
    rate: float = 0.0
    """Of joint rates [rad/s]."""
    velocity: float = 0.0
    """Of the base [m/s]."""
    spin: float = 0.0
    """Of its angular velocity [rad/s]."""
    attitude: float = 0.0
    """Of the direction of gravity in the base [rad]."""
    angle_bias: float = 0.0
    """Every joint reads this much too much or too little, which of the two is drawn [rad]."""
    attitude_bias: float = 0.0
    """The base reads as tilted by this much, about a horizontal axis that is drawn [rad]."""
    late: int = 0
    """Ticks by which readings come late."""
    spin_bias: float = 0.0
    """Each rate of the gyroscope is off by this, up or down as drawn [rad/s]."""
    force: float = 0.0
    """Noise of the accelerometer [m/s²]."""
    force_bias: float = 0.0
    """It is off by this along each axis, up or down as drawn [m/s²]."""
    load: float = 0.0
    """Noise of a foot's load, in its own share of the weight."""


LEGGED_GYM = Imperfections(0.01, 1.5, 0.1, 0.2, 0.05)
"""The noise that policies of legged_gym are trained with."""
NOISE = {
    "exact": Imperfections(),
    "go2": Imperfections(
        0.002, 0.1, spin=0.02, attitude_bias=0.01, spin_bias=0.005, force=0.3, force_bias=0.05, load=0.02
    ),
    "legged-gym": Imperfections(
        0.01, 1.5, spin=0.2, attitude_bias=0.01, spin_bias=0.02, force=0.5, force_bias=0.1, load=0.05
    ),
}
"""Noise of encoders, inertial unit and feet by name; what a robot does not sense has none."""
