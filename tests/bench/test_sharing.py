"""Sharing loads, measured: other solvers agree on loads of real gaits, and a wrong answer is found out."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.bench.claims import jumps, sharing
from gaitwright.bench.claims.tick import run_rounds
from gaitwright.bench.context import Context
from gaitwright.bench.evidence import agreement
from gaitwright.bench.evidence.agreement import KINDS, Tally, weakened
from gaitwright.bench.evidence.gaits import GAITS, loads
from gaitwright.bench.evidence.moments import LiveTrot
from gaitwright.bench.evidence.sharing_oracles import Task, by_highs, by_quadprog
from gaitwright.control.numerical import PLAIN
from gaitwright.numerics.status import INFEASIBLE, SOLVED
from gaitwright.workers import Workers


@pytest.fixture(scope="module")
def context() -> Iterator[Context]:
    with Workers(1) as workers, Context(workers, quick=True) as context:
        yield context


@pytest.fixture(scope="module")
def trot() -> LiveTrot:
    return LiveTrot()


@pytest.fixture(scope="module")
def few() -> list[Task]:
    """Loads of every gait that the bench records."""
    return [task for gait in GAITS for task in loads(replace(gait, seconds=0.6), every=30)]


# --- agreement -------------------------------------------------------------------------------------
def test_other_solvers_agree_on_loads_of_real_gaits(context, few):
    figures = list(agreement.agreement(context, [*few, *few]))
    assert len(figures) == 6
    assert all(figure.reached and figure.starts == 2 * len(few) for figure in figures)
    seen = figures[1].numbers["outcomes"]
    for kind, asked in KINDS.items():
        assert f"{kind}: solved" in seen
        assert np.isfinite(asked.unmet) or f"{kind}: infeasible" in seen


def test_motors_too_weak_for_the_load_are_so_for_everyone(few):
    task = replace(few[0], tau_max=1e-6 * few[0].tau_max)
    assert by_quadprog(task) is None and task.quadratic()[2] == INFEASIBLE
    assert by_highs(task, PLAIN).status == 2 and task.linear(PLAIN).code == INFEASIBLE


def test_weaker_motors_keep_the_load_and_their_proportions(few, rng):
    weak = weakened(few[0], rng)
    share = weak.tau_max / few[0].tau_max
    assert agreement.WEAK[0] <= share.min() <= share.max() <= agreement.WEAK[1]
    assert np.ptp(share) < 1e-12
    assert weak.load is few[0].load


@pytest.mark.parametrize(
    ("ours", "theirs", "difference"),
    [(SOLVED, SOLVED, 2e-7), (SOLVED, INFEASIBLE, np.nan), (INFEASIBLE, SOLVED, np.nan), (3, -1, np.nan)],
)
def test_a_wrong_value_or_verdict_is_counted(ours, theirs, difference):
    tally = Tally(1e-7)
    tally.add("any", SOLVED, SOLVED, 1e-9)
    tally.add("any", INFEASIBLE, INFEASIBLE, np.nan)
    assert [figure.reached for figure in tally.figures("any", "")] == [True, True]
    tally.add("any", ours, theirs, difference)
    worst, same = tally.figures("any", "")
    assert (same.measured, same.starts, same.reached) == (2, 3, False)
    assert worst.reached is (difference != 2e-7)


def test_without_other_solvers_nothing_is_claimed(context, few, monkeypatch):
    monkeypatch.setattr(agreement, "missing", lambda: "quadprog is not installed")
    figures = list(agreement.agreement(context, few))
    assert [figure.measured_text for figure in figures] == ["not measured"] * 3
    assert not any(figure.reached for figure in figures)


# --- times and jumps -------------------------------------------------------------------------------
def test_every_way_solves_every_tick_of_a_trot(context, trot):
    moments = trot.moments(60)
    ticks = [sharing.Tick(way, trot.brain.robot, moments) for way in sharing.WAYS]
    rounds = run_rounds(context, ticks)
    assert all(set(times) == {tick.name for tick in ticks} for times in rounds)
    assert all((times[tick.name] > 0.0).all() for times in rounds for tick in ticks)
    assert {tick.about() for tick in ticks} == {"every tick solved"}


def test_a_price_of_change_calms_the_linear_program(trot, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    moments, robot = trot.moments(300), trot.brain.robot
    ways = (sharing.QP, sharing.CALM, sharing.PRINTED)
    figures = list(jumps.force_jumps(moments, {way.name: way.controller(robot) for way in ways}))
    largest = [figure.measured for figure in figures if "largest" in figure.what]
    assert largest == sorted(largest) and largest[2] > 2.0 * largest[0] > 0.0
    assert (tmp_path / jumps.PICTURE).read_bytes().startswith(b"\x89PNG")
    assert all(str(jumps.PICTURE) in figure.note for figure in figures)


def test_without_the_extra_the_figures_say_so(trot, monkeypatch):
    monkeypatch.setattr(jumps, "find_spec", lambda name: None)
    figure = next(jumps.force_jumps(trot.moments(20), {"QP": sharing.QP.controller(trot.brain.robot)}))
    assert "gaitwright[plot]" in figure.note
