"""`gaitwright books`: nothing is lost from file to text and back; of two books one, and each difference
told."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from gaitwright.cli import book_lessons, main
from gaitwright.errors import BadFile
from gaitwright.knowledge.json_form import dumps
from gaitwright.learning.notes import pupil_of, relearned
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning
from skillbook.profiles import some_profiles
from skillbook.schooling import begun, lesson, taught_skillbook, tell

GRASS = {"slope": 1.0, "possible": 0.5, "sway": 0.3}
STEPS = {"slope": 15.0, "possible": 0.5, "sway": 0.1}
OLD = Path(__file__).parents[1] / "skillbook" / "version_1.txt"


@pytest.fixture(autouse=True)
def books(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Skillbook, Skillbook]:
    """Two books that went apart, in an empty folder: both teach what to do on grass, and not the same."""
    monkeypatch.chdir(tmp_path)
    base = begun()
    base.save("base.skills")
    a, b = base.forked("a"), base.forked("b")
    ours = tell(a, pupil_of(a), lesson("mine", GRASS, "trot"))
    steps = [lesson(f"steps {k}", STEPS | {"slope": 15.0 + k}, "climb", "slope") for k in range(6)]
    theirs = tell(b, pupil_of(b), lesson("yours", GRASS, "walk"), *steps)
    ours.save("a.skills")
    theirs.save("b.skills")
    return ours, theirs


def files() -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path().iterdir()}


def test_a_merge_tells_each_conflict_and_what_to_do(capsys):
    before = files()
    assert main(["books", "merge", "a.skills", "b.skills", "--out", "both.skills"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "mine of a (ours) teaches trot and yours of b walk: ours stays." in told
    assert "ours a.skills, called a, of go2: 1 rule from 1 lesson" in told
    assert "new rules climb" in told and "gaitwright books merge b.skills a.skills --out NEW" in told
    book = Skillbook.load("both.skills")
    assert book.name == "both" and {rule.name for rule in book.rulebook.rules} == {"trot", "climb"}
    assert relearned(book).rules == book.rulebook.rules
    assert {**before, "both.skills": Path("both.skills").read_bytes()} == files()


def test_a_merge_reports_figures(capsys):
    words = ["books", "merge", "a.skills", "b.skills", "--base", "base.skills", "--out", "both.skills"]
    assert main([*words, "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["new_rules"] == ["climb"] and report["hash"] == content_hash(Skillbook.load("both.skills"))
    (conflict,) = report["conflicts"]
    assert (conflict["ours"], conflict["theirs"]) == (["mine"], ["yours"])


def test_a_merge_tells_of_the_profiles_that_came_along(books, capsys):
    replace(books[1], profiles=some_profiles()).save("b.skills")
    assert main([*MERGE, "b.skills", "--out", "both.skills"]) == 0
    assert "taken from theirs 6 steps, 3 torque profiles" in " ".join(capsys.readouterr().out.split())
    assert Skillbook.load("both.skills").profiles == some_profiles()
    assert main(["books", "merge", "both.skills", "b.skills", "--out", "more.skills", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["new_profiles"] == 0


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
    for name, told in (("a", "heard again, make these rules"), ("quiet", "heard again, make other rules")):
        Path("c.txt").write_text(text if name == "a" else text.replace('"quiet":0', '"quiet":3', 1))
        assert main(["books", "import", "c.txt", "--out", f"{name}-again.skills"]) == 0
        assert told in capsys.readouterr().out


def test_rules_as_json_and_older_lessons_are_taken_as_they_stand(books, capsys):
    Path("garden.json").write_bytes(dumps(books[1].rulebook))
    assert main(["books", "import", "garden.json", "--out", "garden.skills"]) == 0
    assert "there are no lessons in it: its rules are taken" in " ".join(capsys.readouterr().out.split())
    assert Skillbook.load("garden.skills").rulebook == books[1].rulebook
    assert main(["books", "merge", "a.skills", "garden.skills", "--out", "both.skills"]) == 2
    assert "the rules of garden rest on no lessons with measurements" in capsys.readouterr().err
    assert main(["books", "import", str(OLD), "--out", "old.skills"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "its lessons are of an older kind, which nobody hears any more" in told


# --- lessons taken in and back ---------------------------------------------------------------------
def test_what_is_confirmed_drives_and_is_taken_back_in_one(books, capsys):
    before = Skillbook.load("b.skills")
    assert main(["books", "confirm", "b.skills", "descend"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "told 6 lessons, by analogy" in told and "decided there now descend 6" in told
    assert "a new rule: descend" in told and "gaitwright books undo b.skills" in told
    after = Skillbook.load("b.skills")
    assert "descend" in [rule.name for rule in after.rulebook.rules]
    assert len(after.steps) == len(before.steps) + 6 and relearned(after).rules == after.rulebook.rules
    assert main(["books", "undo", "b.skills", "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert len(report["forgotten"]) == 6 and "the rule descend is gone" in report["changed"]
    undone = Skillbook.load("b.skills")
    assert pupil_of(undone).told == pupil_of(before).told and "descend" not in report["rules"]
    assert main(["books", "confirm", "b.skills", "descend"]) == 0  # and again, under other names
    assert "descend" in [rule.name for rule in Skillbook.load("b.skills").rulebook.rules]


def test_the_last_lesson_and_any_other_are_forgotten_by_name(books, capsys):
    assert main(["books", "undo", "b.skills", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["forgotten"] == ["steps 5"]
    assert main(["books", "forget", "b.skills", "yours"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "b.skills forgets yours" in told and "the rule walk is gone" in told
    book = Skillbook.load("b.skills")
    assert [told.id for told in pupil_of(book).told] == [f"steps {k}" for k in range(5)]
    assert {rule.name for rule in book.rulebook.rules} == {"climb"}
    for _ in range(5):
        assert main(["books", "undo", "b.skills"]) == 0
    capsys.readouterr()
    assert main(["books", "undo", "b.skills"]) == 2
    assert "counts any more: there is nothing to undo" in capsys.readouterr().err


def test_a_book_in_use_is_left_alone(capsys):
    with open_for_learning("b.skills") as other:
        for words in (
            ["confirm", "b.skills", "descend"],
            ["undo", "b.skills"],
            ["forget", "b.skills", "yours"],
        ):
            assert main(["books", *words]) == 3
            assert "in use by another process" in capsys.readouterr().err
        assert Skillbook.load("b.skills") == other.book


def test_a_book_that_was_changed_meanwhile_is_left_alone(books):
    book = Skillbook.load("b.skills")
    with book_lessons.opened("b.skills", book) as ledger:
        ledger.tell(lesson("new", GRASS, "stop"))
    with pytest.raises(BadFile, match="was changed by another process"):
        book_lessons.opened("b.skills", book)
    book_lessons.opened("b.skills", Skillbook.load("b.skills")).close()  # and it is free again


def test_older_books_have_nothing_to_take_back(capsys):
    import_text(OLD.read_text(encoding="utf-8")).save("old.skills")
    before = Path("old.skills").read_bytes()
    assert main(["books", "undo", "old.skills"]) == 2
    assert "gaitwright teach --out old.skills" in " ".join(capsys.readouterr().err.split())
    assert Path("old.skills").read_bytes() == before


MERGE = ("books", "merge", "a.skills")
WRONG = [
    (("books",), 2, "required: TASK, FILE"),
    (
        ("books", "mrge", "a.skills"),
        2,
        "there is: merge, export, import, confirm, edit, undo, forget, trust, map; did you mean",
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
    (("books", "confirm", "b.skills"), 2, "books confirm takes 2: BOOK SKILL; got b.skills"),
    (("books", "confirm", "b.skills", "gallop"), 2, "for 'gallop': proposed are walk-backward, descend"),
    (
        ("books", "undo", "b.skills", "--out", "c.skills"),
        2,
        "books undo changes BOOK itself: leave --out out",
    ),
    (("books", "forget", "b.skills", "mine"), 2, "no lesson 'mine' that counts"),
    (("books", "forget", "c.skills", "mine"), 3, "no file c.skills"),
    (("books", "undo", "base.skills"), 2, "holds no lessons that can be told or taken back"),
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
