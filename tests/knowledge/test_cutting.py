"""Interval trees with more bounds, marks that are runs, and how they are spoken of."""

from dataclasses import replace

import pytest

from gaitwright.errors import WrongUse
from gaitwright.knowledge.cutting import cut_at, range_of, run_of, spoken, tree_at, value_text
from gaitwright.knowledge.trees import interval_tree, tree

PACE = interval_tree(
    "pace", "m/s", (0.3, 1.0), {"slow": ("creeping", "walking"), "fast": ()}, about="the speed is a"
)
ROAD = tree("road", {"even": ("flat", "wet"), "stairs": ()})


def test_a_cut_leaf_becomes_a_value_with_its_parts():
    cut = cut_at(PACE, (0.5, 0.7, 1.4))
    assert cut.bounds == (0.3, 0.5, 0.7, 1.0, 1.4)
    assert cut.leaves_below("walking") == ("walking under 0.5", "walking, 0.5 … 0.7", "walking from 0.7")
    assert cut.leaves_below("fast") == ("fast under 1.4", "fast from 1.4")
    assert cut.leaves_below("slow") == ("creeping", *cut.leaves_below("walking"))
    assert [cut.leaf_of(x) for x in (0.3, 0.5, 1.39, 1.4)] == [
        "walking under 0.5", "walking, 0.5 … 0.7", "fast under 1.4", "fast from 1.4"
    ]  # fmt: skip


def test_known_bounds_cut_nothing():
    assert cut_at(PACE, (0.3, 1.0)) is PACE


def test_a_cut_tree_can_be_cut_again():
    twice = cut_at(cut_at(PACE, (0.5,)), (0.4, 0.6))
    assert twice.bounds == (0.3, 0.4, 0.5, 0.6, 1.0)
    assert set(PACE.values) <= set(twice.values)
    assert len(twice.leaves_below("walking")) == 4


def test_runs_and_several_leaves_are_marks():
    cut = cut_at(PACE, (0.5,))
    run = cut.label_of(run_of(cut, 0.5, float("inf")))
    assert run == "walking from 0.5 to fast"
    assert cut.is_below("fast", run) and not cut.is_below("walking under 0.5", run)
    assert cut.is_below("fast", cut.label_of(cut.leaf_set("fast")))
    several = ROAD.label_of(ROAD.set_of(("flat", "stairs")))
    assert several == "flat or stairs" and not ROAD.is_below("wet", several)
    assert ROAD.label_of(ROAD.set_of(("flat", "wet"))) == "even"


@pytest.mark.parametrize(
    ("grown", "mark"), [(PACE, "fast to creeping"), (PACE, "walking to nowhere"), (ROAD, "flat or ice")]
)
def test_what_is_no_mark_is_refused(grown, mark):
    with pytest.raises(WrongUse, match="no value of"):
        grown.leaf_set(mark)


@pytest.mark.parametrize(
    ("low", "high", "says"),
    [
        (float("-inf"), 0.3, "the speed is a creeping"),
        (float("-inf"), 0.5, "the speed is under 0.5 m/s"),
        (0.5, float("inf"), "the speed is at least 0.5 m/s"),
        (0.3, 0.5, "the speed is from 0.3 to 0.5 m/s"),
        (0.3, 1.0, "the speed is a walking"),
    ],
)
def test_marks_are_spoken_of_by_name_or_by_numbers(low, high, says):
    cut = cut_at(PACE, (0.5,))
    mark = cut.label_of(run_of(cut, low, high))
    assert spoken(cut, mark) == says
    assert range_of(cut, mark) == (low, high)


def test_a_group_is_spoken_of_without_its_article():
    paces = {"slow": ("creeping", "walking"), "fast": ()}
    tree = interval_tree("pace", "m/s", (0.3, 1.0), paces, about="the speed is a")
    assert spoken(cut_at(tree, (0.5,)), "slow") == "the speed is slow"
    assert spoken(cut_at(tree, (0.5,)), "walking") == "the speed is a walking"


def test_names_are_spoken_of_as_they_are():
    assert value_text(ROAD, "flat or stairs") == "flat or stairs"
    assert spoken(ROAD, "even") == "road is even"


def test_a_number_without_a_tree_gets_one():
    grown = tree_at("gap", "m", (0.2, 0.1), "a gap is", "gap")
    assert grown.bounds == (0.1, 0.2) and grown.source == "gap"
    assert spoken(grown, grown.leaves[2]) == "a gap is at least 0.2 m"


def test_what_says_nothing_of_its_number_is_told_by_it():
    swaying = interval_tree("stability", "", (0.3,), ("steady", "stumbling"), about="it is")
    grown = replace(cut_at(swaying, (0.1,)), source="sway")
    assert spoken(grown, "stumbling") == "it is stumbling"
    assert spoken(grown, grown.label_of(run_of(grown, 0.1, float("inf")))) == "its sway is at least 0.1"
