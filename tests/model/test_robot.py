"""A robot's numbers are the same however they travel."""

import numpy as np
import pytest

from gaitwright.model.robot import unpacked
from gaitwright.numerics.geometry import GRAVITY
from oracles import robot_called

NAMES = pytest.mark.parametrize("name", ["dog", "insect", "go2", "thesis", "hexapod"])


@NAMES
def test_packed_and_unpacked_it_is_the_same_robot(name: str) -> None:
    robot = robot_called(name)
    for field, value in unpacked(robot.packed)._asdict().items():
        np.testing.assert_array_equal(value, getattr(robot.arrays, field), err_msg=field)
        np.testing.assert_array_equal(np.squeeze(value), getattr(robot, field), err_msg=field)


@NAMES
def test_derived_lengths_follow_from_the_stance(name: str) -> None:
    robot = robot_called(name)
    assert robot.n == len(robot.legs) == len(robot.nominal_feet)
    assert robot.height == pytest.approx(robot.foot_radius.mean() - robot.nominal_feet[:, 2].mean())
    assert robot.natural_frequency == pytest.approx(np.sqrt(GRAVITY / robot.height))
    assert robot.total_mass == pytest.approx(robot.base_mass + robot.mass.sum())
    assert robot.body_length > 0.0 and robot.height < 1.2 * robot.leg_length
