"""Smooth ground: through the control points, as other programs have the curves, without a crease."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BPoly, CubicHermiteSpline

from gaitwright.ground.splines import FINEST, bezier, cardinal, fineness, spline_field


@given(st.integers(2, 9), st.integers(1, 8), st.floats(0.0, 1.0), st.integers(0, 1000))
def test_a_cardinal_spline_is_a_hermite_spline_of_its_slopes(
    controls: int, fine: int, tension: float, seed: int
) -> None:
    points = np.random.default_rng(seed).normal(size=controls)
    longer = np.array([2 * points[0] - points[1], *points, 2 * points[-1] - points[-2]])
    slopes = (1.0 - tension) * (longer[2:] - longer[:-2]) / 2.0
    theirs = CubicHermiteSpline(np.arange(controls), points, slopes)
    t = np.arange((controls - 1) * fine + 1) / fine
    np.testing.assert_allclose(cardinal(controls, fine, tension) @ points, theirs(t), atol=1e-12)


@given(st.integers(1, 4), st.integers(1, 8), st.integers(0, 1000))
def test_bezier_curves_are_bernstein_polynomials(curves: int, fine: int, seed: int) -> None:
    points = np.random.default_rng(seed).normal(size=3 * curves + 1)
    pieces = np.array([points[3 * k : 3 * k + 4] for k in range(curves)]).T
    theirs = BPoly(pieces, np.arange(curves + 1))
    t = np.arange(3 * fine * curves + 1) / (3 * fine)
    np.testing.assert_allclose(bezier(len(points), fine) @ points, theirs(t), atol=1e-12)


@pytest.mark.parametrize("tension", [0.0, 0.5, 1.0])
def test_the_ground_goes_through_the_net(tension: float, rng: np.random.Generator) -> None:
    net = rng.normal(size=(5, 7))
    field = spline_field(-1.0, 2.0, 0.5, net, tension)
    x, y = -1.0 + 0.5 * np.arange(7), 2.0 + 0.5 * np.arange(5)
    np.testing.assert_allclose(field.height(x[None, :], y[:, None]), net, atol=1e-9)
    assert field.x_max == pytest.approx(x[-1]) and field.y_max == pytest.approx(y[-1])


@pytest.mark.parametrize("tension", [0.0, None])
def test_a_plane_of_control_points_is_a_plane(tension: float | None) -> None:
    x, y = np.arange(7), np.arange(4)
    field = spline_field(0.0, 0.0, 1.0, 0.3 * x[None, :] - 0.2 * y[:, None] + 1.0, tension)
    at_x, at_y = np.linspace(0, 6, 50)[None, :], np.linspace(0, 3, 30)[:, None]
    np.testing.assert_allclose(field.height(at_x, at_y), 0.3 * at_x - 0.2 * at_y + 1.0, atol=1e-9)


def test_full_tension_is_level_at_every_control_point(rng: np.random.Generator) -> None:
    field = spline_field(0.0, 0.0, 1.0, rng.normal(size=(4, 4)), 1.0)
    nodes = field.heights[:: fineness(1.0)]
    assert np.abs(nodes[:, 1] - nodes[:, 0]).max() < 0.05 * np.abs(np.diff(nodes, axis=1)).max()


@given(st.floats(0.001, 100.0))
def test_nodes_are_near_enough_and_not_too_many(spacing: float) -> None:
    fine = fineness(spacing)
    assert 1 <= fine <= FINEST
    assert spacing / fine <= 0.05 + 1e-9 or fine == FINEST
