"""Algorithm C and its compiled form."""

import numpy as np
import pytest
from random_books import is_below, random_book, random_forest, random_situation

from gaitwright.errors import WrongUse
from gaitwright.knowledge.compiled import compile_book, decide, decide_leaves, decide_many
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
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
