"""Least squares against scipy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import least_squares

from gaitwright.numerics.least_squares import fit

T = np.linspace(0.0, 3.0, 40)


@given(st.integers(0, 10_000), st.floats(0.0, 0.05))
def test_a_curve_is_fitted_as_scipy_does_it(seed, noise):
    rng = np.random.default_rng(seed)
    true = rng.uniform(0.5, 2.0, 3)
    y = true[0] * np.exp(-true[1] * T) + true[2] * T + noise * rng.standard_normal(T.size)

    def residuals(p):
        return p[0] * np.exp(-p[1] * T) + p[2] * T - y

    ours, theirs = fit(residuals, np.ones(3), np.ones(3)), least_squares(residuals, np.ones(3))
    np.testing.assert_allclose(ours.numbers, theirs.x, atol=2e-3)
    assert ours.rms**2 <= 2.0 * theirs.cost / T.size + 1e-8
    covariance = np.linalg.inv(theirs.jac.T @ theirs.jac) * 2.0 * theirs.cost / (T.size - 3)
    np.testing.assert_allclose(ours.spread, np.sqrt(np.diag(covariance)), rtol=0.05, atol=1e-5)


def test_what_the_data_do_not_fix_has_no_bound():
    found = fit(lambda p: p[0] - T, np.array([0.0, 7.0]), np.ones(2))
    assert found.numbers[0] == pytest.approx(1.5, abs=1e-4) and found.numbers[1] == 7.0
    assert np.isfinite(found.spread[0]) and found.spread[1] == np.inf


def test_the_scale_of_numbers_does_not_matter():
    y = 3e-4 * T + 2e5
    found = fit(lambda p: p[0] * T * 1e5 + p[1] - y * 1e5, np.array([0.0, 1e10]), np.array([1e-4, 1e6]))
    assert found.numbers[0] == pytest.approx(3e-4, rel=1e-3)
