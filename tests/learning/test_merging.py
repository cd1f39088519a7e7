"""Two books that went apart, made one: nothing that was told is lost without a word."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.told import Told
from gaitwright.learning.merging import Merged, decided, merge
from gaitwright.learning.notes import pupil_of, relearned
from gaitwright.learning.older_books import told_by
from gaitwright.skillbook import Skillbook, export_text, import_text, open_for_learning
from gaitwright.skillbook.history import all_told
from knowledge.random_books import random_book, random_forest
from skillbook.profiles import profile_notes
from skillbook.schooling import (
    begun,
    forget,
    forget_in,
    lesson,
    moment,
    random_lesson,
    settle,
    taught_skillbook,
    tell,
    tell_in,
    truthful_lesson,
    written_by,
)

SEEDS = st.integers(0, 1 << 30)
HERE = {"slope": 1.0, "possible": 0.5, "sway": 0.1}


def more(book: Skillbook, *told: Told) -> Skillbook:
    """The book after its pupil heard some more."""
    return tell(book, pupil_of(book), *told)


def schooled(book: Skillbook, rng: np.random.Generator, n: int, draw) -> Skillbook:
    """The book after lessons that are named after it."""
    return more(book, *(draw(rng, f"{book.name} {k}") for k in range(n)))


def sound(merged: Merged) -> None:
    """What any joined book is: one that learning could have made, that can be heard again and is kept."""
    book = merged.book
    assert not audit(book.rulebook) and relearned(book).rules == book.rulebook.rules
    assert import_text(export_text(book)) == book
    assert [event for step in book.steps for event in step.events] == list(book.rulebook.events)
    assert book.pupil.heard == len(all_told(book.steps))
    assert all(conflict.sentence for conflict in merged.conflicts)


def reported(merged: Merged) -> set[str]:
    """The lessons that conflicts speak of."""
    return {name for conflict in merged.conflicts for name in (*conflict.ours, *conflict.theirs)}


def does(book: Skillbook, told: list[Told]) -> list[bool]:
    """Whether a book's pupil does what some lessons say."""
    actions = decided(pupil_of(book), told)
    return [action == one.action for one, action in zip(told, actions, strict=True)]


@given(SEEDS)
@settings(max_examples=5)
def test_a_book_merged_with_itself_or_with_what_it_comes_from_is_itself(seed):
    book = taught_skillbook(seed % 1000, 8)
    later = more(book, random_lesson(np.random.default_rng(seed), "later"))
    assert merge(book, book) == Merged(book)
    assert merge(later, book, base=book) == Merged(later)
    forward = merge(book, later)
    assert (forward.book.rulebook, forward.book.steps) == (later.rulebook, later.steps)
    assert forward.book.pupil == later.pupil and not forward.conflicts
    assert forward.book.ancestors[-1].name == later.name


@pytest.mark.parametrize("draw", [truthful_lesson, random_lesson])
@given(seed=SEEDS)
@settings(max_examples=6)
def test_what_two_books_were_told_and_do_is_all_there_or_reported(draw, seed):
    rng = np.random.default_rng(seed)
    base = replace(schooled(begun(seed % 1000), rng, 8, draw), name="base")
    ours, theirs = schooled(base.forked("a"), rng, 12, draw), schooled(base.forked("b"), rng, 12, draw)
    merged = merge(ours, theirs, base)
    sound(merged)
    assert [(a.how, a.name) for a in merged.book.ancestors[-2:]] == [("merged", "a"), ("merged", "b")]
    assert merged.book.steps[: len(ours.steps)] == ours.steps
    assert [told.id for told in all_told(merged.book.steps)[20:]] == [f"b {k}" for k in range(12)]
    looked_at = 0
    for book in (ours, theirs):
        since = all_told(book.steps)[8:]
        for told, here, there in zip(since, does(book, since), does(merged.book, since), strict=True):
            looked_at += here
            assert there or not here or told.id in reported(merged)
            assert not (there and told.id in reported(merged))
    assert looked_at > 5
    assert merge(merged.book, theirs) == Merged(merged.book), "nothing is new a second time"


def test_the_joined_book_is_what_a_ledger_would_have_made(tmp_path):
    rng = np.random.default_rng(4)
    base = schooled(begun(), rng, 8, truthful_lesson)
    ours, theirs = schooled(base.forked("a"), rng, 5, truthful_lesson), base.forked("b")
    theirs = forget(theirs, pupil_of(theirs), "book 0 3")
    theirs = schooled(theirs, rng, 5, truthful_lesson)
    merged = merge(ours, theirs)
    path = ours.save(tmp_path / "a.skills")
    with open_for_learning(path) as ledger:
        pupil = pupil_of(ledger.book)
        forget_in(ledger, pupil, "book 0 3")
        for told in all_told(theirs.steps)[8:]:
            tell_in(ledger, pupil, told)
        settle(ledger, pupil)
    assert replace(merged.book, ancestors=ours.ancestors) == Skillbook.load(path)


def test_one_moment_told_two_ways_is_a_conflict_and_ours_stays():
    base = begun()
    ours = more(base.forked("a"), lesson("mine", HERE, "trot"))
    theirs = more(
        base.forked("b"), lesson("yours", HERE, "walk"), lesson("up", HERE | {"slope": 15.0}, "climb")
    )
    merged = merge(ours, theirs)
    sound(merged)
    (conflict,) = merged.conflicts
    assert (conflict.rule, conflict.ours, conflict.theirs) == ("walk", ("mine",), ("yours",))
    assert conflict.sentence == (
        "at one and the same moment mine of a (ours) teaches trot and yours of b walk: ours stays"
    )
    assert [told.id for told in all_told(merged.book.steps)] == ["mine", "up"]
    other = merge(theirs, ours)
    assert all_told(other.book.steps) == all_told(theirs.steps), "turned round, theirs stays"
    assert other.book == theirs and "ours stays" in other.conflicts[0].sentence


def test_the_same_lesson_under_another_name_is_told_once():
    base = begun()
    ours = more(base.forked("a"), lesson("mine", HERE, "trot"))
    theirs = more(base.forked("b"), lesson("yours", HERE, "trot"))
    assert merge(ours, theirs) == Merged(ours)


def test_names_that_clash_say_whose_they_are():
    base = begun()
    ours = more(
        base.forked("a"), lesson("trip 1", HERE, "trot"), lesson("trip 1 of b", HERE | {"sway": 0.2}, "trot")
    )
    theirs = more(base.forked("b"), lesson("trip 1", HERE | {"slope": 15.0}, "climb"))
    merged = merge(ours, theirs)
    sound(merged)
    assert [told.id for told in all_told(merged.book.steps)] == ["trip 1", "trip 1 of b", "trip 1 of b (2)"]
    same = merge(ours, replace(theirs, name="a"))
    assert all_told(same.book.steps)[-1].id == "trip 1 of the other a"


def test_what_theirs_forgot_is_forgotten_and_what_ours_forgot_stays_so():
    rng = np.random.default_rng(1)
    base = schooled(begun(), rng, 10, truthful_lesson)
    ours, theirs = base.forked("a"), base.forked("b")
    ours = more(ours, lesson("mine", HERE | {"sway": 0.2}, "walk"))
    ours = forget(ours, pupil_of(ours), "book 0 1")
    theirs = forget(theirs, pupil_of(theirs), "book 0 1")
    theirs = forget(theirs, pupil_of(theirs), "book 0 2")
    theirs = more(theirs, lesson("slip", HERE, "stop"), lesson("new", HERE | {"slope": 15.0}, "climb"))
    theirs = forget(theirs, pupil_of(theirs), "slip")
    merged = merge(ours, theirs)
    sound(merged)
    assert [step.note for step in merged.book.steps if step.how == "forgotten"] == ["book 0 1", "book 0 2"]
    counts = [told.id for told in pupil_of(merged.book).told]
    assert counts == [f"book 0 {k}" for k in range(10) if k not in (1, 2)] + ["mine", "new"]
    # told again, after it was forgotten
    again = more(theirs, replace(all_told(base.steps)[2], id="again"))
    assert [told.id for told in pupil_of(merge(ours, again).book).told][-2:] == ["new", "again"]


def test_what_the_joined_book_does_not_do_any_more_is_told_with_what_it_does():
    """Ours takes the trot there for certain; theirs was told once to stop, and did."""
    rng = np.random.default_rng(2)
    near = [moment(rng) | {"slope": 0.0, "possible": 1.0 + k / 100} for k in range(30)]
    base = begun()
    ours = more(base.forked("a"), *(lesson(f"a {k}", facts, "trot") for k, facts in enumerate(near)))
    theirs = more(base.forked("b"), lesson("once", near[7] | {"possible": 1.075}, "stop"))
    merged = merge(ours, theirs)
    sound(merged)
    since = [*all_told(ours.steps), *all_told(theirs.steps)]
    lost = [told for told, here in zip(since, does(merged.book, since), strict=True) if not here]
    assert reported(merged) == {told.id for told in lost}
    for told, conflict in zip(lost, merged.conflicts, strict=True):
        book, instead = ("b", "trot") if told.id == "once" else ("a (ours)", "stop")
        assert conflict.sentence == (
            f"{told.id} of {book} teaches {told.rule}, and the joined book does {instead} there"
        )


def test_books_of_other_robots_are_joined_and_of_other_beginnings_too():
    rng = np.random.default_rng(3)
    ours = schooled(begun(), rng, 8, truthful_lesson)
    theirs = replace(schooled(begun(1), rng, 8, truthful_lesson), robot="hexapod")
    merged = merge(ours, theirs)
    sound(merged)
    assert merged.book.robot == "go2" and len(all_told(merged.book.steps)) == 16


@pytest.mark.parametrize("went", ["nowhere", "ahead", "apart", "against each other"])
def test_profiles_are_ours_and_theirs_of_the_skills_that_ours_has_none_of(went):
    base = begun()
    mine, back = profile_notes("trot", first=1.0), profile_notes("walk-backward")
    run, walk, edited = profile_notes("run"), profile_notes("walk"), profile_notes("walk", edited="softer")
    ours = replace(base.forked("a"), profiles=(mine, back))
    theirs = replace(base.forked("b"), profiles=(run, profile_notes("trot", first=2.0), walk, edited))
    if went != "nowhere":
        theirs = more(theirs, lesson("yours", HERE, "trot"))
    if went in ("apart", "against each other"):
        ours = more(ours, lesson("mine", HERE | {"sway": 0.2 if went == "apart" else 0.1}, "walk"))
    merged = merge(ours, theirs).book
    assert merged.profiles == (run, mine, walk, edited, back)
    assert merged.ancestors[-1].name == "b" and import_text(export_text(merged)) == merged
    assert merge(merged, theirs).book == merged, "nothing is new a second time"
    assert merge(ours, replace(theirs, profiles=())).book.profiles == ours.profiles


def test_profiles_of_another_robot_stay_where_they_are():
    base = begun()
    ours, theirs = base.forked("a"), replace(base.forked("b"), robot="hexapod", profiles=(profile_notes(),))
    assert merge(ours, theirs) == Merged(ours)


def test_the_base_is_checked():
    rng = np.random.default_rng(5)
    base = schooled(begun(), rng, 3, truthful_lesson)
    ours, theirs = (schooled(base.forked(name), rng, 2, truthful_lesson) for name in "ab")
    assert merge(ours, theirs, base) == merge(ours, theirs)
    with pytest.raises(WrongUse, match="do not both go on from 'book 7'"):
        merge(ours, theirs, taught_skillbook(7, 3))


def test_an_older_book_is_told_again(tmp_path):
    school = written_by_school(tmp_path)
    told = told_by(school)
    assert told and not all_told(school.steps)
    ours = more(begun(), lesson("mine", HERE, "trot"))
    merged = merge(ours, school)
    sound(merged)
    assert [one.facts for one in all_told(merged.book.steps)[1:]] == [one.facts for one in told]
    other = merge(school, ours)
    sound(other)
    assert len(all_told(other.book.steps)) == len(told) + 1


def written_by_school(folder: Path) -> Skillbook:
    """What a school left when the first version was new."""
    return Skillbook.load(written_by(1, folder / "school.skills", "_school"))


def test_a_book_whose_rules_rest_on_no_lessons_is_refused_by_name():
    rng = np.random.default_rng(6)
    bare = Skillbook.new(random_book(rng, random_forest(rng, 3), 3), "go2", "bare")
    ours = more(begun(), lesson("mine", HERE, "trot"))
    for pair in ((ours, bare), (bare, ours)):
        with pytest.raises(WrongUse, match="the rules of bare rest on no lessons with measurements"):
            merge(*pair)
