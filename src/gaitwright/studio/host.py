"""The process that has the robot: a `Room` on a clock, at the other end of a pipe from the server.

It is a process of its own, so that a busy page never slows the robot, nor the robot the page, and what breaks
in one does not take the other along. What goes through the pipe is bytes: a number that says for whom it is
(`FROM`), then a message as JSON, or a frame.
"""

import signal
import time
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

import msgspec

from gaitwright import compiled_ahead
from gaitwright.errors import GaitwrightError
from gaitwright.session import DT
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST
from gaitwright.studio.messages import id_of, message_of
from gaitwright.studio.room import Room
from gaitwright.studio.setup import EVERYBODY, FROM, Ends, Gone, Setup

FRAMES, STATUSES, SCANS, MAPS = 60.0, 10.0, 10.0, 2.0
"""So many a second."""
BUSY = 0.012
"""Longest stretch of laps without a look at what is asked, and of what is asked without a lap [s]."""
FIRST_RUN = "compiling, at a first run only: about a minute …"
BEHIND = 0.1
"""What is owed beyond this is dropped: a slow machine walks slower, and does not try to catch up [s]."""


def host(pipe: Ends, setup: Setup, book: Path, folder: Path, begins: bool) -> None:
    """Runs until the other end of the pipe is gone; says why where it cannot."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # for the server to act on: it closes the pipe
    cold = compiled_ahead.begin()
    try:
        if cold:
            tell(pipe, EVERYBODY, {"say": "waits", "because": FIRST_RUN})
        if begins and not book.exists():
            folder.mkdir(parents=True, exist_ok=True)
            Skillbook.new(FOREST, setup.robot, book.stem, setup.seed).save(book)
        with open_for_learning(book) as ledger:
            room = Room(setup, ledger, folder, lambda said: tell(pipe, EVERYBODY, said))
            try:
                Clock(room, pipe, cold).run()
            finally:
                room.close()
    except Gone:  # nobody is left to tell
        pass
    except GaitwrightError as error:
        ended(pipe, str(error), error.exit_code)
    except Exception as error:
        traceback.print_exc()
        ended(pipe, fault_of(error), GaitwrightError.exit_code)


def ended(pipe: Ends, because: str, code: int) -> None:
    """Says why there is no robot any more."""
    with suppress(Gone):
        tell(pipe, EVERYBODY, {"say": "closed", "because": because, "code": code})


def fault_of(error: Exception) -> str:
    """A fault of ours, in a sentence; what led to it is on the terminal."""
    return f"this should not have happened: {type(error).__name__}: {error}; the terminal says where"


class Clock:
    """Gives a room its time: laps as they are due, and what is told of them."""

    def __init__(self, room: Room, pipe: Ends, is_waited_for: bool = False) -> None:
        """`is_waited_for`: whether everybody was told so, until it moves."""
        self.room, self.pipe, self.is_waited_for = room, pipe, is_waited_for
        self.sequence = 0
        self.owed = 0.0
        """Simulated time that is due [s]."""
        self.real_time = 1.0
        """Simulated seconds per second, of late."""
        self.due = dict.fromkeys((self.say_frame, self.say_status, self.say_scan, self.say_seen), 0.0)

    def run(self) -> None:
        """Until the other end is gone (`Gone`)."""
        self.room.welcome()
        before = time.monotonic()
        while True:
            self.listen()
            now = time.monotonic()
            passed, before = now - before, now
            walked = self.walk(passed)
            if walked and self.is_waited_for:
                self.is_waited_for = False
                tell(self.pipe, EVERYBODY, {"say": "waits", "because": ""})
            self.tell_what_is_due(time.monotonic())
            if not walked:
                self.pipe.poll(0.004)  # until somebody says something

    def listen(self) -> None:
        """Does what was asked since; of very much the rest waits, so that time goes on."""
        until = time.monotonic() + BUSY
        while self.pipe.poll() and time.monotonic() < until:
            said = self.pipe.recv_bytes()
            (who,) = FROM.unpack_from(said)
            self.answer(who, said[FROM.size :])
        self.room.driving.watch_over()

    def answer(self, who: int, text: bytes) -> None:
        """Does what one asks, and says whether it is done."""
        asked = {"id": id_of(text)}
        try:
            answer = self.room.hears(message_of(text))
        except GaitwrightError as error:
            tell(self.pipe, who, {"say": "refused", **asked, "because": str(error)})
            return
        except Gone:
            raise
        except Exception as error:
            traceback.print_exc()
            tell(self.pipe, who, {"say": "refused", **asked, "because": fault_of(error)})
            return
        tell(self.pipe, who, {"say": "done", **asked, **(answer or {})})
        self.due[self.say_status] = self.due[self.say_frame] = 0.0  # who asked sees it at once

    def walk(self, passed: float) -> bool:
        """Laps for so much time [s]; whether there were any."""
        if self.room.paused:
            self.owed = 0.0
            return False
        self.owed = min(self.owed + passed * self.room.pace, BEHIND)
        until, laps = time.monotonic() + BUSY, 0
        while self.owed >= DT and time.monotonic() < until and self.room.lap():
            self.owed -= DT
            laps += 1
        share = min(1.0, passed / 0.5)
        self.real_time += share * (laps * DT / passed - self.real_time) if passed > 0.0 else 0.0
        return laps > 0

    # --- what is told -------------------------------------------------------------------------------
    def tell_what_is_due(self, now: float) -> None:
        rates = (FRAMES, STATUSES, SCANS, MAPS)
        for (say, due), rate in zip(list(self.due.items()), rates, strict=True):
            if now >= due:
                self.due[say] = max(due + 1.0 / rate, now)
                say()

    def say_frame(self) -> None:
        frame = self.room.frame(self.sequence)
        if frame is not None:
            self.sequence += 1
            self.pipe.send_bytes(FROM.pack(EVERYBODY) + frame)

    def say_status(self) -> None:
        told = self.room.status() | {"real_time": round(self.real_time, 3)}
        tell(self.pipe, EVERYBODY, told)

    def say_scan(self) -> None:
        self.room.say_scan()

    def say_seen(self) -> None:
        self.room.teaching.look()
        self.room.say_seen()


def tell(pipe: Ends, who: int, said: dict[str, Any]) -> None:
    """Sends a message; numbers that are none as null."""
    pipe.send_bytes(FROM.pack(who) + msgspec.json.encode(said))
