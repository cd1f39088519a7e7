"""The active-set method proves itself: stationary, feasible, priced, and quadprog's minimum."""

import numpy as np
import pytest
import quadprog
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.numerics.quadratic_program import minimise
from gaitwright.numerics.status import INFEASIBLE, NOT_FINITE, SOLVED

seeds = st.integers(0, 2**32 - 1)


def program(seed: int, twins: bool = False, room: float = 0.0) -> tuple[np.ndarray, ...]:
    """A feasible program of 1 … 24 unknowns, some limits tight, some with equal bounds, some twice.

    `room`: what every bound leaves at least.
    """
    rng = np.random.default_rng(seed)
    n, m = int(rng.integers(1, 25)), int(rng.integers(3, 50))
    half = rng.normal(size=(6, n))
    hessian = half.T @ half + 1e-3 * np.eye(n)
    rows = rng.normal(size=(m, n))
    if twins:
        rows[1], rows[2] = rows[0], -rows[0]
    inside = 0.3 * rng.normal(size=n)
    values = np.concatenate([inside, rows @ inside])
    lower = values - rng.uniform(0.0, 0.3, n + m) * (rng.random(n + m) < 0.7) - room
    upper = values + rng.uniform(0.0, 0.3, n + m) * (rng.random(n + m) < 0.9) + room
    return hessian, rng.normal(size=n), rows, lower, upper


def certificate(hessian, gradient, rows, lower, upper, x, prices) -> tuple[float, float, float]:
    """Largest violation, defect of the gradient, and price paid for a limit that is not touched."""
    values = np.concatenate([x, rows @ x])
    normals = np.vstack([np.eye(len(x)), rows])
    violation = max((lower - values).max(), (values - upper).max())
    defect = np.abs(hessian @ x + gradient - normals.T @ prices).max()
    idle = np.maximum(prices, 0.0) * (values - lower) + np.maximum(-prices, 0.0) * (upper - values)
    return violation, defect, np.abs(idle).max()


@given(seeds, st.booleans())
@settings(max_examples=300)
def test_the_answer_proves_itself(seed: int, twins: bool) -> None:
    task = program(seed, twins)
    x, prices, code, culprit = minimise(*task)
    assert (code, culprit) == (SOLVED, -1)
    violation, defect, idle = certificate(*task, x, prices)
    size = 1.0 + np.abs(prices).max()
    assert violation < 1e-8 and defect < 1e-6 * size and idle < 1e-6 * size


@given(seeds)
@settings(max_examples=200)
def test_the_minimum_is_quadprogs(seed: int) -> None:
    # quadprog finds no room at all between equal bounds: it is given some.
    hessian, gradient, rows, lower, upper = program(seed, room=1e-3)
    x, _, _, _ = minimise(hessian, gradient, rows, lower, upper)
    normals = np.vstack([np.eye(len(x)), rows])
    least = np.concatenate([lower, -upper])
    theirs = quadprog.solve_qp(hessian, -gradient, np.vstack([normals, -normals]).T, least)[0]
    np.testing.assert_allclose(x, theirs, rtol=0, atol=1e-7)


@given(seeds)
def test_limits_that_exclude_each_other_name_a_culprit(seed: int) -> None:
    """All others leave room enough: the culprit is one of the two, and without it there is an answer."""
    hessian, gradient, rows, lower, upper = program(seed, room=1e3)
    first, second = len(gradient), len(gradient) + 1
    rows[1], upper[first] = rows[0], 0.5
    lower[second], upper[second] = 0.6, 1.6
    _, _, code, culprit = minimise(hessian, gradient, rows, lower, upper)
    assert code == INFEASIBLE and culprit in (first, second)
    lower[culprit], upper[culprit] = -1e3, 1e3
    assert minimise(hessian, gradient, rows, lower, upper)[2] == SOLVED


def test_a_price_tells_what_a_limit_costs() -> None:
    """½ (x − 2)² with x ≤ 1: giving way by a hair is worth one hair."""
    one = np.array([[1.0]])
    x, prices, _, _ = minimise(one, np.array([-2.0]), np.zeros((0, 1)), np.array([-9.0]), np.array([1.0]))
    assert x[0] == pytest.approx(1.0) and prices[0] == pytest.approx(-1.0)


def test_without_unknowns_there_is_nothing_to_solve() -> None:
    empty = np.zeros(0)
    x, prices, code, _ = minimise(np.zeros((0, 0)), empty, np.zeros((0, 0)), empty, empty)
    assert x.size == prices.size == 0 and code == SOLVED


def test_a_number_that_is_none_is_told() -> None:
    hessian, gradient, rows, lower, upper = program(3)
    gradient[0] = np.nan
    assert minimise(hessian, gradient, rows, lower, upper)[2] == NOT_FINITE
