"""A swinging foot clears the ground on its way, and an edge that it touches there is no ground."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gaitwright.gait.clearance import CLEAR, LOOKS, LOW, MOST_LIFT, is_on_ground, lift_needed
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import tabulated
from gaitwright.ground.elevation import BLIND, elevation_grid, height_at
from gaitwright.ground.scene import load_scene
from oracles import robot_called

DOG = robot_called("dog")
H = DOG.height
STAIRS = elevation_grid(load_scene("stairs:0.10"), DOG)


@pytest.mark.parametrize("cycle", ["trot", "climb"])
@given(x=st.floats(0.8, 4.6), way=st.floats(0.15, 0.35))
def test_a_raised_swing_clears_the_steps(cycle: str, x: float, way: float) -> None:
    ground, table, r = STAIRS, tabulated(load_cycle(cycle)), 0.02
    start = np.array([x, 0.0, height_at(ground, x, 0.0) + r])
    end = (x + way, 0.0, height_at(ground, x + way, 0.0) + r)
    lift = lift_needed(ground, start, *end, r, table, H)
    assert lift >= 1.0
    assume(lift < MOST_LIFT / table[:, 3].max() - 1e-9)
    for row in table[[(i * (len(table) - 1)) // LOOKS for i in range(1, LOOKS)]]:
        if row[3] > LOW * table[:, 3].max():
            at = start[0] + row[0] * way
            z = start[2] + row[0] * (end[2] - start[2]) + lift * row[3] * H
            assert z >= height_at(ground, at, 0.0) + r + CLEAR * H - 1e-2


def test_an_edge_on_the_way_is_no_ground() -> None:
    assert is_on_ground(STAIRS, np.array([5.2, 0.0, 0.02]), 0.02, H)
    assert not is_on_ground(STAIRS, np.array([5.2, 0.0, 0.10]), 0.02, H)
    assert is_on_ground(BLIND, np.array([5.2, 0.0, 9.0]), 0.02, H)
