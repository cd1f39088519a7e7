"""A book keeps what the learned controller went through: added to, never lost, and damage is noticed."""

import sqlite3
from contextlib import closing
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lived import some_history
from profiles import profile_notes, some_profiles
from schooling import random_lesson, taught_skillbook, tell_in
from test_skillbook_damage import alter, refused, reseal, restate

from gaitwright.errors import WrongUse
from gaitwright.knowledge.trust import GRADES, Experience
from gaitwright.learning.merging import merge
from gaitwright.learning.notes import pupil_of
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning

ENTRIES = st.one_of(
    st.builds(
        Experience,
        st.sampled_from(["trot", "walk"]),
        st.sampled_from(["taught", "drove", "watched", "bug", "returned"]),
        st.floats(0.0, 1e5),
        why=st.text(st.characters(categories=("L", "N", "P")), max_size=9),
        facts=st.dictionaries(
            st.sampled_from(["slope", "goal"]), st.floats(-9, 9) | st.just("far"), max_size=2
        ),
    ),
    st.builds(
        lambda skill, grade: Experience(skill, "set", grade=grade), st.just("trot"), st.sampled_from(GRADES)
    ),
)
DROVE = Experience("trot", "drove", 4.0, why="flat (seed 1)")


@pytest.fixture
def book():
    return replace(taught_skillbook(31, 4), profiles=some_profiles(), trust=some_history())


@pytest.fixture
def path(tmp_path, book):
    return book.save(tmp_path / "a.skills")


@given(st.lists(ENTRIES, max_size=6), st.lists(ENTRIES, max_size=6))
@settings(max_examples=20)
def test_a_history_comes_back_from_ledger_file_and_text(tmp_path_factory, first, more):
    path = taught_skillbook(31, 0).save(tmp_path_factory.mktemp("books") / "a.skills")
    with open_for_learning(path) as ledger:
        ledger.trust(first)
        ledger.keep_profiles(some_profiles(), more)
        book = ledger.book
    assert book.trust == (*first, *more) and book.profiles == some_profiles()
    assert Skillbook.load(path) == book == import_text(export_text(book))
    assert Skillbook.load(book.save(path)) == book


def test_lessons_and_trust_do_not_touch_each_other(path, book, rng):
    with open_for_learning(path) as ledger:
        tell_in(ledger, pupil_of(ledger.book), random_lesson(rng, "new"))
        ledger.trust([DROVE])
        assert ledger.book.trust == (*book.trust, DROVE) and len(ledger.book.steps) == len(book.steps) + 1
    assert Skillbook.load(path).trust == (*book.trust, DROVE)


def test_a_fork_has_it_and_the_hash_knows_it(book):
    assert book.forked("b").trust == book.trust
    assert content_hash(replace(book, trust=book.trust[1:])) != content_hash(book)


@pytest.mark.parametrize(
    "wrong",
    [
        Experience("trot", "drove", -1.0),
        Experience("trot", "drove", float("nan")),
        Experience("trot", "set"),
        Experience("trot", "drove", 1.0, grade="partner"),
        Experience("x" * 300, "drove", 1.0),
    ],
)
def test_what_no_file_can_hold_is_said_before_it_is_kept(wrong, path, book):
    with open_for_learning(path) as ledger:
        with pytest.raises(WrongUse, match="a skillbook cannot hold this"):
            ledger.trust([wrong])
        assert ledger.book == book
    assert Skillbook.load(path) == book


# --- two books -------------------------------------------------------------------------------------
def test_of_two_books_both_trips_count_once_where_both_play_the_same(book):
    theirs = replace(book.forked("b"), trust=(*book.trust, DROVE))
    walked = Experience("walk-backward", "drove", 2.0)
    ours = replace(book, trust=(*book.trust, walked))
    joined = merge(ours, theirs).book
    assert joined.trust == (*book.trust, walked, DROVE)
    assert merge(joined, theirs).book == joined, "nothing is taken twice"


def test_what_was_lived_through_with_other_profiles_says_nothing_of_ours(book):
    other = (profile_notes("trot", first=-9.0), *some_profiles()[1:])
    theirs = replace(book.forked("b"), profiles=other, trust=(*book.trust, DROVE))
    assert merge(book, theirs).book.trust == book.trust
    without = replace(book, profiles=some_profiles()[2:], trust=())
    assert merge(without, theirs).book.trust == (*book.trust, DROVE), "it comes with profiles that come"
    assert merge(replace(book, robot="other"), theirs).book.trust == book.trust


# --- damage ----------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "statement",
    [
        "DELETE FROM trust WHERE place = 5",
        "DELETE FROM trust WHERE place = 1",
        "UPDATE trust SET place = 9 WHERE place = 5",
        "UPDATE trust SET content = replace(content, '12.5', '99.5')",
        "UPDATE trust SET seal = x'0011223344556677'",
    ],
)
def test_entries_missing_or_altered_are_noticed(path, statement):
    alter(path, statement)
    refused(path, "damaged")


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda e: e.update(seconds=-1.0), "seconds"),
        (lambda e: e.update(how="boasted"), "how"),
        (lambda e: e.update(grade="master"), "grade"),
        (lambda e: e.update(grade="skilled"), "trot has a grade that nobody set"),
        (lambda e: e.update(colour="red"), "unknown field `colour`"),
    ],
)
def test_hostile_entries_are_refused(path, edit, message):
    reseal(path, "trust", edit, "place = 1")
    assert message in refused(path)


def test_a_book_that_counts_otherwise_is_refused(path):
    restate(path, "book", (0,), {"trust": 900_000})
    refused(path, "of 900000 entries of trust it has 6")
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        db.execute("DROP TABLE trust")
    refused(path, "other tables than a skillbook of version 6")
