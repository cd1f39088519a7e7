"""The forest picture: drawn for any book, larger for more rules, and nothing in it stands on another."""

from itertools import pairwise

import matplotlib.image
import numpy as np
import pytest

from gaitwright.bench.evidence.random_rulebooks import RandomRulebook
from gaitwright.errors import WrongUse
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import tree
from gaitwright.pictures.forest import bands, box_width, forest_picture, leaf_span, two_lines
from gaitwright.pictures.rule_trees import GAP, LINE, layout, lines_below, shortened
from knowledge.hand_made import rule_of

DRAWN = RandomRulebook(3, rules=5, trees=6)


def test_a_whole_book_and_the_trees_of_one_rule_are_drawn(tmp_path):
    book, situation = DRAWN.book, DRAWN.asked(0, 1)[0]
    decision = consult(book, situation)
    whole = matplotlib.image.imread(forest_picture(book, tmp_path / "book.png"))
    one = matplotlib.image.imread(forest_picture(book, tmp_path / "rule.png", str(decision.rule), decision))
    assert whole.shape[1] == one.shape[1] == 1600
    assert one.shape[0] > whole.shape[0] + 200
    assert len(np.unique(whole.reshape(-1, 4), axis=0)) > 50
    assert not list(tmp_path.glob(".*"))


def test_the_situation_and_the_marks_are_seen(tmp_path):
    """The blue of a situation and the red of marks are there only where these are."""
    forest = Forest((tree("ground", ("flat", "rough")), tree("load", ("light", "heavy"))))
    at = forest.situation({"ground": "flat", "load": "light"})
    book = Rulebook(forest, (rule_of(forest, "trot", right={"lap 1": at}),))
    blue, red = (0x19, 0x71, 0xC2), (0xC2, 0x25, 0x5C)
    plain = pixels(forest_picture(book, tmp_path / "a.png"))
    assert blue not in plain and red not in plain
    asked = pixels(forest_picture(book, tmp_path / "b.png", "trot", consult(book, at)))
    assert blue in asked and red in asked


def pixels(path) -> set[tuple[int, ...]]:
    image = (matplotlib.image.imread(path)[:, :, :3] * 255).round().astype(int)
    return {tuple(colour) for colour in np.unique(image.reshape(-1, 3), axis=0).tolist()}


def test_what_cannot_be_drawn_is_said(tmp_path):
    with pytest.raises(WrongUse, match="no rules yet"):
        forest_picture(Rulebook(DRAWN.forest), tmp_path / "none.png")
    with pytest.raises(WrongUse, match="no rule 'skil 1'"):
        forest_picture(DRAWN.book, tmp_path / "none.png", "skil 1")
    assert not list(tmp_path.iterdir())


def test_trees_that_do_not_fit_side_by_side_come_below():
    trees = [tree(f"t{k}", [f"leaf {k}.{i}" for i in range(40)]) for k in range(5)]
    rows = bands(trees)
    assert [grown for row in rows for grown in row] == trees
    assert len(rows) > 1 and all(box_width(row) >= 0.12 for row in rows)
    huge = tree("huge", [f"leaf {i}" for i in range(500)])
    assert bands([huge]) == [[huge]] and box_width([huge]) > 0.02


def test_marks_cover_neighbours():
    for grown in DRAWN.forest.trees:
        for value in grown.values:
            first, end = leaf_span(grown, value)
            assert grown.leaves[first:end] == grown.leaves_below(value)
            first, end = lines_below(grown, value)
            below = {other for other in grown.values if grown.is_below(other, value)}
            assert set(grown.values[first:end]) == below


def test_no_tree_stands_on_another():
    for column, height in layout(DRAWN.forest.trees):
        for (above, top), (_, next_top) in pairwise(column):
            assert top + LINE * (len(above.values) + 1) <= next_top - 0.9 * GAP
        assert height >= column[-1][1] + LINE * len(column[-1][0].values)


def test_labels_are_cut_to_their_room():
    assert shortened("gravel", 6) == "gravel" and shortened("gravelly", 6) == "grave…"
    assert two_lines("obstacle ahead", 9) == ["obstacle", "ahead"]
    assert two_lines("ground", 3) == ["gr…"]
