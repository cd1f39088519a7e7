"""A terrain operator from one edit on one leg: what it says, and that it serves other legs and skills."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.errors import BadFile, WrongUse
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import Operator
from gaitwright.learning.operator_books import notes_of, operator_of, operators_in, sentence
from gaitwright.learning.operator_lessons import Edit, learned_from
from gaitwright.learning.operator_trials import Swung, swung
from gaitwright.learning.profile_lessons import taught
from gaitwright.skillbook import Skillbook
from gaitwright.skills.situation import FOREST
from oracles import robot_called

GO2 = robot_called("go2")
HIGH = LegCycle("high", ((0.0, -0.5, 0.0), (0.25, -0.4, 0.3), (0.75, 0.4, 0.3), (1.0, 0.5, 0.0)))


@pytest.fixture(scope="module")
def shown() -> Operator:
    """What the numerical controller shows on the first leg in trot."""
    return learned_from(Edit(GO2, 0.06))


def test_an_edit_is_told_per_metre(shown: Operator) -> None:
    assert shown.path[:, 1].max() == pytest.approx(1.0) and not shown.path[:, 0].any()
    assert shown.largest == pytest.approx(0.099) and shown.landing == 0.0
    assert shown.strategy == "follows the ground"
    up = shown.force[:, 2]
    assert up[1:8].mean() > 200.0, "to raise a foot it is pushed up first, …"
    assert up[12:20].mean() < -100.0, "… then held back"
    assert "raised by 1.00 cm" in sentence(shown) and "on FL in trot at 0.060 m" in sentence(shown)


@pytest.mark.parametrize(("skill", "leg"), [("walk", 1), ("pace", 3)])
def test_one_edit_serves_every_leg_and_skill(shown: Operator, skill: str, leg: int) -> None:
    profile = taught(GO2, skill)
    found = swung(Swung(GO2, skill, leg, 0.06, (shown,), (profile,)))
    usual = swung(Swung(GO2, skill, leg, 0.0, (), (profile,)))
    assert not found.fell and found.share == pytest.approx(1.0, abs=0.03)
    assert found.reached - usual.reached == pytest.approx(0.06, abs=0.006)


def test_a_leg_cycle_of_a_person_and_a_landing_become_an_operator() -> None:
    told = learned_from(Edit(GO2, 0.05, "trot", "FR", ("hole",), HIGH, 0.03), "over a hole")
    assert (told.name, told.kinds, told.strategy) == ("over a hole", ("hole",), "steps over")
    assert told.landing == pytest.approx(0.6) and told.path[8, 0] != 0.0
    assert "by the leg cycle high" in told.taught


def test_a_book_keeps_it(shown: Operator) -> None:
    book = replace(Skillbook.new(FOREST, "go2"), operators=(notes_of(shown),))
    (back,) = operators_in(book, GO2, "a book")
    assert np.array_equal(back.path, shown.path) and np.array_equal(back.force, shown.force)
    assert (back.name, back.kinds, back.duration) == (shown.name, shown.kinds, shown.duration)
    assert operators_in(replace(book, robot="dog"), GO2, "a book") == ()


def test_a_damaged_one_is_refused(shown: Operator) -> None:
    notes = notes_of(shown)
    for wrong in (
        replace_notes(notes, path=((0.0, 9.0), (0.0, 9.0))),
        replace_notes(notes, kinds=("wall",)),
        replace_notes(notes, force=((1e4,) * 33, (0.0,) * 33, (0.0,) * 32)),
    ):
        with pytest.raises(BadFile, match="a book: "):
            operator_of(wrong, "a book")


def replace_notes(notes, **others):
    fields = {name: getattr(notes, name) for name in notes.__struct_fields__}
    return type(notes)(**(fields | others))


@pytest.mark.parametrize(
    ("others", "told"),
    [
        ({"leg": "XX"}, "no leg of go2 'XX'; there is: FL"),
        ({"kinds": ("wall",)}, "no kind of obstacle 'wall'"),
        ({"size": 0.0}, "an obstacle of 0 m"),
        ({"size": 2.0}, "as high as the body"),
    ],
)
def test_an_edit_of_nothing_is_refused(others: dict, told: str) -> None:
    with pytest.raises(WrongUse, match=told):
        Edit(**({"robot": GO2, "size": 0.05} | others))
