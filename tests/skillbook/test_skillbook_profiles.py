"""A book keeps torque profiles beside what was taught: kept, replaced, taken out, and damage is noticed."""

import sqlite3
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec import structs
from profiles import profile_notes, some_profiles
from schooling import random_lesson, settle, taught_skillbook, tell_in
from test_skillbook_damage import alter, refused, reseal, restate

from gaitwright.errors import BadFile, WrongUse
from gaitwright.learning.notes import pupil_of
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning
from gaitwright.skillbook import profile_notes as limits
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of

TROT, EDITED, BACK = some_profiles()
FLOAT32 = st.floats(-1e5, 1e5, width=32)
VELOCITY = st.floats(-5.0, 5.0)
PROFILES = st.builds(
    lambda skill, command, numbers, edited: ProfileNotes(
        skill, command, 0.5, 0.75, (0.0, 0.5), np.array(numbers, "<f4").tobytes(), b"", 0.5, edited
    ),
    st.text(st.characters(categories=("L", "N")), min_size=1, max_size=8),
    st.tuples(VELOCITY, VELOCITY, VELOCITY),
    st.lists(FLOAT32, max_size=9),
    st.sampled_from(["", "softer"]),
)


@pytest.fixture
def book():
    return replace(taught_skillbook(31, 4), profiles=some_profiles())


@pytest.fixture
def path(tmp_path, book):
    return book.save(tmp_path / "a.skills")


@given(st.lists(PROFILES, max_size=6, unique_by=name_of))
@settings(max_examples=20)
def test_profiles_come_back_from_ledger_file_and_text(tmp_path_factory, profiles):
    path = taught_skillbook(31, 0).save(tmp_path_factory.mktemp("books") / "a.skills")
    with open_for_learning(path) as ledger:
        ledger.keep_profiles(profiles)
        book = ledger.book
    assert book.profiles == tuple(sorted(profiles, key=name_of))
    assert Skillbook.load(path) == book == import_text(export_text(book))
    assert Skillbook.load(book.save(path)) == book


def test_what_is_kept_takes_the_place_of_what_was_there(path, book):
    with open_for_learning(path) as ledger:
        for profiles in (
            (TROT, EDITED, BACK),
            (structs.replace(TROT, repeat=0.5), EDITED, BACK),
            (BACK,),
            (),
            (profile_notes("walk"), TROT),
        ):
            ledger.keep_profiles(profiles)
            assert ledger.book == replace(book, profiles=tuple(sorted(profiles, key=name_of)))
            assert Skillbook.load(path) == ledger.book
    with open_for_learning(path) as ledger:
        assert [name_of(profile) for profile in ledger.book.profiles] == [
            "trot 0.400 0.000 0.000",
            "walk 0.400 0.000 0.000",
        ]


def test_lessons_and_profiles_do_not_touch_each_other(path, book, rng):
    with open_for_learning(path) as ledger:
        pupil = pupil_of(ledger.book)
        tell_in(ledger, pupil, random_lesson(rng, "new"))
        ledger.keep_profiles((BACK,))
        settle(ledger, pupil)
        assert ledger.book.profiles == (BACK,) and len(ledger.book.steps) == len(book.steps) + 1
        assert Skillbook.load(path) == ledger.book


def test_a_fork_has_them_and_the_hash_knows_them(book):
    assert book.forked("b").profiles == book.profiles
    softer = (TROT, structs.replace(EDITED, edited="softer still"), BACK)
    assert content_hash(replace(book, profiles=softer)) != content_hash(book)


def test_an_interrupt_while_they_are_kept_leaves_those_that_were_there(path, book, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    with open_for_learning(path) as ledger:
        with monkeypatch.context() as patch:
            patch.setattr("gaitwright.skillbook.writer.rows.put", interrupted)
            with pytest.raises(KeyboardInterrupt):
                ledger.keep_profiles((BACK,))
        assert ledger.book == book == Skillbook.load(path)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ((TROT, TROT), "two profiles of one skill at one velocity"),
        ((TROT, profile_notes(command=(0.4004, 0.0, 0.0))), "two profiles of one skill at one velocity"),
        ((profile_notes(first=float("nan")),), "trot 0.400 0.000 0.000 holds what is no number"),
        ((structs.replace(TROT, table=b"abc"),), "trot 0.400 0.000 0.000 holds what is no number"),
        ((structs.replace(TROT, period=0.0),), "period"),
        ((profile_notes(command=(0.4, 0.0, float("inf"))),), "cannot hold this"),
        ((profile_notes("x" * 300),), "length"),
        (tuple(profile_notes(command=(k / 1000, 0.0, 0.0)) for k in range(4)), "4 profiles; 3 is the most"),
    ],
)
def test_what_no_file_can_hold_is_said_before_it_is_kept(wrong, told, path, book, monkeypatch):
    monkeypatch.setattr(limits, "MOST", 3)
    with open_for_learning(path) as ledger:
        with pytest.raises(WrongUse, match=told):
            ledger.keep_profiles(wrong)
        assert ledger.book == book
    with pytest.raises(WrongUse, match=told):
        replace(book, profiles=wrong).save(path)
    assert Skillbook.load(path) == book


# --- damage ----------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "statement",
    [
        "DELETE FROM profiles WHERE name LIKE 'walk-backward%'",
        "DELETE FROM profiles",
        "UPDATE profiles SET name = 'trot 0.500 0.000 0.000' WHERE name = 'trot 0.400 0.000 0.000'",
        "UPDATE profiles SET content = replace(content, '0.4', '0.5')",
        "UPDATE profiles SET seal = x'0011223344556677'",
    ],
)
def test_profiles_missing_or_altered_are_noticed(path, statement):
    alter(path, statement)
    refused(path, "damaged")


def test_a_profile_under_another_name_is_noticed_whoever_sealed_it(path):
    reseal(path, "profiles", lambda p: p.update(command=[0.5, 0.0, 0.0]), "name LIKE 'walk%'")
    refused(path, "of 3 profiles it has 3, or under other names")
    restate(path, "book", (0,), {"profiles": 900_000})
    refused(path, "of 900000 profiles it has 3")


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda p: p.update(table="AADAfw=="), "trot 0.400 0.000 0.000 holds what is no number"),  # NaN
        (lambda p: p.update(answers="AACA/w=="), "trot 0.400 0.000 0.000 holds what is no number"),  # -inf
        (lambda p: p.update(table="AAAA"), "holds what is no number"),
        (lambda p: p.update(table="not base 64!"), "base64"),
        (lambda p: p.update(command=[0.4, 0.0]), "length 3"),
        (lambda p: p.update(command=[1e6, 0.0, 0.0]), "command"),
        (lambda p: p.update(period=-1.0), "period"),
        (lambda p: p.update(duty=2.0), "duty"),
        (lambda p: p.update(offsets=[]), "offsets"),
        (lambda p: p.update(colour="red"), "unknown field `colour`"),
    ],
)
def test_hostile_profiles_are_refused(path, edit, message):
    reseal(path, "profiles", edit, "name = 'trot 0.400 0.000 0.000'")
    assert message in refused(path)


def test_a_profile_twice_in_a_text_is_refused(book):
    text = export_text(book)
    line = next(line for line in text.splitlines(keepends=True) if line.startswith("profile"))
    with pytest.raises(BadFile, match=r"a\.txt: it holds two profiles of one skill at one velocity"):
        import_text(text.replace(line, 2 * line), "a.txt")


def test_a_text_may_have_them_in_any_order(book):
    lines = export_text(book).splitlines()
    where = [k for k, line in enumerate(lines) if line.startswith("profile")]
    lines[where[0]], lines[where[-1]] = lines[where[-1]], lines[where[0]]
    assert import_text("\n".join(lines)) == book


def test_a_book_without_the_table_it_counts_is_refused(path):
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        db.execute("DROP TABLE profiles")
    refused(path, "other tables than a skillbook of version 6")
