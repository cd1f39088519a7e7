"""A book that was made before a tree came is used, taught and kept as if its rules had never cared for it."""

import sqlite3
from contextlib import closing
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from test_critic import ROADS, TEACHER

from gaitwright.cli import main
from gaitwright.errors import WrongUse
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.modifier import audit
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import interval_tree, tree
from gaitwright.knowledge.widen import widened
from gaitwright.learning.apprentice import corrected, step_of, study
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.school import catch_up, keep
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skills import book_trees, situation
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import FOREST, named
from knowledge.random_books import random_book, random_forest, random_situation
from oracles import robot_called

OLD = Path(__file__).parents[1] / "skillbook" / "version_1_school.sql"
DOG = robot_called("dog")
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


def decisions(rules: Rulebook, moments=ROADS) -> list:
    """The rule at each moment."""
    return [step_of(rules, one).rule for one in moments]


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


def test_a_book_of_fewer_trees_drives_and_is_taught_and_kept(tmp_path, monkeypatch):
    fewer = Forest(tuple(tree for tree in FOREST.trees if tree.name not in ("pace", "path")))
    with monkeypatch.context() as before:
        over(before, fewer)
        then = [moment_like(one.raw) for one in ROADS]
        studied = study(Rulebook(fewer), TEACHER, then)
        path = Skillbook.new(studied.rulebook, "go2", "old").save(tmp_path / "old.skills")
        decided = decisions(studied.rulebook, then)
    assert decisions(Skillbook.load(path).rulebook) == decided
    assert_drives_alike(Skillbook.load(path).rulebook, decided)
    assert_taught_further(path, decided, ("pace", "path"))


def test_a_book_of_the_first_version_learns_with_a_tree_that_came_later(school, later):
    old = Skillbook.load(school)
    assert old.rulebook.forest == FOREST and old.replayed() == old.rulebook
    decided = decisions(old.rulebook)
    assert decided == [TEACHER.ideal(one.raw).rule for one in ROADS]
    assert_drives_alike(old.rulebook, decided)
    assert_taught_further(school, decided, ("hurry",))
    with open_for_learning(school) as ledger:
        rules = ledger.book.rulebook
        assert rules["trot"].marks_in("hurry").lower is not None, "it was seen right since"


def moment_like(raw) -> DecisionPoint:
    """What a robot of this version's trees makes of measured numbers."""
    return DecisionPoint("later", named(raw), raw, {})


def assert_drives_alike(rules: Rulebook, decided: list) -> None:
    """Whoever drives by the rules as they were stored does what they decided then."""
    chooser = RuleChooser(DOG, rules)
    assert set(chooser.rulebook.forest.names) >= set(situation.FOREST.names)
    for one, rule in zip(ROADS, decided, strict=True):
        assert chooser.ruling(chooser.situation(one.raw, None), {}).rule == rule


def assert_taught_further(path: Path, decided: list, names: tuple[str, ...]) -> None:
    """The book is brought up to date in its file, keeps its decisions, learns, and comes back as it was."""
    with open_for_learning(path) as ledger:
        old = ledger.book.rulebook
        rules = catch_up(ledger)
        assert rules.forest.names == (*old.forest.names, *names) and not audit(rules)
        assert names[0] in ledger.book.steps[-1].note
        assert catch_up(ledger) is rules, "once is enough"
        assert decisions(rules) == decided and Skillbook.load(path) == ledger.book
        for one in (moment_like({**ROADS[0].raw, "remaining": 2.0}), moment_like(ROADS[1].raw)):
            correction = TEACHER.judge(None, one.raw)
            assert correction is not None
            studied = corrected(ledger.book.rulebook, one, correction)
            keep(ledger, studied)
            assert step_of(ledger.book.rulebook, one).rule == correction.right.rule
        taught = ledger.book
    again = Skillbook.load(path)
    assert again == taught and again.replayed() == again.rulebook and not audit(again.rulebook)
    assert decisions(again.rulebook) == decided


def test_a_school_goes_on_from_an_older_book(school, later, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("gaitwright.cli.teach.EXAM", 4)
    monkeypatch.setattr("gaitwright.learning.exam.FOREST", later)
    before, new = school.read_bytes(), tmp_path / "new.skills"
    assert main(["teach", "--from", str(school), "--trips", "1", "--out", str(new)]) == 0
    book = Skillbook.load(new)
    assert school.read_bytes() == before and book.name == "new"
    assert [(one.how, one.name) for one in book.ancestors] == [("forked", "school")]
    assert book.rulebook.forest.names[:13] == later.names and book.replayed() == book.rulebook
    assert {rule.name for rule in Skillbook.load(school).rulebook.rules} <= {
        r.name for r in book.rulebook.rules
    }


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
