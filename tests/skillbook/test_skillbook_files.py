"""A skillbook survives its file, its text and its own history, exactly."""

import os
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from schooling import (
    begun,
    forget_in,
    random_lesson,
    settle,
    taught_skillbook,
    tell,
    tell_in,
    truthful_lesson,
)

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.told import Told
from gaitwright.learning.notes import relearned
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning
from knowledge.random_books import random_book, random_forest

SEEDS = st.integers(0, 1 << 30)


@given(SEEDS, st.integers(0, 12))
@settings(max_examples=12)
def test_a_book_comes_back_from_file_and_text_and_history(tmp_path_factory, seed, lessons):
    book = taught_skillbook(seed, lessons)
    path = tmp_path_factory.mktemp("books") / "a.skills"
    book.save(path)
    assert Skillbook.load(path) == book
    assert os.listdir(path.parent) == ["a.skills"]
    text = export_text(book)
    again = import_text(text)
    assert again == book and export_text(again) == text and content_hash(again) == content_hash(book)
    assert relearned(again).rules == book.rulebook.rules


def test_a_book_can_begin_with_rules_of_any_kind(tmp_path, rng):
    for _ in range(8):
        start = random_book(rng, random_forest(rng, 5), 7)
        book = Skillbook.new(start, "go2").forked("next").forked("last")
        book.save(tmp_path / "a.skills")
        assert Skillbook.load(tmp_path / "a.skills") == import_text(export_text(book)) == book
        assert [ancestor.how for ancestor in book.ancestors] == ["forked", "forked"]


def test_one_lesson_more_changes_few_lines(rng):
    book, pupil = begun(7), SkillPupil(7)
    for k in range(40):
        book = tell(book, pupil, truthful_lesson(rng, f"trip {k // 4}, moment {k}"))
    # what she does anyway moves no rule
    more = tell(book, pupil, replace(pupil.told[0], id="new"))
    before, after = (export_text(b).splitlines() for b in (book, more))
    assert len(set(before) ^ set(after)) < 30 < len(before)
    assert export_text(replace(book, name="new name")).splitlines()[2:] == before[2:]


def test_lessons_appended_one_by_one_make_the_same_file_as_all_at_once(tmp_path, rng):
    path = tmp_path / "a.skills"
    whole, pupil, other = begun(3), SkillPupil(3), SkillPupil(3)
    told = [random_lesson(rng, f"lesson {k}") for k in range(25)]
    whole.save(path)
    with open_for_learning(path) as ledger:
        for k, one in enumerate(told):
            tell_in(ledger, pupil, one)
            assert Skillbook.load(path) == ledger.book
            if k % 5 == 4:
                settle(ledger, pupil)
                assert Skillbook.load(path) == ledger.book
        forget_in(ledger, pupil, "lesson 7")
        book = ledger.book
    whole = tell(whole, other, *told)
    forgotten = other.forget("lesson 7")
    assert Skillbook.load(path) == book
    assert [step.told for step in book.steps[:-1]] == [step.told for step in whole.steps]
    assert book.rulebook.rules == other.rulebook().rules == relearned(book).rules
    assert book.rulebook.events == (*whole.rulebook.events, *forgotten)
    assert [event for step in book.steps for event in step.events] == list(book.rulebook.events)
    book.save(tmp_path / "b.skills")
    assert Skillbook.load(tmp_path / "b.skills") == book
    assert sorted(os.listdir(tmp_path)) == ["a.skills", "b.skills"]


def test_saving_takes_the_place_of_what_was_there(tmp_path):
    path = tmp_path / "a.skills"
    taught_skillbook(1).save(path)
    other = taught_skillbook(2)
    other.save(path)
    assert Skillbook.load(path) == other
    path.write_text("something else")
    other.save(path)
    (tmp_path / "link.skills").symlink_to(path)
    taught_skillbook(3).save(tmp_path / "link.skills")
    assert (tmp_path / "link.skills").is_symlink() and Skillbook.load(path) == taught_skillbook(3)
    with pytest.raises(WrongUse, match="is not a file"):
        other.save(tmp_path)


def test_a_book_on_a_medium_without_writing_is_read(tmp_path):
    path = tmp_path / "a.skills"
    book = taught_skillbook(4)
    book.save(path)
    path.chmod(0o400)
    tmp_path.chmod(0o500)
    before = (tmp_path.stat().st_mtime_ns, path.stat().st_mtime_ns, path.read_bytes())
    try:
        assert Skillbook.load(path) == book
    finally:
        tmp_path.chmod(0o700)
    # Where permissions bind nobody (root), this tells that nothing was made there.
    assert (tmp_path.stat().st_mtime_ns, path.stat().st_mtime_ns, path.read_bytes()) == before


def test_what_no_file_can_hold_is_said_before_it_is_written(tmp_path):
    path = tmp_path / "a.skills"
    book = taught_skillbook(5, 3)
    book.save(path)
    facts, walk = {"slope": 1.0}, Action("walk")
    for told in (
        Told("new", facts, "x" * 300, walk),
        Told("new", facts, "x", walk, because="n" * 20_000),
        Told("new", facts, "x", walk, because="\ud800"),
        Told("new", {f"fact {k}": 1.0 for k in range(2000)}, "x", walk),
    ):
        with open_for_learning(path) as ledger, pytest.raises(WrongUse, match="skillbook"):
            ledger.tell(told)
        assert Skillbook.load(path) == book
    with pytest.raises(WrongUse, match="skillbook"):
        replace(book, name="n" * 300).save(path)
    assert Skillbook.load(path) == book


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda t: t.replace("text 1", "text 2", 1), "does not begin with"),
        (lambda t: t[: len(t) // 2], "does not end with 'end'"),
        (lambda t: t.replace("\ntree ", "\nbush ", 1), "line 3: no line begins with 'bush'"),
        (lambda t: t.replace("\nbook ", "\n# ", 1), "no line begins with '#'"),
        (lambda t: t.replace('"quiet":', '"noisy":', 1), "unknown field `noisy`"),
        (lambda t: t.replace("\nmark {", "\nmark {{", 1), "line"),
        (
            lambda t: "\n".join(x for x in t.splitlines() if not x.startswith("book")),
            "line 'book' is missing",
        ),
        (lambda t: t.replace('"how":"begun"', '"how":"taught"', 1), "does not begin with a rulebook"),
        (lambda t: t.replace('"id":"trip 0, moment 1"', '"id":"\\ud800"', 1), "line"),
    ],
)
def test_text_that_is_no_book_is_refused(spoil, message):
    with pytest.raises(BadFile, match=message):
        import_text(spoil(export_text(taught_skillbook(3))), "a.txt")
