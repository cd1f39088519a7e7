"""`skills --profile` and `books edit`: a profile drawn, as a table, edited, played, and taken back."""

import csv
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.learning.profile_books import notes_of
from gaitwright.learning.profile_lessons import taught
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skills.situation import FOREST
from oracles import robot_called

EDITED = "trot 0.406 0.000 0.000 edited"


@pytest.fixture(scope="module")
def trotting(tmp_path_factory) -> Path:
    """A book with one profile."""
    path = Skillbook.new(FOREST, "go2", "trotting").save(tmp_path_factory.mktemp("books") / "a.skills")
    with open_for_learning(path) as ledger:
        ledger.keep_profiles([notes_of(taught(robot_called("go2"), "trot"))])
    return path


def change(table: Path, more: float) -> None:
    """Adds a torque to the front left knee amid its swing."""
    rows = list(csv.reader(table.read_text().splitlines()))
    place = rows[1].index("FL knee torque [N·m]")
    for row in rows[2:]:
        if 0.6 < float(row[0]) < 0.95:
            row[place] = f"{float(row[place]) + more:.3f}"
    with table.open("w") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def test_a_profile_is_edited_shown_taken_in_played_and_taken_back(trotting, tmp_path, capsys, monkeypatch):
    for name, quick in (("STARTS", 1), ("SECONDS", 2.0), ("LOOKED_AT", 0.5)):
        monkeypatch.setattr(f"gaitwright.learning.profile_school.{name}", quick)
    table, book = tmp_path / "trot.csv", str(trotting)
    before = trotting.read_bytes()
    assert main(["skills", "--profile", "trot", "--skillbook", book, "--out", str(table)]) == 0
    change(table, -1.0)
    assert main(["books", "edit", book, str(table)]) == 0
    told = capsys.readouterr()
    assert "up to -1.00 N·m at FL knee" in told.err and "add --accept" in told.err and "as it was" in told.out
    assert trotting.read_bytes() == before, "only shown"
    assert main(["books", "edit", book, str(table), "--accept"]) == 0
    assert [notes.edited != "" for notes in Skillbook.load(trotting).profiles] == [False, True]
    picture = tmp_path / "trot.png"
    assert main(["skills", "--profile", "trot", "--skillbook", book, "--out", str(picture)]) == 0
    assert picture.stat().st_size > 50_000
    assert main(["skill", "--driver", "learned", "--skillbook", book, "--seconds", "1"]) == 0
    assert main(["books", "forget", book, EDITED]) == 0
    assert [notes.edited for notes in Skillbook.load(trotting).profiles] == [""]


@pytest.mark.parametrize(
    ("argv", "told"),
    [
        (["skills", "--profile", "trot"], "--profile SKILL and --skillbook BOOK go together"),
        (["skills", "--speed", "1"], "add --profile SKILL"),
        (["skills", "--profile", "walk", "--skillbook", "BOOK"], "a.skills 'walk'; there is: trot"),
        (["skills", "--profile", "trot", "--skillbook", "BOOK", "--out", "x.txt"], "a table in .csv"),
        (["books", "undo", "BOOK", "--accept"], "has no use for it"),
        (["books", "edit", "BOOK", "BOOK"], "no text in UTF-8"),
    ],
)
def test_what_cannot_be_shown_or_edited_is_said(argv, told, trotting, capsys):
    argv = [str(trotting) if word == "BOOK" else word for word in argv]
    assert main(argv) in (2, 3)
    assert told in " ".join(capsys.readouterr().err.split())
