"""`gaitwright scenes`: what there is, pictures of it, and of files; what was mended in them is told."""

import json
from pathlib import Path

import matplotlib.image
import pytest

from gaitwright.cli import main
from gaitwright.ground.scenes_list import OFFERS

SQUARE = [[2, 0], [3, 0], [3, 1], [2, 1]]


def test_the_list_names_every_scene(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes"]) == 0
    out = capsys.readouterr().out
    assert all(f"\n{name} " in out for name in OFFERS)
    assert main(["scenes", "--json", "-"]) == 0
    assert [fact["name"] for fact in json.loads(capsys.readouterr().out)] == list(OFFERS)


def test_scenes_and_files_are_drawn_into_one_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    yard = tmp_path / "yard.json"
    yard.write_text(json.dumps({"holes": [{"outline": [*SQUARE, SQUARE[0]], "depth": 0.2}]}))
    out = tmp_path / "new" / "both.png"
    assert main(["scenes", "--plot", "maze:0.3", str(yard), "--out", str(out), "--seed", "2"]) == 0
    said = capsys.readouterr()
    assert f"picture: {out}" in said.err and said.out == ""
    assert "yard: holes[0]: 1 corner repeated or within 1 mm of the next left out" in said.err
    assert matplotlib.image.imread(out).shape[1] == 1600


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--plot", "moon"], "no scene 'moon'; there is: flat"),
        (["--plot", "maze:2"], "takes a difficulty from 0 to 1, not '2'"),
        (["--plot", "maze", "--out", "maze.jpg"], "name one that ends in .png"),
        (["--plot", *["flat"] * 61], "at most 60 scenes"),
    ],
)
def test_wrong_use_is_one_sentence(words: list, told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes", *words]) == 2
    assert told in " ".join(capsys.readouterr().err.split())


def test_a_mission_tells_what_was_mended(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    yard = tmp_path / "yard.json"
    around_start = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [0.5, 0.5]]
    yard.write_text(json.dumps({"shapes": [{"type": "prism", "outline": around_start, "height": 1}]}))
    assert main(["mission", "--scene", str(yard), "--goal", "3", "0", "--seconds", "1"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "yard: shapes[0]: 1 corner repeated" in said
    assert "the start (0, 0) is on an obstacle of scene yard, or too near to one" in said


@pytest.mark.parametrize("sight", ["known", "camera"])
def test_no_mission_begins_where_something_stands_that_moves_off_later(
    sight: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    yard = tmp_path / "yard.json"
    post = {"type": "cylinder", "x": 0.1, "y": 0, "radius": 0.3, "height": 1}
    yard.write_text(json.dumps({"shapes": [post | {"moves": {"along": [[3, 3]], "speed": 1, "from": 2}}]}))
    words = ["mission", "--scene", str(yard), "--goal", "3", "0", "--seconds", "1", "--sight", sight]
    assert main(words) == 2
    assert "the start (0, 0) is on an obstacle of scene yard" in " ".join(capsys.readouterr().err.split())
