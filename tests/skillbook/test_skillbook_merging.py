"""Two books that went apart, made one: nothing taught is lost without a word."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from schooling import corrected, random_lesson, taught_skillbook, truth_and_forest, truthful_lesson

from gaitwright.errors import WrongUse
from gaitwright.knowledge.analogy import confirm, mirrored
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit
from gaitwright.knowledge.trees import tree
from gaitwright.skillbook import Skillbook, export_text, import_text, merge
from gaitwright.skillbook.history import Step
from gaitwright.skillbook.merging.check import follows

SEEDS = st.integers(0, 1 << 30)
GROUND = tree("ground", ("flat", "grass", "stairs"))
LIGHT = tree("light", ("day", "night"))


def does(book, situation):
    rule = consult(book.rulebook, situation).rule
    return None if rule is None else book.rulebook[rule].action.skill


def sound(merged):
    """What any merged book is: one that learning could have made, that replays and is kept."""
    book = merged.book
    assert not audit(book.rulebook) and book.replayed() == book.rulebook
    assert import_text(export_text(book)) == book
    assert all(conflict.sentence for conflict in merged.conflicts)


def schooled(book, rng, lessons, draw):
    for _ in range(lessons):
        book = corrected(book, draw(rng))
    return book


@given(SEEDS)
@settings(max_examples=8)
def test_a_book_merged_with_itself_or_with_what_it_comes_from_is_itself(seed):
    book = taught_skillbook(seed, 5)
    rng = np.random.default_rng(seed)
    more = corrected(book, random_lesson(rng, book.rulebook.forest))
    assert merge(book, book).book == book and not merge(book, book).conflicts
    assert merge(more, book, base=book).book == more
    forward = merge(book, more)
    assert forward.book.rulebook == more.rulebook and forward.book.steps == more.steps
    assert forward.book.ancestors[-1].name == more.name and not forward.conflicts


@given(SEEDS)
@settings(max_examples=8)
def test_what_two_truthful_teachers_taught_is_all_there(seed):
    rng, truth = truth_and_forest(seed)

    def draw(rng):
        return truthful_lesson(rng, truth)

    base = schooled(Skillbook.new(truth.forest, "go2", "base"), rng, 5, draw)
    ours, theirs = schooled(base.forked("a"), rng, 6, draw), schooled(base.forked("b"), rng, 6, draw)
    merged = merge(ours, theirs, base)
    sound(merged)
    assert [(a.how, a.name) for a in merged.book.ancestors[-2:]] == [("merged", "a"), ("merged", "b")]
    reported = {i for conflict in merged.conflicts for i in (*conflict.ours, *conflict.theirs)}
    mine = {step.lesson.situation for step in ours.steps if step.lesson}
    looked_at = 0
    for book in (ours, theirs):
        for told in (step.lesson for step in book.steps if step.how == "taught"):
            stays = book is theirs and told.situation in mine  # where both were taught, ours stays
            if follows(book.rulebook, told) and not stays:
                looked_at += 1
                kept = does(merged.book, told.situation) == told.rule
                assert kept or {told.id, f"{told.id} of b"} & reported
    assert looked_at > 10
    if not merged.conflicts:
        assert merge(merged.book, theirs).book == merged.book


@given(SEEDS)
@settings(max_examples=6)
def test_of_teachers_who_contradict_each_other_nothing_is_lost_without_a_word(seed):
    rng = np.random.default_rng(seed)
    base = taught_skillbook(seed, 3, trees=2)

    def draw(rng):
        return random_lesson(rng, base.rulebook.forest)

    ours, theirs = schooled(base.forked("a"), rng, 6, draw), schooled(base.forked("b"), rng, 6, draw)
    merged = merge(ours, theirs)
    sound(merged)
    reported = {i for conflict in merged.conflicts for i in (*conflict.ours, *conflict.theirs)}
    looked_at = 0
    for step in theirs.steps[len(base.steps) :]:
        if step.how == "taught" and follows(theirs.rulebook, step.lesson):
            looked_at += 1
            kept = does(merged.book, step.lesson.situation) == step.lesson.action.skill
            assert kept or {step.lesson.id, f"{step.lesson.id} of b"} & reported
    assert looked_at


def lesson(rule, situation, **more):
    return Lesson("omission", rule, situation, action=Action(rule), **more)


@pytest.fixture
def base():
    return Skillbook.new(Forest((GROUND, LIGHT)), "go2", "base")


def at(book, ground, light="day"):
    known = {"ground": ground, "light": light}
    return book.rulebook.forest.situation({name: known[name] for name in book.rulebook.forest.names})


def test_one_situation_taught_two_ways_is_a_conflict_and_ours_stays(base):
    ours = corrected(base.forked("a"), lesson("trot", at(base, "grass"), id="mine"))
    theirs = corrected(base.forked("b"), lesson("walk", at(base, "grass"), id="yours"))
    theirs = corrected(theirs, lesson("climb", at(base, "stairs"), id="stairs"))
    merged = merge(ours, theirs)
    sound(merged)
    assert len(merged.conflicts) == 1
    conflict = merged.conflicts[0]
    assert (conflict.rule, conflict.trees, conflict.ours, conflict.theirs) == (
        "walk",
        (),
        ("mine",),
        ("yours",),
    )
    assert conflict.sentence == (
        "where ground grass, light day, mine of ours teaches trot and yours of b walk: ours stays"
    )
    assert does(merged.book, at(base, "grass")) == "trot"
    assert does(merged.book, at(base, "stairs")) == "climb"


def test_trees_of_both_are_there_and_lessons_know_them_by_measurement():
    flat = Skillbook.new(Forest((GROUND,)), "go2", "a")
    lit = Skillbook.new(Forest((LIGHT,)), "go2", "b")
    ours = corrected(flat, lesson("trot", at(flat, "grass"), raw={"light": "day"}))
    theirs = corrected(lit, lesson("stop", lit.rulebook.forest.situation({"light": "night"})))
    merged = merge(ours, theirs)
    sound(merged)
    assert merged.book.rulebook.forest == Forest((GROUND, LIGHT)) and not merged.conflicts
    assert merged.book.rulebook["trot"].marks_in("light").lower == "day"
    assert merged.book.rulebook["stop"].positives[0].situation.values == (None, "night")


def test_what_cannot_be_said_here_is_reported(base):
    other = tree("ground", ("flat", "ice"))
    theirs = Skillbook.new(Forest((other, LIGHT)), "go2", "b")
    theirs = corrected(theirs, lesson("creep", at(theirs, "ice"), id="slippery"))
    theirs = corrected(theirs, lesson("trot", at(theirs, "flat"), id="plain"))
    ours = corrected(base.forked("a"), lesson("walk", at(base, "stairs")))
    merged = merge(ours, theirs)
    sound(merged)
    assert [c.theirs for c in merged.conflicts] == [(), ("slippery",)]
    assert (
        "ground is flat or grass or stairs in our book and flat or ice in b" in merged.conflicts[0].sentence
    )
    assert does(merged.book, at(base, "flat")) == "trot"


def test_one_name_for_two_actions_becomes_two_rules(base):
    ours = corrected(base.forked("a"), lesson("go", at(base, "grass")))
    quick = Lesson("omission", "go", at(base, "flat"), action=Action("run"))
    merged = merge(ours, corrected(base.forked("b"), quick))
    sound(merged)
    assert does(merged.book, at(base, "grass")) == "go" and does(merged.book, at(base, "flat")) == "run"
    assert [c.rule for c in merged.conflicts] == ["go"]
    assert {rule.name for rule in merged.book.rulebook.rules} == {"go", "go of b"}


def edited(book, rulebook, note=""):
    events = rulebook.events[len(book.rulebook.events) :]
    step = Step("edited", None, replace(rulebook, events=()), note, events)
    return replace(book, rulebook=rulebook, steps=(*book.steps, step))


def test_what_was_changed_by_hand_is_taken_over(base):
    base = corrected(base, lesson("walk", at(base, "flat")))
    ours = corrected(base.forked("a"), lesson("trot", at(base, "grass")))
    back = mirrored(
        base.rulebook, "walk", "back", lambda a: replace(a, skill="back"), {"light": {"day": "night"}}
    )
    theirs = edited(base.forked("b"), back.rulebook)
    merged = merge(ours, theirs)
    sound(merged)
    assert merged.book.rulebook["back"].proposed and not merged.conflicts
    confirmed = edited(theirs, confirm(theirs.rulebook, "back", "seen").rulebook)
    again = merge(merged.book, confirmed)
    sound(again)
    assert not again.book.rulebook["back"].proposed and not again.conflicts
    less = edited(base.forked("c"), replace(base.rulebook, rules=()))
    gone = merge(ours, less)
    sound(gone)
    assert [c.sentence for c in gone.conflicts] == ["c took walk out by hand: it stays"]


def test_a_base_that_is_none_is_refused(base):
    with pytest.raises(WrongUse, match="do not both go on from"):
        merge(base, base, base=taught_skillbook(1))
