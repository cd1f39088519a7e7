"""`gaitwright scanner`: asked of a run that was recorded, in words, as JSON, as a picture."""

import json
from pathlib import Path

import numpy as np
import pytest

from gaitwright.cli import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """What a second on stairs leaves, seen by a camera."""
    out = tmp_path_factory.mktemp("runs") / "walk"
    words = ["skill", "--skill", "trot", "--scene", "stairs", "--sight", "camera", "--seconds", "1"]
    assert main([*words, "--out", str(out)]) == 0
    return out


def test_a_moment_is_told(folder: Path, capsys):
    assert main(["scanner", str(folder / "recording.npz"), "--at", "0.6"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "go2 in stairs at 0.60 s" in told
    for part in (
        "supporting feet",
        "support polygon",
        "coming polygon",
        "centre of gravity",
        "critical feet",
    ):
        assert part in told
    assert all(f" {leg} " in told for leg in ("FL", "FR", "RL", "RR"))


def test_without_a_moment_it_is_the_last_one(folder: Path, capsys):
    assert main(["scanner", str(folder / "recording.npz"), "--json", "-"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["time_s"] == pytest.approx(1.0, abs=0.051) and facts["robot"] == "go2"


def test_json_is_what_the_file_holds(folder: Path, capsys):
    assert main(["scanner", str(folder / "recording.npz"), "--at", "0.42", "--json", "-"]) == 0
    facts = json.loads(capsys.readouterr().out)
    with np.load(folder / "recording.npz") as file:
        k = int(np.abs(file["scanner_time"] - 0.42).argmin())
        assert facts["time_s"] == pytest.approx(file["scanner_time"][k])
        np.testing.assert_allclose(facts["centre_of_gravity_m"], file["scanner_centre_w"][k], atol=1e-5)
        down = file["scanner_supporting"][k] > 0.5
    assert facts["supporting_feet"] == [leg for leg, is_so in zip(facts["feet"], down, strict=True) if is_so]


def test_a_picture_is_drawn_where_it_is_asked_for(folder: Path, tmp_path: Path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["scanner", str(folder / "recording.npz"), "--at", "0.5", "--out", "held.png"]) == 0
    assert (tmp_path / "held.png").stat().st_size > 50_000
    assert main(["scanner", str(folder / "recording.npz"), "--plot"]) == 0
    assert (tmp_path / "runs/scanner.png").exists()
    assert "picture: runs/scanner.png" in capsys.readouterr().err


def test_a_run_without_out_records_nothing_more(tmp_path: Path, monkeypatch):
    seen = []
    monkeypatch.setattr("gaitwright.record.previews.Previewer.add", lambda *of: seen.append(of))
    assert main(["skill", "--seconds", "0.1", "--json", str(tmp_path / "a.json")]) == 0
    assert not seen


def test_wrong_uses_have_a_sentence(folder: Path, tmp_path: Path, capsys):
    path = str(folder / "recording.npz")
    with np.load(path) as file:
        np.savez(tmp_path / "old.npz", **{name: file[name] for name in file.files if "scanner" not in name})
    for words, code, told in (
        ([path, "--at", "7"], 2, "--at 7: the terrain scanner was recorded from 0 to"),
        ([str(tmp_path / "old.npz")], 2, "has nothing of the terrain scanner"),
        ([path, "--out", "held.jpg"], 2, "name one that ends in .png"),
        ([str(tmp_path / "nothing.npz")], 3, "nothing.npz"),
    ):
        assert main(["scanner", *words]) == code
        assert told in " ".join(capsys.readouterr().err.split())
