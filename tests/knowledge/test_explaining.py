"""Sentences that are true of the book: why, why not, history, the trees with their marks, what would
change."""

import itertools

import numpy as np
import pytest
from random_books import random_book, random_forest, random_situation

from gaitwright.errors import WrongUse
from gaitwright.knowledge.analogy import confirm, mirrored
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.counterfactual import counterfactual
from gaitwright.knowledge.explain import forest_text, history, why, why_not
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.json_form import dumps, loads
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit, learn
from gaitwright.knowledge.rules import Marks, Rulebook, status
from gaitwright.knowledge.trees import interval_tree, tree

FOREST = Forest(
    (
        tree("ground", {"firm": ("flat", "gravel"), "slope": ("uphill", "downhill")}, "the ground is"),
        interval_tree("speed", "m/s", (1.0, 2.0), {"calm": ("slow", "medium"), "fast": ()}, "the speed is"),
        tree("heading", ("forward", "backward")),
    )
)


def at(ground="flat", speed="slow", heading="forward"):
    return FOREST.situation({"ground": ground, "speed": speed, "heading": heading})


@pytest.fixture
def book():
    """Trot on the flat, run when fast, climb uphill."""
    book = Rulebook(FOREST)
    for k, (rule, situation, blame) in enumerate(
        [
            ("trot", at(), ""),
            ("run", at(speed="fast"), "speed"),
            ("climb", at("uphill"), "ground"),
            ("run", at(speed="slow"), ""),
        ]
    ):
        kind = "commission" if k == 3 else "omission"
        lesson = Lesson(kind, rule, situation, f"lap {k}", blame=blame, action=Action(rule))
        learned = learn(book, lesson) if k == 3 else teach(book, lesson)
        assert learned.trouble is None
        book = learned.rulebook
    return book


def test_why_names_the_conditions_the_nearest_others_and_what_nobody_has_seen(book):
    told = why(book, consult(book, at("gravel", "medium")))
    assert told.startswith("trot, because the ground is gravel (firm) and the speed is medium (calm)")
    assert "run would need speed to be fast" in told
    assert "nobody has yet seen trot where the ground is gravel and the speed is medium: grey" in told
    assert "grey" not in why(book, consult(book, at()))


def test_why_tells_of_rules_that_come_after():
    book = Rulebook(FOREST)
    for rule in ("walk", "rest"):
        book = learn(book, Lesson("omission", rule, at(), action=Action(rule))).rulebook
    told = why(book, consult(book, at()))
    assert told == "walk, because no lesson speaks against it; rest could fire too, but comes after it."
    assert why_not(book, "rest", at()) == "rest could fire, but walk comes before it."


def test_why_not_names_the_tree_and_the_lesson_behind_it(book):
    assert why_not(book, "run", at()) == "run would need speed to be fast, not slow, since lap 3."
    assert why_not(book, "trot", at()).startswith("trot does fire: trot, because")
    with pytest.raises(WrongUse, match="no rule 'rum'"):
        why_not(book, "rum", at())
    nothing = learn(book, Lesson("commission", "hop", at(), action=Action("hop"))).rulebook
    assert "nobody has seen it right" in why_not(nothing, "hop", at())


def test_history_tells_status_and_every_move(book):
    head, *moves = history(book, "run")
    assert head == "run is a rule shell: 1 right and 2 wrong situations, 0 lessons since a mark moved"
    assert moves[0].startswith("lap 1: run is new")
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


BACKWARD = {"heading": {"forward": "backward", "backward": "forward"}}


def to_walk_backward(action):
    return Action(f"{action.skill} backward", -action.fastest, -action.slowest)


def test_a_rule_is_proposed_by_analogy_and_fires_once_it_is_confirmed(book):
    learned = learn(book, Lesson("commission", "trot", at(heading="backward")))
    proposed = mirrored(learned.rulebook, "trot", "trot backward", to_walk_backward, BACKWARD)
    rule = proposed.rulebook["trot backward"]
    assert rule.action.skill == "trot backward" and status(rule) == "proposed"
    assert rule.marks_in("heading") == Marks("heading", "backward", "backward")
    assert rule.marks_in("ground") == book["trot"].marks_in("ground")
    assert "trot backward" not in consult(proposed.rulebook, at(heading="backward")).conflict
    assert "only proposed" in why_not(proposed.rulebook, "trot backward", at(heading="backward"))
    confirmed = confirm(proposed.rulebook, "trot backward", "lap 9").rulebook
    assert "trot backward" in consult(confirmed, at(heading="backward")).conflict
    assert loads(dumps(proposed.rulebook)) == proposed.rulebook and not audit(confirmed)
    with pytest.raises(WrongUse, match="nothing to confirm"):
        confirm(confirmed, "trot backward", "lap 10")


def test_what_is_seen_overrules_an_analogy(book):
    book = mirrored(book, "trot", "trot backward", to_walk_backward, BACKWARD).rulebook
    seen = learn(book, Lesson("positive", "trot backward", at("gravel", heading="backward")))
    assert seen.rulebook["trot backward"].may_fire
    against = learn(seen.rulebook, Lesson("commission", "trot backward", at(heading="backward")))
    assert against.trouble is None and not audit(against.rulebook)
    rule = against.rulebook["trot backward"]
    assert all(instance.seen for instance in (*rule.positives, *rule.negatives))
    assert any("by analogy gave way" in event.why for event in against.events)


def test_an_analogy_that_contradicts_itself_is_no_rule(book):
    book = learn(book, Lesson("commission", "trot", at(heading="backward"))).rulebook
    both = {"heading": {"backward": "forward"}}
    learned = mirrored(book, "trot", "trot too", to_walk_backward, both)
    assert learned.rulebook == book and learned.trouble is not None
    with pytest.raises(WrongUse, match="no leaf of heading 'sideways'"):
        mirrored(book, "trot", "trot too", to_walk_backward, {"heading": {"forward": "sideways"}})
    with pytest.raises(WrongUse, match="already"):
        mirrored(book, "trot", "run", to_walk_backward, BACKWARD)
