"""Algorithm C, its compiled form, and whole corrections with rule ordering."""

from dataclasses import replace

import numpy as np
import pytest
from random_books import is_below, random_book, random_forest, random_situation

from gaitwright.errors import WrongUse
from gaitwright.knowledge.compiled import compile_book, decide, decide_leaves, decide_many
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import prefer, relapses, teach
from gaitwright.knowledge.forest import Forest, replace_value
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit, learn
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import tree

FOREST = Forest(
    (
        tree("terrain", {"even": ("flat", "slippery"), "slope": ("uphill", "downhill")}),
        tree("speed", ("slow", "medium", "fast")),
    )
)


def by_plain_arrays(book, leaves):
    """Rule and certainty of many situations, from the paths in the trees: `(situations,)` each."""
    shape = (len(leaves), len(book.rules))
    may, sure = np.ones(shape, bool), np.ones(shape, bool)
    for k, rule in enumerate(book.rules):
        may[:, k] = rule.may_fire
        for place, (grown, marks) in enumerate(zip(book.forest.trees, rule.marks, strict=True)):
            under = [is_below(grown, leaf, marks.upper) for leaf in grown.leaves]
            inside = [is_below(grown, leaf, marks.lower) for leaf in grown.leaves]
            may[:, k] &= np.array(under)[leaves[:, place]]
            sure[:, k] &= np.array(inside)[leaves[:, place]]
    first = may.argmax(axis=1)
    fires = may.any(axis=1)
    rows = np.arange(len(leaves))
    return np.where(fires, first, -1), fires & sure[rows, first]


@pytest.mark.parametrize(("rules", "trees", "books"), [(14, 12, 14), (1, 1, 1), (64, 6, 3), (130, 5, 2)])
def test_compiled_decisions_are_the_same_in_a_million_situations(rng, rules, trees, books):
    for _ in range(books):
        book = random_book(rng, random_forest(rng, trees), rules)
        compiled = compile_book(book)
        sizes = [len(grown.leaves) for grown in book.forest.trees]
        leaves = rng.integers(0, sizes, (50_000, trees))
        fired, sure = decide_many(compiled, leaves)
        wanted, wanted_sure = by_plain_arrays(book, leaves)
        assert np.array_equal(fired, wanted) and np.array_equal(sure, wanted_sure)
        assert (fired >= 0).any() or rules == 1
        for k in range(4):
            decision = consult(book, book.forest.at(tuple(leaves[k].tolist())))
            name = book.rules[fired[k]].name if fired[k] >= 0 else None
            assert decision.rule == name and (decision.certainty == "sure") == sure[k]
            assert decide_leaves(compiled, leaves[k].tolist()) == (fired[k], sure[k])
            assert decide(compiled, dict(decision.situation.items())) == (name, sure[k])


def test_a_decision_lists_the_conflict_set_in_order_and_the_trees_in_doubt(rng):
    book = random_book(rng, random_forest(rng, 3), 8)
    for _ in range(50):
        situation = random_situation(rng, book.forest)
        decision = consult(book, situation)
        wanted = [
            rule.name
            for rule in book.rules
            if rule.may_fire
            and all(
                is_below(grown, value, marks.upper)
                for grown, marks, value in zip(book.forest.trees, rule.marks, situation.values, strict=True)
            )
        ]
        assert list(decision.conflict) == wanted
        assert decision.rule == (wanted[0] if wanted else None)
        assert decision.certainty == (("grey" if decision.grey else "sure") if wanted else "none")


def test_what_is_no_situation_is_refused_by_the_compiled_form_too(rng):
    compiled = compile_book(random_book(rng, FOREST, 3))
    with pytest.raises(WrongUse, match="missing: speed"):
        decide(compiled, {"terrain": "flat"})
    with pytest.raises(WrongUse, match="no value of terrain 'flatt'"):
        decide(compiled, {"terrain": "flatt", "speed": "slow"})
    with pytest.raises(WrongUse, match="got an array"):
        decide_many(compiled, np.array([[0, 3]]))
    with pytest.raises(WrongUse, match="got an array"):
        decide_many(compiled, np.array([[0, -1]]))


def test_an_empty_book_decides_nothing():
    book = Rulebook(FOREST)
    situation = FOREST.situation({"terrain": "flat", "speed": "slow"})
    assert consult(book, situation).rule is None
    assert decide(compile_book(book), dict(situation.items())) == (None, False)
    assert decide_many(compile_book(book), np.array([[0, 0]]))[0].tolist() == [-1]


def correct(book, rule, terrain, speed, **fields):
    situation = FOREST.situation({"terrain": terrain, "speed": speed})
    learned = teach(book, Lesson("omission", rule, situation, action=Action(rule), **fields))
    assert learned.trouble is None, learned.trouble.sentence
    assert consult(learned.rulebook, situation).rule == rule and not audit(learned.rulebook)
    return learned


def test_a_correction_ends_with_the_right_decision():
    book = correct(Rulebook(FOREST), "walk", "flat", "slow").rulebook
    learned = correct(book, "run", "flat", "fast")
    assert [event.rule for event in learned.events if event.mark == "upper"] == ["walk"]
    again = correct(learned.rulebook, "run", "flat", "fast")
    assert again.events == () and again.rulebook["run"].quiet == 1


def ordered(*lessons):
    """A book from lessons on single rules: ("+" | "-", rule, terrain, speed, blamed tree)."""
    forest = Forest((FOREST.trees[0], tree("speed", {"slow": (), "quick": ("medium", "fast")})))
    book = Rulebook(forest)
    for sign, rule, terrain, speed, *blame in lessons:
        kind = "omission" if sign == "+" else "commission"
        situation = forest.situation({"terrain": terrain, "speed": speed})
        lesson = Lesson(kind, rule, situation, action=Action(rule), blame=blame[0] if blame else "")
        learned = learn(book, lesson)
        assert learned.trouble is None, learned.trouble.sentence
        book = learned.rulebook
    return book, forest.situation({"terrain": "uphill", "speed": "fast"})


WALK_THEN_RUN = (
    ("+", "walk", "flat", "slow"),
    ("+", "run", "flat", "fast"),
    ("-", "run", "flat", "slow"),
)


def test_rules_are_ordered_before_they_are_narrowed():
    book, situation = ordered(*WALK_THEN_RUN)
    assert consult(book, situation).conflict == ("walk", "run")
    learned = teach(book, Lesson("omission", "run", situation, id="lap 7"))
    assert consult(learned.rulebook, situation).conflict == ("run", "walk")
    assert learned.rulebook["walk"] == book["walk"]  # ordered, not narrowed
    assert [event.mark for event in learned.events].count("order") == 1
    wish = learned.rulebook.preferences[0]
    assert (wish.better, wish.worse, wish.instance) == ("run", "walk", "lap 7")
    slow = learned.rulebook.forest.situation({"terrain": "flat", "speed": "slow"})
    assert consult(learned.rulebook, slow).rule == "walk"


def test_a_rule_rises_after_it_was_kept_out_of_what_those_it_passes_were_right_at():
    book, situation = ordered(*WALK_THEN_RUN, ("+", "walk", "slippery", "medium"))
    learned = teach(book, Lesson("omission", "run", situation))
    assert [rule.name for rule in learned.rulebook.rules] == ["run", "walk"]
    assert learned.rulebook["walk"] == book["walk"] and len(learned.rulebook["run"].negatives) == 2
    seen = learned.rulebook.forest.situation({"terrain": "slippery", "speed": "medium"})
    assert consult(learned.rulebook, seen).conflict == ("walk",)
    assert consult(learned.rulebook, situation).rule == "run" and not relapses(learned.rulebook)


def test_a_rule_is_narrowed_where_stored_instances_forbid_the_order():
    book, situation = ordered(
        *WALK_THEN_RUN, ("+", "walk", "slippery", "medium"), ("+", "run", "slippery", "fast")
    )
    book = learn(
        book, Lesson("omission", "run", replace_value(book.forest, situation, "speed", "medium"))
    ).rulebook
    book = learn(book, Lesson("commission", "walk", situation)).rulebook
    wide = Rulebook(book.forest, (replace(book["walk"], negatives=(), choices=()), book["run"]))
    assert prefer(wide, "run", "walk", situation, "lap 1") is None
    assert [rule.name for rule in teach(book, Lesson("omission", "run", situation)).rulebook.rules] == [
        "walk",
        "run",
    ]


def test_relapses_are_what_a_rule_before_took_away():
    book, situation = ordered(*WALK_THEN_RUN)
    book = teach(book, Lesson("omission", "run", situation, id="lap 5")).rulebook
    assert relapses(book) == ()
    undone = Rulebook(book.forest, (book["walk"], book["run"]))
    assert {lesson.id for lesson in relapses(undone)} == {"lesson 2", "lap 5"}


def test_the_worse_rule_sinks_where_the_better_one_cannot_rise():
    walk, *run = WALK_THEN_RUN
    middle = (
        ("+", "trot", "flat", "medium"),
        ("-", "trot", "flat", "slow"),
        ("-", "trot", "uphill", "fast", "terrain"),
    )
    book, situation = ordered(walk, *middle, *run)
    assert consult(book, situation).conflict == ("walk", "run")
    learned = teach(book, Lesson("omission", "run", situation))
    assert [rule.name for rule in learned.rulebook.rules] == ["trot", "run", "walk"]
    assert consult(learned.rulebook, situation).rule == "run" and not audit(learned.rulebook)


def test_a_wish_is_not_undone_by_a_later_one():
    book, situation = ordered(*WALK_THEN_RUN)
    book = teach(book, Lesson("omission", "run", situation)).rulebook
    assert prefer(book, "walk", "run", situation, "lap 8") is None
    assert prefer(book, "run", "walk", situation, "lap 9").rulebook.rules == book.rules


def test_a_correction_that_meets_a_contradiction_says_so_and_keeps_what_it_learned():
    book, situation = ordered(*WALK_THEN_RUN, ("+", "walk", "uphill", "fast"))
    learned = teach(book, Lesson("omission", "run", situation))
    assert learned.trouble is not None and learned.trouble.rule == "walk" and learned.trouble.same
    assert len(learned.rulebook["run"].positives) == 2 and not audit(learned.rulebook)
