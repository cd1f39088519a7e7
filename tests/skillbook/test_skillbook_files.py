"""A skillbook survives its file, its text and its own history, exactly."""

import os
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from schooling import mend_in, random_lesson, stepped, taught_skillbook, teach_in

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.analogy import mirrored
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.features import accept, propose_features
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.trees import tree
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning
from gaitwright.skillbook.history import Step
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
    assert book.replayed() == book.rulebook


def test_a_book_can_begin_with_rules_of_any_kind(tmp_path, rng):
    for _ in range(8):
        start = random_book(rng, random_forest(rng, 5), 7)
        book = Skillbook.new(start, "go2").forked("next").forked("last")
        book.save(tmp_path / "a.skills")
        assert Skillbook.load(tmp_path / "a.skills") == import_text(export_text(book)) == book
        assert [ancestor.how for ancestor in book.ancestors] == ["forked", "forked"]
        assert book.replayed() == start


def test_one_lesson_more_changes_few_lines(rng):
    book = taught_skillbook(7, 12)
    learned = teach(book.rulebook, random_lesson(rng, book.rulebook.forest))
    lesson = Lesson("positive", "x", random_lesson(rng, book.rulebook.forest).situation, id="new")
    more = stepped(book, Step("taught", lesson, None, ""), learned.rulebook)
    before, after = (export_text(b).splitlines() for b in (book, more))
    assert len(set(before) ^ set(after)) < 30 < len(before)
    assert export_text(replace(book, name="new name")).splitlines()[2:] == before[2:]


def test_lessons_appended_one_by_one_make_the_same_file_as_all_at_once(tmp_path, rng):
    path = tmp_path / "a.skills"
    started = Skillbook.new(random_forest(rng, 4), "go2", "a", 3)
    started.save(path)
    with open_for_learning(path) as ledger:
        for _ in range(25):
            lesson = random_lesson(rng, ledger.book.rulebook.forest)
            learned = teach_in(ledger, lesson)
            if learned.trouble is not None:
                mend_in(ledger, lesson, learned)
            assert Skillbook.load(path) == ledger.book
        book = ledger.book
    assert any(step.how == "mended" for step in book.steps)
    assert Skillbook.load(path) == book and book.replayed() == book.rulebook
    assert [event for step in book.steps for event in step.events] == list(book.rulebook.events)
    book.save(tmp_path / "b.skills")
    assert Skillbook.load(tmp_path / "b.skills") == book
    assert sorted(os.listdir(tmp_path)) == ["a.skills", "b.skills"]


def test_features_analogies_and_a_changed_order_are_kept(tmp_path):
    path = tmp_path / "a.skills"
    ground = tree("ground", ("flat", "grass"))
    forest = Forest((ground,))
    Skillbook.new(forest, "go2", "a").save(path)
    flat = forest.situation({"ground": "flat"})
    with open_for_learning(path) as ledger:
        teach_in(ledger, Lesson("omission", "walk", flat, raw={"friction": 0.9}, action=Action("walk")))
        wrong = Lesson("omission", "creep", flat, raw={"friction": 0.2}, action=Action("creep"))
        learned = teach_in(ledger, wrong)
        assert learned.trouble is not None and learned.trouble.same
        proposal = propose_features(ledger.book.rulebook, learned.trouble)[0]
        ledger.edit(accept(ledger.book.rulebook, proposal).rulebook, "a feature was accepted")
        ledger.edit(
            mirrored(ledger.book.rulebook, "walk", "back", lambda a: replace(a, skill="back"), {}).rulebook,
            "an analogy",
        )
        swapped = replace(ledger.book.rulebook, rules=ledger.book.rulebook.rules[::-1], preferences=())
        ledger.edit(swapped, "turned round")
        fewer = replace(ledger.book.rulebook, rules=ledger.book.rulebook.rules[1:], preferences=())
        book = ledger.edit(fewer, "one rule less")
    assert Skillbook.load(path) == book == import_text(export_text(book))
    assert book.replayed() == book.rulebook


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
    situation = book.rulebook.forest.at((0,) * 4)
    for lesson in (
        Lesson("omission", "x" * 300, situation, action=Action("x")),
        Lesson("omission", "x", situation, note="n" * 20_000, action=Action("x")),
        Lesson("omission", "x", situation, note="\ud800", action=Action("x")),
    ):
        with open_for_learning(path) as ledger, pytest.raises(WrongUse, match="skillbook"):
            teach_in(ledger, lesson)
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
        (lambda t: t.replace('"id":"lesson 1"', '"id":"\\ud800"', 1), "line"),
    ],
)
def test_text_that_is_no_book_is_refused(spoil, message):
    with pytest.raises(BadFile, match=message):
        import_text(spoil(export_text(taught_skillbook(3))), "a.txt")
