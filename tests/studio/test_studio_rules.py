"""What a room tells of rules and terrain operators (rows L4, S6): their order, and which are in use."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from rooms import laps, opened

from gaitwright.errors import WrongUse
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.studio import messages as m
from gaitwright.studio.room import Room


def over() -> Operator:
    path = np.zeros((SHARES, 2))
    path[8:25, 1] = 1.2
    kinds = ("block", "step up")
    return Operator("over it", kinds, 0.15, path, np.zeros((SHARES, 3)), 0.16, taught="by hand")


@pytest.fixture
def room(tmp_path: Path, said: list[dict]) -> Iterator[Room]:
    with opened(tmp_path, said, "flat", [over()]) as room:
        yield room


def looked(room: Room, seconds: float) -> None:
    """Time for the robot, and a look at what it comes to."""
    laps(room, seconds)
    room.teaching.look()


def teach(room: Room, skill: str, name: str) -> None:
    room.hears(m.Skill(name=skill))
    looked(room, 0.8)
    room.hears(m.Right(skill=skill, name=name))
    room.hears(m.Keep())
    looked(room, 0.4)


def test_a_rule_comes_before_another_where_both_could_fire_and_only_once_it_is_kept(room: Room):
    for skill, name in 2 * (("trot", "one"), ("walk", "two")):
        teach(room, skill, name)
    book = room.ledger.book.rulebook
    assert [rule.name for rule in book.rules] == ["two", "one"]
    with pytest.raises(WrongUse, match="nowhere on this run did one fire where two could too"):
        room.hears(m.Order(rule="two", before="one"))
    tried = room.hears(m.Order(rule="one", before="two"))
    assert tried and tried["followed"] and tried["moves"]
    assert room.ledger.book.rulebook == book
    kept = room.hears(m.Keep())
    assert kept and kept["lesson"] == tried["lesson"]
    assert room.ledger.book.rulebook != book


def test_operators_of_the_book_are_told_and_the_one_in_use(room: Room, said: list[dict]):
    (told,) = next(one for one in said if one["say"] == "curve")["operators"]
    assert (told["name"], told["kinds"]) == ("over it", ["block", "step up"])
    assert told["sentence"].startswith("if a block or a step up of up to 15.0 cm is ahead of a leg")
    assert room.status()["operators_in_use"] == []
    room.hears(m.PlaceBox(x=0.9, y=0.0, lx=0.1, ly=1.5, height=0.05))
    room.hears(m.Skill(name="walk"))
    used: dict[str, dict] = {}
    for _ in range(400):
        looked(room, 0.02)
        now = room.status()["operators_in_use"]
        used |= {one["leg"]: one for one in now if one["name"]}
    assert used.keys() & {"FL", "FR"}
    for leg, one in used.items():
        assert one["name"] == "over it" and 0.0 < one["reach"] < 0.15
        raised = f"the foot is raised by up to {120.0 * one['reach']:.1f} cm"
        assert one["because"] == f"a block or step up is in the way of {leg}: {raised}"
