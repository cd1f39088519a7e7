"""The process that has the robot, from the server's side: begun, asked, begun anew, ended.

Quick to import: it is the first thing that a studio begins, since a robot takes longest.
"""

import multiprocessing
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Full, Queue

from gaitwright.errors import WrongUse
from gaitwright.studio.setup import FROM, Ends, Gone, Setup, begin

WRITES, SETTLES = 120.0, 3.0
"""It may take so long to end where it has a recording to write, and where it is begun anew [s]."""
SAFE_PATH = "PYTHONSAFEPATH"
MOST_WAITING = 1000
"""So much may be asked that it has not heard yet."""


class RobotProcess:
    """A run in a process of its own; a context manager, after which it is gone."""

    def __init__(self, setup: Setup, book: Path, folder: Path, begins: bool = False) -> None:
        """`folder`: for recordings; `begins`: whether a book that is not there is begun."""
        self.setup, self.book, self.folder, self.begins = setup, book, folder, begins
        self.has_begun = False
        """Whether there is a run, of which something may have been recorded."""
        self.begin()

    def __enter__(self) -> "RobotProcess":
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    def begin(self) -> None:
        """A run from its start."""
        self.ends, theirs = Ends.pair()
        arguments = (theirs, self.setup, str(self.book), str(self.folder), self.begins)
        context = multiprocessing.get_context("spawn")
        self.process = context.Process(target=begin, args=arguments, daemon=True)
        with safe_path():
            self.process.start()
        for end in theirs:
            end.close()
        self.asked = Queue[bytes | None](MOST_WAITING)
        threading.Thread(target=hand_on, args=(self.asked, self.ends), daemon=True).start()

    def again(self, setup: Setup) -> None:
        """Another run in the place of one that has ended, or that does not answer."""
        self.end(SETTLES)
        self.setup = setup
        self.begin()

    def ask(self, who: int, text: bytes) -> None:
        """Hands on what a page asks. Raises `WrongUse` where too much waits to be heard."""
        try:
            self.asked.put_nowait(FROM.pack(who) + text)
        except Full:
            raise WrongUse("the robot's process does not answer: a reset begins another") from None

    def end(self, patience: float | None = None) -> None:
        """Ends it; it keeps what was recorded, unless that takes longer than `patience` [s]."""
        if patience is None:
            patience = WRITES if self.has_begun else SETTLES
        with suppress(Full):
            self.asked.put_nowait(None)
        try:
            self.process.join(patience if self.process.is_alive() else 0.0)
        except KeyboardInterrupt:  # who is impatient waits a little longer for what was recorded
            self.process.join(SETTLES)
        if self.process.is_alive():
            self.process.kill()
            self.process.join(SETTLES)


@contextmanager
def safe_path() -> Iterator[None]:
    """Processes that are begun meanwhile take no file of the folder that one is in for a module."""
    before = os.environ.get(SAFE_PATH)
    os.environ[SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[SAFE_PATH]
        else:
            os.environ[SAFE_PATH] = before


def hand_on(asked: "Queue[bytes | None]", ends: Ends) -> None:
    """Writes what is asked, in a thread of its own: who writes to one that does not read waits. At the end it
    closes the way there, which ends the process."""
    with suppress(Gone):
        while (text := asked.get()) is not None:
            ends.send_bytes(text)
    ends.tells.close()
