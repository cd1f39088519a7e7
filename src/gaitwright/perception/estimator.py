"""The state from what a robot really senses: encoders, gyroscope, accelerometer and loads on the feet.

Attitude: the gyroscope, drawn slowly to where gravity is felt to point, with its bias (Mahony 2008).
Velocity: the accelerometer, drawn to what the feet that stand say. Position: feet that stand stay, but for
the rolling of their spheres (Bloesch 2013 has the same parts in a filter that also weighs them).
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.leg import foot_and_columns, hinge_axes, leg_at, leg_turns
from gaitwright.model.robot import scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import (
    GRAVITY,
    add,
    cross,
    length,
    rotation,
    scale,
    sub,
    times,
    times_t,
    vec,
)
from gaitwright.numerics.matrices import apply, write
from gaitwright.numerics.packing import Layout
from gaitwright.signals import Sensed

FELT_OVER = 0.3
"""The accelerometer is averaged over this time for where gravity points [s]."""
TILT, BIAS = 1.0, 0.1
"""So fast the attitude is drawn there [1/s], and the bias of the gyroscope [1/s²]."""
ODOMETRY = 30.0
"""So fast the velocity is drawn to what the feet say [1/s]."""
ANCHOR, ANCHOR_VELOCITY = 10.0, 25.0
"""So fast the position is drawn to where feet stand [1/s], and the velocity with it [1/s²]."""
LOADED, FULLY = 0.04, 0.2
"""A foot stands from this share of the weight on, and is believed fully from this one on."""
SETTLED = 0.03
"""Nor is it believed fully until it has stood for so long [s]."""
RATES_OVER = 0.012
"""Joint rates are averaged over this time [s]: in the noise of legged_gym run falls in 2 of 24 starts, with
8 ms in 5, with 4 ms in 19."""


class Estimate(NamedTuple):
    """What the estimator remembers."""

    orientation: Float[np.ndarray, "4"]
    bias: Float[np.ndarray, "3"]
    """Of the gyroscope [rad/s]."""
    velocity: Float[np.ndarray, "3"]
    """Of the base origin, world axes [m/s]."""
    position: Float[np.ndarray, "3"]
    """[m]"""
    felt: Float[np.ndarray, "3"]
    """Mean specific force, world axes [m/s²]."""
    rates: Float[np.ndarray, "legs 3"]
    """Mean joint rates [rad/s]."""
    stood: Float[np.ndarray, "legs"]
    """For how long each foot has stood [s]; 0: it does not."""
    anchor: Float[np.ndarray, "legs 3"]
    """Where the centre of its sphere should be, world axes [m]."""


LAYOUT = Layout.of(Estimate)
estimate_in = LAYOUT.views(Estimate)
sensed_fields = Sensed.layout.views()
UP = (0.0, 0.0, 1.0)


@kernel
def turned_by(orientation, angle, is_in_base):
    """Turns a quaternion in place by a small rotation vector, in axes of the base or of the world."""
    w, x, y, z = orientation[0], orientation[1], orientation[2], orientation[3]
    a, b, c = 0.5 * angle[0], 0.5 * angle[1], 0.5 * angle[2]
    s = 1.0 if is_in_base else -1.0
    orientation[0] = w - x * a - y * b - z * c
    orientation[1] = x + w * a + s * (y * c - z * b)
    orientation[2] = y + w * b + s * (z * a - x * c)
    orientation[3] = z + w * c + s * (x * b - y * a)
    size = math.sqrt((orientation * orientation).sum())
    for i in range(4):
        orientation[i] /= size


@kernel
def estimate(packed, seen, force_b, dt, memory, out):
    """One tick: changes the memory, an `Estimate`, and writes the row of a `Sensed`.

    `seen`: the row of a `Measured`, of which only joints, gyroscope and loads are read; `force_b`: specific
    force [m/s²].
    """
    read, state, told = sensed_fields(seen), estimate_in(memory), sensed_fields(out)
    omega = sub(vec(read.angular_velocity_b), vec(state.bias))
    R = levelled(state, omega, force_b, dt)
    pull = sub(times(R, force_b), scale(GRAVITY, UP))
    velocity = add(vec(state.velocity), scale(dt, pull))
    position = add(vec(state.position), scale(dt, velocity))
    says, off, trust = asked_feet(packed, state, read, R, omega, position, dt)
    if trust > 0.0:
        share = min(1.0, trust)
        says, off = scale(1.0 / trust, says), scale(1.0 / trust, off)
        velocity = add(velocity, scale(share * ODOMETRY * dt, sub(says, velocity)))
        velocity = add(velocity, scale(share * ANCHOR_VELOCITY * dt, off))
        position = add(position, scale(share * ANCHOR * dt, off))
    write(state.velocity, 0, velocity)
    write(state.position, 0, position)
    out[:] = seen
    told.orientation_wb[:] = state.orientation
    write(told.position_w, 0, position)
    write(told.velocity_w, 0, velocity)
    write(told.angular_velocity_b, 0, omega)
    keep = math.exp(-dt / RATES_OVER)
    state.rates[:] = keep * state.rates + (1.0 - keep) * read.qd
    told.qd[:] = state.rates


@kernel
def levelled(state, omega, force_b, dt):
    """Brings the attitude one tick on; the matrix of the base."""
    turned_by(state.orientation, scale(dt, omega), True)
    felt, share = vec(state.felt), dt / FELT_OVER
    now = times(rotation(state.orientation), force_b)
    felt = add(felt, scale(share, sub(now, felt)))
    write(state.felt, 0, felt)
    error = scale(1.0 / max(length(felt), 1.0), cross(felt, UP))
    turned_by(state.orientation, scale(TILT * dt, error), False)
    R = rotation(state.orientation)
    write(state.bias, 0, sub(vec(state.bias), scale(BIAS * dt, times_t(R, error))))
    return R


@kernel
def asked_feet(packed, state, read, R, omega, position, dt):
    """What the feet that stand say, each times how far it is believed: velocity of the base, how far it is
    from where its feet have it; and how far they are believed in all."""
    _, weight, _ = scales(packed)
    says, off, trust = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0
    below_w = times_t(R, UP)
    for k in range(read.load.size):
        if read.load[k] < LOADED * weight:
            state.stood[k] = 0.0
            continue
        leg = leg_at(packed, k)
        turns = leg_turns(read.q[k], leg.sign)
        foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
        axes, qd = hinge_axes(turns, leg.sign), read.qd[k]
        below = scale(-leg.foot_radius, below_w)
        centre = add(leg.hip, apply(leg.frame, foot))
        rate = apply(leg.frame, add(add(scale(qd[0], c1), scale(qd[1], c2)), scale(qd[2], c3)))
        spin = add(add(scale(qd[0], axes[0]), scale(qd[1], axes[1])), scale(qd[2], axes[2]))
        rolls = add(apply(leg.frame, spin), omega)  # angular velocity of the shank, base axes
        moves = add(rate, cross(omega, centre))
        rolling = times(R, cross(below, rolls))  # of the centre, where the sphere rolls and does not slip
        at = add(position, times(R, centre))
        if state.stood[k] <= 0.0:
            write(state.anchor[k], 0, at)
        else:
            write(state.anchor[k], 0, add(vec(state.anchor[k]), scale(dt, rolling)))
        state.stood[k] += dt
        share = min(1.0, read.load[k] / (FULLY * weight)) * min(1.0, state.stood[k] / SETTLED)
        says = add(says, scale(share, sub(rolling, times(R, moves))))
        off = add(off, scale(share, sub(vec(state.anchor[k]), at)))
        trust += share
    return says, off, trust
