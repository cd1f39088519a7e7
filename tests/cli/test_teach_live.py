"""A lesson in a terminal: what is typed is done or refused in a sentence, and what was kept drives a robot
elsewhere and is explained."""

import io
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.knowledge.memory import Action
from gaitwright.learning.notes import pupil_of
from gaitwright.skillbook import Skillbook, open_for_learning

ICE = ("--scene", "slippery:0.3", "--goal", "3", "0", "--speed", "0.6")


def typed(monkeypatch: pytest.MonkeyPatch, book: Path, where: tuple[str, ...], *lines: str) -> int:
    """The exit code of a lesson in which these lines are typed."""
    monkeypatch.setattr("sys.stdin", io.StringIO("\n".join(lines)))
    return main(["teach", "--live", "--out", str(book), *where])


@pytest.fixture(scope="module")
def taught(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A book in which somebody taught to trot, and to walk on a slippery road."""
    book = tmp_path_factory.mktemp("live") / "ice.skills"
    with pytest.MonkeyPatch.context() as patch:
        lines = "right trot 0.2 1.0", "keep", "go 0.4", "ok", "quit"
        assert typed(patch, book, ("--goal", "3", "0"), *lines) == 0
        lines = "go 0.8", "right walk 0.1 0.25 because grip as 'walk on ice'", "keep", "go 0.4", "quit"
        assert typed(patch, book, ICE, *lines) == 0
    return book


def test_what_was_typed_is_in_the_book(taught: Path) -> None:
    book = Skillbook.load(taught)
    told = [step.told for step in book.steps if step.told]
    assert [one.rule for one in told] == ["trot", "trot", "walk on ice"]
    assert [one.given for one in told] == ["corrected", "confirmed", "corrected"]
    assert told[-1].action == Action("walk", 0.1, 0.25) and told[-1].about == "grip"
    assert told[-1].id == "slippery:0.3 (seed 0) at 0.80 s" and told[-1].facts["grip"] == 0.3
    assert pupil_of(book).rulebook().rules == book.rulebook.rules


def test_each_word_does_what_it_says(taught, tmp_path, monkeypatch, capsys) -> None:
    book = tmp_path / "copy.skills"
    book.write_bytes(taught.read_bytes())
    lines = (
        "help", "look", "rules", "lessons", "why", "right run because grip", "back", "go 0.2",
        "right run because grip", "keep", "undo", "forget slippery:0.3 (seed 0) at 0.80 s", "quit",
    )  # fmt: skip
    assert typed(monkeypatch, book, ICE, *lines) == 0
    out = " ".join(capsys.readouterr().out.split())
    for words in (
        "to where another skill is used", "grip 0.3", "1. ", "3 lessons; the last first", "Not learned.",
        "run at 0.6 to 2.5 m/s is right, because of grip (0.3)", "Learned as", "Forgotten: slippery:0.3",
        "Over what you have seen here", "1 lesson kept",
    ):  # fmt: skip
        assert words in out
    assert [one.rule for one in pupil_of(Skillbook.load(book)).told] == ["trot", "trot"]


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("fly", "no word 'fly'"),
        ("right", "right is which skill?"),
        ("right fly", "no skill 'fly'"),
        ("right walk 3", "walk goes at 0 to 0.45 m/s"),
        ("right walk fast", "a number is wanted"),
        ("right walk because weather", "no number 'weather'"),
        ("right walk because", "write because NUMBER"),
        ("right walk as 'a\x07b'", "names that can be read"),
        ("right walk 'until turn is sideways'", "a number is wanted"),
        ("right walk until turn is sideways", "no value of turn 'sideways'"),
        ("keep", "nothing to keep"),
        ("at 0.1", "cannot be gone back to in a mission that runs"),
        ("go -3", "a number from 0 on is wanted"),
        ("go nan", "a number from 0 on is wanted"),
        ("forget", "forget which lesson?"),
        ("forget the past", "no lesson 'the past' that counts"),
        ("why not", "no rule 'not'"),
        ("'unbalanced", "no line of words"),
    ],
)
def test_what_makes_no_sense_is_told_and_changes_nothing(taught, monkeypatch, capsys, line, told) -> None:
    before = Skillbook.load(taught)
    assert typed(monkeypatch, taught, ICE, line) == 0
    assert told in " ".join(capsys.readouterr().err.split())
    assert Skillbook.load(taught) == before


@pytest.mark.parametrize(
    ("words", "code", "told"),
    [
        (("--scene", "flat"), 2, "--scene is where a person teaches: add --live"),
        (("--live",), 2, "teach where?"),
        (("--live", "--recording", "x", "--goal", "1", "1"), 2, "has its own scene and goal"),
        (("--live", "--goal", "1", "1", "--trips", "3"), 2, "with --live a person teaches"),
        (("--live", "--scene", "stairs", "--goal", "99", "1"), 2, "lies outside scene stairs"),
        (("--live", "--recording", "none.npz"), 3, "cannot be read"),
        (("--policy", "none.toml"), 3, "cannot be read"),
    ],
)
def test_options_that_make_no_sense_leave_nothing(tmp_path, capsys, words, code, told) -> None:
    book = tmp_path / "a.skills"
    assert main(["teach", "--out", str(book), *words]) == code
    assert told in capsys.readouterr().err and not book.exists()


def test_a_lesson_in_which_nothing_was_said_leaves_no_book(tmp_path, monkeypatch) -> None:
    assert typed(monkeypatch, tmp_path / "a.skills", ICE, "quit") == 0
    assert not (tmp_path / "a.skills").exists()


def test_two_teachers_at_once_are_one_too_many(taught, monkeypatch, capsys) -> None:
    with open_for_learning(taught):
        assert typed(monkeypatch, taught, ICE, "quit") == 3
    assert "in use by another process" in capsys.readouterr().err


def test_what_was_taught_drives_a_mission_elsewhere_and_is_explained(taught, tmp_path, capsys) -> None:
    out = tmp_path / "trip"
    words = ["mission", "--driver", "hybrid", "--skillbook", str(taught), "--scene", "slippery:0.2"]
    words += ["--goal", "1.5", "0.2", "--speed", "0.5", "--out", str(out)]
    assert main(words) == 0
    assert "skills walk" in " ".join(capsys.readouterr().out.split())
    words = ["explain", str(taught), "--recording", str(out / "recording.npz"), "--at", "1.5"]
    assert main(words) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "walk on ice, because the grip of the ground is under" in told
    assert "trot would fire if the grip of the ground were at least" in told


def test_a_recording_is_taught_at_too(taught, tmp_path, monkeypatch, capsys) -> None:
    trip, book = tmp_path / "trip", tmp_path / "b.skills"
    words = ["mission", "--scene", "slippery:0.3", "--goal", "1", "0", "--speed", "0.4", "--out", str(trip)]
    assert main(words) == 0
    where = ("--recording", str(trip / "recording.npz"))
    lines = ("go 0.6", "at 1.2", "right walk because grip", "keep", "at 99", "go 99", "go", "quit")
    assert typed(monkeypatch, book, where, *lines) == 0
    captured = capsys.readouterr()
    assert "the recording goes from 0 to" in captured.err and "it is over" in captured.err
    (told,) = pupil_of(Skillbook.load(book)).told
    assert told.id == "recording.npz at 1.20 s" and told.facts["grip"] == pytest.approx(0.3)
