"""The book that a mission learns into: opened before the trip, and its map of the place written after it."""

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from gaitwright.cli import trips
from gaitwright.cli.book_files import is_skillbook, new_file, skillbook_of
from gaitwright.cli.console import remark
from gaitwright.cli.driving import BY_BOOK
from gaitwright.driving import Memories
from gaitwright.errors import WrongUse, short
from gaitwright.files import is_there
from gaitwright.learning.map_books import known, map_in, notes_of, with_trip
from gaitwright.model.robot import Robot
from gaitwright.navigation.travel import Travel
from gaitwright.record.recording import Recording
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import Ledger, open_for_learning
from gaitwright.skills.situation import FOREST


@contextmanager
def book_of(args: Namespace, robot: Robot) -> Iterator[Ledger | None]:
    """The book of `--skillbook`, for this process alone to learn into; `None` where nothing is learned.

    One that is not there is begun, where no driver goes by it, and taken away again where nothing came into
    it. Raises `BadFile` for a file that is no book, but for rules that drive alone: they keep no map.
    """
    asked, goes_by_book = args.skillbook, args.driver in BY_BOOK
    if asked is None or not (args.learn or args.sight == "camera"):
        yield None
        return
    is_new = not is_there(asked) and not goes_by_book
    if is_new:
        path = new_file(asked, "skillbook", "--skillbook")
        Skillbook.new(FOREST, robot.name, path.stem, args.seed).save(path)
        remark(f"{short(asked)} is not there: a skillbook is begun")
    elif goes_by_book and not args.learn and not is_skillbook(asked):
        remark(f"{short(asked)} holds rules alone: no map is kept")
        yield None
        return
    else:
        skillbook_of(asked)
    ledger = None
    try:
        with open_for_learning(asked) as ledger:
            yield ledger
    finally:
        if is_new and (ledger is None or not ledger.book.maps):
            Path(asked).unlink()


def with_map(setting: trips.Setting, ledger: Ledger, place: str) -> trips.Setting:
    """The same with what the book knows of the place, which is said."""
    nothing = setting.brain.explorer.nothing(setting.scene.bounds)
    try:
        learned = map_in(ledger.book, place, nothing)
    except WrongUse as error:
        remark(f"{error}: it is learned anew")
        return setting
    if learned is None:
        remark(f"nothing is known of {place} yet")
        return setting
    remark(f"the map of {place}: {known(learned)}")
    return replace(setting, brain=setting.brain.with_map(learned))


def keep_map(ledger: Ledger, recording: Recording, memories: Memories, place: str) -> None:
    """Writes what the robot knows of the place now, and the way that it walked, into the book."""
    travel = memories.navigator
    assert isinstance(travel, Travel)
    learned = with_trip(travel.known, recording)
    ledger.keep_map(notes_of(learned, place))
    remark(f"the map of {place} is now: {known(learned)}")
