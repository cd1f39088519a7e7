"""The thesis's program: HiGHS, told the physics in other words, agrees, and prices say what room is worth."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gaitwright.bench.evidence.gaits import loads
from gaitwright.bench.evidence.sharing_oracles import Task, by_highs
from gaitwright.bench.trial import Trial
from gaitwright.control.certificate import linear_status_of
from gaitwright.control.forces import PYRAMID, contact_frame
from gaitwright.control.linear import Shared
from gaitwright.control.thesis_program import LinearSettings, settings_of
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.numerics.status import INFEASIBLE, SOLVED
from oracles import robot_called
from tasks import any_task

seeds = st.integers(0, 2**32 - 1)
INF = np.inf
CLOSED_LOOP = LinearSettings()
ABSOLUTE = LinearSettings(change=0.0, unmet=INF)
LITERAL = ABSOLUTE._replace(literal=1.0)
SIX = ABSOLUTE._replace(components=6.0, roll_lever=0.05, pitch_lever=0.08, twist_lever=0.04)
KINDS = {
    "closed loop": CLOSED_LOOP,
    "absolute": ABSOLUTE,
    "soft": ABSOLUTE._replace(unmet=10.0),
    "literal": LITERAL,
    "six": SIX,
    "six, soft, calm": SIX._replace(unmet=5.0, change=0.05, xi=0.2, friction=0.7, most_normal=1.0),
    "six, literal": SIX._replace(literal=1.0),
}
kinds = st.sampled_from(list(KINDS.values()))


def width_of(task: Task, asked: LinearSettings) -> np.ndarray:
    """Half-width of the friction pyramid of each foot that is down, as a column."""
    return np.minimum(asked.friction, PYRAMID * task.friction[task.down])[:, None]


def agree(task: Task, asked: LinearSettings, shared: Shared) -> None:
    best = by_highs(task, asked)
    if shared.code == SOLVED:
        assert best.success and shared.objective == pytest.approx(best.fun, abs=1e-7)
    else:
        assert shared.code == INFEASIBLE and best.status == 2 and shared.culprit >= 0


@given(seeds, kinds)
@settings(max_examples=300)
def test_highs_finds_no_better(seed: int, asked: LinearSettings) -> None:
    task = any_task(seed)
    agree(task, asked, task.linear(asked))


@given(seeds, kinds)
@settings(max_examples=60)
def test_highs_finds_no_better_for_a_calm_robot_of_many_legs(seed: int, asked: LinearSettings) -> None:
    rng = np.random.default_rng(seed)
    legs = int(rng.choice([4, 6, 8]))
    task = any_task(seed, legs, int(rng.integers(legs // 2, legs + 1)), calm=True)
    agree(task, asked, task.linear(asked))


def test_each_kind_is_sometimes_possible_and_some_are_sometimes_not() -> None:
    """Otherwise the two tests above would prove little."""
    for kind, asked in KINDS.items():
        codes = {any_task(seed).linear(asked).code for seed in range(60)}
        codes |= {any_task(seed, calm=True).linear(asked).code for seed in range(60)}
        assert codes == ({SOLVED} if np.isfinite(asked.unmet) else {SOLVED, INFEASIBLE}), kind


# --- a real gait ---------------------------------------------------------------------------------
@cache
def recorded(name: str, skill: str) -> list[Task]:
    """A second of a gait, tick by tick, as the controller saw it."""
    return list(loads(Trial(name, "flat", 1.2, 0, skill)))[100:]


GAITS = pytest.mark.parametrize(("name", "skill"), [("go2", "trot"), ("go2", "walk"), ("thesis", "walk")])


@GAITS
def test_in_a_real_gait_highs_finds_no_better(name: str, skill: str) -> None:
    tasks = [task for task in recorded(name, skill)[::8] if task.stance.any()]
    assert len(tasks) > 40
    for task in tasks:
        for asked in (CLOSED_LOOP, KINDS["soft"]):
            agree(task, asked, task.linear(asked))


@GAITS
def test_from_tick_to_tick_few_steps_are_needed(name: str, skill: str) -> None:
    cold, warm, hints = [], [], None
    for task in recorded(name, skill):
        first, again = task.linear(CLOSED_LOOP), task.linear(CLOSED_LOOP, hints)
        assert again.objective == pytest.approx(first.objective, abs=1e-9)
        cold.append(first.steps)
        warm.append(again.steps)
        hints = again.basis
    assert np.mean(warm) < 0.4 * np.mean(cold)


# --- the answer ----------------------------------------------------------------------------------
@given(seeds, kinds)
def test_garbage_for_hints_changes_nothing(seed: int, asked: LinearSettings) -> None:
    task, rng = any_task(seed), np.random.default_rng(seed)
    first, most = task.linear(asked), 3 * (int(asked.components) * 4 + 1 + 4 * 14 + 6)
    for hints in (rng.integers(-50, most + 50, first.basis.size), any_task(seed + 1).linear(asked).basis):
        again = task.linear(asked, hints)
        assert again.code == first.code
        if first.code == SOLVED:
            assert again.objective == pytest.approx(first.objective, abs=1e-8)


@given(seeds, kinds)
def test_the_unmet_balance_and_the_limits_belong_to_the_forces(seed: int, asked: LinearSettings) -> None:
    task = any_task(seed)
    shared = task.linear(asked)
    assume(shared.code == SOLVED)
    W, h = task.weight, task.height
    x = shared.x.reshape(len(task.down), -1)
    frame = contact_frame(task.normal_w)
    f, m = W * x[:, :3] @ frame, W * h * x[:, 3:] @ frame if asked.components > 3 else np.zeros((len(x), 3))
    arm = task.load.arm[task.down]
    wrench = np.concatenate([f.sum(axis=0), (np.cross(arm, f) + m).sum(axis=0)])
    missing = task.row_scale * (wrench - task.load.wrench)
    if len(task.down) > 2 or asked.components > 3 or not np.isfinite(asked.unmet):
        np.testing.assert_allclose(shared.unmet, missing, atol=1e-9)
    push, turn = task.load.push[task.down], task.load.turn[task.down]
    tau = task.load.free[task.down] - np.einsum("lji,li->lj", push, f) - np.einsum("lji,li->lj", turn, m)
    assert (abs(tau) <= task.tau_max[task.down] * (1 + 1e-8)).all()
    assert (x[:, 2] >= -1e-8).all() and (
        x[:, 2] <= asked.most_normal * task.load_scale[task.down] + 1e-8
    ).all()
    assert (abs(x[:, :2]) <= width_of(task, asked) * x[:, 2:3] + 1e-8).all()
    levers = np.array([asked.roll_lever, asked.pitch_lever, asked.twist_lever])
    assert (abs(x[:, 3:]) <= (levers * x[:, 2:3] / h + 1e-8)[:, : x.shape[1] - 3]).all()


def test_with_no_foot_down_there_is_nothing_to_share() -> None:
    task = replace(any_task(1), stance=np.zeros(4, dtype=bool))
    shared = task.linear(CLOSED_LOOP)
    assert (
        shared.code == SOLVED
        and shared.x.size == 0
        and not shared.multipliers.any()
        and (shared.basis == -1).all()
    )


# --- prices --------------------------------------------------------------------------------------
def test_no_limit_without_contact_has_a_price() -> None:
    with_price = np.zeros(9, dtype=int)
    for seed in range(30):
        task = any_task(seed)
        shared = task.linear(CLOSED_LOOP)
        assert shared.code == SOLVED and not shared.multipliers[~task.stance].any()
        x = shared.x.reshape(-1, 3)
        priced = shared.multipliers[task.down] != 0.0
        most = width_of(task, CLOSED_LOOP)[:, 0] * x[:, 2]
        slip = np.stack([s * x[:, i] - most for i in (0, 1) for s in (1, -1)], axis=1)
        assert (abs(slip[priced[:, :4]]) < 1e-8).all()
        assert (abs(x[priced[:, 4], 2]) < 1e-8).all()
        assert (abs(x[:, 2] - 1.5 * task.load_scale[task.down])[priced[:, 5]] < 1e-8).all()
        with_price += priced.sum(axis=0)
    assert (with_price[:6] > 0).all(), "no kind of limit went untested"


def roomier(task: Task, leg: int, limit: int, d: float) -> Task:
    """The task with the bound of a normal force (5) or a torque limit (6, 7, 8) moved out by d."""
    share, most = task.load_scale.copy(), task.tau_max.copy()
    if limit == 5:
        share[leg] += d / CLOSED_LOOP.most_normal
    else:
        most[leg, limit - 6] *= 1.0 + d
    return replace(task, load_scale=share, tau_max=most)


def test_a_price_says_what_a_little_more_room_saves() -> None:
    checked = np.zeros(9, dtype=int)
    d = 1e-6
    for task in map(any_task, range(150)):
        shared = task.linear(CLOSED_LOOP)
        for leg in task.down:
            for limit in (5, 6, 7, 8):
                price = abs(shared.multipliers[leg, limit])
                if price > 1e-6:
                    more = roomier(task, leg, limit, d).linear(CLOSED_LOOP)
                    assert (shared.objective - more.objective) / d == pytest.approx(price, rel=1e-4, abs=1e-4)
                    checked[limit] += 1
    assert checked[5:].min() > 10


def test_the_price_of_a_torque_has_the_sign_of_its_limit() -> None:
    seen = set()
    for seed in range(60):
        task = any_task(seed)
        shared = task.linear(ABSOLUTE._replace(unmet=10.0))
        if shared.code != SOLVED:
            continue
        forces = task.weight * shared.x.reshape(-1, 3) @ contact_frame(task.normal_w)
        tau = task.load.free[task.down] - np.einsum("lji,li->lj", task.load.push[task.down], forces)
        priced = shared.multipliers[task.down, 6:]
        hit = abs(priced) > 1e-6
        np.testing.assert_allclose(tau[hit], np.sign(priced[hit]) * 20.0, rtol=1e-8)
        seen |= set(np.sign(priced[hit]))
    assert seen == {1.0, -1.0}


# --- the thesis's objective ----------------------------------------------------------------------
def standing_still(task: Task, rng: np.random.Generator) -> Task:
    """The task with joint rates of feet that do not move while the base does."""
    v, w = rng.normal(0.0, 0.5, (2, 3))
    rates = [
        np.linalg.solve(push.T, -v - np.cross(w, r))
        for push, r in zip(task.load.push, task.load.arm, strict=True)
    ]
    return replace(task, qd=np.array(rates), tau_max=np.full(task.tau_max.shape, 80.0))


def literal_objective(task: Task, x: np.ndarray, xi: float) -> float:
    """Joint power and the sum of normal forces, as printed."""
    forces = task.weight * x.reshape(-1, 3) @ contact_frame(task.normal_w)
    tau = task.load.free[task.down] - np.einsum("lji,li->lj", task.load.push[task.down], forces)
    power = (tau * task.qd[task.down]).sum() / (task.weight * np.sqrt(GRAVITY * task.height))
    return xi * power + (1.0 - xi) * x.reshape(-1, 3)[:, 2].sum()


def test_the_literal_objective_is_the_same_for_all_forces_that_balance(rng: np.random.Generator) -> None:
    """Equations.md .linear(5: whatever else is minimised, it does not change, so it chooses nothing."""
    differ = found = 0
    for seed in range(200):
        task = standing_still(any_task(seed, feet=4, calm=True), rng)
        literal, absolute = task.linear(LITERAL), task.linear(ABSOLUTE)
        if literal.code != SOLVED:
            continue
        found += 1
        assert literal.objective == pytest.approx(literal_objective(task, literal.x, 0.5), abs=1e-9)
        assert literal_objective(task, absolute.x, 0.5) == pytest.approx(literal.objective, abs=1e-9)
        differ += bool(abs(absolute.x - literal.x).max() > 1e-3)
    assert found > 50 and differ > 0.9 * found


# --- two feet, six components --------------------------------------------------------------------
def test_two_point_feet_cannot_balance_but_six_components_can() -> None:
    """Equations.md .linear(5: no moment about the line of the feet."""
    codes = {SOLVED: 0, INFEASIBLE: 0}
    for seed in range(40):
        task = any_task(seed, feet=2, calm=True)
        task = replace(task, tau_max=np.full((4, 3), 200.0))
        glued = SIX._replace(roll_lever=1.0, pitch_lever=1.0, twist_lever=1.0, friction=1.0)
        assert task.linear(ABSOLUTE).code == INFEASIBLE
        codes[task.linear(glued).code] += 1
        soft = task.linear(KINDS["soft"])
        assert soft.code == SOLVED
    assert codes[SOLVED] > 30


# --- in words and numbers ------------------------------------------------------------------------
def test_settings_survive_their_array() -> None:
    odd = LinearSettings(*(0.1 * k for k in range(1, 11)))
    assert settings_of(np.array(odd)) == odd


def test_the_limit_in_the_way_is_named() -> None:
    task = any_task(1, feet=4)
    free = np.zeros((4, 3))
    free[2, 1] = 100.0
    push = np.zeros((4, 3, 3))
    shared = replace(task, load=task.load._replace(free=free, push=push)).linear(CLOSED_LOOP)
    dog = robot_called("dog")
    limit = f"{dog.tau_max[2, 1]:.3g}"
    sentence = f"these feet cannot carry this load without overloading a joint: leg RL, hip 2, {limit} N·m"
    assert linear_status_of(dog, shared.code, shared.culprit) == sentence
    assert linear_status_of(dog, any_task(1, feet=4, calm=True).linear(CLOSED_LOOP).code, -1) == "solved"


@pytest.mark.parametrize("components", [3, 6])
def test_every_culprit_has_a_sentence(components: int) -> None:
    dog = robot_called("dog")
    count = 4 * components + 1 + 4 * (2 * components + 2) + 6
    told = [linear_status_of(dog, INFEASIBLE, q, components) for q in range(count)]
    assert told[0].endswith("no room is left for the force of foot FL")
    assert told[4 * components + 1].endswith("without foot FL slipping towards +x")
    assert told[-1].endswith("force and moment cannot be balanced")
    # A sentence for each foot's force, each of its limits, and the balance.
    assert len(set(told)) == 4 + 4 * (2 * components + 1) + 1


def test_six_components_tell_what_tipping_costs() -> None:
    """Small feet under a load far off their middle: the prices of their edges are not nothing."""
    tiny = SIX._replace(unmet=10.0, roll_lever=1e-3, pitch_lever=1e-3, twist_lever=1e-3)
    prices = [any_task(seed, feet=2).linear(tiny).multipliers for seed in range(20)]
    assert prices[0].shape == (4, 15)
    assert max(float(np.abs(p[:, 9:]).max()) for p in prices) > 0.0
