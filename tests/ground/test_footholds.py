"""Footholds: always fit, never farther than need be, and the last one before what is too much is found."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gaitwright.ground.elevation import elevation_grid, height_at, nearest
from gaitwright.ground.footholds import (
    OFF_PLANE,
    RIM,
    SEARCHED,
    FootholdRequest,
    choose_foothold,
    is_fit,
    last_foothold,
)
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.signals import ElevationGrid
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
    level = float(height_at(GROUNDS[name], *before))
    return FootholdRequest(x, y, *before, level, OFF_PLANE * DOG.step_limit, lean, H)


@given(names, places, st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)))
@settings(max_examples=200)
def test_a_chosen_foothold_is_fit_and_near(name: str, place, off) -> None:
    asked = wish(name, *place, tuple(np.add(place, off).tolist()), lean=(-1.0, 0.0))
    found, x, y = choose_foothold(GROUNDS[name], asked)
    if found:
        assert is_fit(GROUNDS[name], *nearest(GROUNDS[name], x, y), asked, 1.0)
        assert math.dist((x, y), place) <= SEARCHED * H + 0.03
    else:
        assert (x, y) == place


@given(names, places)
def test_what_is_fit_already_is_left(name: str, place) -> None:
    asked = wish(name, *place, place)
    assume(is_fit(GROUNDS[name], *nearest(GROUNDS[name], *place), asked, RIM))
    assert choose_foothold(GROUNDS[name], asked) == (True, *place)


@pytest.mark.parametrize(("swung", "goes_over"), [(0.0, True), (0.5, False), (0.9, False)])
def test_far_into_its_swing_a_foot_keeps_to_its_side_of_a_gap(swung: float, goes_over: bool) -> None:
    """A gap from 0.01 to 0.19 m. The foot was to land before it, and the wish has gone past its middle."""
    edges = np.zeros((50, 50))
    edges[:, 26:35] = 1.0
    ground = ElevationGrid(np.array([-0.5, -0.5, 0.02]), np.zeros((50, 50)), edges)
    asked = FootholdRequest(0.16, 0.0, 0.0, 0.0, 0.0, 0.1, (0.0, 0.0), H, swung)
    found, x, _ = choose_foothold(ground, asked)
    assert found and x == pytest.approx(0.2 if goes_over else 0.0)


def test_in_the_middle_of_a_hole_a_foot_takes_the_rim_since_it_finds_nothing_better() -> None:
    """A hole of 0.3 m, with rims beside it as wide as they are around what is hidden."""
    edges = np.zeros((60, 60))
    edges[:, 20:40] = RIM
    edges[:, 23:38] = 1.0
    ground = ElevationGrid(np.array([-0.6, -0.6, 0.02]), np.zeros((60, 60)), edges)
    asked = FootholdRequest(0.0, 0.0, -0.1, 0.0, 0.0, 0.1, (0.0, 0.0), H)
    found, x, _ = choose_foothold(ground, asked)
    assert found and x == pytest.approx(-0.16)


def test_on_a_rim_stands_nobody_who_has_a_choice_but_it_stops_nobody() -> None:
    """Even ground, all of which lies beside what is hidden but for what is beyond 0.1 m."""
    spacing, n = 0.02, 200
    rims = np.full((n, n), RIM)
    rims[:, : n // 2] = 0.0
    ground = ElevationGrid(np.array([-2.0, -2.0, spacing]), np.zeros((n, n)), rims)
    asked = FootholdRequest(0.04, 0.0, 0.04, 0.0, 0.0, 0.1, (0.0, 0.0), H)
    found, x, _ = choose_foothold(ground, asked)
    assert found and x < 0.0
    assert not last_foothold(ground, (-0.5, 0.0), 0.0, 0.0, 1.5, 0.05, 0.1, 0.3, H)[0]
    broken = ground._replace(edges=np.where(rims > 0.0, 1.0, 0.0))
    assert last_foothold(broken, (-0.5, 0.0), 0.0, 0.0, 1.5, 0.05, 0.1, 0.3, H)[0]


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
                assert not is_fit(ground, row, column, asked, RIM)


def test_the_shank_needs_room_behind_a_step_down() -> None:
    """Just below a step a foot could stand, but its shank, which leans back, would be in the step."""
    ground = GROUNDS["stairs:0.10"]
    below = wish("stairs:0.10", 5.16, 0.0, (5.16, 0.0))
    assert choose_foothold(ground, below) == (True, 5.16, 0.0)
    found, x, _ = choose_foothold(ground, below._replace(lean=(-1.0, 0.0)))
    assert found and 5.19 < x < 5.3


@given(st.floats(0.3, 0.6), st.floats(-0.5, 0.5), st.floats(0.0, 3.0))
def test_a_track_ends_before_a_step_that_is_too_high(share: float, off: float, way: float) -> None:
    """A wide block ahead stops a track exactly where it is higher than a step, and not far from its rim."""
    rise, step, stride = share * H, 0.45 * H, 1.1 * H
    assume(abs(rise - step) > 1e-6)
    c, s = math.cos(way), math.sin(way)
    block = Box(2.0 * c, 2.0 * s, way, 2.0, 3.0, rise)
    ground = elevation_grid(Scene("block", Flat(), (block,), (-4.0, -4.0, 4.0, 4.0)), DOG)
    start = np.array([0.0, 0.0]) + off * np.array([-s, c])
    stops, last, up, _ = last_foothold(ground, start, 0.0, way, 1.8, 0.15 * H, step, stride, H)
    if rise > OFF_PLANE * step:
        assert stops and 1.0 - 4.0 * ground.place[2] - 0.15 * H < last < 1.0
    assert stops == (rise > step)
    assert up == pytest.approx(rise if stops else 0.0)


def test_a_track_goes_over_a_gap_as_wide_as_a_stride_and_no_wider() -> None:
    ground = elevation_grid(load_scene("gap:0.2"), DOG)
    level = float(height_at(ground, 0.0, 0.0))
    narrow, wide = (
        last_foothold(ground, np.zeros(2), level, 0.0, 3.0, 0.15 * H, DOG.step_limit, stride, H)
        for stride in (1.1 * H, 0.4 * H)
    )
    assert not narrow[0] and wide[0] and wide[2] < -0.2
