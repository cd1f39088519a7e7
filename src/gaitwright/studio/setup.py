"""What is begun, and how the server and the process with the robot talk: nothing here is slow to import."""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

FROM = struct.Struct("<I")
"""Goes before all that is sent: who said it, or who is answered; 0: everybody."""
EVERYBODY = 0
HYBRID, NUMERICAL = "hybrid", "numerical"
DRIVERS = ("programmed", "kinematic", NUMERICAL, "learned", HYBRID)


@dataclass(frozen=True, slots=True)
class Setup:
    """What a run is of, by names."""

    robot: str = "go2"
    scene: str = "blocks"
    seed: int = 0
    sight: str = "known"
    """Or "camera": nothing is known but what the robot sees."""
    driver: str = "hybrid"


def who_drives(driver: str) -> str:
    """Who has the joints in a lap by `driver`: where a hybrid does not name the learned controller, it is the
    numerical one."""
    return NUMERICAL if driver == HYBRID else driver


class Gone(Exception):
    """Whoever was at the other end is there no more."""


class Ends(NamedTuple):
    """One side of the connection between server and robot: two pipes, each for one way.

    So one thread can wait for what is said while another closes the way there, which ends the other side.
    """

    hears: Connection
    tells: Connection

    @classmethod
    def pair(cls) -> "tuple[Ends, Ends]":
        """Both sides."""
        ours_in, theirs_out = Pipe(duplex=False)
        theirs_in, ours_out = Pipe(duplex=False)
        return cls(ours_in, ours_out), cls(theirs_in, theirs_out)

    def send_bytes(self, said: bytes) -> None:
        """Raises `Gone`, as the others do."""
        with attended():
            self.tells.send_bytes(said)

    def recv_bytes(self) -> bytes:
        with attended():
            return self.hears.recv_bytes()

    def poll(self, timeout: float = 0.0) -> bool:
        with attended():
            return self.hears.poll(timeout)


@contextmanager
def attended() -> Iterator[None]:
    """What a pipe raises when nobody is at its other end becomes `Gone`."""
    try:
        yield
    except (EOFError, OSError) as error:
        raise Gone(str(error)) from None


def begin(pipe: Ends, setup: Setup, book: str, folder: str, begins: bool) -> None:
    """In a process of its own: the robot, at this end of a pipe. `begins`: whether a book that is not there
    is begun."""
    from gaitwright.studio.host import host  # noqa: PLC0415 - only here: it takes seconds to import

    host(pipe, setup, Path(book), Path(folder), begins)
