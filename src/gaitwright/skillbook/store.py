"""Whole books ↔ files."""

import os
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path

from gaitwright.errors import BadFile, WrongUse
from gaitwright.files import whole
from gaitwright.skillbook import rows
from gaitwright.skillbook.entries import File, encoded
from gaitwright.skillbook.schema import MIGRATIONS, connected, located, make, migrate, sentences, version_of


def read(path: str | Path) -> File:
    """All of a book, as it is at one moment, brought to the newest version. Raises `BadFile`."""
    real = located(path)
    with sentences(real), closing(connected(real, reading_mode(real))) as db:
        db.execute("PRAGMA query_only=ON")
        db.execute("BEGIN")
        version = version_of(db, real)
        if version == len(MIGRATIONS):
            return rows.read(db, str(path))
        with closing(sqlite3.connect(":memory:", isolation_level=None)) as copy:
            db.backup(copy)
            migrate(copy, version)
            return rows.read(copy, str(path))


def reading_mode(path: Path) -> str:
    """How SQLite may open a file to read it: it mends what a kill left behind wherever it may write."""
    if os.access(path, os.W_OK) and os.access(path.parent, os.W_OK):
        return "rw"
    left = any(path.with_name(f"{path.name}{end}").exists() for end in ("-wal", "-journal"))
    return "ro" if left else "ro&immutable=1"


def write(entry: File, path: str | Path) -> Path:
    """A book as a new file, in place of what was there. Raises `BadFile` where that is in use."""
    real = Path(path).resolve()
    if real.exists() and not real.is_file():
        raise WrongUse(f"{path} is not a file: no book can be written there")
    with at_rest(real), whole(real) as draft, sentences(draft), closing(connected(draft, "rwc")) as db:
        db.execute("PRAGMA journal_mode=MEMORY")  # a draft that is not finished is thrown away
        db.execute("BEGIN")
        make(db)
        rows.put(db, file_rows(entry))
        db.execute("COMMIT")
    synced(real.parent)
    return Path(path)


def file_rows(entry: File) -> rows.Rows:
    """All rows of a book."""
    found = {("book", (0,)): encoded(entry.about)}
    found |= {("ancestors", (k,)): encoded(ancestor) for k, ancestor in enumerate(entry.ancestors)}
    if entry.pupil is not None:
        found["pupil", (0,)] = encoded(entry.pupil)
    found |= rows.profile_rows(entry.profiles) | rows.trust_rows(entry.trust)
    found |= rows.operator_rows(entry.operators) | rows.map_rows(entry.maps)
    found |= rows.book_rows(entry.rulebook, range(len(entry.rulebook.rules)))
    start = 0
    for place, step in enumerate(entry.steps):
        found |= rows.step_rows(place, step, entry.rulebook.events[start : start + step.events])
        start += step.events
    return found


@contextmanager
def at_rest(path: Path) -> Iterator[None]:
    """While another file takes this one's place: what a killed learner left beside it is taken in first
    (its log would be read into the new file), and nobody can begin to learn. Raises `BadFile`."""
    beside = [path.with_name(f"{path.name}{end}") for end in ("-wal", "-shm", "-journal")]
    if not path.exists():
        for left in beside:
            left.unlink(missing_ok=True)
        yield
        return
    with sentences(path):
        db = lock_file(path, beside)
    if db is not None and os.name == "nt":  # which replaces no file that is open
        db.close()
    try:
        yield
    finally:
        if db is not None:
            db.close()


def lock_file(path: Path, beside: Sequence[Path]) -> sqlite3.Connection | None:
    """A connection that keeps others out, with all that a log held in the file; `None` where the file is no
    SQLite file, or a damaged one: it may go, but a log beside it may not."""
    db = None
    try:
        db = connected(path, "rw")
        db.execute("PRAGMA journal_mode=DELETE")
        db.execute("BEGIN EXCLUSIVE")
        return db
    except sqlite3.DatabaseError as error:
        if db is not None:
            db.close()
        if isinstance(error, sqlite3.OperationalError):
            raise
    if any(left.exists() for left in beside):
        raise BadFile(f"{path} is damaged and has a log beside it: move both away first")
    return None


def synced(folder: Path) -> None:
    """Makes a new name in a folder last through a loss of power, where the system can."""
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
