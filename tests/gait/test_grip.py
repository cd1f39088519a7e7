"""Feet count on the ground's friction until they slip, then on less, and slowly on more again."""

import numpy as np
import pytest

from gaitwright.gait.grip import FALLS, LEAST, RISES, SETTLES, SLIPS, feel_grip
from gaitwright.gait.state import STANCE, SWING, GaitState, standing, state_of
from gaitwright.numerics.geometry import GRAVITY

HEIGHT, DT, KNOWN = 0.3, 0.002, 0.6
SLOW, FAST = (share * SLIPS * np.sqrt(GRAVITY * HEIGHT) for share in (0.9, 1.1))
FEET = np.array([[0.2, 0.1, 0.02], [0.2, -0.1, 0.02], [-0.2, 0.1, 0.02], [-0.2, -0.1, 0.02]])


def slid(state: GaitState, ticks: int, speed: float, felt: bool = True) -> np.ndarray:
    """What the feet count on after they slid along x for so many ticks."""
    for _ in range(ticks):
        feet = state.contact + np.array([speed * DT, 0.0, 0.0])
        feel_grip(state, np.full(4, felt), feet, KNOWN, HEIGHT, DT)
        state.contact[:] = feet
    return state.grip


@pytest.fixture
def state() -> GaitState:
    return state_of(standing(FEET, np.array([0.0, 0.0, HEIGHT]), 0.0, 0.0).row)


def test_before_anything_slips_it_is_what_is_known(state: GaitState) -> None:
    np.testing.assert_allclose(slid(state, 1, 0.0), KNOWN)
    np.testing.assert_allclose(slid(state, 50, SLOW), KNOWN)


def test_it_falls_while_a_foot_slips_and_comes_back_slowly(state: GaitState) -> None:
    fallen = slid(state, 50, FAST).copy()
    np.testing.assert_allclose(fallen, KNOWN * (1.0 - FALLS * 50 * DT))
    np.testing.assert_allclose(slid(state, 50, 0.0), fallen + KNOWN * RISES * 50 * DT)


def test_it_never_falls_to_nothing_nor_rises_beyond_what_is_known(state: GaitState) -> None:
    np.testing.assert_allclose(slid(state, 1000, FAST), LEAST)
    np.testing.assert_allclose(slid(state, 20_000, 0.0), KNOWN)


def test_each_foot_feels_for_itself_and_only_on_the_ground(state: GaitState) -> None:
    state.mode[:], state.age[:] = (STANCE, SWING, STANCE, STANCE), (1.0, 1.0, 0.5 * SETTLES, 1.0)
    state.unfelt[3] = DT
    grip = slid(state, 5, FAST)
    assert grip[0] < KNOWN and (grip[1:] == KNOWN).all()


def test_a_foot_without_load_tells_nothing(state: GaitState) -> None:
    np.testing.assert_allclose(slid(state, 50, FAST, felt=False), KNOWN)
