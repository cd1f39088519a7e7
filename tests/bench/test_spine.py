"""The bench: what it measures, how it says it, and the exit codes that follow from it."""

import json
import os
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.claims import walks
from gaitwright.bench.claims.walks import Walk, measure_walks
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.children import can_measure, measured
from gaitwright.bench.measurement import Figure, at_least, at_most, count
from gaitwright.bench.trial import Trial, brain_for, robot_named, simulate
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Mission
from gaitwright.workers import Workers

SHORT = Walk("go2", "trot", 0.4, seconds=2.0, starts=1, roll=2.5)


@pytest.fixture(scope="module")
def context() -> Iterator[Context]:
    with Workers(2) as workers, Context(workers) as context:
        yield context


# --- figures ---------------------------------------------------------------------------------------
def test_a_figure_is_reached_within_its_bound():
    assert Figure("speed", 2.0, "m/s", at_most(2.0)).reached is True
    assert Figure("speed", 2.1, "m/s", at_most(2.0)).reached is False
    assert Figure("speed", 2.1, "m/s", at_least(2.0)).reached is True
    assert Figure("speed", 2.0).reached is None


def test_what_was_not_measured_is_not_reached():
    figure = Figure("ratio", float("nan"), "×", at_most(0.5), 0, "it is not installed")
    assert figure.reached is False
    assert figure.measured_text == "not measured"
    assert figure.plain()["measured"] is None


def test_a_count_wants_whole_starts():
    assert count("pushed", 18, 20, 0.9, "", {}).reached
    assert not count("pushed", 3, 4, 0.9, "", {}).reached
    assert count("pushed", 3, 4, 0.9, "", {}).wanted_text == "≥ 4 of 4"


# --- walks -----------------------------------------------------------------------------------------
def test_a_walk_is_measured_for_real(context):
    falls, roll = measure_walks(context, [SHORT])
    assert (falls.measured, falls.starts, falls.reached) == (1, 1, True)
    assert falls.numbers["each"][0]["stopped_because"] == "the 2 s asked for are over"
    assert 0.0 < roll.measured < 2.5


def test_an_error_is_not_made_up_where_the_gait_was_not_steady(context):
    _, error = measure_walks(context, [replace(SHORT, seconds=1.0, velocity=0.02, roll=None)])
    assert error.measured_text == "not measured"
    assert error.reached is False


def test_outcomes_do_not_depend_on_the_number_of_workers(context):
    trials = [Trial("go2", "rough:0.03", 0.4, seed, speed=0.4) for seed in (0, 1, 2)]
    side_by_side = [o.report.state_hash for o in context.outcomes("hashes", trials)]
    assert side_by_side == [simulate(trial).report.state_hash for trial in trials]
    assert len(set(side_by_side)) == 3


@pytest.mark.parametrize("phase", [0.0, 0.4])
def test_a_push_has_its_impulse_and_its_phase(phase):
    trial = Trial("go2", "flat", 1.5, 0, speed=0.4)
    robot, scene = robot_named("go2"), load_scene("flat")
    plant = MujocoPlant(robot, scene, DT)
    session = Session(brain_for(trial, robot, scene), plant, Mission(()), trial.seconds, trial.seed)
    session.push(Push(0.6, 90.0, at=0.7, phase=phase))
    seen = [(lap.target.phase, *plant.data.xfrc_applied[1, :3]) for lap in session]
    table = np.array(seen)
    force = np.linalg.norm(table[:, 1:], axis=1)
    assert force.sum() * DT == pytest.approx(0.6 * robot.total_mass, rel=0.02)
    start = np.flatnonzero(force)[0]
    assert 0.7 / DT <= start <= 0.7 / DT + 220
    assert (table[start, 0] - phase) % 1.0 < 0.01
    assert table[start, 2] > 0.9 * force[start]  # to the left, less the heading of a varied start


# --- the run ---------------------------------------------------------------------------------------
def test_an_unknown_name_is_told_with_what_there_is():
    with pytest.raises(WrongUse, match=r"no bench 'walk'; there is: spine, .*; did you mean 'walks'\?"):
        bench.run(["walk"])


def test_names_choose_claims_and_groups():
    assert bench.claims_named(["tick", "walks"]) == [("spine", "walks"), ("spine", "tick")]
    assert bench.claims_named([*bench.GROUPS, "tick"]) == bench.claims_named([])


def test_the_exit_code_tells_of_a_missed_figure(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(walks, "WALKS", [replace(SHORT, roll=0.0)])
    assert bench.run(["walks"], json_path=str(tmp_path / "bench.json"), workers=1) == 1
    shown = capsys.readouterr()
    for words in ("what", "measured", "wanted", "reached?", "starts", "NO", "1 of 2 wanted figures reached"):
        assert words in shown.out
    assert "go2 trot" in shown.err
    told = json.loads((tmp_path / "bench.json").read_text())
    assert told["reached"] is False
    assert told["machine"]["cores"] >= 1 and "numpy" in told["machine"]["versions"]
    (claim,) = told["claims"]
    assert [figure["reached"] for figure in claim["figures"]] == [True, False]
    assert claim["figures"][1]["wanted"] == {"sign": "≤", "bound": 0.0}


def test_json_on_the_standard_output_is_alone_there(monkeypatch, capsys):
    monkeypatch.setattr(walks, "WALKS", [])
    assert bench.run(["walks"], quick=True, json_path="-", workers=1) == 0
    shown = capsys.readouterr()
    assert json.loads(shown.out)["quick"] is True
    assert "QUICK" in shown.err


def test_an_interrupt_keeps_what_was_finished(monkeypatch, tmp_path, capsys):
    def measure(context):
        yield Figure("finished", 1.0, "", at_most(2.0))
        raise KeyboardInterrupt

    monkeypatch.setattr(walks, "measure", measure)
    assert bench.run(["walks", "ground"], json_path=str(tmp_path / "bench.json"), workers=1) == 130
    assert "finished" in capsys.readouterr().out
    told = json.loads((tmp_path / "bench.json").read_text())
    assert told["interrupted"] and not told["reached"]
    assert [figure["what"] for figure in told["claims"][0]["figures"]] == ["finished"]


# --- children --------------------------------------------------------------------------------------
@pytest.mark.skipif(not can_measure(), reason="this system does not tell what a child took")
def test_a_child_is_charged_its_own_memory_only():
    ours = bytearray(os.urandom(1)) * 300_000_000
    used = measured([sys.executable, "-S", "-c", "bytearray(b'x') * 100_000_000"], os.environ, Path.cwd())
    assert 100 < used.peak_mb < 150 < len(ours) / 1e6
    assert used.wall_s > 0.0
