"""Books of every version load forever, and a newer version can add tables.

`version_N.sql` is the file that version N wrote, `version_N.txt` the same book as text, `format_N.json` its
rulebook alone; `version_N_school.sql` a book that a school of then made.
"""

import sqlite3
from collections import Counter
from contextlib import closing
from pathlib import Path

import pytest
from lived import some_history
from places import map_notes, some_maps
from profiles import profile_notes, some_operators, some_profiles
from schooling import random_lesson, tell_in, written_by

from gaitwright.errors import BadFile
from gaitwright.knowledge import json_form
from gaitwright.learning.notes import pupil_as_noted, pupil_of, relearned
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook import Skillbook, import_text, open_for_learning, schema, text

HERE = Path(__file__).parent


@pytest.fixture
def first(tmp_path):
    """A book as version 1 wrote it."""
    return written_by(1, tmp_path / "first.skills")


def test_every_version_so_far_left_a_book():
    versions = range(1, len(schema.MIGRATIONS) + 1)
    assert {f"version_{k}.sql" for k in versions} == {path.name for path in HERE.glob("version_?.sql")}
    assert (HERE / f"version_{text.HEAD.split()[-1]}.txt").is_file()
    assert (HERE / f"format_{json_form.FORMAT}.json").is_file()


def test_a_rulebook_of_the_first_format_loads():
    written = (HERE / "format_1.json").read_bytes()
    book = import_text((HERE / "version_1.txt").read_text(encoding="utf-8"))
    assert json_form.loads(written) == book.rulebook


def test_a_book_of_the_first_version_loads(first):
    book = Skillbook.load(first)
    assert book == import_text((HERE / "version_1.txt").read_text(encoding="utf-8"))
    assert (book.name, book.robot, len(book.rulebook.rules)) == ("the first", "go2", 3)
    assert Counter(step.how for step in book.steps) == {"begun": 1, "taught": 7, "mended": 3}


def test_the_pupil_of_a_book_of_the_second_version_goes_on(tmp_path):
    book = Skillbook.load(written_by(2, tmp_path / "second.skills"))
    assert book == import_text((HERE / "version_2.txt").read_text(encoding="utf-8"))
    taught, rest = pupil_as_noted(book)
    assert (len(taught.told), len(rest), book.rulebook.lessons) == (14, 1, 15)
    assert in_old_trees(taught.rulebook(), book) == in_old_trees(book.rulebook, book)
    assert pupil_of(book).told == [*taught.told, *rest]
    assert relearned(book).lessons == 14, "it can be heard again, and may be learned otherwise now"


def test_the_profiles_of_a_book_of_the_third_version_are_there(tmp_path):
    path = written_by(3, tmp_path / "third.skills")
    book = Skillbook.load(path)
    assert book == import_text((HERE / "version_3.txt").read_text(encoding="utf-8"))
    assert (book.name, len(book.rulebook.rules), book.rulebook.lessons) == ("the third", 5, 7)
    assert book.profiles == some_profiles()
    assert pupil_of(book).rulebook().rules == book.rulebook.rules
    with open_for_learning(path) as ledger:
        ledger.keep_profiles((*book.profiles, profile_notes("walk")))
    assert len(Skillbook.load(path).profiles) == 4


def test_the_trust_in_a_book_of_the_fourth_version_goes_on(tmp_path):
    path = written_by(4, tmp_path / "fourth.skills")
    book = Skillbook.load(path)
    assert book == import_text((HERE / "version_4.txt").read_text(encoding="utf-8"))
    assert (book.name, book.profiles, book.trust) == ("the fourth", some_profiles(), some_history())
    with open_for_learning(path) as ledger:
        ledger.trust(some_history()[1:2])
    assert Skillbook.load(path).trust == (*some_history(), some_history()[1])


def test_the_operators_of_a_book_of_the_fifth_version_are_there(tmp_path):
    path = written_by(5, tmp_path / "fifth.skills")
    book = Skillbook.load(path)
    assert book == import_text((HERE / "version_5.txt").read_text(encoding="utf-8"))
    assert book.name == "the fifth" and book.trust and book.profiles
    assert book.operators == some_operators()
    with open_for_learning(path) as ledger:
        ledger.keep_operators(reversed(book.operators))
    assert Skillbook.load(path).operators == some_operators()[::-1]


def test_the_maps_of_a_book_of_the_sixth_version_are_there(tmp_path):
    path = written_by(6, tmp_path / "sixth.skills")
    book = Skillbook.load(path)
    assert book == import_text((HERE / "version_6.txt").read_text(encoding="utf-8"))
    assert book.name == "the sixth" and book.trust and book.profiles and book.operators == some_operators()
    assert book.maps == some_maps()
    with open_for_learning(path) as ledger:
        ledger.keep_map(map_notes("a maze (seed 2)"))
        ledger.keep_map(map_notes(some_maps()[0].place))
    kept = (map_notes("a maze (seed 2)"), map_notes(some_maps()[0].place), *some_maps()[1:])
    assert Skillbook.load(path).maps == kept


def in_old_trees(rulebook, book):
    """What the rules say in the trees that there were when the book was written."""
    trees = book.rulebook.forest.names
    return [
        (rule.name, rule.action, [rule.marks_in(tree) for tree in trees], [one.id for one in rule.positives])
        for rule in rulebook.rules
    ]


def test_older_books_can_be_given_profiles(first):
    book = Skillbook.load(first)
    with open_for_learning(first) as ledger:
        ledger.keep_profiles(some_profiles())
    assert book.profiles == () and Skillbook.load(first).profiles == some_profiles()


def test_a_newer_version_reads_and_teaches_older_books(first, rng, monkeypatch):
    book = Skillbook.load(first)
    more = "CREATE TABLE songs (name TEXT NOT NULL PRIMARY KEY, content TEXT NOT NULL) STRICT"
    with monkeypatch.context() as newer:
        newer.setattr(schema, "MIGRATIONS", (*schema.MIGRATIONS, more))
        newer.setattr("gaitwright.skillbook.store.MIGRATIONS", schema.MIGRATIONS)
        before = first.read_bytes()
        assert Skillbook.load(first) == book and first.read_bytes() == before
        with open_for_learning(first) as ledger:
            assert ledger.book == book
            tell_in(ledger, SkillPupil(), random_lesson(rng, "a new lesson"))
            taught = ledger.book
        with closing(sqlite3.connect(first)) as db:
            assert db.execute("SELECT count(*) FROM songs").fetchone() == (0,)
        assert Skillbook.load(first) == taught
    with pytest.raises(BadFile, match="book version 7, this one reads up to 6"):
        Skillbook.load(first)
