"""A recording as one page: what is in it is what was recorded, and nothing in it can break out."""

import base64
import json
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from rooms import kept, laps, opened

from gaitwright.errors import BadFile, WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.record.mcap_export import export_mcap
from gaitwright.record.notes import Note
from gaitwright.record.recording import Recording, load
from gaitwright.record.scene_of import scene_of
from gaitwright.studio import messages as m
from gaitwright.studio.replay import PLACE, TEMPLATE, replay_data, replay_page
from oracles import robot_called


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    """Two skills, one after the other."""
    with opened(tmp_path, []) as room:
        room.hears(m.Record(on=True))
        room.hears(m.Skill(name="walk"))
        laps(room, 1.0)
        room.hears(m.Skill(name="pace"))
        laps(room, 1.0)
        return load(kept(room))


def rows_in(data: dict) -> np.ndarray:
    plain = zlib.decompress(base64.b64decode(data["rows"]), -zlib.MAX_WBITS)
    return np.frombuffer(plain, "<f4").reshape(data["count"], -1)


def test_rows_are_what_was_recorded_fifty_times_a_second(recording: Recording):
    data = replay_data(recording)
    rows, at = rows_in(data), 0
    assert data["rate"] == pytest.approx(50.0) and len(rows) == len(recording["time"][::10])
    for column in data["columns"]:
        mine = rows[:, at : at + column["size"]]
        at += column["size"]
        if column["name"] in ("time", "position_w", "q", "tau", "forces_w"):
            theirs = recording[column["name"]][::10].reshape(len(rows), -1)
            np.testing.assert_allclose(mine, theirs, rtol=1e-5, atol=1e-5)
    assert at == rows.shape[1]


def test_events_are_the_skills_in_their_order(recording: Recording):
    events = replay_data(recording)["events"]
    assert [event["skill"] for event in events][-2:] == ["walk", "pace"]
    assert [event["time"] for event in events] == sorted(event["time"] for event in events)


def test_no_name_breaks_out_of_the_page(recording: Recording, tmp_path: Path):
    (tmp_path / TEMPLATE).write_text(f"<html>{PLACE}</script></html>", encoding="utf-8")
    evil = replace(recording, scene="<!--</script><script>alert(1)</script>")
    page = replay_page(evil, tmp_path)
    assert page.count("</script>") == page.count("<script") == 1 and "<!--" not in page
    data = page.partition(PLACE)[2].rpartition("</script>")[0]
    assert "<!--</script><script>" in json.loads(data)["title"]


def test_what_cannot_be_shown_is_told(recording: Recording, tmp_path: Path):
    with pytest.raises(WrongUse, match="not built"):
        replay_page(recording, tmp_path / "nowhere")
    with pytest.raises(WrongUse, match="no moment"):
        replay_data(replace(recording, data=recording.data[:0, :]))


# --- what a person did ------------------------------------------------------------------------------
@pytest.fixture
def told(tmp_path: Path) -> Recording:
    """A box is dragged, and on at once; another driver is asked; what is done is right; a skill is held."""
    with opened(tmp_path, []) as room:
        before = room.hears(m.PlaceBox(x=3.0, y=-2.0, lx=0.3, ly=0.3, height=0.2))["thing"]
        laps(room, 0.1)
        room.hears(m.Record(on=True))
        laps(room, 0.3)
        room.hears(m.Move(thing=before, x=3.0, y=2.0))
        laps(room, 0.1)
        room.hears(m.Move(thing=before, x=3.5, y=2.0))
        room.hears(m.Drive(driver="kinematic"))
        room.hears(m.Ok())
        laps(room, 0.5)
        room.hears(m.Skill(name="trot"))
        laps(room, 0.3)
        return load(kept(room))


def test_a_recording_says_what_a_person_did(told: Recording):
    assert [note.time for note in told.notes] == sorted(note.time for note in told.notes)
    first, dragged, driver, *others = replay_data(told)["notes"]
    assert first["kind"] == dragged["kind"] == "world" and "(3.50, 2.00)" in dragged["sentence"]
    assert driver["kind"] == "mode" and "kinematic" in driver["sentence"]
    assert [note["kind"] for note in others] == ["lesson", "mode"]


def test_a_replay_says_why_each_skill_was_chosen(told: Recording):
    events = replay_data(told)["events"]
    assert {event["skill"] for event in events} == {"stand", "trot"}
    assert all(event["because"] for event in events), events


def test_a_box_is_seen_where_it_was_at_the_time(told: Recording):
    scene, begins, ends = scene_of(told), float(told["time"][0]), float(told["time"][-1])
    assert isinstance(scene, Scene)

    def places(time: float) -> set[tuple[float, float]]:
        now = scene.at(time)
        return {solid.centre for solid in (*now.boxes, *now.things)}

    assert (3.0, -2.0) in places(begins) and (3.0, -2.0) not in places(ends)
    assert (3.5, 2.0) in places(ends) and (3.5, 2.0) not in places(begins)
    assert len(places(begins)) == len(places(ends))
    assert (3.0, 2.0) not in places(ends), "it was dragged on at once"


def test_topics_for_what_a_person_did_open_in_foxglove(told: Recording, tmp_path: Path):
    path, found = export_mcap(told, tmp_path / "told.mcap"), {}
    with path.open("rb") as file:
        for _, channel, message in make_reader(file).iter_messages():
            found.setdefault(channel.topic, []).append(message.data)
    assert len(found["/gaitwright/world"]) == 2 and len(found["/gaitwright/mode"]) == 2
    (lesson,) = map(json.loads, found["/gaitwright/lesson"])
    (note,) = (note for note in told.notes if note.kind == "lesson")
    assert lesson == {"time": note.time, "sentence": note.sentence}


def test_notes_of_a_file_are_not_believed(told: Recording, tmp_path: Path):
    for notes in ((Note(1.0, "mode", "x" * 5000),), (Note(1.0, "", "no kind"),)):
        path = replace(told, notes=notes).save(tmp_path / "evil.npz")
        with pytest.raises(BadFile):
            load(path)
    shown = load(replace(told, notes=(Note(1.0, "mode", "\x1b[2J"),)).save(tmp_path / "red.npz"))
    assert "\x1b" not in shown.notes[0].sentence


# --- several on one page ----------------------------------------------------------------------------
def test_several_recordings_are_shown_on_one_ground(recording: Recording, told: Recording):
    data = replay_data(recording, others=[told, recording])
    world = json.loads(zlib.decompress(base64.b64decode(data["world"]), -zlib.MAX_WBITS))
    assert [robot["name"] for robot in world["robots"]] == ["go2"] * 3
    first, second = data["others"]
    np.testing.assert_array_equal(rows_in({**data, **first}), rows_in(replay_data(told)))
    assert [event["skill"] for event in second["events"]] == [event["skill"] for event in data["events"]]


def test_what_does_not_fit_on_one_page_is_refused(recording: Recording):
    with pytest.raises(WrongUse, match="21 recordings on one page; there can be 20"):
        replay_data(recording, others=[recording] * 20)
    hexapod = replace(recording, robot=robot_called("hexapod"))
    with pytest.raises(WrongUse, match="hexapod has 6 legs, and go2 4"):
        replay_data(recording, others=[hexapod])
