"""`gaitwright explain`: sentences that are true of the book, and one sentence for every wrong use."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright.cli import main
from gaitwright.cli.situation_args import asked, last_lessons, said, whatever
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import replace_value
from gaitwright.knowledge.json_form import dumps
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.sentences import history_lines
from knowledge.hand_made import GARDEN, at, garden, rule_of

FOREST, BOOK = GARDEN, garden()


@pytest.fixture(autouse=True)
def book(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The book's file, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    Path("garden.json").write_bytes(dumps(BOOK))
    return "garden.json"


def explained(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """What is printed, in one line."""
    assert main(["explain", "garden.json", *words]) == 0
    return " ".join(capsys.readouterr().out.split())


def figures(capsys: pytest.CaptureFixture[str], *words: str) -> dict:
    """What is reported; nothing else is on the standard output."""
    assert main(["explain", "garden.json", *words, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


# --- the book --------------------------------------------------------------------------------------
def test_a_book_is_told_rule_by_rule(capsys):
    told = explained(capsys)
    assert told.startswith(
        "garden.json knows 3 rules over 3 trees, from 4 lessons (3 shell). The first of them"
    )
    assert "trot shell 1 2 fires when the ground is firm (flat, gravel) and the speed is calm" in told
    assert "climb shell 1 0 fires wherever none before it does; grey in 3 of 3 trees" in told
    report = figures(capsys)
    assert [rule["name"] for rule in report["rules"]] == [rule.name for rule in BOOK.rules]
    assert report["rules"][0]["status"] == "shell"
    assert "decision" not in report


def test_a_book_without_rules_says_so(capsys, book):
    Path(book).write_bytes(dumps(Rulebook(FOREST)))
    assert "has no rules yet, over 3 trees: nobody has taught it" in explained(capsys)


def test_a_rule_nobody_has_seen_right_does_not_fire(capsys, book):
    hop = rule_of(GARDEN, "hop", right={}, wrong={"lap 4": at()})
    Path(book).write_bytes(dumps(replace(BOOK, rules=(*BOOK.rules, hop))))
    assert "hop empty 0 1 does not fire yet: nobody has seen it right" in explained(capsys)


def test_a_rule_is_told_with_its_trees(capsys):
    told = explained(capsys, "--rule", "trot")
    assert told.startswith("trot, a rule shell (1 right and 2 wrong, ")
    assert "firm ▲ + flat ▼ ? gravel slope − uphill" in told


def test_the_history_has_a_line_for_each_lesson(capsys):
    told = explained(capsys, "--history", "run")
    assert "lap 1: run is new; its lower marks were set where" in told
    assert "lap 3: the upper mark in speed went from any to fast: run was wrong at speed slow." in told
    assert figures(capsys, "--history", "run")["history"] == history_lines(BOOK, "run")


# --- a decision ------------------------------------------------------------------------------------
def test_a_decision_is_told_with_its_reasons(capsys):
    told = explained(capsys, "--situation", "ground=gravel", "speed=1.5 m/s", "heading=forward")
    for words in (
        "ground gravel speed medium heading forward trot fires: nobody has seen it right there yet.",
        "trot, because the ground is gravel (firm) and the speed is medium (calm)",
        "why not another climb could fire, but trot comes before it.",
        "run would need speed to be fast, not medium, since lap 3.",
        "run would fire if the speed is fast instead of medium.",
        "marks of trot",
        "ground gravel firm lap 2 flat lap 0",
    ):
        assert words in told
    assert "left open" not in told


def test_every_counterfactual_comes_true(capsys):
    for ground, speed in (("flat", "slow"), ("uphill", "fast"), ("downhill", "medium")):
        report = figures(capsys, "--situation", f"ground={ground}", f"speed={speed}", "heading=backward")
        here = FOREST.situation(report["situation"])
        assert report["decision"]["rule"] == consult(BOOK, here).rule
        assert report["counterfactuals"]
        for found in report["counterfactuals"]:
            changed = here
            for change in found["changes"]:
                assert changed[change["tree"]] == change["before"]
                changed = replace_value(FOREST, changed, change["tree"], change["after"])
            assert changed != here and consult(BOOK, changed).rule == found["tried"]
            assert found["sentence"].startswith(f"{found['tried'] or 'no rule'} would fire if")


def test_why_not_a_named_rule(capsys):
    report = figures(capsys, "--not", "run", "--situation", "ground=flat", "speed=slow")
    assert report["why_not"] == {"run": "run would need speed to be fast, not slow, since lap 3."}
    assert report["counterfactuals"][-1]["tried"] == "run"
    fires = figures(capsys, "--not", "trot", "--situation", "ground=flat", "speed=slow")
    assert list(fires["why_not"]) == ["climb", "run"] and fires["decision"]["rule"] == "trot"


def test_what_is_left_open_is_taken_from_the_last_lesson_and_said(capsys):
    report = figures(capsys, "--situation", "speed=slow")
    assert report["situation"] == {"ground": "flat", "speed": "slow", "heading": "forward"}
    assert report["taken_from"] == {"ground": "as at lap 3", "speed": "said", "heading": "as at lap 3"}
    assert report["left_open"].startswith("What was left open matters: ")
    alike = figures(capsys, "--situation", "ground=flat", "speed=slow")
    assert alike["left_open"] == "That is so whatever heading may be."
    assert "as at lap 3 ground flat; heading forward" in explained(capsys, "--situation", "speed=slow")


def test_a_value_above_the_leaves_is_filled_below_it(capsys):
    report = figures(capsys, "--situation", "ground=firm", "speed=slow", "heading=forward")
    assert report["situation"]["ground"] == "flat" and report["taken_from"]["ground"] == "as at lap 3"
    assert report["left_open"] == "That is so whatever ground may be."
    uphill = figures(capsys, "--situation", "ground=slope", "speed=slow", "heading=forward")
    assert uphill["situation"]["ground"] == "uphill" and uphill["taken_from"]["ground"] == "as at lap 2"


def test_whatever_is_true_of_all_values():
    """What is said of the trees left open, against all of their values."""
    found = set()
    for words in (["speed=slow"], ["ground=flat"], ["ground=slope"], ["ground=firm", "speed=calm"], []):
        values = said(words, FOREST)
        situation = asked(BOOK, values, {})
        every = [
            at(ground, speed, heading)
            for ground in FOREST["ground"].leaves_below(values.get("ground", "any"))
            for speed in FOREST["speed"].leaves_below(values.get("speed", "any"))
            for heading in FOREST["heading"].leaves
        ]
        alike = len({consult(BOOK, other).rule for other in every}) == 1
        assert whatever(BOOK, situation).startswith("That is so" if alike else "What was left open matters")
        found.add(alike)
    assert found == {True, False}


def test_the_last_lesson_comes_first():
    names = [name for name, _ in last_lessons(BOOK)]
    assert names[0] == "lap 3" and set(names) == {"lap 0", "lap 1", "lap 2", "lap 3"}


# --- a recording -----------------------------------------------------------------------------------
def test_a_recording_tells_what_it_can(capsys):
    assert main(["skill", "--seconds", "0.4", "--out", "run"]) == 0
    capsys.readouterr()
    report = figures(capsys, "--recording", "run/recording.npz", "--at", "0.2")
    assert report["at_s"] == pytest.approx(0.2, abs=0.003)
    assert report["taken_from"]["speed"] == "recorded" and report["situation"]["speed"] == "slow"
    assert report["taken_from"]["ground"] == "as at lap 3"
    report = figures(capsys, "--recording", "run/recording.npz", "--situation", "speed=fast")
    assert report["situation"]["speed"] == "fast"
    assert main(["explain", "garden.json", "--recording", "run/recording.npz", "--at", "9"]) == 2
    assert "--at 9: the recording goes from 0 to 0." in capsys.readouterr().err


# --- pictures --------------------------------------------------------------------------------------
def test_the_picture_goes_where_it_is_said(capsys):
    assert figures(capsys, "--plot")["picture"] == "runs/explain-garden.png"
    assert Path("runs/explain-garden.png").read_bytes().startswith(b"\x89PNG")
    figures(capsys, "--rule", "trot", "--out", "trot.png")
    assert Path("trot.png").stat().st_size > Path("runs/explain-garden.png").stat().st_size


# --- wrong use -------------------------------------------------------------------------------------
WRONG = [
    (["--rule", "trott"], "no rule 'trott'; there is: "),
    (["--rule", "trott"], "did you mean 'trot'?"),
    (["--not", "climp"], "did you mean 'climb'?"),
    (["--history", "runn"], "did you mean 'run'?"),
    (
        ["--situation", "gruond=flat"],
        "no tree 'gruond'; there is: ground, speed, heading; did you mean 'ground'?",
    ),
    (["--situation", "ground=flt"], "did you mean 'flat'?"),
    (["--situation", "ground"], "--situation ground: write TREE=VALUE; the trees are ground, speed, heading"),
    (["--situation", "ground="], "write TREE=VALUE"),
    (["--situation", "ground=flat", "ground=gravel"], "--situation says ground twice: flat and gravel"),
    (["--situation", "speed=nan"], "speed is not a number"),
    (["--situation", "heading=3"], "no value of heading '3'"),
    (["--at", "3"], "--at is a moment of a recording"),
    (["--rule", "trot", "--not", "run"], "not allowed with argument"),
    (["--out", "trot.pdf"], "the picture is a PNG file"),
]


@pytest.mark.parametrize(("words", "sentence"), WRONG)
def test_wrong_use_is_one_sentence(words: list[str], sentence: str, capsys):
    assert main(["explain", "garden.json", *words]) == 2
    shown = capsys.readouterr()
    assert sentence in shown.err and shown.out == ""
    assert len(shown.err.strip().splitlines()) == 1


def test_an_empty_book_asks_for_what_it_cannot_take_from_a_lesson(capsys, book):
    Path(book).write_bytes(dumps(Rulebook(FOREST)))
    assert main(["explain", book, "--situation", "speed=slow"]) == 2
    told = capsys.readouterr().err
    assert (
        "no lesson has a value of ground (flat, gravel, uphill, downhill); heading (forward, backward)"
        in told
    )


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"format": 1, "trees": []}', np.arange(9).tobytes()])
def test_a_file_that_is_no_rulebook_is_exit_code_3(content: bytes, capsys, book):
    Path(book).write_bytes(content)
    assert main(["explain", book]) == 3
    assert capsys.readouterr().err.startswith("gaitwright: garden.json")
    assert main(["explain", "none.json"]) == 3
    assert "no file none.json" in capsys.readouterr().err
