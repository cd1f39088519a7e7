"""Modes (row S2): a motion that a person composes by driving and plays back; an apprentice that is shown."""

import math
import time
from pathlib import Path

import pytest

from gaitwright.errors import WrongUse
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST
from gaitwright.studio import messages as m
from gaitwright.studio.room import Room
from gaitwright.studio.setup import Setup


@pytest.fixture
def room(tmp_path: Path, said: list[dict]):
    book = tmp_path / "studio.skills"
    Skillbook.new(FOREST, "go2", "studio", 0).save(book)
    with open_for_learning(book) as ledger:
        room = Room(Setup(scene="flat", driver="numerical"), ledger, tmp_path, said.append)
        yield room
        room.close()


def laps(room: Room, seconds: float) -> None:
    for _ in range(round(seconds / 0.002)):
        assert room.lap()


def remarks(said: list[dict]) -> list[str]:
    return [one["sentence"] for one in said if one["say"] == "remark"]


def composed(room: Room) -> float:
    """A walk of 0.8 s and a stand of 0.4 s; how far it led [m]."""
    room.hears(m.Compose(on=True))
    before = room.run.sensed.position_w.copy()
    room.hears(m.Skill(name="walk"))
    room.hears(m.Skill(name="walk", id=7))
    laps(room, 0.8)
    room.hears(m.Stand())
    laps(room, 0.4)
    assert room.hears(m.Compose(on=False)) == {"words": 2}
    return math.dist(before[:2], room.run.sensed.position_w[:2])


def test_what_moves_the_robot_is_noted_once_and_told(room: Room):
    room.hears(m.Compose(on=True))
    room.hears(m.Steer(forward=0.2))
    room.hears(m.Steer(forward=0.2))
    room.hears(m.Pace(factor=0.5))
    laps(room, 0.2)
    status = room.status()
    assert status["composing"] and status["composed"] == 1
    assert status["composed_seconds"] == pytest.approx(0.2, abs=0.01)
    room.hears(m.Compose(on=False))
    assert not room.status()["composing"] and room.status()["composed"] == 1


def test_a_motion_is_played_as_long_as_it_was_and_ends_in_a_stand(room: Room, said: list[dict]):
    composed(room)
    assert room.hears(m.Play()) == {"seconds": pytest.approx(1.2, abs=0.01)}
    laps(room, 0.4)
    status = room.status()
    assert status["playing"] and status["held"] == "walk"
    assert status["played_seconds"] == pytest.approx(0.4, abs=0.01)
    laps(room, 0.7)
    assert room.status()["playing"] and not remarks(said)
    laps(room, 0.2)
    assert not room.status()["playing"] and remarks(said) == ["the motion was played"]
    assert room.status()["velocity"] == [0.0, 0.0, 0.0]


def test_whoever_moves_the_robot_ends_what_is_played(room: Room, said: list[dict]):
    composed(room)
    room.hears(m.Play())
    laps(room, 0.2)
    room.hears(m.Stand())
    assert not room.status()["playing"]
    laps(room, 1.5)
    assert not remarks(said) and room.status()["composed"] == 2


def test_a_motion_outlives_a_reset_and_nothing_cannot_be_played(room: Room):
    with pytest.raises(WrongUse, match="nothing was composed"):
        room.hears(m.Play())
    far = composed(room)
    room.hears(m.Reset())
    assert not room.status()["playing"] and room.status()["composed"] == 2
    before = room.run.sensed.position_w.copy()
    room.hears(m.Play())
    laps(room, 1.2)
    assert math.dist(before[:2], room.run.sensed.position_w[:2]) == pytest.approx(far, abs=0.05)


def test_one_who_steers_a_held_skill_has_taken_over_from_it(room: Room):
    room.hears(m.Skill(name="walk"))
    laps(room, 0.4)
    room.hears(m.Stand())
    assert room.status()["held"] == ""


# --- an apprentice ----------------------------------------------------------------------------------
def waits(said: list[dict]) -> list[bool]:
    return [one["proposed"] for one in said if one["say"] == "tried"]


def test_what_an_apprentice_is_shown_waits_for_a_word_that_all_are_told_of(room: Room, said: list[dict]):
    room.hears(m.SetMode(mode="apprentice"))
    laps(room, 0.1)
    room.hears(m.Skill(name="trot", speed=0.3))
    shown = next(one for one in said if one["say"] == "tried")
    assert shown["followed"] and "trot" in shown["sentence"] and waits(said) == [True]
    assert not room.ledger.book.rulebook.rules, "nothing is learned before it is kept"
    room.hears(m.Keep())
    assert waits(said) == [True, False]
    assert [rule.action.skill for rule in room.ledger.book.rulebook.rules] == ["trot"]


@pytest.mark.parametrize("word", [m.Back(), m.Reset(), m.Right(skill="walk")])
def test_what_was_shown_waits_no_more_after_another_word(room: Room, said: list[dict], word: m.Message):
    room.hears(m.SetMode(mode="apprentice"))
    room.hears(m.Skill(name="trot"))
    room.hears(word)
    assert waits(said) == [True, False]


def test_no_one_else_than_an_apprentice_asks(room: Room, said: list[dict]):
    room.hears(m.Skill(name="trot"))
    room.hears(m.Back())
    assert not waits(said)


def test_a_robot_that_was_let_down_is_asked_nothing_but_to_begin_anew(room: Room):
    room.hears(m.Abort())
    for word in (
        m.Go(x=1.0, y=0.0),
        m.Skill(name="trot"),
        m.Steer(forward=0.2),
        m.Push(impulse=0.1, direction=0.0),
    ):
        with pytest.raises(WrongUse, match="aborted: the robot is let down: a reset begins another"):
            room.hears(word)
    room.hears(m.Reset())
    room.hears(m.Skill(name="trot"))
    assert room.status()["over"] is None and room.status()["held"] == "trot"


def test_what_is_played_ends_with_the_run(room: Room):
    room.hears(m.Compose(on=True))
    room.hears(m.Steer(forward=0.2))
    laps(room, 1.0)
    room.hears(m.Compose(on=False))
    room.hears(m.Play())
    room.hears(m.Abort())
    assert not room.status()["playing"]
    with pytest.raises(WrongUse, match="aborted"):
        room.hears(m.Play())


def test_a_motion_holds_that_its_composer_was_gone(room: Room):
    room.hears(m.Compose(on=True))
    room.hears(m.Steer(forward=0.2))
    time.sleep(0.4)  # longer than the watchdog waits
    room.driving.watch_over()
    room.hears(m.Compose(on=False))
    kinds = [type(word) for _, word in room.driving.score.words]
    assert kinds == [m.Steer, m.Stand]
