"""A camera's rays go through its pixels, its eye sits on the robot, and wrong settings get a sentence."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.model.camera import Camera
from gaitwright.numerics.geometry import from_roll_pitch_yaw
from oracles import robot_called

DOG = robot_called("dog")
CAMERA = Camera.for_robot(DOG)


@given(st.floats(0.2, 2.5), st.floats(0.2, 2.5), st.integers(1, 9), st.integers(1, 9), st.floats(-1.5, 1.5))
def test_rays_are_a_pinholes(across, upright, rows, columns, tilt):
    camera = replace(CAMERA, across=across, upright=upright, rows=rows, columns=columns, tilt=tilt)
    np.testing.assert_allclose(np.linalg.norm(camera.rays, axis=1), 1.0)
    in_camera = (camera.rays @ camera.axes).reshape(rows, columns, 3)
    left, up = (in_camera[..., i] / in_camera[..., 0] for i in (1, 2))
    np.testing.assert_allclose(left, np.broadcast_to(left[:1], left.shape), atol=1e-12)
    np.testing.assert_allclose(left[0], -left[0, ::-1], atol=1e-12)
    np.testing.assert_allclose(up[:, 0], -up[::-1, 0], atol=1e-12)
    # Half a pixel beyond the outermost rays is the rim of the field of view.
    assert left[0, 0] == pytest.approx(math.tan(across / 2) * (1 - 1 / columns))
    assert up[0, 0] == pytest.approx(math.tan(upright / 2) * (1 - 1 / rows))


def test_it_looks_ahead_and_down_from_the_front_of_the_back():
    (x, y, z), (centre, half) = CAMERA.mount, DOG.trunk
    assert (x, y) == (centre[0] + half[0], 0.0) and z >= centre[2] + half[2]
    axis = CAMERA.axes @ [1.0, 0.0, 0.0]
    assert axis[0] > 0.7 and axis[2] == pytest.approx(-math.sin(CAMERA.tilt))
    lowest, highest = CAMERA.rays[-1], CAMERA.rays[0]
    assert lowest[2] < -0.5 and abs(highest[2]) < 0.1
    # The nearest ground in view lies before the feet make their next step.
    assert (z + DOG.height) / -lowest[2] * lowest[0] < DOG.height


def test_its_eye_moves_and_turns_with_the_base():
    turn = from_roll_pitch_yaw(np.array([0.1, -0.2, 1.0]))
    place = np.array([1.0, 2.0, 3.0])
    np.testing.assert_allclose(CAMERA.eye(place, turn), place + turn @ CAMERA.mount)


def test_it_is_as_big_as_its_robot():
    large = Camera.for_robot(robot_called("thesis"))
    assert large.range / robot_called("thesis").height == pytest.approx(CAMERA.range / DOG.height)
    assert (large.rows, large.columns, large.rate) == (48, 64, 10.0)


@pytest.mark.parametrize(
    "field, value, word",
    [
        ("range", 0.0, "range"),
        ("range", math.nan, "finite"),
        ("rate", -1.0, "rate"),
        ("noise", -0.1, "noise"),
        ("across", math.pi, "180"),
        ("upright", 0.0, "180"),
        ("rows", 0, "pixels"),
        ("columns", 10**7, "pixels"),
        ("dropouts", 1.5, "drop-outs"),
    ],
)
def test_wrong_settings_get_a_sentence(field, value, word):
    with pytest.raises(WrongUse, match=word):
        replace(CAMERA, **{field: value})
