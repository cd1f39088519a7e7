"""`gaitwright books`: nothing is lost from file to text and back; of two books one, and each difference
told."""

import json
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.json_form import dumps
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.trees import tree
from gaitwright.skillbook import Skillbook, content_hash, export_text
from skillbook.schooling import corrected, taught_skillbook

FOREST = Forest((tree("ground", ("flat", "grass", "stairs")), tree("light", ("day", "night"))))


def lesson(rule: str, ground: str, name: str) -> Lesson:
    situation = FOREST.situation({"ground": ground, "light": "day"})
    return Lesson("omission", rule, situation, name, action=Action(rule))


@pytest.fixture(autouse=True)
def books(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Skillbook, Skillbook]:
    """Two books that went apart, in an empty folder: both teach what to do on grass, and not the same."""
    monkeypatch.chdir(tmp_path)
    base = Skillbook.new(FOREST, "go2", "base")
    base.save("base.skills")
    ours = corrected(base.forked("a"), lesson("trot", "grass", "mine"))
    theirs = corrected(base.forked("b"), lesson("walk", "grass", "yours"))
    theirs = corrected(theirs, lesson("climb", "stairs", "steps"))
    ours.save("a.skills")
    theirs.save("b.skills")
    return ours, theirs


def files() -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path().iterdir()}


def test_a_merge_tells_each_conflict_and_what_to_do(capsys):
    before = files()
    assert main(["books", "merge", "a.skills", "b.skills", "--out", "both.skills"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "mine of ours teaches trot and yours of b walk: ours stays." in told
    assert "ours a.skills, called a, of go2: 1 rule from 1 lesson" in told
    assert "new rules climb" in told and "gaitwright books merge b.skills a.skills --out NEW" in told
    book = Skillbook.load("both.skills")
    assert book.name == "both" and {rule.name for rule in book.rulebook.rules} == {"trot", "climb"}
    assert book.replayed() == book.rulebook
    assert {**before, "both.skills": Path("both.skills").read_bytes()} == files()


def test_a_merge_reports_figures(capsys):
    words = ["books", "merge", "a.skills", "b.skills", "--base", "base.skills", "--out", "both.skills"]
    assert main([*words, "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["new_rules"] == ["climb"] and report["hash"] == content_hash(Skillbook.load("both.skills"))
    (conflict,) = report["conflicts"]
    assert (conflict["ours"], conflict["theirs"]) == (["mine"], ["yours"])


def test_a_merge_with_nothing_new_says_so(capsys):
    assert main(["books", "merge", "a.skills", "base.skills", "--out", "both.skills"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "nothing: ours has all that it was taught" in told and "conflicts none" in told


def test_a_book_goes_to_text_and_back(capsys):
    book = taught_skillbook(5, 8)
    book.save("c.skills")
    assert main(["books", "export", "c.skills"]) == 0
    assert capsys.readouterr().out == export_text(book)
    assert main(["books", "export", "c.skills", "--out", "c.txt"]) == 0
    assert main(["books", "import", "c.txt", "--out", "again.skills", "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert Skillbook.load("again.skills") == book
    assert (report["hash"], report["name"]) == (content_hash(book), book.name)


def test_a_text_changed_by_hand_is_taken_with_a_word(books, capsys):
    text = export_text(books[0])
    for name, told in (("a", "make these rules"), ("quiet", "make other rules")):
        Path("c.txt").write_text(text if name == "a" else text.replace('"quiet":0', '"quiet":3', 1))
        assert main(["books", "import", "c.txt", "--out", f"{name}-again.skills"]) == 0
        assert told in capsys.readouterr().out


def test_rules_as_json_become_a_book_that_can_be_merged(books):
    Path("garden.json").write_bytes(dumps(books[1].rulebook))
    assert main(["books", "import", "garden.json", "--out", "garden.skills"]) == 0
    assert Skillbook.load("garden.skills").rulebook == books[1].rulebook
    assert main(["books", "merge", "a.skills", "garden.skills", "--out", "both.skills"]) == 0


MERGE = ("books", "merge", "a.skills")
WRONG = [
    (("books",), 2, "required: TASK, FILE"),
    (
        ("books", "mrge", "a.skills"),
        2,
        "no task of books 'mrge'; there is: merge, export, import; did you mean",
    ),
    (MERGE, 2, "books merge takes 2: OURS THEIRS; got a.skills"),
    (("books", "export", "a.skills", "b.skills"), 2, "books export takes 1: BOOK; got a.skills b.skills"),
    ((*MERGE, "b.skills"), 2, "name its file with --out"),
    ((*MERGE, "b.skills", "--out", "-"), 2, "name its file with --out"),
    ((*MERGE, "b.skills", "--out", "b.skills"), 2, "b.skills exists: name a new skillbook"),
    ((*MERGE, "b.skills", "--out", "no/c.skills"), 2, "there is no folder no for c.skills"),
    ((*MERGE, "c.skills", "--out", "d.skills"), 3, "no file c.skills"),
    ((*MERGE, "notes.txt", "--out", "d.skills"), 3, "notes.txt is no skillbook; what was exported"),
    ((*MERGE, "b.skills", "--base", "strange.skills", "--out", "d"), 2, "do not both go on from 'book 9'"),
    (("books", "export", "a.skills", "--base", "b.skills"), 2, "books export has no use for it"),
    (("books", "export", "a.skills", "--json", "-"), 2, "cannot both go to the standard output"),
    (("books", "export", "a.skills", "--out", "notes.txt"), 2, "notes.txt exists"),
    (("books", "export", "notes.txt"), 3, "notes.txt is no skillbook"),
    (("books", "import", "notes.txt", "--out", "d.skills"), 3, "does not begin with"),
    (("books", "import", "a.skills", "--out", "d.skills"), 3, "a.skills is a skillbook already"),
    (("books", "import", "noise", "--out", "d.skills"), 3, "noise is no text"),
    (("books", "import", "half.txt", "--out", "d.skills"), 3, "a part of it is missing"),
    (
        ("books", "import", "none.txt", "--out", "d.skills"),
        3,
        "no file none.txt: what `gaitwright books export`",
    ),
    (("books", "import", "bad.json", "--out", "d.skills"), 3, "bad.json is not JSON"),
]


@pytest.mark.parametrize(("words", "code", "sentence"), WRONG, ids=lambda value: str(value)[:40])
def test_what_cannot_be_done_is_told_in_a_sentence_and_leaves_nothing(words, code, sentence, books, capsys):
    Path("notes.txt").write_text("nothing of a book")
    Path("noise").write_bytes(b"\xff\xfe\x00")
    Path("bad.json").write_text("{rules}")
    text = export_text(books[0])
    Path("half.txt").write_text(text[: len(text) // 2], encoding="utf-8")
    taught_skillbook(9, 2).save("strange.skills")
    before = files()
    assert main(list(words)) == code
    out, err = capsys.readouterr()
    assert sentence in err and out == "" and err.splitlines()[-1].startswith("gaitwright: ")
    assert files() == before
