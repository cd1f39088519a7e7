"""The force distribution proves itself: limits kept, residual told, optimum that of other solvers."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gaitwright.bench.evidence.sharing_oracles import Task, by_quadprog
from gaitwright.control.forces import MOST_NORMAL, PYRAMID, contact_frame, torques, unmet
from gaitwright.control.inverse_dynamics import Load, load_of
from gaitwright.numerics.status import INFEASIBLE, SOLVED
from gaitwright.signals import GRIP
from tasks import HEIGHT, WEIGHT, any_task

seeds = st.integers(0, 2**32 - 1)


@dataclass(frozen=True)
class Answer:
    tau: np.ndarray
    forces_w: np.ndarray
    residual: float
    multipliers: np.ndarray
    code: int
    culprit: int


def solve(task: Task) -> Answer:
    """Our answer, with torques and residual as the controller hands them on."""
    forces, prices, code, culprit = task.quadratic()
    tau = torques(task.packed, forces, task.tau_max)
    residual = unmet(task.packed, forces, task.stance, task.weight, task.height)
    return Answer(tau, forces, residual, prices, code, culprit)


def torques_of(task: Task, forces_w: np.ndarray) -> np.ndarray:
    """Leg torques `(legs, 3)` without their limits [N·m]."""
    return task.load.free - np.einsum("lji,li->lj", task.load.push, forces_w)


# --- the certificate -----------------------------------------------------------------------------
def in_contact(task: Task, forces_w: np.ndarray) -> np.ndarray:
    """Forces on the feet along two tangents and the normal `(legs, 3)` [N]."""
    return forces_w @ contact_frame(task.normal_w).T


def missing(task: Task, forces_w: np.ndarray) -> np.ndarray:
    """What the feet lack of the wanted wrench `(6,)`, rows as shares of the weight, weighted."""
    given_w = np.concatenate([forces_w.sum(axis=0), np.cross(task.load.arm, forces_w).sum(axis=0)])
    return task.row_scale * (given_w - task.load.wrench)


@given(seeds)
def test_every_limit_is_kept(seed: int) -> None:
    task = any_task(seed)
    answer = solve(task)
    hair = 2e-6 * WEIGHT
    t1, t2, n = in_contact(task, answer.forces_w).T
    assert answer.code == SOLVED
    assert (answer.forces_w[~task.stance] == 0.0).all()
    assert (n >= -hair).all() and (n <= MOST_NORMAL * task.load_scale * WEIGHT + hair).all()
    assert (np.maximum(abs(t1), abs(t2)) <= PYRAMID * task.friction * n + hair).all()
    assert (np.hypot(t1, t2) <= 0.89 * task.friction * n + hair).all(), "outside the cone"
    assert (
        abs(torques_of(task, answer.forces_w))[task.stance] <= task.tau_max[task.stance] * (1 + 2e-6)
    ).all()


@given(seeds)
def test_torques_and_residual_belong_to_the_forces(seed: int) -> None:
    task = any_task(seed)
    answer = solve(task)
    assert answer.residual == pytest.approx(np.linalg.norm(missing(task, answer.forces_w)), abs=1e-12)
    limited = np.clip(torques_of(task, answer.forces_w), -task.tau_max, task.tau_max)
    np.testing.assert_allclose(answer.tau, limited, atol=1e-12)


@given(seeds)
def test_a_load_that_four_feet_can_carry_is_carried(seed: int) -> None:
    rng = np.random.default_rng(seed)
    task = any_task(seed, feet=4)
    forces = rng.uniform([-0.05, -0.05, 0.2], [0.05, 0.05, 0.3], (4, 3)) * WEIGHT
    forces = forces @ contact_frame(task.normal_w)
    wrench = np.concatenate([forces.sum(axis=0), np.cross(task.load.arm, forces).sum(axis=0)])
    load, strong = task.load._replace(wrench=wrench), np.full((4, 3), 1e3)
    able = replace(task, load=load, load_scale=np.ones(4), previous_w=forces, tau_max=strong)
    assert solve(able).residual < 1e-3


def test_standing_level_the_load_is_shared_evenly() -> None:
    arm = np.array([[0.2, 0.1, -0.3], [0.2, -0.1, -0.3], [-0.2, 0.1, -0.3], [-0.2, -0.1, -0.3]])
    maps = np.zeros((2, 4, 3, 3))
    load = Load(np.array([0, 0, WEIGHT, 0, 0, 0]), np.zeros((4, 3)), arm, *maps)
    evenly = np.tile([0.0, 0.0, WEIGHT / 4], (4, 1))
    up, four = np.array([0.0, 0.0, 1.0]), np.ones(4)
    ones, still = np.ones((4, 3)), np.zeros((4, 3))
    answer = solve(Task(load, four > 0, four, GRIP * four, up, evenly, ones, still, WEIGHT, HEIGHT))
    np.testing.assert_allclose(answer.forces_w, evenly, atol=1e-4 * WEIGHT)


def test_a_load_no_joint_can_bear_names_its_culprit() -> None:
    task = any_task(1, feet=4)
    free = np.zeros((4, 3))
    free[2, 1] = 100.0
    load = task.load._replace(free=free, push=np.zeros((4, 3, 3)))
    answer = solve(replace(task, load=load))
    assert answer.code == INFEASIBLE
    assert answer.culprit == 7 * 4 + 3 * 2 + 1, "the second joint of the third foot"


def test_some_of_these_tasks_press_against_every_limit() -> None:
    """Otherwise the tests here would prove little."""
    hit = np.zeros(4, dtype=int)
    for seed in range(100):
        task = any_task(seed)
        forces = solve(task).forces_w
        t1, t2, n = in_contact(task, forces)[task.down].T
        close, most = 1e-5 * WEIGHT, PYRAMID * task.friction[task.down]
        hit += [
            bool((n < close).any()),
            bool((n > MOST_NORMAL * task.load_scale[task.down] * WEIGHT - close).any()),
            bool((np.maximum(abs(t1), abs(t2)) > most * n - close)[n > close].any()),
            bool((abs(torques_of(task, forces)) > task.tau_max - 1e-4)[task.down].any()),
        ]
    assert (hit >= 5).all(), hit


# --- another solver ------------------------------------------------------------------------------
@given(seeds)
@example(1_072_017_619)  # grip so good that tangential forces are larger than normal ones
def test_the_quadratic_optimum_is_quadprogs(seed: int) -> None:
    task = any_task(seed)
    np.testing.assert_allclose(solve(task).forces_w, by_quadprog(task), rtol=0, atol=1e-6)


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
