"""The force distribution proves itself: limits kept, residual told, optimum that of other solvers."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
import quadprog
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.control.active_set import INFEASIBLE, SOLVED
from gaitwright.control.demand import Load, load_of
from gaitwright.control.forces import (
    FORCE_WEIGHTS,
    FRICTION,
    MOMENT_WEIGHTS,
    MOST_NORMAL,
    SMALL,
    SMOOTH,
    contact_frame,
    distribute,
    to_world,
    torques,
    unmet,
)
from gaitwright.geometry import GRAVITY

MASS, HEIGHT = 15.0, 0.3
WEIGHT = MASS * GRAVITY
ROW_SCALE = np.array([*FORCE_WEIGHTS, *(weight / HEIGHT for weight in MOMENT_WEIGHTS)]) / WEIGHT
"""Turns a wrench into the rows of the balance: shares of the weight, weighted."""
seeds = st.integers(0, 2**32 - 1)


@dataclass(frozen=True)
class Answer:
    tau: np.ndarray
    forces_w: np.ndarray
    residual: float
    prices: np.ndarray
    code: int
    culprit: int


@dataclass(frozen=True)
class Task:
    """What a distribution is asked, leg torques `free - push @ f` included."""

    load: Load
    stance: np.ndarray
    share: np.ndarray
    normal_w: np.ndarray
    previous_w: np.ndarray
    tau_max: np.ndarray

    def solve(self) -> Answer:
        packed = np.concatenate([np.ravel(part) for part in self.load])
        task = (packed, self.stance, self.share, self.normal_w, self.previous_w, self.tau_max, WEIGHT, HEIGHT)
        x, prices, code, culprit = distribute(*task)
        forces = to_world(x, self.stance, contact_frame(self.normal_w), WEIGHT)
        tau = torques(packed, forces, self.tau_max)
        return Answer(tau, forces, unmet(packed, forces, self.stance, WEIGHT, HEIGHT), prices, code, culprit)

    @property
    def down(self) -> np.ndarray:
        """Indices of the legs in stance."""
        return np.flatnonzero(self.stance)

    def torques(self, forces_w: np.ndarray) -> np.ndarray:
        return self.load.free - np.einsum("lji,li->lj", self.load.push, forces_w)


def any_task(seed: int, feet_down: int | None = None, strong: float = 20.0) -> Task:
    """A quadruped on a slope, asked for any wrench of about its weight."""
    rng = np.random.default_rng(seed)
    stance = np.zeros(4, dtype=bool)
    stance[rng.permutation(4)[: feet_down or rng.integers(1, 5)]] = True
    arm = np.array([[0.2, 0.14, -0.3], [0.2, -0.14, -0.3], [-0.2, 0.14, -0.3], [-0.2, -0.14, -0.3]])
    arm += rng.uniform(-0.05, 0.05, (4, 3))
    push = rng.uniform(-0.25, 0.25, (4, 3, 3))
    wrench = WEIGHT * rng.normal([0, 0, 1, 0, 0, 0], [0.3, 0.3, 0.4, 0.1, 0.1, 0.1])
    free = rng.uniform(-5.0, 5.0, (4, 3))
    normal = np.array([*rng.uniform(-0.3, 0.3, 2), 1.0])
    previous = rng.uniform(-0.3, 0.3, (4, 3)) * WEIGHT * stance[:, None]
    share = np.where(stance, rng.uniform(0.1, 1.0, 4), 0.0)
    return Task(
        Load(wrench, free, arm, push, np.zeros((4, 3, 3))), stance, share,
        normal / np.linalg.norm(normal), previous, np.full((4, 3), strong),
    )  # fmt: skip


# --- the certificate -----------------------------------------------------------------------------
def in_contact(task: Task, forces_w: np.ndarray) -> np.ndarray:
    """Forces on the feet along two tangents and the normal `(legs, 3)` [N]."""
    return forces_w @ contact_frame(task.normal_w).T


def missing(task: Task, forces_w: np.ndarray) -> np.ndarray:
    """What the feet lack of the wanted wrench `(6,)`, rows as shares of the weight, weighted."""
    given_w = np.concatenate([forces_w.sum(axis=0), np.cross(task.load.arm, forces_w).sum(axis=0)])
    return ROW_SCALE * (given_w - task.load.wrench)


@given(seeds)
def test_every_limit_is_kept(seed: int) -> None:
    task = any_task(seed)
    answer = task.solve()
    hair = 2e-6 * WEIGHT
    t1, t2, n = in_contact(task, answer.forces_w).T
    assert answer.code == SOLVED
    assert (answer.forces_w[~task.stance] == 0.0).all()
    assert (n >= -hair).all() and (n <= MOST_NORMAL * task.share * WEIGHT + hair).all()
    assert (np.maximum(abs(t1), abs(t2)) <= FRICTION * n + hair).all()
    assert (abs(task.torques(answer.forces_w))[task.stance] <= task.tau_max[task.stance] * (1 + 2e-6)).all()


@given(seeds)
def test_torques_and_residual_belong_to_the_forces(seed: int) -> None:
    task = any_task(seed)
    answer = task.solve()
    assert answer.residual == pytest.approx(np.linalg.norm(missing(task, answer.forces_w)), abs=1e-12)
    limited = np.clip(task.torques(answer.forces_w), -task.tau_max, task.tau_max)
    np.testing.assert_allclose(answer.tau, limited, atol=1e-12)


@given(seeds)
def test_a_load_that_four_feet_can_carry_is_carried(seed: int) -> None:
    rng = np.random.default_rng(seed)
    task = any_task(seed, feet_down=4, strong=1e3)
    forces = rng.uniform([-0.05, -0.05, 0.2], [0.05, 0.05, 0.3], (4, 3)) * WEIGHT
    forces = forces @ contact_frame(task.normal_w)
    wrench = np.concatenate([forces.sum(axis=0), np.cross(task.load.arm, forces).sum(axis=0)])
    able = replace(task, load=task.load._replace(wrench=wrench), share=np.ones(4), previous_w=forces)
    assert able.solve().residual < 1e-3


def test_standing_level_the_load_is_shared_evenly() -> None:
    arm = np.array([[0.2, 0.1, -0.3], [0.2, -0.1, -0.3], [-0.2, 0.1, -0.3], [-0.2, -0.1, -0.3]])
    maps = np.zeros((2, 4, 3, 3))
    load = Load(np.array([0, 0, WEIGHT, 0, 0, 0]), np.zeros((4, 3)), arm, *maps)
    evenly = np.tile([0.0, 0.0, WEIGHT / 4], (4, 1))
    up, four = np.array([0.0, 0.0, 1.0]), np.ones(4)
    answer = Task(load, four > 0, four, up, evenly, np.ones((4, 3))).solve()
    np.testing.assert_allclose(answer.forces_w, evenly, atol=1e-4 * WEIGHT)


def test_a_load_no_joint_can_bear_names_its_culprit() -> None:
    task = any_task(1, feet_down=4)
    free = np.zeros((4, 3))
    free[2, 1] = 100.0
    load = task.load._replace(free=free, push=np.zeros((4, 3, 3)))
    answer = replace(task, load=load).solve()
    assert answer.code == INFEASIBLE
    assert answer.culprit == 7 * 4 + 3 * 2 + 1, "the second joint of the third foot"


def test_some_of_these_tasks_press_against_every_limit() -> None:
    """Otherwise the tests here would prove little."""
    hit = np.zeros(4, dtype=int)
    for seed in range(100):
        task = any_task(seed)
        forces = task.solve().forces_w
        t1, t2, n = in_contact(task, forces)[task.down].T
        close = 1e-5 * WEIGHT
        hit += [
            bool((n < close).any()),
            bool((n > MOST_NORMAL * task.share[task.down] * WEIGHT - close).any()),
            bool((np.maximum(abs(t1), abs(t2)) > FRICTION * n - close)[n > close].any()),
            bool((abs(task.torques(forces)) > task.tau_max - 1e-4)[task.down].any()),
        ]
    assert (hit >= 5).all(), hit


# --- the same programs, written down once more in newtons and world axes, for other solvers ------
def balance_of(task: Task) -> np.ndarray:
    """Wrench per force of the stance feet, rows scaled `(6, 3m)`."""
    blocks = [
        np.vstack([np.eye(3), [[0, -z, y], [z, 0, -x], [-y, x, 0]]]) for x, y, z in task.load.arm[task.down]
    ]
    return ROW_SCALE[:, None] * np.hstack(blocks)


def limits_of(task: Task) -> tuple[np.ndarray, np.ndarray]:
    """Rows and least values of the limits: rows @ forces ≥ least."""
    t1, t2, n = contact_frame(task.normal_w)
    rows, least = [], []
    for k, leg in enumerate(task.down):
        sides = [(n, 0.0), (-n, -MOST_NORMAL * task.share[leg] * WEIGHT)]
        sides += [(FRICTION * n - s * t, 0.0) for t in (t1, t2) for s in (1, -1)]
        for s in (1, -1):
            sides += [
                (s * row, s * free - most)
                for row, free, most in zip(
                    task.load.push[leg], task.load.free[leg], task.tau_max[leg], strict=True
                )
            ]
        for normal, bound in sides:
            row = np.zeros((len(task.down), 3))
            row[k] = normal
            rows.append(row.ravel())
            least.append(bound)
    return np.array(rows), np.array(least)


def on_all_feet(task: Task, forces: np.ndarray) -> np.ndarray:
    out = np.zeros((4, 3))
    out[task.down] = forces.reshape(-1, 3)
    return out


def by_quadprog(task: Task) -> np.ndarray:
    rows, least = limits_of(task)
    A, b = balance_of(task), ROW_SCALE * task.load.wrench
    hessian = A.T @ A + (SMALL + SMOOTH) / WEIGHT**2 * np.eye(A.shape[1])
    linear = A.T @ b + SMOOTH / WEIGHT**2 * task.previous_w[task.down].ravel()
    return on_all_feet(task, quadprog.solve_qp(WEIGHT**2 * hessian, WEIGHT**2 * linear, rows.T, least)[0])


@given(seeds)
def test_the_quadratic_optimum_is_quadprogs(seed: int) -> None:
    task = any_task(seed)
    np.testing.assert_allclose(task.solve().forces_w, by_quadprog(task), rtol=0, atol=1e-6)


# --- values in arrays, frames --------------------------------------------------------------------
@pytest.mark.parametrize("legs", [4, 6, 8])
def test_a_packed_load_is_unpacked_whole(legs: int, rng: np.random.Generator) -> None:
    shapes = ((3,), (3,), (3, 3), (3, 3))
    whole = Load(rng.normal(size=6), *(rng.normal(size=(legs, *shape)) for shape in shapes))
    again = load_of(np.concatenate([part.ravel() for part in whole]))
    for part, same in zip(whole, again, strict=True):
        np.testing.assert_array_equal(part, same)


@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_the_contact_frame_is_a_right_handed_rotation(slope_x: float, slope_y: float) -> None:
    normal = np.array([-slope_x, -slope_y, 1.0]) / np.sqrt(1.0 + slope_x**2 + slope_y**2)
    frame = contact_frame(normal)
    np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0)
    np.testing.assert_array_equal(frame[2], normal)
    assert frame[0, 0] > 0.0, "the first tangent points forward"
