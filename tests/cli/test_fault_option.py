"""`--fault`: what is typed fails, and what came of it is told."""

import json
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.record.recording import load

SKILL = ["skill", "--seconds", "1.6"]


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_dead_motor_is_in_the_report_and_the_recording(capsys: pytest.CaptureFixture[str]) -> None:
    words = [*SKILL, "--fault", "motor-dead:FL:knee@1", "--out", "out", "--json", "-"]
    assert main(words) == 1
    report = json.loads(capsys.readouterr().out)
    fault = report["faults"][0]
    assert (fault["kind"], fault["leg"], fault["joint"]) == ("motor-dead", "FL", "knee")
    assert 1.0 <= fault["noticed"] <= 1.25
    assert report["stopped_because"] == fault["sentence"] and report["falls"] == 0
    assert json.loads(Path("out/report.json").read_text(encoding="utf-8"))["faults"] == report["faults"]
    recording = load("out/recording.npz")
    assert recording.trip and recording["position_w"][-1, 2] < 0.2


def test_faults_add_up_and_a_foot_may_lie(capsys: pytest.CaptureFixture[str]) -> None:
    words = [*SKILL, "--fault", "foot-off:FL@0.6", "--fault", "foot-on:RR@0.9"]
    assert main(words) == 0
    shown = capsys.readouterr().out
    assert "front left foot's sensor feels" in shown and "rear right foot's sensor keeps" in shown


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ("frozen", "write KIND[:LEG[:JOINT]]@T"),
        ("motor-dead:FL:knee:more@1", "write KIND[:LEG[:JOINT]]@T"),
        ("motor-ded:FL:knee@1", "did you mean 'motor-dead'"),
        ("motor-dead:XL:knee@1", "there is: FL, FR, RL, RR"),
        ("foot-off@1", "is written foot-off:LEG@T"),
        ("frozen@-1", "not negative"),
        ("frozen@nan", "not a finite number"),
    ],
)
def test_what_cannot_fail_is_told(asked: str, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SKILL, "--fault", asked]) == 2
    assert sentence in capsys.readouterr().err


def test_without_mechanics_nothing_can_fail(capsys: pytest.CaptureFixture[str]) -> None:
    words = [*SKILL, "--plant", "kinematic", "--driver", "kinematic", "--fault", "frozen@1"]
    assert main(words) == 2
    assert "plant kinematic has no motors and sensors" in capsys.readouterr().err
