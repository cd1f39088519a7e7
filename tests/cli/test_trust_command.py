"""`gaitwright books trust`: what a book says of trust, why, and what a person sets."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.knowledge.trust import Experience, grades_in
from gaitwright.skillbook import Skillbook
from skillbook.profiles import some_profiles
from skillbook.schooling import begun

HISTORY = (
    Experience("trot", "taught"),
    Experience("trot", "drove", 40.0, why="blocks (seed 1)"),
    Experience("trot", "bug", why="rough:0.07 (seed 3): it fell at 4.2 s"),
)


@pytest.fixture(autouse=True)
def book(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Skillbook:
    """A book with profiles of two skills, of which one has a history."""
    monkeypatch.chdir(tmp_path)
    book = replace(begun(), profiles=some_profiles(), trust=HISTORY)
    book.save("a.skills")
    begun().save("rules.skills")
    return book


def said(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["books", "trust", *words]) == 0
    return " ".join(capsys.readouterr().out.split())


def test_a_line_for_each_skill(capsys):
    told = said(["a.skills"], capsys)
    assert "trot partner 0.47 40.0 1 bug: rough:0.07 (seed 3): it fell at 4.2 s" in told
    assert "walk-backward partner – – – no history yet" in told


def test_the_history_of_a_skill_and_what_each_entry_did(capsys):
    told = said(["a.skills", "trot"], capsys)
    assert "drove 40.0 0.93 skilled blocks (seed 1)" in told
    assert "bug 0.47 partner rough:0.07" in told and told.endswith("trot partner")
    assert "it has no history" in said(["a.skills", "walk-backward"], capsys)


def test_a_person_raises_and_lowers_it_and_that_is_in_the_history(capsys):
    assert said(["a.skills", "trot", "skilled"], capsys).endswith("trot skilled")
    assert said(["a.skills", "walk-backward", "apprentice"], capsys).endswith("walk-backward apprentice")
    book = Skillbook.load("a.skills")
    assert grades_in(book.trust) == {"trot": "skilled", "walk-backward": "apprentice"}
    assert [(e.how, e.grade, e.why) for e in book.trust[3:]] == [
        ("set", "skilled", "a person said so"),
        ("set", "apprentice", "a person said so"),
    ]


def test_the_figures(capsys):
    assert main(["books", "trust", "a.skills", "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    trot = report["skills"]["trot"]
    assert (trot["grade"], trot["motion_bugs"], trot["driven_s"]) == ("partner", 1, 40.0)
    assert [entry["what"] for entry in trot["history"]] == ["taught", "drove", "bug"]
    assert report["skills"]["walk-backward"] == {
        "grade": "partner", "trust": None, "driven_s": 0, "motion_bugs": 0, "history": [],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("words", "code", "sentence"),
    [
        (["a.skills", "gallop"], 2, "no skill in a.skills 'gallop'; there is: trot, walk-backward"),
        (["a.skills", "trot", "master"], 2, "'master'; there is: apprentice, assistant, partner, skilled"),
        (["rules.skills", "trot"], 2, "rules.skills holds no torque profiles: there is nothing to trust yet"),
        (["a.skills", "trot", "partner", "walk"], 2, "books trust takes 1 to 3: BOOK [SKILL [GRADE]]; got"),
        (["none.skills"], 3, "no file none.skills"),
        (["a.skills", "--out", "b.skills"], 2, "leave --out out"),
    ],
)
def test_what_cannot_be_shown_or_set_is_said_and_changes_nothing(words, code, sentence, capsys):
    before = {path.name: path.read_bytes() for path in Path().iterdir()}
    assert main(["books", "trust", *words]) == code
    assert sentence in " ".join(capsys.readouterr().err.split())
    assert {path.name: path.read_bytes() for path in Path().iterdir()} == before


def test_a_book_without_profiles_has_nothing_to_trust(capsys):
    assert main(["books", "trust", "rules.skills"]) == 0
    assert "there is nothing to trust yet" in capsys.readouterr().err
