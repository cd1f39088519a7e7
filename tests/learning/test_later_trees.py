"""A book that was made before a tree came is used, taught and kept as if its rules had never cared for it."""

import sqlite3
from contextlib import closing
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from gaitwright.cli import main
from gaitwright.errors import WrongUse
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import interval_tree, tree
from gaitwright.knowledge.widen import widened
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.older_books import told_by
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skillbook import Skillbook
from gaitwright.skills import book_trees, situation
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import FOREST
from knowledge.random_books import random_book, random_forest, random_situation
from learning.roads import ROADS
from oracles import robot_called

OLD = Path(__file__).parents[1] / "skillbook" / "version_1_school.sql"
DOG = robot_called("dog")
TEACHER = ScriptedTeacher()
HURRY = interval_tree("hurry", "m/s at 0.29 m", (0.5, 1.5), ("calm", "brisk", "pressing"))


def over(monkeypatch: pytest.MonkeyPatch, forest: Forest) -> None:
    """Another situation space, as another version of Gaitwright has it."""
    for home in (situation, book_trees):
        monkeypatch.setattr(home, "FOREST", forest)


@pytest.fixture
def school(tmp_path: Path) -> Path:
    """A book that the first version's school made, over its twelve trees."""
    path = tmp_path / "school.skills"
    with closing(sqlite3.connect(path)) as db:
        db.executescript(OLD.read_text(encoding="utf-8"))
        db.execute(f"PRAGMA application_id={0x47614954}")
        db.execute("PRAGMA user_version=1")
    return path


@pytest.fixture
def later(monkeypatch: pytest.MonkeyPatch) -> Forest:
    """Today's trees and one that came later."""
    monkeypatch.setitem(situation.NUMBER_OF, "hurry", "wished")
    forest = Forest((*FOREST.trees, HURRY))
    over(monkeypatch, forest)
    return forest


def decisions(rules: Rulebook) -> list:
    """The rule at each moment, as whoever drives by them decides."""
    chooser = RuleChooser(DOG, rules)
    return [chooser.ruling(chooser.situation(one.raw, None), {}).rule for one in ROADS]


@pytest.mark.parametrize("seed", range(6))
def test_a_later_tree_changes_no_decision(seed):
    rng = np.random.default_rng(seed)
    forest = random_forest(rng, 6)
    rules = random_book(rng, Forest(forest.trees[:4]), 8)
    wider = widened(rules, forest.trees)
    assert wider.forest == forest and widened(wider, forest.trees) is wider
    assert not audit(wider) or audit(rules)
    for _ in range(50):
        old = random_situation(rng, rules.forest)
        before = consult(rules, old)
        unknown = consult(wider, forest.read(dict(old.items()), {}))
        assert (unknown.rule, unknown.conflict, unknown.certainty, unknown.grey) == (
            before.rule,
            before.conflict,
            before.certainty,
            before.grey,
        )
        for leaves in product(*(new.leaves for new in forest.trees[4:])):
            now = dict(zip(forest.names[4:], leaves, strict=True))
            after = consult(wider, forest.situation({**dict(old.items()), **now}))
            assert (after.rule, after.conflict) == (before.rule, before.conflict)


def test_a_book_of_the_first_version_drives_as_ever_with_a_tree_that_came_later(school, later):
    rules = Skillbook.load(school).rulebook
    assert {tree.name for tree in rules.forest.trees} < {*FOREST.names}
    assert set(RuleChooser(DOG, rules).rulebook.forest.names) == set(later.names)
    assert decisions(rules) == [TEACHER.ideal(one.facts).rule for one in ROADS]


def test_what_an_older_book_taught_is_told_again_and_the_school_goes_on(
    school, tmp_path, capsys, monkeypatch
):
    monkeypatch.setattr("gaitwright.cli.teach.EXAM", 4)
    before, new = school.read_bytes(), tmp_path / "new.skills"
    assert main(["teach", "--from", str(school), "--trips", "1", "--out", str(new)]) == 0
    old, book = Skillbook.load(school), Skillbook.load(new)
    assert school.read_bytes() == before and book.name == "new"
    assert [(one.how, one.name) for one in book.ancestors] == [("forked", "school")]
    assert book.steps[: len(old.steps)] == old.steps
    again = told_by(old)
    assert [step.told for step in book.steps[len(old.steps) :]][: len(again)] == again
    assert {told.action for told in again} == {rule.action for rule in old.rulebook.rules}
    wanted = [TEACHER.ideal(one.facts).action for one in ROADS]
    done = [book.rulebook[rule].action for rule in decisions(book.rulebook)]
    assert sum(did == right for did, right in zip(done, wanted, strict=True)) > len(ROADS) // 2
    assert pupil_of(book).rulebook().rules == book.rulebook.rules


def test_a_book_about_something_else_is_still_refused(tmp_path, capsys):
    other = Rulebook(Forest((tree("weather", ("dry", "wet")),)))
    path = Skillbook.new(other, "go2", "weather").save(tmp_path / "weather.skills")
    out = tmp_path / "new.skills"
    assert main(["teach", "--from", str(path), "--out", str(out)]) == 2
    assert "knows nothing of support" in capsys.readouterr().err and not out.exists()
    for strange in (tree("road", ("asphalt", "gravel")), tree("mood", ("good", "bad"))):
        forest = Forest((*(own for own in FOREST.trees if own.name != strange.name), strange))
        with pytest.raises(WrongUse, match=f"asks whether {strange.name} is .* and here"):
            RuleChooser(DOG, Rulebook(forest))
