"""Sentences that are true of the book: why, why not, history, the trees with their marks, what would
change."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hand_made import GARDEN, at, book_of, garden, rule_of
from random_books import random_book, random_forest, random_situation

from gaitwright.errors import WrongUse
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.counterfactual import counterfactual
from gaitwright.knowledge.explain import forest_text, history, why, why_not
from gaitwright.knowledge.json_form import dumps, loads
from gaitwright.knowledge.rules import Preference, Rulebook, status


@pytest.fixture
def book():
    return garden()


def test_why_names_the_conditions_the_nearest_others_and_what_nobody_has_seen(book):
    told = why(book, consult(book, at("gravel", "medium")))
    assert told.startswith("trot, because the ground is gravel (firm) and the speed is medium (calm)")
    assert "run would need speed to be fast" in told
    assert "nobody has yet seen trot where the ground is gravel and the speed is medium: grey" in told
    assert "grey" not in why(book, consult(book, at()))


def test_why_tells_of_rules_that_come_after():
    book = book_of(GARDEN, {"walk": {}, "rest": {}})
    told = why(book, consult(book, at()))
    assert told == "walk, because no lesson speaks against it; rest could fire too, but comes after it."
    assert why_not(book, "rest", at()) == "rest could fire, but walk comes before it."
    wished = replace(book, preferences=(Preference("walk", "rest", at(), "lap 7"),))
    assert why_not(wished, "rest", at()) == "rest could fire, but walk comes before it, as lap 7 taught."


def test_why_not_names_the_tree_and_the_lesson_behind_it(book):
    assert why_not(book, "run", at()) == "run would need speed to be fast, not slow, since lap 3."
    assert why_not(book, "trot", at()).startswith("trot does fire: trot, because")
    with pytest.raises(WrongUse, match="no rule 'rum'"):
        why_not(book, "rum", at())
    nothing = Rulebook(GARDEN, (*book.rules, rule_of(GARDEN, "hop", right={}, wrong={"lap 4": at()})))
    assert "nobody has seen it right" in why_not(nothing, "hop", at())


def test_history_tells_status_and_every_move(book):
    head, *moves = history(book, "run")
    assert head == "run is a rule shell: 1 right and 2 wrong situations, 0 lessons since a mark moved"
    assert moves[0] == "lap 1: run is new"
    assert moves[-1] == "lap 3: the upper mark in speed went from any to fast: run was wrong at speed slow"


def test_the_trees_show_their_marks(book):
    assert forest_text(book, "trot") == (
        "ground\n"
        "  any\n"
        "    firm ▲\n"
        "      + flat ▼\n"
        "      ? gravel\n"
        "    slope\n"
        "      − uphill\n"
        "      − downhill\n"
        "speed\n"
        "  any\n"
        "    calm ▲\n"
        "      + slow ▼\n"
        "      ? medium\n"
        "    − fast\n"
        "heading\n"
        "  any ▲\n"
        "    + forward ▼\n"
        "    ? backward"
    )


def test_counterfactuals_name_the_smallest_change(book):
    found = counterfactual(book, at())
    assert found.decision.rule == "run"
    assert found.sentence == "run would fire if the speed is fast instead of slow"
    to_run = counterfactual(book, at(), to="run", keep=["speed"])
    assert to_run.decision is None
    assert to_run.sentence == "no change was found after which run fires while speed stays as it is"
    assert counterfactual(book, at(), to="trot").changes == ()
    with pytest.raises(WrongUse, match="no rule 'trott'"):
        counterfactual(book, at(), to="trott")
    with pytest.raises(WrongUse, match="no tree 'sped'"):
        counterfactual(book, at(), keep=["sped"])


@pytest.mark.parametrize("seed", range(12))
def test_counterfactuals_are_true_and_none_is_smaller(seed):
    """Against all situations of a small forest."""
    rng = np.random.default_rng(seed)
    forest = random_forest(rng, 3, 4)
    book = random_book(rng, forest, 5, 0.3)
    everywhere = [forest.at(p) for p in itertools.product(*(range(len(t.leaves)) for t in forest.trees))]
    decided = [consult(book, other).rule for other in everywhere]
    now = random_situation(rng, forest)

    def cost(other):
        pairs = zip(forest.trees, now.values, other.values, strict=True)
        steps = [grown.steps(a, b) for grown, a, b in pairs]
        return sum(step > 0 for step in steps), sum(steps)

    for to in ("", *(rule.name for rule in book.rules)):
        found = counterfactual(book, now, to)
        fits = [
            cost(other)
            for other, rule in zip(everywhere, decided, strict=True)
            if (rule == to if to else rule != consult(book, now).rule)
        ]
        assert (found.decision is None) == (not fits)
        if found.decision is not None:
            assert consult(book, found.decision.situation) == found.decision
            assert cost(found.decision.situation) == min(fits)
            assert len(found.changes) == min(fits)[0]


def test_a_rule_that_is_only_proposed_does_not_fire_and_says_so(book):
    """Books of older versions hold such rules."""
    back = rule_of(GARDEN, "trot backward", {"heading": "backward"})
    seen = tuple(replace(instance, kind="analogy for") for instance in back.positives)
    back = replace(back, positives=seen, proposed=True)
    proposed = replace(book, rules=(back, *book.rules))
    assert status(back) == "proposed" and not audit(proposed)
    here = at(heading="backward")
    assert "trot backward" not in consult(proposed, here).conflict
    assert "only proposed" in why_not(proposed, "trot backward", here)
    assert loads(dumps(proposed)) == proposed
    confirmed = replace(book, rules=(replace(back, proposed=False), *book.rules))
    assert consult(confirmed, here).rule == "trot backward"
