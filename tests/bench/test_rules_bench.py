"""What the bench of rules measures with: schools that teach, CLIPS's text, replays, and peers that are
missing."""

import math
import re

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.context import Context
from gaitwright.bench.evidence import random_schools, rule_decisions, rule_lessons
from gaitwright.bench.evidence.clips_text import constructs, loops, symbols
from gaitwright.bench.evidence.random_schools import RandomSchool, School, decided, share_firm, share_right
from gaitwright.bench.peers import rules_client
from gaitwright.bench.peers.environment import RECIPES, PeerUnavailable
from gaitwright.bench.workers import Workers
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.json_form import loads
from gaitwright.knowledge.modifier import audit


@pytest.fixture
def context():
    with Workers(1) as workers, Context(workers, quick=True) as context:
        yield context


@pytest.fixture
def no_peer(monkeypatch):
    def unavailable(name):
        raise PeerUnavailable(f"{name} is not installed here")

    monkeypatch.setattr(rules_client, "peer_python", unavailable)


@pytest.fixture(autouse=True)
def hasty_teachers(monkeypatch):
    """Teachers who look at few situations before they demonstrate one."""
    monkeypatch.setattr(random_schools, "CANDIDATES", 5)
    monkeypatch.setattr(random_schools, "EXAM", 3)


@pytest.fixture(scope="module")
def school() -> RandomSchool:
    return RandomSchool(5, rules=5, trees=5)


# --- schools ---------------------------------------------------------------------------------------
def test_a_random_school_is_a_school_and_the_same_for_the_same_seed(school):
    assert isinstance(school, School)
    again = RandomSchool(5, rules=5, trees=5)
    assert again.truth == school.truth and again.held_out(1, 9) == school.held_out(1, 9)
    assert RandomSchool(6, rules=5, trees=5).truth != school.truth


def test_every_skill_is_asked_as_often_as_any_other(school):
    asked = [school.right(situation) for situation in school.held_out(3, 50)]
    assert {asked.count(skill) for skill in asked} == {10} and len(set(asked)) == 5
    assert asked == [consult(school.truth, situation).rule for situation in school.held_out(3, 50)]


def test_a_pupil_learns_from_demonstrations(school):
    book, shown = school.demonstrate(4)
    assert len(shown) == 4 * 5 and not audit(book)
    assert all(school.right(situation) == skill for situation, skill in shown)
    exam = [(situation, school.right(situation)) for situation in school.held_out(7, 100)]
    few, _ = RandomSchool(5, rules=5, trees=5).demonstrate(1)
    assert share_right(book, exam) > 0.95 > share_right(few, exam)
    assert share_firm(book) > share_firm(few)


def test_a_correction_mends_a_fault_and_its_variants_were_the_same_mistake(school):
    book, _ = school.demonstrate(1)
    faults = rule_lessons.found_faults(school, book, 11)
    assert faults
    for fault in faults:
        mistake = (decided(book, fault), school.right(fault))
        variants = school.variants(book, fault, 6)
        assert variants and fault not in variants
        assert {(decided(book, s), school.right(s)) for s in variants} <= {mistake}
        assert decided(school.correct(book, fault), fault) == mistake[1]


# --- CLIPS -----------------------------------------------------------------------------------------
def test_the_rules_of_clips_decide_as_ours(school):
    """The text is read as CLIPS reads it: of the rules whose conditions hold, the highest salience fires."""
    rules = [text for text in constructs(school.truth) if text.startswith("(defrule")]
    assert len(rules) == len(school.truth.rules)
    for situation in school.held_out(0, 60):
        words = symbols(school.forest.leaf_places(situation))
        fired = [rule for rule in rules if holds(rule, words)]
        best = max(fired, key=lambda rule: int(re.search(r"salience (\d+)", rule)[1]))
        place = int(re.search(r"\?\*decision\* (\d+)", best)[1])
        assert school.truth.rules[place].name == consult(school.truth, situation).rule


def holds(rule: str, words: list[str]) -> bool:
    conditions = re.findall(r"\(t(\d+) ([^()]+)\)", rule)
    return all(words[int(slot)] in allowed.split("|") for slot, allowed in conditions)


def test_all_situations_are_in_the_loops_and_parentheses_match(school):
    situations = [symbols(school.forest.leaf_places(s)) for s in school.held_out(0, 230)]
    texts = loops(situations)
    assert len(texts) == 3 and sum(text.count("(decide ") for text in texts) == 230
    for text in (*texts, *constructs(school.truth)):
        assert text.count("(") == text.count(")")


# --- figures ---------------------------------------------------------------------------------------
def test_facts_describe_the_situation_they_were_made_from(school):
    intervals = [tree for tree in school.forest.trees if tree.bounds]
    assert intervals
    for situation in school.held_out(2, 20):
        facts = rule_decisions.facts_of(school.forest, situation)
        assert school.forest.read({}, facts) == situation
        rule, _ = rule_decisions.built(school.table, intervals, facts)
        assert rule == school.right(situation)


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


def test_learning_and_corrections_are_measured(context, no_peer, monkeypatch, tmp_path):
    small = [RandomSchool(5, rules=5, trees=5)]
    monkeypatch.setattr(rule_lessons, "schools", lambda _: small)
    monkeypatch.setattr(rule_lessons, "PER_SKILL", 2)
    taught = rule_lessons.pupils(context)
    right, firm, more = rule_lessons.learning(context, taught)
    book, school = taught[0].book, small[0]
    exam = [(situation, school.right(situation)) for situation in school.held_out(1, 300)]
    assert right.measured == pytest.approx(100.0 * share_right(book, exam), abs=10.0)
    assert 50.0 < right.measured < 75.0 and firm.measured == pytest.approx(100.0 * share_firm(book))
    assert math.isnan(more.measured) and more.note == "sklearn is not installed here"
    mended, broken, time = rule_lessons.corrections(context, taught)
    assert mended.starts > 0 and mended.measured > 80.0 and broken.measured < 30.0
    assert time.measured > 0.0 and time.unit == "ms"
    rule_lessons.store(taught[0].book, tmp_path)
    assert loads((tmp_path / "book.json").read_bytes()) == taught[0].book


def test_a_pupil_without_faults_is_no_measured_correction(context, school):
    perfect = rule_lessons.Pupil(school, school.truth, ())
    figures = list(rule_lessons.corrections(context, [perfect]))
    assert len(figures) == 3
    for figure in figures:
        assert figure.measured_text == "not measured" and figure.reached is not True


def test_learners_get_the_groups_of_the_trees_too(school):
    situation = school.held_out(0, 1)[0]
    row = rule_lessons.row_of(school, situation)
    assert len(row) == sum(len(tree.values) - 1 for tree in school.forest.trees)
    depth = sum(len(tree.path(situation[tree.name])) - 1 for tree in school.forest.trees)
    assert sum(row) == depth


def test_rules_are_a_group_and_have_pinned_peers():
    assert ("rules", "rules") in bench.claims_named(["rules"])
    for name in ("clips", "sklearn"):
        assert name in rules_client.SCRIPTS and rules_client.SCRIPTS[name].is_file()
        assert all("==" in wheel for recipe in RECIPES[name] for wheel in recipe.requirements)


def test_random_rules_all_fire_somewhere(rng):
    truth = random_schools.random_truth(rng, 6, 4)
    drawn = [random_schools.random_situation(rng, truth.forest) for _ in range(300)]
    drawn += [random_schools.random_situation(rng, truth.forest, rule) for rule in truth.rules * 40]
    assert {consult(truth, situation).rule for situation in drawn} == {rule.name for rule in truth.rules}
    assert np.all([len(tree.leaves) <= random_schools.LEAVES for tree in truth.forest.trees])
