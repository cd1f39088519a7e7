"""The plane under the feet: least squares where the feet span it, the past where they do not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.contact_plane import (
    LINE,
    STEEPEST,
    WIDE,
    Plane,
    advance_ground,
    fit_plane,
    plane_height,
    plane_normal,
)

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


def past(slope) -> Plane:
    """A plane so far with these slopes, somewhere."""
    return Plane(float(slope[0]), float(slope[1]), 0.7, -0.3, float(slope[2]))


def normal_of(plane) -> np.ndarray:
    """Upward unit normal of a plane."""
    normal = np.array([-plane[0], -plane[1], 1.0])
    return normal / np.linalg.norm(normal)


@given(seeds, slopes, st.sampled_from([3, 4, 6]))
def test_the_fit_is_plain_least_squares(seed: int, before, count: int) -> None:
    """numpy's lstsq, whatever was before; three feet lie in the plane."""
    points = feet(np.random.default_rng(seed), count)
    plane, determined = fit_plane(points, past(before))
    design = np.column_stack([np.ones(count), points[:, :2]])
    best = np.linalg.lstsq(design, points[:, 2], rcond=None)[0]
    np.testing.assert_allclose(plane[:2], best[1:], atol=1e-12)
    np.testing.assert_allclose(plane.z, best @ [1.0, plane.x, plane.y], atol=1e-13)
    assert determined == 1.0
    if count == 3:
        off = points[:, 2] - plane.z - (points[:, :2] - [plane.x, plane.y]) @ plane[:2]
        np.testing.assert_allclose(off, 0.0, atol=1e-13)


@given(seeds, slopes, slopes)
def test_feet_in_a_plane_find_it_whatever_was_before(seed: int, truth, before) -> None:
    points = on_plane(feet(np.random.default_rng(seed)), truth)
    np.testing.assert_allclose(fit_plane(points, past(before))[0][:2], truth[:2], atol=1e-12)


@given(st.floats(-3.0, 3.0), slopes, st.floats(-0.3, 0.3), st.sampled_from([2, 3, 4]))
def test_feet_on_a_line_take_the_nearest_normal(direction: float, before, climb: float, count: int) -> None:
    """N = N_before − (N_before·u) u (equations.md §2): it holds the line, no plane through it is nearer."""
    u = np.array([np.cos(direction), np.sin(direction), climb])
    middle = np.array([0.3, -0.2, 0.1])
    points = middle + np.linspace(-0.3, 0.3, count)[:, None] * u
    u /= np.linalg.norm(u)
    was = normal_of(before)
    plane, determined = fit_plane(points, past(before))
    expected = was - (was @ u) * u
    np.testing.assert_allclose(normal_of(plane), expected / np.linalg.norm(expected), atol=1e-12)
    np.testing.assert_allclose(plane[2:], middle, atol=1e-15)
    assert determined == 0.0
    for turn in (-0.01, 0.01):
        tilted = normal_of(plane) + turn * np.cross(u, normal_of(plane))
        assert was @ normal_of(plane) > was @ tilted / np.linalg.norm(tilted)


@given(seeds, slopes)
def test_one_foot_keeps_the_slope_and_no_foot_keeps_the_plane(seed: int, before) -> None:
    place = np.random.default_rng(seed).normal(size=3)
    for count in (1, 4):
        plane, determined = fit_plane(np.tile(place, (count, 1)), past(before))
        np.testing.assert_allclose(plane, (*before[:2], *place), rtol=0, atol=1e-15)
        assert determined == 0.0
    assert fit_plane(np.empty((0, 3)), past(before)) == (past(before), 0.0)


@given(seeds, slopes, st.floats(0.0, 0.15), st.floats(-3.0, 3.0))
def test_narrow_feet_pass_from_the_past_to_least_squares_without_a_leap(seed, before, width, turn) -> None:
    """Errors of height never count for much more than tenfold, and a little more width changes little."""
    rng = np.random.default_rng(seed)
    c, s = np.cos(turn), np.sin(turn)

    def narrow(share: float, error: np.ndarray) -> np.ndarray:
        points = np.array([[1.0, share], [-1.0, share], [1.0, -share], [-1.0, -share]]) @ [[c, s], [-s, c]]
        return np.column_stack([points, error])

    error = rng.uniform(-1.0, 1.0, 4)
    error *= 0.01 / np.linalg.norm(error)
    quiet, trust = fit_plane(narrow(width, np.zeros(4)), past((0.0, 0.0, 0.0)))
    loud, _ = fit_plane(narrow(width, error), past((0.0, 0.0, 0.0)))
    assert trust == pytest.approx(np.clip((width - LINE) / (WIDE - LINE), 0.0, 1.0), abs=1e-9)
    assert np.hypot(*np.subtract(loud[:2], quiet[:2])) <= 0.01 * 0.5 * np.hypot(1.0, 1.0 / WIDE) + 1e-12
    more, _ = fit_plane(narrow(width + 1e-7, error), past(before))
    here, _ = fit_plane(narrow(width, error), past(before))
    np.testing.assert_allclose(more[:2], here[:2], atol=1e-5)


@given(seeds, slopes, st.floats(-3.0, 3.0))
def test_the_fit_turns_with_the_world(seed: int, before, turn: float) -> None:
    points = feet(np.random.default_rng(seed), 4) * [1.0, 0.2, 1.0]
    c, s = np.cos(turn), np.sin(turn)
    omega = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    plane, trust = fit_plane(points, past(before))
    turned, turned_trust = fit_plane(points @ omega.T, past([*(omega[:2, :2] @ before[:2]), before[2]]))
    assert turned_trust == pytest.approx(trust, abs=1e-9)
    np.testing.assert_allclose(turned[:2], omega[:2, :2] @ plane[:2], atol=1e-9)


def test_walls_are_not_believed() -> None:
    points = on_plane(feet(np.random.default_rng(0)), np.array([5.0, -7.0, 0.0]))
    plane, _ = fit_plane(points, past(np.zeros(3)))
    np.testing.assert_allclose(plane[:2], STEEPEST * np.array([5.0, -7.0]) / np.hypot(5.0, 7.0), atol=1e-9)
    line = np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.4]])
    against, _ = fit_plane(line, past((-1.0, 0.3, 0.0)))
    assert np.isfinite(against).all() and np.hypot(*against[:2]) <= STEEPEST


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
    plane, _ = fit_plane(points, past(before))
    np.testing.assert_allclose(memory[:2], before[:2] + 0.01 * (plane[:2] - before[:2]), atol=1e-12)


@given(slopes, st.floats(-2, 2), st.floats(-2, 2))
def test_the_normal_is_square_to_the_plane(slope, x: float, y: float) -> None:
    normal, place = np.array(plane_normal(slope)), np.array([0.3, -0.4, 9.9])
    assert np.linalg.norm(normal) == pytest.approx(1.0) and normal[2] > 0.0
    here = np.array([x, y, plane_height(slope, place, x, y)])
    assert normal @ (here - (*place[:2], slope[2])) == pytest.approx(0.0, abs=1e-12)
