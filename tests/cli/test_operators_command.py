"""`gaitwright operators` and `teach --lesson operators`: taught, shown, ordered, played, taken out again."""

import json
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.skillbook import Skillbook

SHOWN = ["over an obstacle", "over a hole"]
CYCLE = {"points": [[0, -0.5, 0], [0.25, -0.4, 0.3], [0.75, 0.4, 0.3], [1, 0.5, 0]]}


@pytest.fixture(scope="module")
def book(tmp_path_factory) -> str:
    """A book with the operator that the numerical controller shows."""
    path = tmp_path_factory.mktemp("books") / "go2.skills"
    assert main(["teach", "--lesson", "operators", "--robot", "go2", "--out", str(path)]) == 0
    return str(path)


def names(book: str) -> list[str]:
    return [one.name for one in Skillbook.load(book).operators]


def test_the_rules_are_told(book, capsys):
    assert main(["operators", book]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "1. over an obstacle: if a block, a step up or a step down of up to" in told
    assert main(["operators", book, "--json", "-"]) == 0
    one, _ = json.loads(capsys.readouterr().out)["operators"]
    assert one["strategy"] == "follows the ground" and one["kinds"] == ["block", "step up", "step down"]


def test_a_person_teaches_one_sees_it_takes_it_in_orders_and_forgets(book, capsys, tmp_path, monkeypatch):
    lessons, trials = "gaitwright.learning.operator_lessons", "gaitwright.learning.operator_trials"
    quick = {f"{lessons}.STARTS": 1, f"{lessons}.SHOWN": 2.0, f"{trials}.SECONDS": 2.2}
    quick |= {f"{trials}.HANDED_OVER": 0.3, f"{trials}.LOOKED_AT": 0.6}
    for name, value in quick.items():
        monkeypatch.setattr(name, value)
    monkeypatch.setattr("gaitwright.cli.operators.TRIED_ON", ())
    cycle = tmp_path / "high.json"
    cycle.write_text(json.dumps(CYCLE))
    teach = ["operators", book, "--size", "0.05", "--leg", "FR", "--cycle", str(cycle), "--name", "high"]
    assert main(teach) == 0
    told = capsys.readouterr()
    assert "add --accept" in told.err and "trot" in told.out and names(book) == SHOWN
    assert main([*teach, "--accept"]) == 0
    assert names(book) == [*SHOWN, "high"]
    assert main(["operators", book, "--first", "high"]) == 0
    assert names(book) == ["high", *SHOWN]
    picture = tmp_path / "operators.png"
    assert main(["operators", book, "--out", str(picture)]) == 0
    assert picture.stat().st_size > 30_000
    assert main(["operators", book, "--forget", "high"]) == 0
    assert names(book) == SHOWN


def test_it_is_taught_once(book, capsys):
    assert main(["teach", "--lesson", "operators", "--robot", "go2", "--out", book]) == 0
    assert "has 2 terrain operators already" in capsys.readouterr().err
    assert names(book) == SHOWN


@pytest.mark.parametrize(
    ("argv", "told"),
    [
        (["--kind", "hole"], "--kind says what is taught: add --size"),
        (["--accept"], "--accept says what is taught: add --size"),
        (
            ["--first", "nobody"],
            "no operator in go2.skills 'nobody'; there is: over an obstacle, over a hole",
        ),
        (["--forget", "a", "--first", "b"], "one thing at a time"),
        (["--size", "0.05", "--kind", "wall"], "no kind of obstacle 'wall'"),
        (["--size", "0.05", "--leg", "XX"], "no leg of go2 'XX'"),
        (["--size", "0.05", "--skill", "fly"], "no skill 'fly'"),
        (["--size", "0.05", "--cycle", "none.json"], "none.json"),
        (["--size", "-1"], "not greater than 0"),
        (["--size", "7"], "as high as the body"),
        (["--out", "a.csv"], "a picture ends in .png"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(book, argv, told, capsys, monkeypatch):
    monkeypatch.chdir(Path(book).parent)
    assert main(["operators", "go2.skills", *argv]) in (2, 3)
    error = capsys.readouterr().err
    assert told in error and error.count("\n") == 1
