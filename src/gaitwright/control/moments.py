"""Moments in rows: all that one tick of the numerical controller reads, as one row of numbers."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel
from gaitwright.signals import MotionTarget, Sensed

Moments = Float[np.ndarray, "steps numbers"]
"""One moment a row, the columns in the order of `Moment`."""


BODY, LEG = 40, 17
"""Columns of the body, and of each leg after them."""


class Moment(NamedTuple):
    """What a tick reads, field by field as in `Sensed` and `MotionTarget`."""

    position: np.ndarray
    orientation: np.ndarray
    velocity: np.ndarray
    spin_b: np.ndarray
    normal: np.ndarray
    want_p: np.ndarray
    want_v: np.ndarray
    want_a: np.ndarray
    want_w: np.ndarray
    want_wd: np.ndarray
    want_r: np.ndarray
    stance: np.ndarray
    share: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    feet_p: np.ndarray
    feet_v: np.ndarray
    feet_a: np.ndarray


def moments_of(sensed: Sequence[Sensed], targets: Sequence[MotionTarget]) -> Moments:
    """What a robot sensed and was to do, tick by tick, as rows."""
    return np.array([row(s, t) for s, t in zip(sensed, targets, strict=True)])


def row(s: Sensed, t: MotionTarget) -> Float[np.ndarray, "numbers"]:
    """One moment as a row."""
    parts = Moment(
        s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, t.normal_w, t.position_w,
        t.velocity_w, t.acceleration_w, t.angular_velocity_w, t.angular_acceleration_w, t.rotation_wb,
        t.stance, t.share, s.q, s.qd, t.feet_w, t.feet_velocity_w, t.feet_acceleration_w,
    )  # fmt: skip
    return np.concatenate([np.ravel(part) for part in parts])


@kernel
def moment_of(numbers):
    """The `Moment` in a row, as views; only `stance` is a copy."""
    n = (numbers.size - BODY) // LEG
    legs = numbers[BODY:]
    return Moment(
        numbers[:3],
        numbers[3:7],
        numbers[7:10],
        numbers[10:13],
        numbers[13:16],
        numbers[16:19],
        numbers[19:22],
        numbers[22:25],
        numbers[25:28],
        numbers[28:31],
        numbers[31:40].reshape(3, 3),
        legs[:n] > 0.5,
        legs[n : 2 * n],
        legs[2 * n : 5 * n].reshape(n, 3),
        legs[5 * n : 8 * n].reshape(n, 3),
        legs[8 * n : 11 * n].reshape(n, 3),
        legs[11 * n : 14 * n].reshape(n, 3),
        legs[14 * n :].reshape(n, 3),
    )
