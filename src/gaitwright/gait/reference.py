"""The periodic motion that a gait gives the body by itself (control.md, "Periodic reference").

Feet that push in turn bob, pitch and sway the body. A controller without a horizon must know this
motion beforehand, or it fights it: without the reference a gallop falls and a pronk sinks.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait

BINS = 256
MOST_SWAY = 0.12
"""Largest sway acceleration of a gait that always has three feet down, as a share of gravity."""


def periodic_reference(robot: Robot, gait: Gait) -> Float[np.ndarray, "bins 9"]:
    """Sway y, bob z and pitch over one cycle: position, velocity, acceleration of each [m, rad, s].

    Columns: y, ẏ, ÿ, z, ż, z̈, θ, θ̇, θ̈; rows: phase φ = row / bins. Each leg pushes with a half-sine
    normal force of mean m g/n over the cycle; sway stands in for the roll moment.
    """
    if gait.duty >= 1.0:
        return np.zeros((BINS, 9))
    phase = np.arange(BINS) / BINS
    offsets = np.asarray(gait.offsets)
    progress = ((phase[:, None] + offsets) % 1.0) / gait.duty
    weight = robot.total_mass * GRAVITY
    peak = weight / (robot.n * gait.duty) * np.pi / 2
    force = np.where(progress < 1.0, peak * np.sin(np.pi * np.minimum(progress, 1.0)), 0.0)
    arm = robot.nominal_feet[:, :2] - robot.nominal_feet[:, :2].mean(axis=0)
    sway = -(force @ arm[:, 1]) / (robot.total_mass * robot.height)
    accelerations = (
        sway * calm(sway, gait, robot.n),
        force.sum(axis=1) / robot.total_mass - GRAVITY,
        -(force @ arm[:, 0]) / pitch_inertia(robot),
    )
    columns = [column for a in accelerations for column in integrate_periodic(a, gait.period)]
    return np.stack(columns, axis=1)


def calm(sway: Float[np.ndarray, "bins"], gait: Gait, legs: int) -> float:
    """Share of the full sway that a gait needs, in (0, 1].

    With three feet always down, the body's centre lies on an edge of the support triangle, and any share
    of the full sway moves it inside; a little is enough, and wide robots cannot do more.
    """
    if gait.duty * legs < 3.0:
        return 1.0
    return min(1.0, MOST_SWAY * GRAVITY / max(float(np.abs(sway).max()), 1e-9))


def integrate_periodic(
    acceleration: Float[np.ndarray, "bins"], period: float
) -> tuple[Float[np.ndarray, "bins"], Float[np.ndarray, "bins"], Float[np.ndarray, "bins"]]:
    """Periodic position and velocity of zero mean that belong to a periodic acceleration, and itself.

    Integrated as a Fourier series, so that the cycle closes exactly.
    """
    spectrum = np.fft.rfft(acceleration)
    spectrum[0] = 0.0
    omega = 2j * np.pi * np.arange(len(spectrum)) / period
    omega[0] = 1.0
    bins = len(acceleration)

    def back(s: np.ndarray) -> np.ndarray:
        return np.fft.irfft(s, bins)

    return back(spectrum / omega**2), back(spectrum / omega), back(spectrum)


def pitch_inertia(robot: Robot) -> float:
    """Moment of inertia of the whole robot about its pitch axis in the nominal stance [kg·m²].

    Leg links count as points half-way between hip and foot: a share of the trunk's own.
    """
    legs = robot.mass.sum(axis=1)
    middle = 0.5 * (robot.hip + robot.nominal_feet)
    return float(robot.base_inertia[1, 1] + (legs * (middle[:, 0] ** 2 + (0.5 * middle[:, 2]) ** 2)).sum())
