"""Algorithms D and E, one step each, and what one rule makes of a row of lessons."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_books import is_below, parent, random_book, random_forest, random_situation

from gaitwright.errors import WrongUse
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.discriminate import discriminate, grey_trees
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.generalise import generalise
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, learn
from gaitwright.knowledge.rules import QUIET, Choice, Marks, Rulebook, outside, status
from gaitwright.knowledge.trees import tree

TERRAIN = tree("terrain", {"even": ("flat", "slippery"), "slope": ("uphill", "downhill")})
SPEED = tree("speed", {"calm": ("slow", "medium"), "quick": ("fast", "very fast")})
LIGHT = tree("light", ("day", "night"))
FOREST = Forest((TERRAIN, SPEED, LIGHT))
seeds = st.integers(0, 2**32 - 1)


def at(terrain: str, speed: str, light: str = "day"):
    return FOREST.situation({"terrain": terrain, "speed": speed, "light": light})


def taught(*lessons, book=None):
    """The book after lessons on one rule, given as ("+" | "-", situation, further fields)."""
    book = book or Rulebook(FOREST)
    for sign, situation, *more in lessons:
        kind = "omission" if sign == "+" else "commission"
        fields = more[0] if more else {}
        learned = learn(book, Lesson(kind, "trot", situation, action=Action("trot"), **fields))
        assert learned.trouble is None, learned.trouble.sentence
        book = learned.rulebook
    return book


@given(seeds)
def test_generalising_never_narrows_and_takes_the_situation_in(seed):
    rng = np.random.default_rng(seed)
    forest = random_forest(rng, 3)
    marks = random_book(rng, forest, 1).rules[0].marks
    situation = random_situation(rng, forest)
    after = generalise(forest, marks, situation)
    for grown, old, new, value in zip(forest.trees, marks, after, situation.values, strict=True):
        assert new.upper == old.upper
        assert is_below(grown, old.lower, new.lower) and is_below(grown, value, new.lower)
        assert new.lower == grown.least_upper_bound(old.lower, value)
    assert generalise(forest, after, situation) == after


@given(seeds)
def test_discriminating_never_widens_and_moves_one_mark_just_enough(seed):
    rng = np.random.default_rng(seed)
    forest = random_forest(rng, 3)
    marks = random_book(rng, forest, 1).rules[0].marks
    situation = random_situation(rng, forest)
    found = discriminate(forest, marks, situation)
    below = zip(forest.trees, marks, situation.values, strict=True)
    grey = [grown.name for grown, mark, value in below if not is_below(grown, value, mark.lower)]
    assert (found is None) == (not grey)
    if found is None:
        return
    moved = [(old, new) for old, new in zip(marks, found.marks, strict=True) if old != new]
    assert len(moved) <= 1
    assert {found.choice.tree, *found.choice.others} == set(grey)
    chosen = forest.names.index(found.choice.tree)
    grown, value, new = forest.trees[chosen], situation.values[chosen], found.marks[chosen]
    assert not is_below(grown, value, new.upper)
    for old, new in moved:
        assert new.lower == old.lower
        assert is_below(grown, new.upper, old.upper) and is_below(grown, new.lower, new.upper)
        assert is_below(grown, value, parent(grown, new.upper))  # one step higher would let it in


def test_the_first_instance_puts_lower_marks_on_leaves_and_leaves_upper_marks_at_the_roots():
    rule = taught(("+", at("flat", "medium")))["trot"]
    assert rule.marks == (
        Marks("terrain", "any", "flat"),
        Marks("speed", "any", "medium"),
        Marks("light", "any", "day"),
    )
    assert status(rule) == "shell"


def test_a_near_miss_leaves_no_choice():
    rule = taught(("+", at("flat", "medium")), ("-", at("uphill", "medium")))["trot"]
    assert rule.marks_in("terrain") == Marks("terrain", "even", "flat")
    assert rule.choices == (Choice("terrain"),)


def test_a_far_miss_keeps_its_alternatives_and_returns_to_them_when_the_choice_proves_wrong():
    wrong = ("-", at("uphill", "fast"), {"blame": "terrain"})
    book = taught(("+", at("flat", "medium")), wrong)
    assert book["trot"].choices == (Choice("terrain", ("speed",)),)
    learned = learn(book, Lesson("omission", "trot", at("downhill", "slow")))
    rule = learned.rulebook["trot"]
    assert rule.choices == (Choice("speed"),)
    assert rule.marks_in("terrain") == Marks("terrain", "any", "any")
    assert rule.marks_in("speed") == Marks("speed", "calm", "calm")
    assert outside(FOREST, rule, at("uphill", "fast")) == ["speed"]
    moved = {(event.tree, event.mark): event for event in learned.events}
    assert "wrong choice" in moved["terrain", "upper"].why
    assert (moved["speed", "upper"].before, moved["speed", "upper"].after) == ("any", "calm")


def test_the_teacher_says_which_tree_is_to_blame():
    for blame in ("terrain", "speed"):
        rule = taught(("+", at("flat", "medium")), ("-", at("uphill", "fast"), {"blame": blame}))["trot"]
        assert rule.choices[0].tree == blame


def test_a_far_miss_is_blamed_on_the_tree_where_most_values_are_lost():
    book = taught(("+", at("flat", "medium")), ("+", at("uphill", "medium")))
    book = taught(("+", at("flat", "medium", "night")), book=book)
    book = taught(("-", at("flat", "fast")), book=book)  # near: calm is left
    rule = taught(("+", at("flat", "medium")), ("-", at("uphill", "slow")))["trot"]
    assert rule.choices == (Choice("speed", ("terrain",)),)  # one of four values is left, not two
    assert rule.marks_in("speed").upper == "medium"
    assert book["trot"].marks_in("speed").upper == "calm"


def test_what_is_kept_out_already_moves_nothing():
    book = taught(("+", at("flat", "medium")), ("-", at("flat", "fast")))
    learned = learn(book, Lesson("commission", "trot", at("uphill", "very fast", "night")))
    assert learned.events == () and learned.rulebook["trot"].marks == book["trot"].marks
    assert learned.rulebook["trot"].choices[1].tree == "speed"


def test_a_rule_comes_from_empty_to_shell_to_stabilised_to_firm():
    book = taught(("-", at("flat", "fast")))
    assert status(book["trot"]) == "empty"
    book = taught(("+", at("flat", "slow")), book=book)
    assert status(book["trot"]) == "shell"
    assert outside(FOREST, book["trot"], at("flat", "fast")) == ["speed"]
    for k in range(QUIET):
        assert status(book["trot"]) == "shell", k
        book = taught(("+", at("flat", "slow")), book=book)
    assert status(book["trot"]) == "stabilised"
    book = taught(("+", at("uphill", "medium", "night")), book=book)
    assert status(book["trot"]) == "firm"


def test_repeated_instances_do_not_pile_up_but_measurements_are_kept():
    book = taught(*[("+", at("flat", "slow"))] * 50)
    assert len(book["trot"].positives) == 1 and book.lessons == 50
    book = taught(*[("+", at("flat", "slow"), {"raw": {"load": float(k)}}) for k in range(50)])
    assert 2 <= len(book["trot"].positives) <= 10


def test_events_say_what_moved_where_and_for_which_lesson():
    book = taught(("+", at("flat", "slow"), {"id": "lap 3"}), ("-", at("uphill", "slow"), {"id": "lap 9"}))
    last = book.events[-1]
    assert (last.instance, last.rule, last.tree, last.mark) == ("lap 9", "trot", "terrain", "upper")
    assert (last.before, last.after) == ("any", "even") and "wrong at terrain uphill" in last.why


def test_grey_trees_need_values():
    marks = (Marks("terrain", "any", "flat"), Marks("speed"), Marks("light", "any", "day"))
    assert grey_trees(FOREST, marks, at("uphill", "fast", "night")) == [0, 2]


def test_mistakes_of_the_caller_are_named():
    book = taught(("+", at("flat", "slow")))
    with pytest.raises(WrongUse, match="no rule 'trott'; there is: trot; did you mean 'trot'"):
        learn(book, Lesson("commission", "trott", at("flat", "slow")))
    with pytest.raises(WrongUse, match="no tree 'weather'"):
        learn(book, Lesson("commission", "trot", at("flat", "fast"), blame="weather"))
    other = Forest((LIGHT,)).situation({"light": "day"})
    with pytest.raises(WrongUse, match="the lesson is about"):
        learn(book, Lesson("positive", "trot", other))
    with pytest.raises(WrongUse, match="the lesson is about"):
        teach(book, Lesson("omission", "trot", other))
