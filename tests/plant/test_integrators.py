"""Integrators against laws of mechanics, their orders of convergence, and equations.md §3."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.dynamics.tree import Tree, ball_tree
from gaitwright.errors import WrongUse
from gaitwright.plant.armstrong.drift import (
    any_free_state,
    free_motion_drift,
    integrated,
    laws_of,
    refresh_error,
)
from gaitwright.plant.armstrong.integrators import METHODS, advance, method_named
from gaitwright.plant.armstrong.system import at_rest, floating, parts
from gaitwright.plant.names import INTEGRATORS
from oracles import robot_called


@pytest.fixture(scope="module")
def nine_links() -> Tree:
    """The thesis's robot as ball joints."""
    return ball_tree(robot_called("thesis"))[0]


def test_every_integrator_that_is_offered_exists() -> None:
    assert list(METHODS) == list(INTEGRATORS)
    with pytest.raises(WrongUse, match="no integrator 'rk5'; there is: euler, semi-implicit, rk4, adaptive"):
        method_named("rk5")


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_the_tables_fulfil_the_order_conditions(method) -> None:
    """Σ b cⁿ⁻¹ = 1/n for quadrature up to the order; Σ b A c = 1/6 for order 3."""
    nodes = method.stages.sum(axis=1)
    for n in range(1, method.order + 1):
        assert method.weights @ nodes ** (n - 1) == pytest.approx(1 / n, abs=1e-15)
    if method.order >= 3:
        assert method.weights @ method.stages @ nodes == pytest.approx(1 / 6, abs=1e-15)
    assert method.error.sum() == pytest.approx(0.0, abs=1e-15), "both orders agree where nothing changes"


@pytest.mark.parametrize(("integrator", "order"), [("euler", 1), ("semi-implicit", 1), ("rk4", 4)])
@settings(max_examples=2)
@given(seed=st.integers(0, 10**6))
def test_halving_the_step_divides_the_error_by_two_to_the_order(
    nine_links: Tree, integrator: str, order: int, seed: int
) -> None:
    """Over a few motions: in a single one, terms of two orders may cancel."""
    system = floating(nine_links)
    errors = np.zeros(2)
    for start in (any_free_state(system, seed + k) for k in range(4)):
        exact = integrated(system, start, "rk4", 0.0005, 0.2)
        errors += [
            np.abs(integrated(system, start, integrator, dt, 0.2) - exact).max() for dt in (0.02, 0.01)
        ]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.5)


# --- free motion ---------------------------------------------------------------------------------
TABLE = {
    ("euler", 0.001): (7e-4, 1.1e-2, 2.9e-3),
    ("euler", 0.005): (6e-3, 6.9e-2, 1.4e-2),
    ("euler", 0.010): (2.4e-2, 9.9e-2, 2.1e-2),
    ("semi-implicit", 0.001): (7e-4, 1.1e-2, 1.2e-3),
    ("semi-implicit", 0.005): (1e-3, 7.5e-2, 6e-3),
    ("semi-implicit", 0.010): (6e-3, 1.8e-1, 1.4e-2),
    ("rk4", 0.001): (2e-11, 4e-10, 2e-11),
    ("rk4", 0.005): (2e-8, 2e-7, 1e-8),
    ("rk4", 0.010): (4e-7, 4e-6, 2e-7),
}
"""equations.md §3: energy, momentum [N·s] and angular momentum that a free spin of 3 s gains."""


@pytest.mark.parametrize(("integrator", "dt"), TABLE)
def test_free_motion_drifts_as_the_table_says(nine_links: Tree, integrator: str, dt: float) -> None:
    """In the order of magnitude, over five starts: the table's own starts are not known."""
    drifts = np.abs([free_motion_drift(nine_links, integrator, dt, seed=seed) for seed in range(5)])
    off = np.log10(np.median(drifts, axis=0) / TABLE[integrator, dt])
    assert np.abs(off).max() < 1.0


@settings(max_examples=5)
@given(seed=st.integers(0, 10**6))
def test_rk4_keeps_energy_and_momenta(nine_links: Tree, seed: int) -> None:
    energy, momentum, angular = free_motion_drift(nine_links, "rk4", 0.002, 1.0, seed)
    assert max(abs(energy), momentum, angular) < 1e-6


def test_a_falling_tree_falls_as_a_stone_does(nine_links: Tree) -> None:
    system = floating(nine_links, np.array([0.0, 0.0, -9.81]))
    start = any_free_state(system, 3)
    before, after = laws_of(system, start), laws_of(system, integrated(system, start, "rk4", 0.002, 0.5))
    fall = after[1] - before[1]
    np.testing.assert_allclose(fall, [0.0, 0.0, -9.81 * 0.5 * nine_links.mass.sum()], atol=1e-8)
    assert after[0] == pytest.approx(before[0], rel=1e-8)


# --- steps of their own length --------------------------------------------------------------------
def test_a_smaller_tolerance_is_kept_with_more_steps(nine_links: Tree) -> None:
    system = floating(nine_links)
    start = any_free_state(system, 1)
    exact = integrated(system, start, "rk4", 0.0005, 0.5)
    errors, steps = [], []
    for tolerance in (1e-3, 1e-5, 1e-7):
        y = start.copy()
        _, taken = advance(system, at_rest(system), y, METHODS["adaptive"], 0.5, 0.5, 1, tolerance)
        errors.append(np.abs(y - exact).max())
        steps.append(taken)
    assert errors[0] > 5 * errors[1] > 25 * errors[2]
    assert errors[2] < 1e-4
    assert steps[0] < steps[1] < steps[2]


@pytest.mark.parametrize("integrator", METHODS)
def test_a_state_that_is_no_number_stays_one_and_ends(nine_links: Tree, integrator: str) -> None:
    system = floating(nine_links)
    start = any_free_state(system, 0)
    parts(system, start).w[0, 0] = np.nan
    assert not np.isfinite(integrated(system, start, integrator, 0.001, 0.01)).all()


# --- slow coefficients ----------------------------------------------------------------------------
def test_older_slow_coefficients_cost_accuracy_in_proportion(nine_links: Tree) -> None:
    off = [refresh_error(nine_links, refresh, seconds=0.5) for refresh in (1, 2, 4, 8)]
    assert off[0] == 0.0
    assert 0.0 < off[1] < off[2] < off[3] < 0.1
    assert off[3] / off[1] == pytest.approx(4.0, rel=0.2)
