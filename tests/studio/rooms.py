"""A room without a page, to talk to."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from gaitwright.gait.operators import Operator
from gaitwright.learning.operator_books import notes_of
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST
from gaitwright.studio import messages as m
from gaitwright.studio.room import Room
from gaitwright.studio.setup import Setup


@contextmanager
def opened(
    folder: Path, said: list[dict], scene: str = "blocks", operators: Sequence[Operator] = ()
) -> Iterator[Room]:
    """A Go2 that waits, with a new book in a folder; what is said to everybody is noted in `said`."""
    book = folder / "studio.skills"
    Skillbook.new(FOREST, "go2", "studio", 0).save(book)
    with open_for_learning(book) as ledger:
        if operators:
            ledger.keep_operators([notes_of(one) for one in operators])
        room = Room(Setup(scene=scene, driver="numerical"), ledger, folder, said.append)
        yield room
        room.close()


def kept(room: Room) -> Path:
    """The file of what was recorded up to now."""
    name = room.hears(m.Record(on=False))["recording"]
    settle(room)
    return room.recording.shelf.path(name)


def settle(room: Room) -> None:
    """Returns when what was recorded is written, as far as it can be."""
    room.recording.writer.submit(lambda: None).result()


def laps(room: Room, seconds: float) -> None:
    """Time for the robot, as far as its run goes on."""
    for _ in range(round(seconds / 0.002)):
        if not room.lap():
            break
