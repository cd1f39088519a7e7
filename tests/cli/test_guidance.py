"""`mission --route`, `--velocity` and `--strategy`: who says where a robot goes."""

import json
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.cli.guidance_arguments import STRATEGIES
from gaitwright.navigation import learned_map
from gaitwright.skillbook.book import Skillbook

FLAT = ["mission", "--scene", "flat"]
ROUTE = "x,y,speed,wait\n0.6,0,0.4,\n0.6,0.3,,0.5\n"
COMMANDS = "time,forward,left,turn\n0,0.3,0,0\n1,0,0,0.5\n2,0,0,0\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("route.csv").write_text(ROUTE)
    Path("commands.csv").write_text(COMMANDS)
    return tmp_path


def reported(words: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> dict:
    assert main([*words, "--json", "-"]) == code
    return json.loads(capsys.readouterr().out)


def test_strategies_are_those_of_the_map():
    assert tuple(STRATEGIES) == learned_map.STRATEGIES


def test_a_route_is_walked(capsys: pytest.CaptureFixture[str]):
    report = reported([*FLAT, "--route", "route.csv"], 0, capsys)
    assert report["arrived"] and report["stopped_because"] == "arrived at the goal"
    assert 0.8 < report["distance_m"] < 1.3


def test_commands_last_as_long_as_they_say(capsys: pytest.CaptureFixture[str]):
    report = reported([*FLAT, "--velocity", "commands.csv"], 0, capsys)
    assert report["stopped_because"] == "the 2 s asked for are over"
    assert report["duration_s"] == pytest.approx(2.0)
    assert set(report["skills"]) >= {"trot", "turn-in-place"}
    shorter = reported([*FLAT, "--velocity", "commands.csv", "--seconds", "0.5"], 0, capsys)
    assert shorter["duration_s"] == pytest.approx(0.5)


def test_a_route_through_an_obstacle_is_told(capsys: pytest.CaptureFixture[str]):
    Path("route.csv").write_text("x,y\n6,0\n")
    report = reported(["mission", "--route", "route.csv"], 1, capsys)
    assert report["stopped_because"].endswith("straight from here to (6, 0) stands an obstacle")


def test_with_a_camera_it_is_seen_on_the_way(capsys: pytest.CaptureFixture[str]):
    Path("route.csv").write_text("x,y\n6,0\n")
    report = reported(["mission", "--route", "route.csv", "--sight", "camera"], 1, capsys)
    assert report["stopped_because"].startswith("stopped: something stands in the way to (6, 0), ")
    assert 1.0 < report["distance_m"] < 3.0


def test_a_strategy_is_gone_by_and_a_map_that_one_learned_serves_the_other(
    capsys: pytest.CaptureFixture[str],
):
    words = ["mission", "--goal", "1.5", "0.4", "--sight", "camera", "--skillbook", "a.skills"]
    for asked, taken in (("thesis", "thesis"), ("optimistic", "optimistic"), ("", "optimistic")):
        assert main([*words, *(["--strategy", asked] if asked else [])]) == 0
        (notes,) = Skillbook.load("a.skills").maps
        assert notes.strategy == taken
    told = " ".join(capsys.readouterr().err.split())
    assert "is now: 3 trips" in told and "learned anew" not in told


WRONG = [
    ([*FLAT], 2, "one of the arguments --goal --waypoints --route --velocity is required"),
    ([*FLAT, "--route", "route.csv", "--goal", "1", "0"], 2, "not allowed with argument --route"),
    ([*FLAT, "--route", "route.csv", "--velocity", "commands.csv"], 2, "not allowed with argument --route"),
    ([*FLAT, "--route", "none.csv"], 3, "route file none.csv cannot be read"),
    ([*FLAT, "--velocity", "route.csv"], 3, "no column is called 'x'; there is: time, forward, left, turn"),
    ([*FLAT, "--velocity", "commands.csv", "--speed", "1"], 2, "with --velocity the file says how fast"),
    (
        [*FLAT, "--goal", "1", "0", "--strategy", "bold"],
        2,
        "no strategy 'bold'; there is: optimistic, thesis",
    ),
    (
        [*FLAT, "--goal", "1", "0", "--strategy", "thesis"],
        2,
        "it goes with --sight camera, not with --sight known",
    ),
    (
        [*FLAT, "--goal", "1", "0", "--strategy", "thesis", "--sight", "blind"],
        2,
        "it goes with --sight camera, not with --sight blind",
    ),
    (
        [*FLAT, "--route", "route.csv", "--strategy", "thesis", "--sight", "camera"],
        2,
        "with --route the way is not the robot's to choose",
    ),
    (
        [*FLAT, "--velocity", "commands.csv", "--strategy", "thesis", "--sight", "camera"],
        2,
        "with --velocity the way is not the robot's to choose",
    ),
    (["mission", "--route", "far.csv"], 2, "far.csv, row 2: the stop (90, 0) lies outside scene blocks"),
    ([*FLAT, "--route", "fast.csv"], 2, "fast.csv, row 1: run at 9 m/s is beyond the reach of go2"),
    (
        [*FLAT, "--velocity", "wild.csv"],
        2,
        "wild.csv, row 2: walk-backward at 2 m/s is beyond the reach of go2",
    ),
]


@pytest.mark.parametrize(("words", "code", "sentence"), WRONG, ids=lambda value: str(value)[-40:])
def test_what_makes_no_sense_is_one_sentence(
    words: list[str], code: int, sentence: str, capsys: pytest.CaptureFixture[str]
):
    Path("far.csv").write_text("x,y\n1,0\n90,0\n")
    Path("fast.csv").write_text("x,y,speed\n1,0,9\n")
    Path("wild.csv").write_text("time,forward\n0,0.2\n1,-2\n2,0\n")
    assert main([*words, "--out", "run"]) == code
    out, err = capsys.readouterr()
    assert out == "" and sentence in " ".join(err.split()) and not Path("run").exists()


def test_a_robot_learns_nothing_from_what_it_was_told(capsys: pytest.CaptureFixture[str]):
    words = ["--driver", "hybrid", "--skillbook", "a.skills", "--learn", "--velocity", "commands.csv"]
    assert main([*FLAT, *words]) == 2
    assert "not from what --velocity told it" in capsys.readouterr().err
