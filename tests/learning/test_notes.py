"""A pupil put away in a book and taken out again is the same, and goes on the same."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.errors import BadFile
from gaitwright.learning.notes import notes_of, pupil_as_noted, pupil_of
from gaitwright.learning.school import attend, driven_trips
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skillbook import Skillbook, export_text, import_text, open_for_learning
from gaitwright.skills.situation import FOREST
from oracles import robot_called

DOG, TEACHER = robot_called("dog"), ScriptedTeacher()


@pytest.fixture(scope="module")
def put_away(tmp_path_factory):
    """A pupil after two trips, and her book."""
    pupil = SkillPupil(5)
    path = Skillbook.new(FOREST, "dog", "put away", 5).save(tmp_path_factory.mktemp("notes") / "a.skills")
    with open_for_learning(path) as ledger:
        attend(pupil, DOG, TEACHER, 5, 2, keep=lambda told, events: ledger.tell(told, events) and None)
        gone = pupil.told[7].id
        ledger.forget(gone, pupil.rulebook(), notes_of(pupil, len(pupil.told)), pupil.forget(gone))
        ledger.settle(pupil.rulebook(), notes_of(pupil, len(pupil.told) + 1))
        return pupil, ledger.book


def test_she_is_the_same(put_away):
    pupil, book = put_away
    again = pupil_of(import_text(export_text(book)))
    assert again.told == pupil.told and again.kinds == pupil.kinds and again.scenes == pupil.scenes
    for name in ("lines", "rivals", "draft", "age", "drafts", "since", "surprises", "drift", "seed"):
        assert getattr(again.pupil, name) == getattr(pupil.pupil, name)
    for mine, hers in zip(again.pupil.cases, pupil.pupil.cases, strict=True):
        assert np.array_equal(mine, hers, equal_nan=True)
    assert again.rulebook() == pupil.rulebook()


def test_she_goes_on_the_same(put_away):
    pupil, book = put_away
    one, other = pupil.copied(), pupil_of(book)
    trip = next(driven_trips(pupil, DOG, TEACHER, 6))
    for moment in trip[:40]:
        told = told_at(moment, TEACHER.ideal(moment.facts), "another")
        assert one.hear(told).events == other.hear(told).events
        assert one.pupil.lines == other.pupil.lines
    assert one.rulebook() == other.rulebook()


def test_what_was_told_after_the_notes_is_heard_when_the_book_is_opened(put_away, tmp_path):
    pupil, book = put_away
    moment = next(driven_trips(pupil, DOG, TEACHER, 7))[3]
    told = told_at(moment, TEACHER.ideal(moment.facts), "later")
    path = book.save(tmp_path / "b.skills")
    with open_for_learning(path) as ledger:
        ledger.tell(told)
    later = Skillbook.load(path)
    noted, rest = pupil_as_noted(later)
    assert noted.told == pupil.told and rest == [told]
    assert pupil_of(later).told == [*pupil.told, told]


def test_notes_that_are_about_something_else_are_refused(put_away):
    _, book = put_away
    notes = book.pupil
    for odd, told in (
        (replace_notes(notes, surprises=notes.surprises[:-1]), "other lessons"),
        (replace_notes(notes, weights=((notes.heard - 1, 1.0),)), "other lessons"),
        (replace_notes(notes, own=renamed(notes.own)), "which nobody measures here"),
    ):
        with pytest.raises(BadFile, match=told):
            pupil_of(replace(book, pupil=odd))


def replace_notes(notes, **changes):
    return type(notes)(**{name: getattr(notes, name) for name in notes.__struct_fields__} | changes)


def renamed(rules):
    """A list over a number that this version does not know."""
    first, *others = rules.rules
    bound, *rest = first.bounds
    odd = type(bound)("the weather", bound.low, bound.high)
    return type(rules)((type(first)(first.action, (odd, *rest)), *others), rules.otherwise)
