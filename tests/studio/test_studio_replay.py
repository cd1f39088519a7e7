"""A recording as one page: what is in it is what was recorded, and nothing in it can break out."""

import base64
import json
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rooms import laps, opened

from gaitwright.errors import WrongUse
from gaitwright.record.recording import Recording, load
from gaitwright.studio import messages as m
from gaitwright.studio.replay import PLACE, TEMPLATE, replay_data, replay_page


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    """Two skills, one after the other."""
    with opened(tmp_path, []) as room:
        room.hears(m.Record(on=True))
        room.hears(m.Skill(name="walk"))
        laps(room, 1.0)
        room.hears(m.Skill(name="pace"))
        laps(room, 1.0)
        return load(tmp_path / room.hears(m.Record(on=False))["recording"])


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
