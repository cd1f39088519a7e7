"""The plane under the feet: least squares where the feet span it, the past where they do not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.ground import STEEPEST, advance_ground, fit_plane, plane_height, plane_normal

seeds = st.integers(0, 2**32 - 1)
slopes = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-1.0, 1.0)).map(np.array)


def feet(rng: np.random.Generator, count: int = 4) -> np.ndarray:
    """Feet about where those of a robot stand, on ground of no particular form."""
    spread = np.array([[0.2, 0.15], [0.2, -0.15], [-0.2, 0.15], [-0.2, -0.15], [0.0, 0.2], [0.0, -0.2]])[
        :count
    ]
    return np.column_stack([spread + rng.uniform(-0.05, 0.05, (count, 2)), rng.uniform(-0.03, 0.03, count)])


def on_plane(points: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """The same feet, put on a plane through the height `slope[2]` at the origin."""
    return np.column_stack([points[:, :2], slope[2] + points[:, :2] @ slope[:2]])


@given(seeds, slopes, st.sampled_from([4, 6]))
def test_the_fit_is_least_squares_with_a_weak_pull_to_the_past(seed: int, before, count: int) -> None:
    """numpy's lstsq, with two more rows that ask for the slope before."""
    points = feet(np.random.default_rng(seed), count)
    a, b, *middle = fit_plane(points, before)
    centred = points - points.mean(axis=0)
    pull = np.sqrt(1e-3 * (centred[:, :2] ** 2).sum() + 1e-12)
    rows = np.vstack([centred[:, :2], pull * np.eye(2)])
    best = np.linalg.lstsq(rows, np.concatenate([centred[:, 2], pull * before[:2]]), rcond=None)[0]
    np.testing.assert_allclose((a, b), best, atol=1e-12)
    np.testing.assert_allclose(middle, points.mean(axis=0), atol=1e-15)


@given(seeds, slopes)
def test_without_a_past_it_is_nearly_plain_least_squares(seed: int, truth) -> None:
    points = on_plane(feet(np.random.default_rng(seed)), truth)
    a, b, *_ = fit_plane(points, np.zeros(3))
    np.testing.assert_allclose((a, b), truth[:2], atol=0.005 * (0.1 + np.abs(truth[:2]).max()))


@given(seeds, slopes)
def test_a_plane_once_found_is_kept_exactly(seed: int, truth) -> None:
    points = on_plane(feet(np.random.default_rng(seed)), truth)
    np.testing.assert_allclose(fit_plane(points, truth)[:2], truth[:2], atol=1e-12)


@given(st.floats(-3.0, 3.0), slopes, st.floats(-0.3, 0.3))
def test_feet_on_a_line_tell_nothing_across_it(direction: float, before, climb: float) -> None:
    along, across = (
        np.array([np.cos(direction), np.sin(direction)]),
        np.array([-np.sin(direction), np.cos(direction)]),
    )
    r = np.array([-0.3, -0.1, 0.1, 0.3])
    points = np.column_stack([r[:, None] * along, climb * r])
    found = np.array(fit_plane(points, before)[:2])
    assert found @ across == pytest.approx(before[:2] @ across, abs=1e-9)
    assert found @ along == pytest.approx(climb, abs=2e-3)


@given(seeds)
def test_all_feet_in_one_place_keep_the_past(seed: int) -> None:
    rng = np.random.default_rng(seed)
    before = rng.uniform(-0.5, 0.5, 3)
    np.testing.assert_allclose(
        fit_plane(np.tile(rng.normal(size=3), (4, 1)), before)[:2], before[:2], atol=1e-3
    )


def test_walls_are_not_believed() -> None:
    points = on_plane(feet(np.random.default_rng(0)), np.array([5.0, -7.0, 0.0]))
    assert fit_plane(points, np.zeros(3))[:2] == (STEEPEST, -STEEPEST)


@given(slopes, slopes, st.floats(0.02, 0.5))
def test_the_memory_settles_on_the_plane(truth, before, lag: float) -> None:
    points, place = on_plane(feet(np.random.default_rng(1)), truth), np.array([0.05, -0.02, 0.3])
    memory = before.copy()
    for _ in range(2000):
        advance_ground(memory, points, place, np.zeros(3), lag, lag / 50)
    np.testing.assert_allclose(memory[:2], truth[:2], atol=1e-6)
    assert memory[2] == pytest.approx(truth[2] + truth[:2] @ place[:2], abs=1e-6)


@given(slopes, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_on_a_known_slope_the_height_follows_the_body_without_lag(truth, vx: float, vy: float) -> None:
    points, dt = on_plane(feet(np.random.default_rng(2)), truth), 0.002
    velocity, place = np.array([vx, vy, 0.0]), np.zeros(3)
    memory = truth.copy()
    for _ in range(100):
        place = place + dt * velocity
        advance_ground(memory, points, place, velocity, 0.2, dt)
        assert memory[2] == pytest.approx(truth[2] + truth[:2] @ place[:2], abs=1e-12)


@given(slopes, slopes)
def test_each_tick_goes_part_of_the_way(truth, before) -> None:
    points = on_plane(feet(np.random.default_rng(3)), truth)
    memory = before.copy()
    advance_ground(memory, points, np.zeros(3), np.zeros(3), 0.2, 0.002)
    a, b, *_ = fit_plane(points, before)
    np.testing.assert_allclose(memory[:2], before[:2] + 0.01 * (np.array([a, b]) - before[:2]), atol=1e-12)


@given(slopes, st.floats(-2, 2), st.floats(-2, 2))
def test_the_normal_is_square_to_the_plane(slope, x: float, y: float) -> None:
    normal, place = np.array(plane_normal(slope)), np.array([0.3, -0.4, 9.9])
    assert np.linalg.norm(normal) == pytest.approx(1.0) and normal[2] > 0.0
    here = np.array([x, y, plane_height(slope, place, x, y)])
    assert normal @ (here - (*place[:2], slope[2])) == pytest.approx(0.0, abs=1e-12)
