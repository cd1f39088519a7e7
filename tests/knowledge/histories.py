"""Random teaching histories, each checked after every lesson: run as a script for many of them."""

import sys
from itertools import product

import numpy as np
from random_books import is_below, random_forest, random_situation

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit, learn
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Rule, Rulebook

Taught = list[tuple[bool, Situation]]


def fires(forest: Forest, rule: Rule, situation: Situation) -> bool:
    """Whether a rule may fire, by the paths of its marks alone."""
    return all(
        is_below(tree, str(value), marks.upper)
        for tree, marks, value in zip(forest.trees, rule.marks, situation.values, strict=True)
    )


def some_conjunction_fits(forest: Forest, taught: Taught) -> bool:
    """Whether any choice of one value per tree holds all right and no wrong situations: all are tried."""
    for values in product(*(tree.values for tree in forest.trees)):
        if all(
            right
            == all(
                is_below(tree, str(leaf), value)
                for tree, leaf, value in zip(forest.trees, situation.values, values, strict=True)
            )
            for right, situation in taught
        ):
            return True
    return False


def run_history(
    rng: np.random.Generator, forest: Forest, lessons: int, complete: bool
) -> tuple[int, int, int]:
    """Teaches one rule by chance; asserts that nothing taught is lost, and, where `complete`, that each
    contradiction is one. Returns lessons, troubles, mended."""
    book, taught = Rulebook(forest), []
    troubles = mended = 0
    for _ in range(lessons):
        right = not taught or rng.random() < 0.5
        situation = random_situation(rng, forest)
        kind = ("positive" if rng.random() < 0.5 else "omission") if right else "commission"
        learned = learn(book, Lesson(kind, "skill", situation, action=Action("skill")))
        if learned.trouble is None:
            book = learned.rulebook
            taught.append((right, situation))
        else:
            troubles += 1
            assert learned.rulebook == book
            if complete and book.forest == forest:
                assert not some_conjunction_fits(forest, [*taught, (right, situation)])
            change = mend(book, learned.trouble)
            if change.how != "none":
                mended += 1
                book = change.rulebook
                taught.append((right, situation))
            else:
                assert (not right, situation) in taught
        for was_right, earlier in taught:
            assert any(fires(book.forest, rule, earlier) for rule in book.rules) == was_right
        if len(book.rules) > 1:  # the rule was split: a later lesson would be one for one of its parts
            break
    assert not audit(book)
    return len(taught), troubles, mended


def run_histories(seed: int, count: int, lessons: int) -> tuple[int, int, int]:
    rng = np.random.default_rng(seed)
    forests = [random_forest(rng, int(rng.integers(2, 4)), 4) for _ in range(60)]
    totals = np.zeros(3, dtype=int)
    for k in range(count):
        totals += run_history(rng, forests[k % len(forests)], 1 + k % lessons, k % 8 == 0)
    return int(totals[0]), int(totals[1]), int(totals[2])


if __name__ == "__main__":
    print(*run_histories(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])))
