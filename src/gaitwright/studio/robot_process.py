"""The process that has the robot, from the server's side: begun, asked, begun anew, ended.

Quick to import: it is the first thing that a studio begins, since a robot takes longest.
"""

import multiprocessing
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from gaitwright.studio.messages import Reset
from gaitwright.studio.setup import FROM, Ends, Setup, begin

SETTLES = 10.0
"""It may take so long to end [s]."""


class RobotProcess:
    """A run in a process of its own; a context manager, after which it is gone."""

    def __init__(self, setup: Setup, book: Path, folder: Path, begins: bool = False) -> None:
        """`folder`: for recordings; `begins`: whether a book that is not there is begun."""
        self.setup, self.book, self.folder, self.begins = setup, book, folder, begins
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
        self.process.start()
        for end in theirs:
            end.close()

    def again(self, said: Reset) -> None:
        """Another run in the place of one that has ended."""
        self.end()
        given = {name: getattr(said, name) for name in self.setup.__slots__}
        self.setup = replace(self.setup, **{name: of for name, of in given.items() if of is not None})
        self.begin()

    def ask(self, who: int, text: bytes) -> None:
        """Hands on what a page asks."""
        with suppress(OSError):  # it is gone: what it said last tells so
            self.ends.send_bytes(FROM.pack(who) + text)

    def end(self) -> None:
        """Ends it; it keeps what was recorded."""
        self.ends.tells.close()
        self.process.join(SETTLES)
        if self.process.is_alive():
            self.process.terminate()
