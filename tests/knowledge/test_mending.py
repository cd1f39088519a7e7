"""Contradictions: a tree regrouped as in figure 5.6, a rule split, a feature added; never a silent loss."""

import pytest
from random_books import children

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.features import accept, propose_features, round_between
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.json_form import dumps, loads
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson, audit, learn
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Marks, Rulebook
from gaitwright.knowledge.trees import interval_tree, tree

TERRAIN = tree("road terrain", ("flat", "uphill", "downhill"), "the road is")
SPEED = interval_tree("speed", "m/s", (1.0, 2.0, 3.0), ("slow", "medium", "fast", "very fast"))
FOREST = Forest((TERRAIN, SPEED))


def lesson(book: Rulebook, kind, rule, terrain="flat", speed="fast", **fields):
    situation = book.forest.situation({"road terrain": terrain, "speed": speed})
    return learn(book, Lesson(kind, rule, situation, action=Action(rule), **fields))


def taught(*lessons, book=None):
    book = book or Rulebook(FOREST)
    for kind, *rest in lessons:
        learned = lesson(book, {"+": "omission", "-": "commission"}[kind], *rest)
        assert learned.trouble is None, learned.trouble.sentence
        book = learned.rulebook
    return book


@pytest.mark.parametrize("order", [(0, 1, 2), (0, 2, 1), (1, 2, 0)])
def test_the_thesis_gallop_ends_in_figure_5_6(order):
    """Right uphill and downhill, wrong on the flat: uphill and downhill come under a value of their own."""
    told = [("omission", "uphill"), ("omission", "downhill"), ("commission", "flat")]
    book, trouble = Rulebook(FOREST), None
    for k in order:
        kind, terrain = told[k]
        learned = lesson(book, kind, "gallop", terrain)
        book, trouble = learned.rulebook, learned.trouble
    assert trouble is not None and "gallop cannot be" in trouble.sentence
    mended = mend(book, trouble)
    reshaped = mended.rulebook.forest["road terrain"]
    assert mended.how == "regrouped"
    assert children(reshaped, "any") == ("flat", "uphill or downhill")
    assert children(reshaped, "uphill or downhill") == ("uphill", "downhill")
    assert mended.rulebook["gallop"].marks[0] == Marks(
        "road terrain", "uphill or downhill", "uphill or downhill"
    )
    assert "road terrain now has the value 'uphill or downhill'" in mended.sentence
    assert mended.rulebook.events[-1].instance == trouble.instance.id
    assert reshaped.about == "the road is" and not audit(mended.rulebook)


def test_regrouping_keeps_the_marks_of_other_rules_as_sets_of_leaves():
    nested = tree("road terrain", {"even": ("flat", "wet"), "uneven": ("uphill", "downhill")})
    book = Rulebook(Forest((nested, SPEED)))
    book = taught(("+", "walk", "flat"), ("-", "walk", "uphill"), ("+", "gallop", "wet"), book=book)
    book = taught(("+", "gallop", "uphill"), book=book)
    learned = lesson(book, "commission", "gallop", "downhill")
    mended = mend(book, learned.trouble)
    assert mended.how == "split"  # "wet or uphill" crosses "even", which walk's upper mark needs
    assert mended.rulebook.forest == book.forest and mended.rulebook["walk"] == book["walk"]
    free = taught(("+", "gallop", "wet"), ("+", "gallop", "uphill"), book=Rulebook(Forest((nested, SPEED))))
    mended = mend(free, lesson(free, "commission", "gallop", "downhill").trouble)
    assert mended.how == "regrouped" and "even" not in mended.rulebook.forest["road terrain"].values


def test_intervals_are_regrouped_with_their_neighbours_only():
    flat = "flat"
    book = taught(("+", "trot", flat, "medium"), ("+", "trot", flat, "fast"))
    trouble = lesson(book, "commission", "trot", flat, "slow").trouble
    mended = mend(book, trouble)
    speed = mended.rulebook.forest["speed"]
    assert mended.how == "regrouped" and speed.leaves == SPEED.leaves and speed.bounds == SPEED.bounds
    assert speed.leaves_below("medium to fast") == ("medium", "fast") and speed.leaf_of(1.5) == "medium"
    apart = taught(("+", "trot", flat, "slow"), ("+", "trot", flat, "very fast"))
    assert mend(apart, lesson(apart, "commission", "trot", flat, "medium").trouble).how == "split"


def test_a_split_rule_fires_where_it_was_right_and_nowhere_it_was_wrong():
    book = taught(
        ("+", "trot", "flat", "slow"), ("+", "trot", "uphill", "very fast"), ("+", "walk", "downhill")
    )
    wrong = lesson(book, "commission", "trot", "flat", "very fast")
    mended = mend(book, wrong.trouble)
    assert mended.how == "split", mended.sentence
    names = [rule.name for rule in mended.rulebook.rules]
    assert names == ["trot", "trot 2", "walk"]
    parts = [mended.rulebook[name] for name in names[:2]]
    assert {part.action for part in parts} == {Action("trot")}
    assert [len(part.positives) for part in parts] == [1, 1]
    assert [len(part.negatives) for part in parts] == [1, 1]
    for terrain, speed, wanted in (
        ("flat", "slow", "trot"),
        ("uphill", "very fast", "trot 2"),
        ("flat", "very fast", "walk"),
    ):
        situation = FOREST.situation({"road terrain": terrain, "speed": speed})
        assert consult(mended.rulebook, situation).rule == wanted
    assert not audit(mended.rulebook) and loads(dumps(mended.rulebook)) == mended.rulebook


def clash(*instances):
    """A trouble between lessons in one and the same situation, given as ("+" | "-", raw)."""
    book, trouble = Rulebook(FOREST), None
    for k, (sign, raw) in enumerate(instances):
        kind = "omission" if sign == "+" else "commission"
        learned = lesson(book, kind, "run", id=f"lap {k}", raw=raw)
        assert trouble is None
        book, trouble = learned.rulebook, learned.trouble
    assert trouble is not None and trouble.same
    return book, trouble


def test_the_same_situation_right_and_wrong_asks_for_a_feature():
    book, trouble = clash(("+", {}), ("-", {}))
    assert "a feature is missing" in trouble.sentence
    mended = mend(book, trouble)
    assert mended.how == "none" and mended.rulebook == book
    assert propose_features(book, trouble) == ()


def test_a_feature_is_made_from_the_measurement_that_tells_right_from_wrong():
    right = [("+", {"friction": friction, "noise": noise}) for friction, noise in ((0.8, 3.0), (0.7, 1.0))]
    book, trouble = clash(*right, ("-", {"friction": 0.31, "noise": 2.0}))
    best, second = propose_features(book, trouble)
    assert best.tree.bounds == (0.5,) and best.tree.source == "friction"
    assert second.tree.source == "noise" and len(second.tree.bounds) == 2  # needs an island: told last
    assert "friction should be a feature" in best.sentence
    learned = accept(book, best)
    assert learned.trouble is None and not audit(learned.rulebook)
    rule = learned.rulebook["run"]
    assert rule.marks_in("friction") == Marks("friction", "≥ 0.5", "≥ 0.5")
    facts = {"road terrain": "flat", "speed": 2.5}
    for friction, fired in ((0.9, "run"), (0.2, None)):
        situation = learned.rulebook.forest.read({}, facts | {"friction": friction})
        assert consult(learned.rulebook, situation).rule == fired
    assert loads(dumps(learned.rulebook)) == learned.rulebook


def test_named_measurements_become_a_tree_with_room_for_names_nobody_met():
    book, trouble = clash(("+", {"ground": "grass"}), ("+", {"ground": "soil"}), ("-", {"ground": "ice"}))
    (proposal,) = propose_features(book, trouble)
    assert proposal.tree.leaves == ("grass", "soil", "ice", "other")
    learned = accept(book, proposal)
    assert learned.rulebook["run"].marks_in("ground").upper == "grass or soil"


def test_instances_without_the_measurement_bind_nothing():
    book = taught(("+", "run", "flat", "fast"), ("+", "walk", "flat", "slow"))
    book = lesson(book, "positive", "run", raw={"load": 1.0}).rulebook
    trouble = lesson(book, "commission", "run", raw={"load": 9.0}).trouble
    (proposal,) = propose_features(book, trouble)
    learned = accept(book, proposal)
    assert learned.rulebook["walk"].marks_in("load") == Marks("load", "any", None)
    assert learned.rulebook["run"].marks_in("load") == Marks("load", "< 5", "< 5")
    assert not audit(learned.rulebook) and loads(dumps(learned.rulebook)) == learned.rulebook
    grown = learned.rulebook.forest.situation({"road terrain": "flat", "speed": "slow", "load": 7.0})
    assert consult(learned.rulebook, grown).rule == "walk"
    again = learn(learned.rulebook, Lesson("commission", "walk", grown))  # nobody noted where walk was right
    assert again.trouble is not None


def test_measurements_that_do_not_tell_apart_are_not_proposed():
    book, trouble = clash(("+", {"x": 1.0, "y": "a", "z": 1.0}), ("-", {"x": 1.0, "y": "a", "z": "b"}))
    assert propose_features(book, trouble) == ()
    book, trouble = clash(("+", {"x": 1.0}), ("-", {}))
    assert propose_features(book, trouble) == ()
    book, trouble = clash(("+", {"x": float("nan")}), ("-", {"x": 1.0}))
    assert propose_features(book, trouble) == ()


def test_a_bound_between_two_numbers_is_round():
    assert round_between(0.31, 0.7) == 0.5
    assert round_between(1.0, 9.0) == 5.0
    assert 0.1 < round_between(0.1, 0.1 + 1e-12) <= 0.1 + 1e-12
    assert 1.0 < round_between(1.0, 1.0 + 2.3e-16) <= 1.0 + 2.3e-16


def test_a_rule_for_all_the_rest_comes_after_those_that_know_better():
    """Walk is wrong on the flat when fast and uphill when slow: that fits no marks, but other rules are
    right there."""
    book = taught(
        ("+", "run", "flat", "fast"), ("+", "climb", "uphill", "slow"), ("+", "walk", "flat", "slow")
    )
    book = taught(("-", "walk", "flat", "fast"), ("-", "walk", "uphill", "slow"), book=book)
    trouble = lesson(book, "omission", "walk", "uphill", "fast").trouble
    mended = mend(book, trouble)
    assert mended.how == "ordered" and mended.rulebook.forest == book.forest and not audit(mended.rulebook)
    assert [rule.name for rule in mended.rulebook.rules][-1] == "walk"
    assert {(wish.better, wish.worse) for wish in mended.rulebook.preferences} == {
        ("run", "walk"),
        ("climb", "walk"),
    }
    assert "walk now comes after run and climb" in mended.sentence
    for terrain, speed, better in (("flat", "fast", "run"), ("uphill", "slow", "climb")):
        situation = FOREST.situation({"road terrain": terrain, "speed": speed})
        assert consult(mended.rulebook, situation).rule == better
    assert loads(dumps(mended.rulebook)) == mended.rulebook


def test_the_teacher_says_which_tree_to_regroup():
    book = taught(("+", "trot", "uphill", "medium"), ("+", "trot", "downhill", "fast"))
    trouble = lesson(book, "commission", "trot", "flat", "slow").trouble
    for tree_name in FOREST.names:
        mended = mend(book, trouble, blame=tree_name)
        changed = [t.name for t in mended.rulebook.forest.trees if t != FOREST[t.name]]
        assert changed == [tree_name]
