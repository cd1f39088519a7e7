"""Between the cells of a skill its table is straight, along speed and along turn; beyond them it stays."""

from functools import cache
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import RegularGridInterpolator

from gaitwright.control.learned.cells import Cells, row_at
from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.signals import Gait

SPEEDS, TURNS = (0.0, 0.4, 1.0), (-0.8, 0.0, 0.6)
PLACES = tuple(product(SPEEDS, TURNS))
ROOM = (0.05, 0.1)
"""[m/s], [rad/s]"""
LEFT, BACK = (0.0, 1.0), (-1.0, 0.0)
SPEED, TURN, PHASE = st.floats(-0.5, 1.5), st.floats(-1.5, 1.5), st.floats(-1.0, 2.0)


@cache
def profile(speed: float, turn: float, way: tuple[float, float] = (1.0, 0.0), seed: int = 0) -> Profile:
    """A table by lot, at a speed along a way."""
    rng = np.random.default_rng([seed, *(round(100 * (part + 2)) for part in (speed, turn))])
    table = rng.normal(size=(BINS, ROW.size(4)))
    return Profile(
        Gait("trot", 0.4, 0.6, (0.0, 0.5, 0.5, 0.0)), (speed * way[0], speed * way[1], turn), table
    )


@cache
def grid(way: tuple[float, float] = (1.0, 0.0)) -> Cells:
    return Cells.of([profile(*place, way) for place in PLACES])


@cache
def without_a_corner() -> Cells:
    return Cells.of([profile(*place) for place in PLACES if place != (1.0, 0.6)])


def row(cells: Cells, command: tuple[float, float, float], phase: float) -> np.ndarray:
    out = np.empty(cells.tables.shape[3])
    row_at(cells.way, cells.speeds, cells.turns, cells.tables, np.array(command), phase, out)
    return out


@cache
def linear() -> RegularGridInterpolator:
    """The same by another library, over speed, turn and phase."""
    tables = np.array([[profile(speed, turn).table for turn in TURNS] for speed in SPEEDS])
    around = np.concatenate([tables, tables[:, :, :1]], axis=2)
    return RegularGridInterpolator((SPEEDS, TURNS, np.arange(BINS + 1) / BINS), around)


@given(SPEED, TURN, PHASE)
def test_between_four_cells_it_is_straight_both_ways_and_beyond_them_the_nearest(speed, turn, phase):
    held = np.clip(speed, SPEEDS[0], SPEEDS[-1]), np.clip(turn, TURNS[0], TURNS[-1])
    np.testing.assert_allclose(
        row(grid(), (speed, 0.0, turn), phase), linear()((*held, phase % 1.0)), atol=1e-9
    )


@given(SPEED, TURN, st.integers(0, BINS - 1), st.sampled_from([(1.0, 0.0), LEFT, BACK]))
def test_a_row_is_that_of_the_whole_table(speed, turn, k, way):
    command = (speed * way[0], speed * way[1], turn)
    np.testing.assert_allclose(row(grid(way), command, k / BINS), grid(way).at(command)[k], atol=1e-9)


@pytest.mark.parametrize("way", [(1.0, 0.0), LEFT, BACK])
def test_what_was_taught_at_a_velocity_is_there_whatever_its_way(way):
    np.testing.assert_allclose(grid(way).way, way)
    for place in PLACES:
        cell = profile(*place, way)
        np.testing.assert_array_equal(grid(way).at(cell.command), cell.table)


def test_of_two_at_one_velocity_the_later_one_counts():
    edited = profile(0.4, 0.0, seed=7)
    cells = Cells.of([*(profile(*place) for place in reversed(PLACES)), edited])
    np.testing.assert_array_equal(cells.at((0.4, 0.0, 0.0)), edited.table)
    np.testing.assert_array_equal(cells.at((1.0, 0.0, 0.0)), profile(1.0, 0.0).table)
    assert cells.speeds.tolist() == list(SPEEDS) and cells.turns.tolist() == list(TURNS)


def test_a_skill_of_one_velocity_is_one_cell():
    one = Cells.of([profile(0.0, 0.0)])
    assert one.tables.shape[:2] == (1, 1)
    np.testing.assert_array_equal(one.at((0.7, 0.1, -0.3)), profile(0.0, 0.0).table)
    assert one.covers(0.04, 0.0, -0.09, *ROOM) and not one.covers(0.06, 0.0, 0.0, *ROOM)


def test_a_gap_is_filled_by_the_nearest_and_not_covered():
    cells = without_a_corner()
    np.testing.assert_array_equal(cells.at((0.4, 0.0, 0.6)), profile(0.4, 0.6).table)
    gap = cells.at((1.0, 0.0, 0.6))
    assert any((gap == profile(*near).table).all() for near in ((0.4, 0.6), (1.0, 0.0)))
    assert not cells.covers(0.7, 0.0, 0.3, *ROOM) and not cells.covers(1.0, 0.0, 0.6, *ROOM)
    assert cells.covers(0.3, 0.0, 0.3, *ROOM) and cells.covers(0.7, 0.0, -0.3, *ROOM)


@given(st.floats(0.0, 1.0), st.floats(-0.8, 0.6), st.sampled_from([(1.0, 0.0), LEFT, BACK]))
def test_what_lies_among_the_cells_is_covered_and_what_lies_beside_the_way_is_not(speed, turn, way):
    cells, (x, y) = grid(way), way
    assert cells.covers(speed * x, speed * y, turn, *ROOM)
    for beside in (-0.06, 0.06):
        assert not cells.covers(speed * x - beside * y, speed * y + beside * x, turn, *ROOM)


@given(SPEED, TURN)
def test_no_more_than_the_room_beyond_the_ends_is_covered(speed, turn):
    is_near = -0.05 <= speed <= 1.05 and -0.9 <= turn <= 0.7
    assert grid().covers(speed, 0.0, turn, *ROOM) == is_near
