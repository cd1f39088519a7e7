"""The robot's process where something goes wrong in it: it is told, and what can go on goes on."""

import json
import signal
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from rooms import laps, opened

from gaitwright.signals import Measured
from gaitwright.studio import messages as m
from gaitwright.studio.host import Clock, host
from gaitwright.studio.room import Room
from gaitwright.studio.setup import FROM, Ends, Gone, Setup


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    with opened(tmp_path, [], "flat") as room:
        yield room


def told(ours: Ends) -> list[dict]:
    """What was said up to now, frames left out."""
    said = []
    while ours.poll():
        what = ours.recv_bytes()[FROM.size :]
        if what.startswith(b"{"):
            said.append(json.loads(what))
    return said


def test_a_fault_of_ours_is_told_to_who_asked_and_the_robot_goes_on(room: Room, capsys):
    ours, theirs = Ends.pair()
    clock = Clock(room, theirs)

    def breaks(said: m.Why) -> None:
        raise ZeroDivisionError("of nothing")

    room.does[m.Why] = breaks
    clock.answer(1, b'{"do": "why", "id": 7}')
    (refused,) = told(ours)
    assert refused["id"] == 7 and "ZeroDivisionError: of nothing" in refused["because"]
    assert "breaks" in capsys.readouterr().err, "the terminal says where"
    clock.answer(1, b'{"do": "stand", "id": 8}')
    assert told(ours) == [{"say": "done", "id": 8}] and room.lap()


def test_a_state_that_is_no_number_ends_the_run_with_a_sentence(room: Room):
    ours, theirs = Ends.pair()
    clock = Clock(room, theirs)
    laps(room, 0.1)
    session = room.run.session
    row = session.measured.row.copy()
    row[1:4] = np.nan
    felt = session.measured.specific_force_b
    session.measured = Measured.of_row(row, time=session.measured.time, specific_force_b=felt)
    laps(room, 0.1)
    clock.tell_what_is_due(1e9)
    status = [one for one in told(ours) if one["say"] == "status"][-1]
    assert "not a number" in status["over"] and session.closed
    room.hears(m.Reset())
    assert room.lap() and room.status()["over"] is None


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Whatever a test does to Ctrl-C, it works again after it."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_what_cannot_begin_says_so(tmp_path: Path):
    ours, theirs = Ends.pair()
    (tmp_path / "book.skills").mkdir()
    host(theirs, Setup(), tmp_path / "book.skills", tmp_path, begins=False)
    (closed,) = told(ours)
    assert closed["say"] == "closed" and closed["because"] and closed["code"]


def test_whoever_is_gone_is_not_told():
    ours, theirs = Ends.pair()
    ours.hears.close()
    with pytest.raises(Gone):
        theirs.send_bytes(b"anything")
    ours.tells.close()
    with pytest.raises(Gone):
        theirs.recv_bytes()
