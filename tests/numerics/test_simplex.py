"""The simplex method proves its answers, and HiGHS agrees, whatever the program and the hints."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import OptimizeResult, linprog

from gaitwright.numerics.piecewise_linear import BOUND, COLUMN, HIGH, LOW, LOWER, UPPER, program
from gaitwright.numerics.simplex import minimise
from gaitwright.numerics.status import INFEASIBLE, NOT_FINITE, SOLVED, UNBOUNDED

seeds = st.integers(0, 2**32 - 1)
NEAR = 1e-7


class Answer(NamedTuple):
    x: np.ndarray
    y: np.ndarray
    basis: np.ndarray
    code: int
    quantity: int
    steps: int


def certificate(t: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple[float, float, float]:
    """What proves an answer, each zero for an exact one: duality gap, worst limit and price broken.

    Gap: the sum of prices at x less the least one that y allows. Limits: how far x is beyond any. Prices:
    the largest entry of Σ y r, and how far y is beyond a price where there is no limit to carry it.
    """
    value = x @ t[COLUMN:]
    bound = np.minimum(np.maximum(t[BOUND], t[LOWER]), t[UPPER])
    # What a price is beyond those of the curve rests on a limit.
    extra = np.maximum(y - t[HIGH], 0.0) + np.minimum(y - t[LOW], 0.0)
    end = np.where(extra > 0.0, t[UPPER], t[LOWER])
    limited = np.isfinite(end)
    carried = extra[limited] @ (end - bound)[limited]
    gap = price(t, value).sum() - price(t, bound).sum() + y @ bound + carried
    beyond = max(0.0, (t[LOWER] - value).max(), (value - t[UPPER]).max())
    wrong = np.abs(extra[~limited]).max(initial=np.abs(t[COLUMN:] @ y).max())
    return float(gap), float(beyond), float(wrong)


def price(t: np.ndarray, value: np.ndarray) -> np.ndarray:
    """What each quantity costs at a value within its limits."""
    over = value - t[BOUND]
    rate = np.where(over > 0.0, t[HIGH], np.where(over < 0.0, t[LOW], 0.0))
    return rate * over


def solved(t: np.ndarray, hints: np.ndarray | None = None) -> Answer:
    """The answer of the method, from no hints where none are given."""
    return Answer(*minimise(t.copy(), np.full(len(t) - COLUMN, -1) if hints is None else hints))


def values(t: np.ndarray, x: np.ndarray) -> np.ndarray:
    return t[COLUMN:].T @ x


def cost(t: np.ndarray, x: np.ndarray) -> float:
    off = values(t, x) - t[BOUND]
    return float(t[HIGH] @ np.maximum(off, 0.0) + t[LOW] @ np.minimum(off, 0.0))


def by_highs(t: np.ndarray) -> OptimizeResult:
    """The same program as HiGHS reads it: an unknown above each max(v − bound, 0); `fun` is its cost."""
    n, count = len(t) - COLUMN, t.shape[1]
    R = t[COLUMN:].T
    bent, top, bottom = t[HIGH] > t[LOW], np.isfinite(t[UPPER]), np.isfinite(t[LOWER])
    alone = np.zeros((count, count))
    rows = np.vstack(
        [np.hstack([R, -np.eye(count)])[bent], np.hstack([R, alone])[top], -np.hstack([R, alone])[bottom]]
    )
    most = np.concatenate([t[BOUND, bent], t[UPPER, top], -t[LOWER, bottom]])
    prices = np.concatenate([R.T @ t[LOW], t[HIGH] - t[LOW]])
    free, exact = (
        [(None, None)] * n,
        {"primal_feasibility_tolerance": 1e-9, "dual_feasibility_tolerance": 1e-9},
    )
    best = linprog(prices, rows, most, bounds=free + [(0, None)] * count, method="highs", options=exact)
    if best.success:
        best.fun -= t[LOW] @ t[BOUND]
    return best


# --- programs at random --------------------------------------------------------------------------
def any_program(rng: np.random.Generator, feasible: bool) -> np.ndarray:
    """All sorts: sparse, whole numbers, dependent rows, equations, ranges, costs, |v|, fixed unknowns.

    Where it is to be feasible, all limits hold at one point; often many of them meet there.
    """
    n, k = int(rng.integers(1, 14)), int(rng.integers(0, 30))
    rows = rng.normal(size=(k, n)) * (rng.random((k, n)) < rng.choice([0.2, 0.5, 1.0]))
    if rng.random() < 0.4:
        rows = np.round(rows)
    if k > 3 and rng.random() < 0.3:
        rows[k // 2 :] = rng.integers(-1, 2, (k - k // 2, k // 2)) @ rows[: k // 2]
    point = rng.normal(0.0, 0.5, n)
    if rng.random() < 0.5:
        point = np.round(point)
    v = np.concatenate([point, rows @ point])
    count = n + k
    if not feasible:
        v += rng.normal(0.0, 0.5, count) * (rng.random(count) < 0.3)
    room = rng.choice([0.0, 0.5, 1.0], (3, count)) if rng.random() < 0.5 else rng.random((3, count))
    lower, upper = v - room[0], v + room[1]
    bound = lower + room[2] * (upper - lower)
    kind, is_row = rng.random(count), np.arange(count) >= n
    lower = np.where((kind < 0.4) & is_row, -np.inf, lower)
    upper = np.where((kind > 0.3) & (kind < 0.7) & is_row, np.inf, upper)
    low, high = -rng.choice([0.0, 0.0, 1.0, 10.0, 0.5], count), rng.choice([0.0, 0.0, 1.0, 10.0, 0.5], count)
    linear = rng.random(count) < 0.4
    slope = rng.normal(size=count) * (rng.random() < 0.5)
    return program(rows, lower, bound, upper, np.where(linear, slope, low), np.where(linear, slope, high))


def sharp_program(rng: np.random.Generator) -> np.ndarray:
    """One whose best vertex is the only one, with all its prices within their pieces."""
    n, k = 6, 12
    rows = rng.normal(size=(k, n))
    v = rng.normal(0.0, 0.3, n + k)
    lower, upper = v - rng.uniform(2.0, 3.0, n + k), v + rng.uniform(2.0, 3.0, n + k)
    low = -rng.uniform(0.0, 1.0, n + k)
    return program(rows, lower, v, upper, low, low + rng.uniform(0.5, 1.0, n + k))


# --- proofs --------------------------------------------------------------------------------------
@given(seeds)
@settings(max_examples=500)
def test_a_solved_program_comes_with_its_proof(seed: int) -> None:
    t = any_program(np.random.default_rng(seed), feasible=True)
    answer = solved(t)
    assert answer.code == SOLVED and answer.quantity == -1
    assert np.abs(certificate(t, answer.x, answer.y)).max() < NEAR
    assert len(np.unique(answer.basis // 3)) == len(answer.x)


@given(seeds)
def test_the_certificate_tells_a_wrong_answer(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = sharp_program(rng)
    x, y = solved(t)[:2]
    off = np.zeros(x.size)
    off[rng.integers(x.size)] = rng.choice([-0.01, 0.01])
    gap, beyond, wrong = certificate(t, x + off, y)
    assert max(gap, beyond) > 1e-6 and wrong < NEAR
    y[rng.integers(y.size)] += 0.01
    assert certificate(t, x, y)[2] > 1e-4


@given(seeds)
@settings(max_examples=300)
def test_highs_finds_no_better(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = any_program(rng, feasible=rng.random() < 0.6)
    answer, best = solved(t), by_highs(t)
    if answer.code == SOLVED:
        assert best.success and cost(t, answer.x) == pytest.approx(best.fun, abs=NEAR)
    else:
        assert answer.code == INFEASIBLE and best.status == 2


# --- hints ---------------------------------------------------------------------------------------
@given(seeds)
@settings(max_examples=200)
def test_garbage_for_hints_changes_nothing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = any_program(rng, feasible=rng.random() < 0.8)
    n, count = len(t) - COLUMN, t.shape[1]
    first = solved(t)
    for hints in (rng.integers(-9, 3 * count + 9, n), rng.integers(0, 3 * count, 3 * n), np.full(n, 3 * n)):
        again = solved(t, hints)
        assert again.code == first.code
        if first.code == SOLVED:
            assert cost(t, again.x) == pytest.approx(cost(t, first.x), abs=NEAR)
            assert np.abs(certificate(t, again.x, again.y)).max() < NEAR


@given(seeds)
def test_its_own_basis_needs_no_step(seed: int) -> None:
    t = sharp_program(np.random.default_rng(seed))
    first = solved(t)
    again = solved(t, first.basis)
    assert again.steps == 0
    np.testing.assert_allclose(again.x, first.x, rtol=0, atol=1e-12)


def test_a_like_program_needs_few_steps(rng: np.random.Generator) -> None:
    cold = warm = 0
    for _ in range(50):
        t = sharp_program(rng)
        like = t.copy()
        like[BOUND] += rng.normal(0.0, 0.01, t.shape[1])
        cold, warm = cold + solved(like).steps, warm + solved(like, solved(t).basis).steps
    assert warm < 0.25 * cold


def test_the_same_call_gives_the_same_bits(rng: np.random.Generator) -> None:
    t = any_program(rng, feasible=True)
    used, hints = t.copy(), np.full(len(t) - COLUMN, -1)
    for first, second in zip(minimise(used, hints), minimise(used, hints), strict=True):
        np.testing.assert_array_equal(first, second)


# --- prices --------------------------------------------------------------------------------------
@given(seeds)
def test_a_price_belongs_to_the_side_that_the_value_is_on(seed: int) -> None:
    """Complementary slackness."""
    t = any_program(np.random.default_rng(seed), feasible=True)
    x, y = solved(t)[:2]
    v, hair = values(t, x), 1e-7
    bound = np.clip(t[BOUND], t[LOWER], t[UPPER])
    inside = (v > t[LOWER] + hair) & (v < t[UPPER] - hair)
    assert (y[inside] >= t[LOW, inside] - hair).all() and (y[inside] <= t[HIGH, inside] + hair).all()
    below, above = inside & (v < bound - hair), inside & (v > bound + hair)
    np.testing.assert_allclose(y[below], t[LOW, below], atol=hair)
    np.testing.assert_allclose(y[above], t[HIGH, above], atol=hair)
    at_top, at_bottom = v > t[LOWER] + hair, v < t[UPPER] - hair
    assert (y[at_top] >= t[LOW, at_top] - hair).all() and (y[at_bottom] <= t[HIGH, at_bottom] + hair).all()


@given(seeds)
def test_a_price_says_what_moving_its_curve_changes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = sharp_program(rng)
    answer = solved(t)
    q, d = int(rng.integers(t.shape[1])), 1e-7
    moved = t.copy()
    moved[[LOWER, BOUND, UPPER], q] += d
    change = cost(moved, solved(moved).x) - cost(t, answer.x)
    assert change == pytest.approx(-d * answer.y[q], abs=1e-12 + 1e-5 * d)


@given(seeds)
def test_a_moved_limit_never_saves_more_than_its_price(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = any_program(rng, feasible=True)
    answer = solved(t)
    d = rng.uniform(0.0, 1.0, t.shape[1])
    wider = t.copy()
    wider[UPPER] += d
    saved = cost(t, answer.x) - cost(wider, solved(wider).x)
    assert -NEAR <= saved <= np.maximum(answer.y - t[HIGH], 0.0) @ d + NEAR


# --- what has no answer --------------------------------------------------------------------------
def curves(n: int, *rows: tuple[float, ...]) -> np.ndarray:
    """n unknowns between −1 and 1, without price; rows: coefficients, lower, bound, upper, low, high."""
    boxes = [(-1.0, 0.0, 1.0, 0.0, 0.0)] * n
    table = np.array([*boxes, *(row[n:] for row in rows)])
    return program(np.array([row[:n] for row in rows], float), *table.T)


def test_equations_at_odds_are_infeasible_and_the_last_is_named() -> None:
    inf = math.inf
    t = curves(2, (1, 1, 0.5, 0.5, 0.5, 0, 0), (2, 2, 1.5, 1.5, 1.5, 0, 0), (1, 0, -inf, 0, inf, 0, 1))
    answer = solved(t)
    assert answer.code == INFEASIBLE and answer.quantity in (2, 3)
    t[[LOWER, BOUND, UPPER], 3] = 1.0
    assert solved(t).code == SOLVED


def test_a_limit_out_of_reach_is_named() -> None:
    t = curves(2, (1, 0, 0.5, 0.5, 2, 0, 0), (1, 1, 2.5, 3, 4, 0, 0))
    answer = solved(t)
    assert (answer.code, answer.quantity) == (INFEASIBLE, 3)


def test_limits_in_the_wrong_order_are_infeasible() -> None:
    answer = solved(curves(1, (1, 0.5, 0.5, 0.4, 0, 0)))
    assert (answer.code, answer.quantity) == (INFEASIBLE, 1)


def test_an_unknown_that_pays_for_ever_is_unbounded() -> None:
    t = curves(2, (1, 0, -1, 0, 1, 0, 0))
    t[[LOWER, UPPER], 1] = -math.inf, math.inf
    t[[LOW, HIGH], 1] = -0.5
    answer = solved(t)
    assert (answer.code, answer.quantity) == (UNBOUNDED, 1)
    t[HIGH, 1] = 0.5
    assert solved(t).code == SOLVED


@pytest.mark.parametrize("row", [LOWER, BOUND, HIGH, COLUMN])
def test_what_is_no_number_is_said(row: int) -> None:
    t = curves(2, (1, 0.5, -0.5, 0.25, 0.5, -1, 1))
    t[row, 2] = math.nan
    assert solved(t).code == NOT_FINITE


@pytest.mark.parametrize("seed", range(20))
def test_a_hundred_limits_through_one_point_do_not_hold_it_up(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n, k = 12, 100
    rows = rng.integers(-1, 2, (k, n)).astype(float)
    count, inf = n + k, math.inf
    lower, upper = np.full(count, -inf), np.zeros(count)
    lower[:n], upper[:n] = -1.0, 1.0
    low = np.concatenate([rng.integers(-1, 2, n), np.zeros(k)]).astype(float)
    t = program(rows, lower, np.zeros(count), upper, low, low)
    answer = solved(t)
    assert answer.code == SOLVED and np.abs(certificate(t, answer.x, answer.y)).max() < NEAR
