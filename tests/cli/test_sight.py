"""`--sight` and `--camera`: what the robot knows of the ground."""

import json
from pathlib import Path

import pytest

from gaitwright.cli import main

MISSION = ("mission", "--scene", "blocks", "--goal", "1.5", "0", "--seconds", "20")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--sight", "camra"], "no sight 'camra'"),
        (["--camera", "range=2"], "--camera goes with --sight camera, not with --sight known"),
        (["--sight", "blind", "--camera", "range=2"], "not with --sight blind"),
        (["--sight", "camera", "--camera", "zoom=2"], "no setting of a camera 'zoom'"),
        (["--sight", "camera", "--camera", "range"], "write KEY=NUMBER"),
        (["--sight", "camera", "--camera", "range=nan"], "not a finite number"),
        (["--sight", "camera", "--camera", "range=-1"], "range and rate are positive"),
        (["--sight", "camera", "--camera", "rows=2.5"], "whole number of rows"),
        (["--sight", "camera", "--camera", "across=200"], "between 0 and 180 degrees"),
        (["--sight", "camera", "--camera", "dropouts=2"], "share from 0 to 1"),
    ],
)
def test_what_makes_no_sense_is_told(words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as ended:
        raise SystemExit(main([*MISSION, *words]))
    assert ended.value.code == 2
    assert sentence in " ".join(capsys.readouterr().err.split())


def test_a_mission_goes_by_its_camera(tmp_path: Path):
    out = tmp_path / "report.json"
    seen = ["--sight", "camera", "--camera", "range=2.5", "noise=0.01", "height=0.2"]
    assert main([*MISSION, *seen, "--json", str(out)]) == 0
    assert json.loads(out.read_text())["arrived"] is True


def test_a_skill_may_go_by_a_camera_too():
    assert main(["skill", "--skill", "trot", "--seconds", "1", "--scene", "rough", "--sight", "camera"]) == 0
