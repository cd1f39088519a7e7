"""Turns there and back: three angles, a matrix, one of many."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.numerics.geometry import (
    about_axis,
    from_roll_pitch_yaw,
    roll_pitch_yaw,
    rotation,
    rotations,
    wrap,
    wrapped,
)

seeds = st.integers(0, 2**32 - 1)
angle = st.floats(-3.1, 3.1)


@given(angle, st.floats(-1.5, 1.5), angle)
def test_three_angles_are_those_of_their_matrix(roll: float, pitch: float, yaw: float) -> None:
    R = from_roll_pitch_yaw(np.array([roll, pitch, yaw]))
    np.testing.assert_allclose(R, about_axis(2, yaw) @ about_axis(1, pitch) @ about_axis(0, roll), atol=1e-15)
    np.testing.assert_allclose(roll_pitch_yaw(R), (roll, pitch, yaw), atol=1e-12)


@given(angle, st.sampled_from([-1.0, 1.0]))
def test_a_body_straight_up_or_down_has_no_yaw(roll: float, side: float) -> None:
    R = about_axis(1, side * np.pi / 2) @ about_axis(0, roll)
    np.testing.assert_allclose(roll_pitch_yaw(R), (roll, side * np.pi / 2, 0.0), atol=1e-12)


@given(seeds)
def test_many_are_each_of_them(seed: int) -> None:
    quaternions = np.random.default_rng(seed).normal(size=(2, 3, 4))
    R = rotations(quaternions.reshape(-1, 4))
    np.testing.assert_array_equal(R, [rotation(one) for one in quaternions.reshape(-1, 4)])
    angles = roll_pitch_yaw(R.reshape(2, 3, 3, 3))
    np.testing.assert_array_equal(angles[1, 2], roll_pitch_yaw(R[5]))
    np.testing.assert_allclose(from_roll_pitch_yaw(angles).reshape(-1, 3, 3), R, atol=1e-12)
    far = 9.0 * angles[..., 0]
    np.testing.assert_allclose(wrapped(far)[0, 1], wrap(far[0, 1]), atol=1e-15)
