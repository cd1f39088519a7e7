"""The school's command: a book that explains itself and drives, and refusals that leave nothing."""

from pathlib import Path

import pytest

from gaitwright.cli import main, teach
from gaitwright.description.load import load_robot
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.teacher import ScriptedTeacher, teacher_for
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import Ledger

TRIPS = 2


@pytest.fixture(scope="module")
def book(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("school") / "pupil.skills"
    with pytest.MonkeyPatch.context() as short:
        short.setattr(teach, "EXAM", 8)
        assert main(["teach", "--lesson", "skills", "--trips", str(TRIPS), "--out", str(path)]) == 0
    return path


def test_the_book_holds_every_lesson(book: Path) -> None:
    held = Skillbook.load(book)
    assert held.robot == "go2" and len(held.rulebook.rules) >= 10
    assert pupil_of(held).rulebook().rules == held.rulebook.rules


def test_it_explains_itself(book: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(book), "--rule", "climb"]) == 0
    assert "climb" in capsys.readouterr().out


@pytest.mark.parametrize("lessons", [4, 30])
def test_an_interrupted_school_goes_on_to_the_same_book(
    lessons: int,
    book: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    again = tmp_path / "again.skills"
    words = ["teach", "--trips", str(TRIPS), "--out", str(again)]
    monkeypatch.setattr(teach, "EXAM", 8)
    with monkeypatch.context() as cut:
        left = iter(range(lessons))

        def tell(self: Ledger, *told: object) -> None:
            if next(left, None) is None:
                raise KeyboardInterrupt
            told_before(self, *told)

        told_before = Ledger.tell
        cut.setattr(Ledger, "tell", tell)
        assert main(words) == 130
    assert "goes on" in capsys.readouterr().err
    assert len(Skillbook.load(again).steps) == 1 + lessons
    assert main(words) == 0
    whole, continued = Skillbook.load(book), Skillbook.load(again)
    assert continued.rulebook == whole.rulebook and continued.pupil == whole.pupil


def test_a_book_that_is_done_stays_as_it_is(book: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(teach, "EXAM", 8)
    before = Skillbook.load(book)
    assert main(["teach", "--trips", str(TRIPS), "--out", str(book)]) == 0
    assert Skillbook.load(book) == before


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--robot", "hexapod"), "was taught on the robot go2"),
        (("--from", "x.skills"), "goes on from itself"),
    ],
)
def test_a_book_of_something_else_is_never_overwritten(
    words: tuple[str, ...], told: str, book: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = book.read_bytes()
    assert main(["teach", *words, "--out", str(book)]) == 2
    assert told in capsys.readouterr().err and book.read_bytes() == before


def test_no_other_file_is_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    assert main(["teach", "--out", str(tmp_path / "notes.txt")]) == 2
    assert "exists" in capsys.readouterr().err and (tmp_path / "notes.txt").read_text() == "mine"


def test_a_robot_of_six_legs_is_taught_what_it_has() -> None:
    teacher = teacher_for(load_robot("hexapod"))
    skills = {clause.action.skill for clause in teacher.policy}
    assert "trot" in skills and not skills & {"run", "gallop"}
    assert teacher_for(load_robot("go2")).policy == ScriptedTeacher().policy


def test_rules_and_their_driver_go_together(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mission", "--driver", "hybrid", "--goal", "2", "0"]) == 2
    assert "--skillbook" in capsys.readouterr().err
