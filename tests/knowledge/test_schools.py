"""A teacher who corrects every mistake ends with a rulebook that makes none, whatever the rules to be
learned."""

import itertools

import numpy as np
import pytest
from random_books import random_book, random_forest

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import relapses, teach
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Rulebook

PASSES = 12


def skill_at(book, situation):
    rule = consult(book, situation).rule
    return None if rule is None else book[rule].action.skill


def corrected(book, situation, skill):
    """The book after one correction, mended wherever it contradicts itself."""
    for _ in range(10):
        learned = teach(book, Lesson("omission", skill, situation, action=Action(skill)))
        book = learned.rulebook
        if learned.trouble is None:
            return book
        mended = mend(book, learned.trouble)
        assert mended.how != "none", mended.sentence
        book = mended.rulebook
    raise AssertionError("ten repairs were not enough")


@pytest.mark.parametrize("school", range(10))
def test_a_school_ends_without_mistakes_and_no_mistake_is_made_twice(school, rng):
    rng = np.random.default_rng([int(rng.integers(1 << 30)), school])
    forest = random_forest(rng, 4, 4)
    truth = random_book(rng, forest, 6, 0.4)
    places = itertools.product(*(range(len(grown.leaves)) for grown in forest.trees))
    asked = [(forest.at(p), skill) for p in places if (skill := skill_at(truth, forest.at(p))) is not None]
    book, mistakes = Rulebook(forest), []
    for _ in range(PASSES):
        before = len(mistakes)
        for k in rng.permutation(len(asked)):
            situation, skill = asked[k]
            done = skill_at(book, situation)
            if done != skill:
                mistakes.append((situation, done))
                book = corrected(book, situation, skill)
                assert skill_at(book, situation) == skill
                assert all(wrong is None or skill_at(book, s) != wrong for s, wrong in mistakes[-40:])
        if len(mistakes) == before:
            break
    assert len(mistakes) == before and len(set(mistakes)) == len(mistakes) > 0
    assert not audit(book) and not relapses(book)
