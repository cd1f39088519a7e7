"""Curves in a room: what a page asks of them is answered, and an edit is followed from the next cycle on."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from rooms import laps, opened

from gaitwright.errors import GaitwrightError, WrongUse
from gaitwright.studio import messages as m
from gaitwright.studio.room import Room


@pytest.fixture
def room(tmp_path: Path, said: list[dict]) -> Iterator[Room]:
    with opened(tmp_path, said) as room:
        room.hears(m.Skill(name="trot"))
        laps(room, 1.0)
        yield room


def raised(points: list[list[float]], by: float) -> list[list[float]]:
    """The path of a foot with its middle raised [body heights]."""
    middle = len(points) // 2
    return [[s, x, z + by * (k == middle)] for k, (s, x, z) in enumerate(points)]


def edit(room: Room, by: float) -> dict[str, Any]:
    points = raised(shown(room)["points"], by)
    return room.hears(m.Edit(kind="cycle", skill="trot", leg=0, points=points)) or {}


def shown(room: Room, kind: Any = "cycle") -> dict[str, Any]:
    return (room.hears(m.Curve(kind=kind, skill="trot")) or {})["curve"]


def test_an_edit_is_taken_undone_done_again_and_kept(room: Room, said: list[dict], tmp_path: Path):
    before = shown(room)
    taken = edit(room, 0.02)
    assert taken["taken"] and not taken["preview"]["fell"]
    assert taken["curve"]["points"] != before["points"] and taken["curve"]["undo"]
    assert said[-1]["say"] == "curve" and said[-1]["pending"]
    laps(room, 1.0)
    assert said[-1]["say"] == "curve" and not said[-1]["pending"], "a new cycle has begun since"
    room.hears(m.Undo())
    assert shown(room)["points"] == before["points"] and shown(room)["redo"]
    room.hears(m.Redo())
    assert shown(room)["points"] == taken["curve"]["points"]
    assert "trot" in (room.hears(m.Save()) or {})["sentences"][0]
    assert (tmp_path / "leg-cycles" / "go2" / "trot.json").is_file()


def test_a_path_that_no_leg_can_follow_changes_nothing(room: Room, said: list[dict]):
    before = len(said)
    refused = edit(room, 3.0)
    assert not refused["taken"] and refused["point"] == 4 and "body heights" in refused["because"]
    assert not shown(room)["undo"] and said[before:] == []


def test_edits_go_along_to_the_next_run_of_the_same_robot(room: Room):
    points = edit(room, 0.02)["curve"]["points"]
    room.hears(m.Reset(scene="stairs"))
    assert shown(room)["points"] == points
    room.hears(m.Reset(robot="thesis"))
    assert not shown(room)["undo"]


def test_a_curve_of_the_skill_in_use_is_shown_with_what_was_measured(room: Room):
    answer = room.hears(m.Curve(kind="angle", leg=3)) or {}
    assert answer["curve"]["skill"] == "trot" and answer["curve"]["leg"] == "RR"
    assert len(answer["curve"]["measured"]) > 20


@pytest.mark.parametrize(
    ("message", "sentence"),
    [
        (m.Curve(kind="cycle", skill="fly"), "fly"),
        (m.Curve(kind="cycle", skill="stand"), "lifts no foot"),
        (m.Curve(kind="torque", skill="trot"), "no torque profile of trot"),
        (m.Curve(kind="cycle", skill="trot", leg=9), "there is no leg 9: the legs are 0 to 3, FL"),
        (m.Undo(), "no edit to undo"),
        (m.Redo(), "no undone edit"),
        (m.Save(), "no edit to keep"),
    ],
)
def test_what_there_is_not_is_refused(room: Room, message: m.Message, sentence: str):
    with pytest.raises(GaitwrightError, match=sentence):
        room.hears(message)


def test_what_is_no_curve_is_no_message():
    for points in ([[0.0, 1.0]], [[0.0] * 5], [[0.0] * 3] * 129):
        text = {"do": "edit", "kind": "cycle", "skill": "trot", "leg": 0, "points": points}
        with pytest.raises(WrongUse, match="no message"):
            m.message_of(str(text).replace("'", '"'))
