"""The school's command: a book that explains itself and drives, and refusals that leave nothing."""

from pathlib import Path

import pytest

from gaitwright.cli import main, teach
from gaitwright.skillbook.book import Skillbook


@pytest.fixture(scope="module")
def book(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("school") / "pupil.skills"
    with pytest.MonkeyPatch.context() as short:
        short.setattr(teach, "EXAM", 8)
        assert main(["teach", "--lesson", "skills", "--trips", "1", "--out", str(path)]) == 0
    return path


def test_the_book_holds_every_lesson(book: Path) -> None:
    held = Skillbook.load(book)
    assert held.robot == "go2" and len(held.rulebook.rules) >= 10
    assert held.replayed() == held.rulebook


def test_it_explains_itself(book: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(book), "--rule", "climb"]) == 0
    assert "climb" in capsys.readouterr().out


def test_a_book_is_never_overwritten(book: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = book.read_bytes()
    assert main(["teach", "--out", str(book)]) == 2
    assert "exists" in capsys.readouterr().err and book.read_bytes() == before


def test_rules_and_their_driver_go_together(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mission", "--driver", "hybrid", "--goal", "2", "0"]) == 2
    assert "--skillbook" in capsys.readouterr().err
