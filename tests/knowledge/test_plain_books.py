"""A rulebook survives plain data; what is no rulebook is refused with a sentence."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hand_made import rule_of
from random_books import random_forest, random_situation

from gaitwright.errors import BadFile
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.forest import Forest, replace_value
from gaitwright.knowledge.json_form import dumps, from_plain, loads, to_plain
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Event, Preference, Rule, Rulebook
from gaitwright.knowledge.trees import ROOT


def taught_book(seed: int) -> Rulebook:
    """A book of three rules, of all that plain data has to hold."""
    rng = np.random.default_rng(seed)
    forest = random_forest(rng, 4)
    rules = tuple(full_rule(rng, forest, f"rule {k}") for k in range(3))
    wish = Preference("rule 0", "rule 2", random_situation(rng, forest), "lap 3")
    event = Event("lap 3", "rule 0", "a", "upper", "any", "a0", "rule 0 was wrong at a1")
    return Rulebook(forest, rules, (wish,), (event,), 12)


def full_rule(rng: np.random.Generator, forest: Forest, name: str) -> Rule:
    """A rule that was right once and wrong a few times, in situations of which one tree knows nothing."""
    action = Action(name, 0.1, 1.0, "there", (("at", "B"), ("height", 0.3)), ("at",), (("size", 2.0),))
    first = forest.trees[0]
    upper = {first.name: first.values[1]}
    off = [leaf for leaf in first.leaves if not first.is_below(leaf, first.values[1])]
    here = random_situation(rng, forest)
    wrong = {f"{leaf}, wrong": replace_value(forest, here, first.name, leaf) for leaf in off}
    rule = rule_of(forest, name, upper, None, wrong, action)
    raw = {"friction": float(rng.random()), "ground": "grass"}
    seen = tuple(replace(instance, raw=raw, note="it\nslipped") for instance in rule.positives)
    return replace(rule, positives=seen, quiet=int(rng.integers(9)))


@pytest.mark.parametrize("seed", range(8))
def test_books_made_by_hand_are_sound(seed):
    assert not audit(taught_book(seed))


def test_what_learning_could_not_have_made_is_named():
    book = taught_book(3)
    rule, *others = book.rules
    marks = replace(rule.marks[0], upper=rule.marks[0].lower, lower=ROOT)
    upside = replace(book, rules=(replace(rule, marks=(marks, *rule.marks[1:])), *others))
    assert any("the lower mark 'any' is not below the upper" in fault for fault in audit(upside))
    turned = replace(book, rules=book.rules[::-1])
    assert audit(turned) == ("rule 0 should come before rule 2, as lap 3 taught",)


@pytest.mark.parametrize("seed", range(8))
def test_plain_and_back(seed):
    book = taught_book(seed)
    assert loads(dumps(book)) == book
    assert from_plain(json.loads(json.dumps(to_plain(book)))) == book


def spoiled(path, value):
    """The plain book with one place changed."""
    plain = json.loads(dumps(taught_book(3)))
    *way, last = path
    place = plain
    for step in way:
        place = place[step]
    place[last] = value
    return plain


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (("format",), 2, "format"),
        (("trees",), [], "trees"),
        (("colour",), "red", "unknown field `colour`"),
        (("trees", 0, "values", 2), "any", "twice"),
        (("trees", 0, "values", 1), "", "no label"),
        (("trees", 0, "values", 1), "x" * 300, "200"),
        (("trees", 0, "parents", 1), 5, "hangs below"),
        (("trees", 0, "parents", 0), 0, "must begin with"),
        (("trees", 1, "name"), "a", "two trees named 'a'"),
        (("rules", 1, "name"), "rule 0", "two rules named 'rule 0'"),
        (("rules", 0, "upper", 0), "nowhere", "no value of a 'nowhere'"),
        (("rules", 0, "lower"), ["any"], "marks in"),
        (("rules", 0, "choices"), [["a", []]] * 99, "choices for"),
        (("rules", 0, "positives", 0, "values", 0), "any", "no leaf of a"),
        (("rules", 0, "positives", 0, "values"), ["any"], "a situation of 1 values"),
        (("rules", 0, "positives", 0, "kind"), "commission", "among the wrong instances"),
        (("rules", 0, "positives", 0, "kind"), "guess", "kind"),
        (("rules", 0, "action", "slowest"), 9.0, "no range"),
        (("rules", 0, "action", "skill"), " ", "names a skill"),
        (("rules", 0, "quiet"), -1, "quiet"),
        (("preferences",), [{"better": "x", "worse": "y", "values": ["any"], "instance": ""}], "values"),
    ],
)
def test_a_spoiled_book_is_refused(path, value, message):
    with pytest.raises(BadFile, match=message):
        from_plain(spoiled(path, value), "rules.json")


def test_marks_that_do_not_fit_their_instances_are_refused():
    book = taught_book(3)
    plain = json.loads(dumps(book))
    for k, rule in enumerate(book.rules):
        if rule.negatives:
            plain["rules"][k]["upper"] = ["any"] * len(book.forest.names)
            break
    with pytest.raises(BadFile, match="the marks do not fit"):
        from_plain(plain)
    plain = json.loads(dumps(book))
    leaf = book.rules[0].positives[0].situation.values[0]
    other = next(value for value in book.forest.trees[0].leaves if value != leaf)
    plain["rules"][0]["upper"] = [other, *plain["rules"][0]["upper"][1:]]
    with pytest.raises(BadFile, match="rulebook: rule 0"):
        from_plain(plain)


def test_what_is_not_json_is_refused():
    for content in (b"", b"{", b"[" * 100_000, b"\xff", b"null", b"3"):
        with pytest.raises(BadFile, match=r"book\.json"):
            loads(content, "book.json")
