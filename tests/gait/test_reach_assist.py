"""A stretched leg is helped: the body comes nearer to its foot, and not too near to the others."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.reach_assist import FOLDED, MOST_ASIDE, MOST_DOWN, STRETCHED, reach_assist, stretched
from gaitwright.gait.state import standing
from oracles import robot_called

DOG = robot_called("dog")
LEVEL = np.eye(3)
H = DOG.height
offsets = st.lists(st.floats(-0.15, 0.15), min_size=12, max_size=12)


def shift_for(off: np.ndarray, duty: float = 0.75) -> tuple[np.ndarray, np.ndarray]:
    """The shift for feet so far off their nominal stance, and the feet, seen from the base."""
    feet = DOG.nominal_feet + off
    state = standing(feet, np.zeros(3), 0.0, 0.0).state
    return np.array(reach_assist(DOG.arrays, state, LEVEL, (0.0, 0.0, 0.0), feet, duty, H)), feet


def lengths(feet: np.ndarray, shift: np.ndarray) -> np.ndarray:
    return np.linalg.norm(feet - shift - DOG.hip, axis=1)


def test_in_the_nominal_stance_there_is_nothing_to_help() -> None:
    shift, _ = shift_for(np.zeros((4, 3)))
    assert not shift.any()


@given(offsets)
def test_help_shortens_the_longest_leg_and_folds_no_other(numbers: list[float]) -> None:
    shift, feet = shift_for(np.reshape(numbers, (4, 3)))
    whole = np.array([stretched(DOG.arrays, leg) for leg in range(4)])
    before, after = lengths(feet, np.zeros(3)) / whole, lengths(feet, shift) / whole
    assert (before > STRETCHED).any() or not shift.any()
    assert after.max() < before.max() or not shift.any()
    assert -MOST_DOWN * H - 1e-12 <= shift[2] <= 0.0
    assert np.hypot(*shift[:2]) <= MOST_ASIDE * H + 1e-12
    assert (after >= np.minimum(before, FOLDED) - 0.02).all()


def test_a_leg_that_reaches_down_brings_the_body_down() -> None:
    off = np.zeros((4, 3))
    off[0, 2] = -0.14
    shift, feet = shift_for(off)
    assert shift[2] < 0.0
    assert lengths(feet, shift)[0] < lengths(feet, np.zeros(3))[0]


def test_a_gait_on_two_feet_is_helped_downwards_only() -> None:
    off = np.zeros((4, 3))
    off[0] = (0.25, 0.0, -0.1)
    aside, down = shift_for(off)[0], shift_for(off, duty=0.5)[0]
    assert aside[0] > 0.0 and down[0] == 0.0 and down[2] < 0.0
