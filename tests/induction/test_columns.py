"""What can be bounded is derived from the facts, and read as it is named."""

import math

import numpy as np
import pytest

from gaitwright.errors import WrongUse
from gaitwright.induction.columns import (
    LEAST_SPEED,
    PAIR_BITS,
    SIZE_BITS,
    SPEED,
    WAY,
    Names,
    Quantity,
    Vocabulary,
)

FACTS = (
    Quantity("slope", "°", signed=True, known=(-8.0, 0.0, 3.0, 8.0)),
    Quantity("step", "m", "height", known=(0.1,)),
    Names("doing", ("walk", "trot", "rest"), {"moving": ("walk", "trot")}),
    Quantity("gap", "m", "height"),
    Quantity("left", "m", WAY),
    Quantity("pace", "m/s", SPEED),
)
VOCABULARY = Vocabulary(FACTS)
PLACES = {column.name: k for k, column in enumerate(VOCABULARY.columns)}
ALL = {"slope": -4.0, "step": 0.1, "doing": "walk", "gap": 0.3, "left": 6.0, "pace": 1.5}


def read(name: str, **facts) -> float:
    return float(VOCABULARY.row({**ALL, **facts})[PLACES[name]])


def test_the_columns_stand_in_the_order_that_is_promised():
    assert [column.name for column in VOCABULARY.columns] == [
        *("slope", "step", "gap", "left", "pace"),
        "size of slope",
        *("larger of step and gap", "step less gap"),
        "left over pace",
        *("doing is walk", "doing is trot", "doing is rest", "doing is moving"),
    ]
    assert VOCABULARY.plain.tolist() == [0, 1, 2, 3, 4]
    assert VOCABULARY.names == ("slope", "step", "doing", "gap", "left", "pace")


def test_each_column_says_what_it_reads_and_what_it_costs():
    price = {name: float(VOCABULARY.price[k]) for name, k in PLACES.items()}
    assert price["slope"] == price["doing is moving"] == 0.0 and price["size of slope"] == SIZE_BITS
    assert price["step less gap"] == price["left over pace"] == PAIR_BITS
    for name, k in PLACES.items():
        facts = {fact for fact, is_read in zip(VOCABULARY.names, VOCABULARY.reads[k], strict=True) if is_read}
        assert facts == {fact for fact in VOCABULARY.names if fact in name.split()}
    assert VOCABULARY.known[PLACES["slope"]] == (-8.0, 0.0, 3.0, 8.0)
    assert VOCABULARY.known[PLACES["size of slope"]] == (3.0, 8.0)
    assert VOCABULARY.known[PLACES["larger of step and gap"]] == ()


def test_each_form_reads_its_number():
    assert (read("slope"), read("size of slope"), read("size of slope", slope=4.0)) == (-4.0, 4.0, 4.0)
    assert read("size of slope", slope=0.0) == 0.0
    assert (read("larger of step and gap"), read("larger of step and gap", step=0.5)) == (0.3, 0.5)
    assert (read("step less gap"), read("left over pace")) == (pytest.approx(-0.2), 4.0)
    assert read("left over pace", pace=0.0) == read("left over pace", pace=-3.0) == 6.0 / LEAST_SPEED
    names = [read(f"doing is {name}", doing="trot") for name in ("walk", "trot", "rest", "moving")]
    assert names == [0.0, 1.0, 0.0, 1.0]


READS = {column.name: column.sources for column in VOCABULARY.columns}
LARGER = "larger of step and gap"
UNMEASURED = [(name, fact) for name, facts in READS.items() for fact in facts]


@pytest.mark.parametrize(("name", "fact"), UNMEASURED)
def test_a_column_is_no_number_where_a_fact_was_not_measured(name, fact):
    left = {k: v for k, v in ALL.items() if k != fact}
    rows = [VOCABULARY.row(left)]
    if fact != "doing":
        rows.append(VOCABULARY.row({**left, fact: math.nan}))
    others = [k for other, k in PLACES.items() if fact not in READS[other]]
    for row in rows:
        assert math.isnan(row[PLACES[name]])
        assert not np.isnan(row[others]).any()


def test_nothing_is_measured_in_no_facts():
    assert np.isnan(VOCABULARY.row({})).all() and VOCABULARY.row({}).shape == (13,)


def test_numbers_of_different_kinds_or_units_are_not_compared():
    apart = (
        Quantity("a", "m", "height"),
        Quantity("b", "cm", "height"),
        Quantity("c", "m"),
        Quantity("d", "m"),
        Quantity("e", "m/s", SPEED),
    )
    assert [column.name for column in Vocabulary(apart).columns] == ["a", "b", "c", "d", "e"]
    either = Vocabulary((Quantity("pace", "m/s", SPEED), Quantity("left", "m", WAY)))
    assert either.columns[-1].name == "left over pace"
    assert either.row({"pace": 2.0, "left": 5.0})[-1] == 2.5


def test_mistakes_are_named():
    assert VOCABULARY.place_of("gap") == 3
    with pytest.raises(WrongUse, match=r"no fact 'gop'; there are: slope, step, doing, gap, left, pace"):
        VOCABULARY.place_of("gop")
    with pytest.raises(WrongUse, match="two facts have one name, of a, b, a"):
        Vocabulary((Quantity("a"), Quantity("b"), Names("a", ("x",))))


def test_vocabularies_of_the_same_facts_are_equal():
    assert Vocabulary(FACTS) == VOCABULARY and hash(Vocabulary(FACTS)) == hash(VOCABULARY)
    assert Vocabulary(FACTS[:2]) != VOCABULARY
