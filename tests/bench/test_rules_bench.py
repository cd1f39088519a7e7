"""What the bench of rules measures with: rulebooks, CLIPS's text, replays, and peers that are missing."""

import math
import re

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.context import Context
from gaitwright.bench.evidence import random_rulebooks, rule_decisions
from gaitwright.bench.evidence.clips_text import constructs, loops, symbols
from gaitwright.bench.evidence.random_rulebooks import RandomRulebook
from gaitwright.bench.peers import rules_client
from gaitwright.bench.peers.environment import RECIPES, PeerUnavailable
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.consult import consult
from gaitwright.workers import Workers


@pytest.fixture
def context():
    with Workers(1) as workers, Context(workers, quick=True) as context:
        yield context


@pytest.fixture
def no_peer(monkeypatch):
    def unavailable(name):
        raise PeerUnavailable(f"{name} is not installed here")

    monkeypatch.setattr(rules_client, "peer_python", unavailable)


@pytest.fixture(scope="module")
def drawn() -> RandomRulebook:
    return RandomRulebook(5, rules=5, trees=5)


# --- rulebooks -------------------------------------------------------------------------------------
def test_a_random_rulebook_is_the_same_for_the_same_seed(drawn):
    again = RandomRulebook(5, rules=5, trees=5)
    assert again.book == drawn.book and again.asked(1, 9) == drawn.asked(1, 9) and not audit(drawn.book)
    assert RandomRulebook(6, rules=5, trees=5).book != drawn.book


def test_every_rule_is_asked_as_often_as_any_other(drawn):
    fired = [consult(drawn.book, situation).rule for situation in drawn.asked(3, 50)]
    assert {fired.count(rule) for rule in fired} == {10} and len(set(fired)) == 5
    assert fired == [drawn.rule_at(situation) for situation in drawn.asked(3, 50)]


# --- CLIPS -----------------------------------------------------------------------------------------
def test_the_rules_of_clips_decide_as_ours(drawn):
    """The text is read as CLIPS reads it: of the rules whose conditions hold, the highest salience fires."""
    rules = [text for text in constructs(drawn.book) if text.startswith("(defrule")]
    assert len(rules) == len(drawn.book.rules)
    for situation in drawn.asked(0, 60):
        words = symbols(drawn.forest.leaf_places(situation))
        fired = [rule for rule in rules if holds(rule, words)]
        best = max(fired, key=lambda rule: int(re.search(r"salience (\d+)", rule)[1]))
        place = int(re.search(r"\?\*decision\* (\d+)", best)[1])
        assert drawn.book.rules[place].name == consult(drawn.book, situation).rule


def holds(rule: str, words: list[str]) -> bool:
    conditions = re.findall(r"\(t(\d+) ([^()]+)\)", rule)
    return all(words[int(slot)] in allowed.split("|") for slot, allowed in conditions)


def test_all_situations_are_in_the_loops_and_parentheses_match(drawn):
    situations = [symbols(drawn.forest.leaf_places(s)) for s in drawn.asked(0, 230)]
    texts = loops(situations)
    assert len(texts) == 3 and sum(text.count("(decide ") for text in texts) == 230
    for text in (*texts, *constructs(drawn.book)):
        assert text.count("(") == text.count(")")


# --- figures ---------------------------------------------------------------------------------------
def test_facts_describe_the_situation_they_were_made_from(drawn):
    intervals = [tree for tree in drawn.forest.trees if tree.bounds]
    assert intervals
    for situation in drawn.asked(2, 20):
        facts = rule_decisions.facts_of(drawn.forest, situation)
        assert drawn.forest.read({}, facts) == situation
        rule, _ = rule_decisions.built(drawn.compiled, intervals, facts)
        assert rule == drawn.rule_at(situation)


def test_replays_come_true():
    came = [true for true, _ in rule_decisions.replays(2, 12)]
    assert False not in came and True in came


def test_without_peers_their_figures_are_not_measured(context, no_peer, monkeypatch):
    monkeypatch.setattr(rule_decisions, "QUICK_SITUATIONS", 30)
    monkeypatch.setattr(rule_decisions, "QUICK_ROUNDS", 2)
    figures = {figure.what: figure for figure in rule_decisions.decisions(context)}
    ours = figures["decision, 14 rules × 12 trees: compiled, in a loop"]
    assert 0.0 < ours.measured < 1000.0 and ours.wanted is not None
    theirs = [figure for what, figure in figures.items() if "CLIPS" in what]
    assert len(theirs) == 4
    for figure in theirs:
        assert math.isnan(figure.measured) and figure.note == "clips is not installed here"


def test_what_is_explained_is_what_a_pupil_has_learned():
    book, asked = rule_decisions.learned(3, 30, 10)
    assert not audit(book) and book.lessons == 30 and len(asked) == 10
    assert {event.rule for event in book.events} >= {rule.name for rule in book.rules[:2]}
    for situation in asked:
        told = rule_decisions.explain(book, situation)
        assert told[0].startswith(f"{consult(book, situation).rule}, because")
        assert len(told) > len(book.rules)


def test_rules_are_a_group_and_have_pinned_peers():
    assert ("rules", "rules") in bench.claims_named(["rules"])
    for name in ("clips", "sklearn"):
        assert name in rules_client.SCRIPTS and rules_client.SCRIPTS[name].is_file()
        assert all("==" in wheel for recipe in RECIPES[name] for wheel in recipe.requirements)


def test_random_rules_all_fire_somewhere(rng):
    truth = random_rulebooks.random_truth(rng, 6, 4)
    drawn = [random_rulebooks.random_situation(rng, truth.forest) for _ in range(300)]
    drawn += [random_rulebooks.random_situation(rng, truth.forest, rule) for rule in truth.rules * 40]
    assert {consult(truth, situation).rule for situation in drawn} == {rule.name for rule in truth.rules}
    assert np.all([len(tree.leaves) <= random_rulebooks.LEAVES for tree in truth.forest.trees])
