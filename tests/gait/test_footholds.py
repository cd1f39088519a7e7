"""Footholds: always fit, never farther than need be, and reached without touching the ground on the way."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gaitwright.gait.footholds import (
    CLEAR,
    LOOKS,
    LOW,
    MOST_LIFT,
    SEARCHED,
    FootholdRequest,
    choose_foothold,
    is_fit,
    is_on_ground,
    lift_needed,
)
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import tabulated
from gaitwright.ground.elevation import BLIND, elevation_grid, height_at, nearest
from gaitwright.ground.scene import load_scene
from oracles import robot_called

DOG = robot_called("dog")
H = DOG.height
GROUNDS = {
    name: elevation_grid(load_scene(name, seed=2), DOG)
    for name in ("stairs:0.10", "gap:0.2", "rough:0.05", "blocks")
}
names = st.sampled_from(sorted(GROUNDS))
places = st.tuples(st.floats(-1.0, 6.0), st.floats(-1.0, 1.0))


def wish(name: str, x: float, y: float, before: tuple[float, float], lean=(0.0, 0.0)) -> FootholdRequest:
    return FootholdRequest(x, y, *before, float(height_at(GROUNDS[name], *before)), lean, H)


@given(names, places, st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)))
@settings(max_examples=200)
def test_a_chosen_foothold_is_fit_and_near(name: str, place, off) -> None:
    asked = wish(name, *place, tuple(np.add(place, off).tolist()), lean=(-1.0, 0.0))
    found, x, y = choose_foothold(GROUNDS[name], asked)
    if found:
        assert is_fit(GROUNDS[name], *nearest(GROUNDS[name], x, y), asked)
        assert math.dist((x, y), place) <= SEARCHED * H + 0.03
    else:
        assert (x, y) == place


@given(names, places)
def test_what_is_fit_already_is_left(name: str, place) -> None:
    asked = wish(name, *place, place)
    assume(is_fit(GROUNDS[name], *nearest(GROUNDS[name], *place), asked))
    assert choose_foothold(GROUNDS[name], asked) == (True, *place)


def moved(rng: np.random.Generator) -> tuple[str, FootholdRequest, tuple[float, float]]:
    """A ground, a wish for a place of it where no foot can stand, and the foothold that it gets."""
    for _ in range(1000):
        name, place = str(rng.choice(sorted(GROUNDS))), (float(rng.uniform(-1, 6)), float(rng.uniform(-1, 1)))
        asked = wish(name, *place, place)
        found, x, y = choose_foothold(GROUNDS[name], asked)
        if found and (x, y) != place:
            return name, asked, (x, y)
    raise AssertionError("no foothold is ever moved")


@pytest.mark.parametrize("seed", range(20))
def test_nothing_nearer_would_have_done(seed: int) -> None:
    name, asked, (x, y) = moved(np.random.default_rng(seed))
    ground, place = GROUNDS[name], (asked.x, asked.y)
    spacing, rows = ground.place[2], ground.heights.shape[0]
    for row in range(rows):
        at_y = ground.place[1] + row * spacing
        for column in range(ground.heights.shape[1]):
            at = (ground.place[0] + column * spacing, at_y)
            if abs(at_y - place[1]) < 0.2 and math.dist(at, place) < math.dist((x, y), place) - 1e-9:
                assert not is_fit(ground, row, column, asked)


def test_the_shank_needs_room_behind_a_step_down() -> None:
    """Just below a step a foot could stand, but its shank, which leans back, would be in the step."""
    ground = GROUNDS["stairs:0.10"]
    below = wish("stairs:0.10", 5.16, 0.0, (5.16, 0.0))
    assert choose_foothold(ground, below) == (True, 5.16, 0.0)
    found, x, _ = choose_foothold(ground, below._replace(lean=(-1.0, 0.0)))
    assert found and 5.19 < x < 5.3


@pytest.mark.parametrize("cycle", ["trot", "climb"])
@given(x=st.floats(0.8, 4.6), way=st.floats(0.15, 0.35))
def test_a_raised_swing_clears_the_steps(cycle: str, x: float, way: float) -> None:
    ground, table, r = GROUNDS["stairs:0.10"], tabulated(load_cycle(cycle)), 0.02
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
    ground = GROUNDS["stairs:0.10"]
    assert is_on_ground(ground, np.array([5.2, 0.0, 0.02]), 0.02, H)
    assert not is_on_ground(ground, np.array([5.2, 0.0, 0.10]), 0.02, H)
    assert is_on_ground(BLIND, np.array([5.2, 0.0, 9.0]), 0.02, H)
