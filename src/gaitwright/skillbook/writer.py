"""Learning into a file: every lesson is on the disk before anyone is told that it was learned."""

import sqlite3
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.json_form import MAX_EVENTS
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.knowledge.told import Told
from gaitwright.knowledge.trust import Experience
from gaitwright.skillbook import rows
from gaitwright.skillbook.book import Skillbook, about_of, book_of
from gaitwright.skillbook.entries import (
    checked,
    encoded,
    event_entries,
    map_entries,
    operator_entries,
    profile_entries,
    step_entry,
    trust_entries,
)
from gaitwright.skillbook.history import Step, forgotten, names_told
from gaitwright.skillbook.map_notes import MapNotes
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.profile_notes import ProfileNotes
from gaitwright.skillbook.pupil_notes import PupilNotes
from gaitwright.skillbook.schema import MAX_BYTES, connected, located, migrate, number, sentences, version_of

PATIENCE = 2000
"""So long a beginning learner waits for those who read the file at that moment [ms]."""


class Ledger:
    """A skillbook file that one process teaches; a context manager. `book` is all that is on the disk.

    It holds the file's write lock from lesson to lesson, which the system takes back at any death. Others
    can read meanwhile. Use it in the thread that opened it.
    """

    def __init__(self, path: Path, db: sqlite3.Connection, book: Skillbook) -> None:
        self.path, self._db, self.book = path, db, book
        self._seen = number(db, "data_version")
        self._lost = ""

    def __enter__(self) -> "Ledger":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def tell(self, told: Told, events: tuple[Event, ...] = ()) -> Skillbook:
        """Stores what a pupil was told, and what that moved; her notes and rules come with `settle`.

        Raises `WrongUse` where something of that name was told before.
        """
        if told.id in names_told(self.book.steps):
            raise WrongUse(f"{told.id} was told before: what is told has a name of its own")
        return self._append(Step("told", told=told), self._moved(events, 1))

    def forget(
        self, name: str, rulebook: Rulebook, notes: PupilNotes, events: tuple[Event, ...]
    ) -> Skillbook:
        """Stores that something told does not count any more, and what the pupil makes of the rest.

        Raises `WrongUse` where nothing of that name counts.
        """
        steps = self.book.steps
        if name in forgotten(steps) or name not in names_told(steps):
            raise WrongUse(f"{name} was never told, or is forgotten already")
        after = replace(rulebook, events=self._moved(events).events)
        return self._append(Step("forgotten", note=name), after, notes)

    def settle(self, rulebook: Rulebook, notes: PupilNotes) -> Skillbook:
        """Stores the rules that a pupil has made of all that she was told, and her notes."""
        rulebook = replace(rulebook, events=self.book.rulebook.events)
        return self._store(replace(self.book, rulebook=rulebook, pupil=notes), {})

    def keep_profiles(self, profiles: Iterable[ProfileNotes], lived: Iterable[Experience] = ()) -> Skillbook:
        """Stores torque profiles in place of all that were in the book, and what was lived through with them.
        Raises `WrongUse` where no file can hold them."""
        return self._with_trust(replace(self.book, profiles=profile_entries(profiles)), lived)

    def trust(self, lived: Iterable[Experience]) -> Skillbook:
        """Stores more of what the learned controller went through. Raises `WrongUse` where no file can hold
        it."""
        return self._with_trust(self.book, lived)

    def _with_trust(self, book: Skillbook, lived: Iterable[Experience]) -> Skillbook:
        before = self.book.trust
        trust = trust_entries((*before, *lived))
        return self._store(replace(book, trust=trust), rows.trust_rows(trust[len(before) :], len(before)))

    def keep_operators(self, operators: Iterable[OperatorNotes]) -> Skillbook:
        """Stores terrain operators in place of all that were in the book, in the order in which they are
        tried. Raises `WrongUse` where no file can hold them."""
        return self._store(replace(self.book, operators=operator_entries(operators)), {})

    def keep_map(self, notes: MapNotes) -> Skillbook:
        """Stores a learned map in place of the one of its place. Raises `WrongUse` where no file can hold
        it."""
        others = (other for other in self.book.maps if other.place != notes.place)
        return self._store(replace(self.book, maps=map_entries((*others, notes))), {})

    def _moved(self, events: tuple[Event, ...], lessons: int = 0) -> Rulebook:
        """The rules as they are in the file, with more events and lessons behind them."""
        now = self.book.rulebook
        return replace(now, events=(*now.events, *events), lessons=now.lessons + lessons)

    def close(self) -> None:
        """Leaves one file without a log beside it, unless someone is reading it now."""
        with suppress(sqlite3.Error):
            self._db.execute("ROLLBACK")
        with suppress(sqlite3.Error):
            self._db.execute("PRAGMA journal_mode=DELETE")
        self._db.close()

    def _append(self, step: Step, rulebook: Rulebook, notes: PupilNotes | None = None) -> Skillbook:
        """The book with one more step, once it is on the disk."""
        known = len(self.book.rulebook.events)
        if len(rulebook.events) > MAX_EVENTS:
            raise WrongUse(f"a skillbook holds at most {MAX_EVENTS} events")
        step = replace(step, events=rulebook.events[known:])
        pupil = self.book.pupil if notes is None else notes
        book = replace(self.book, rulebook=rulebook, steps=(*self.book.steps, step), pupil=pupil)
        return self._store(
            book, rows.step_rows(len(self.book.steps), step_entry(step), event_entries(step.events))
        )

    def _store(self, book: Skillbook, added: rows.Rows) -> Skillbook:
        """The book, once it is on the disk: what differs from the one there, and rows of a new step."""
        if self._lost:
            raise BadFile(self._lost)
        added["book", (0,)] = encoded(about_of(book))
        if book.pupil is not None and book.pupil is not self.book.pupil:
            added["pupil", (0,)] = encoded(checked(book.pupil, PupilNotes))
        with sentences(self.path):
            try:
                rows.change(self._db, self.book.rulebook, book.rulebook)
                rows.change_profiles(self._db, self.book.profiles, book.profiles)
                rows.change_operators(self._db, self.book.operators, book.operators)
                rows.change_maps(self._db, self.book.maps, book.maps)
                rows.put(self._db, added)
                self._db.execute("COMMIT")
            except BaseException:  # an interrupt too: what was not acknowledged must not be half there
                self._restart()
                raise
        self.book = book
        self._resume()
        return book

    def _restart(self) -> None:
        """Back to what is on the disk."""
        with suppress(sqlite3.Error):
            self._db.execute("ROLLBACK")
        self._resume()

    def _resume(self) -> None:
        """Takes the write lock again; should another have had it in between, this ledger is over."""
        try:
            self._db.execute("BEGIN IMMEDIATE")
        except sqlite3.Error as error:
            self._lost = f"{self.path} cannot be taught any more: {error}"
            return
        if number(self._db, "data_version") != self._seen:
            self._lost = f"{self.path} was changed by another process: open it again to go on"


def open_for_learning(path: str | Path) -> Ledger:
    """The book in a file, to be taught by this process alone. Raises `BadFile` where it is no book, a damaged
    one, or taught already."""
    real = located(path)
    inode = real.stat().st_ino
    with sentences(real):
        db = connected(real, "rw")
        try:
            _prepare(db, real)
            if real.stat().st_ino != inode:
                raise BadFile(f"{path} was replaced while it was opened: open it again")
            return Ledger(real, db, book_of(rows.read(db, str(path)), str(path)))
        except BaseException:
            db.close()
            raise


def _prepare(db: sqlite3.Connection, path: Path) -> None:
    """Checks the file, brings it to the newest version, and takes its write lock."""
    db.execute("BEGIN IMMEDIATE")
    migrate(db, version_of(db, path))
    db.execute("COMMIT")
    db.execute(f"PRAGMA busy_timeout={PATIENCE}")
    db.execute("PRAGMA journal_mode=WAL")
    db.execute("PRAGMA busy_timeout=0")
    db.execute(f"PRAGMA max_page_count={MAX_BYTES // number(db, 'page_size')}")
    db.execute("BEGIN IMMEDIATE")
