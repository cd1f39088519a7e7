"""Moments in rows: all that one tick of the numerical controller reads, as one row of numbers."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Layout
from gaitwright.signals import MotionTarget, Sensed

Moments = Float[np.ndarray, "steps numbers"]
"""One moment a row, the columns in the order of `Moment`."""


class Moment(NamedTuple):
    """What a tick reads, field by field as in `Sensed` and `MotionTarget`."""

    position: Float[np.ndarray, "3"]
    orientation: Float[np.ndarray, "4"]
    velocity: Float[np.ndarray, "3"]
    omega_b: Float[np.ndarray, "3"]
    normal: Float[np.ndarray, "3"]
    position_d: Float[np.ndarray, "3"]
    velocity_d: Float[np.ndarray, "3"]
    acceleration_d: Float[np.ndarray, "3"]
    omega_d: Float[np.ndarray, "3"]
    omega_rate_d: Float[np.ndarray, "3"]
    rotation_d: Float[np.ndarray, "3 3"]
    stance: Bool[np.ndarray, "legs"]
    load_scale: Float[np.ndarray, "legs"]
    friction: Float[np.ndarray, "legs"]
    q: Float[np.ndarray, "legs 3"]
    qd: Float[np.ndarray, "legs 3"]
    feet_p: Float[np.ndarray, "legs 3"]
    feet_v: Float[np.ndarray, "legs 3"]
    feet_a: Float[np.ndarray, "legs 3"]


LAYOUT = Layout.of(Moment)
moment_of = LAYOUT.views(Moment)
"""The `Moment` in a row, as views but for `stance`; for kernels too."""
stance_begins = LAYOUT.start("stance")
sensed_fields, target_fields = Sensed.layout.views(), MotionTarget.layout.views()


@kernel
def moment_between(seen, asked):
    """The `Moment` of a `Sensed` and a `MotionTarget`, given as their rows."""
    s, t = sensed_fields(seen), target_fields(asked)
    return Moment(
        s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, t.normal_w, t.position_w,
        t.velocity_w, t.acceleration_w, t.angular_velocity_w, t.angular_acceleration_w, t.rotation_wb,
        t.stance, t.load_scale, t.friction, s.q, s.qd, t.feet_w, t.feet_velocity_w, t.feet_acceleration_w,
    )  # fmt: skip


def moments_of(sensed: Sequence[Sensed], targets: Sequence[MotionTarget]) -> Moments:
    """What a robot sensed and was to do, tick by tick, as rows."""
    return np.array([row(s, t) for s, t in zip(sensed, targets, strict=True)])


def row(s: Sensed, t: MotionTarget) -> Float[np.ndarray, "numbers"]:
    """One moment as a row."""
    return LAYOUT.pack(moment_between(s.row, t.row))
