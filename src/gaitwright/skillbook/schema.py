"""The tables of a skillbook, their versions, and the checks before a file is believed."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from gaitwright.errors import BadFile

APPLICATION = 0x47614954
"""`application_id` of a skillbook ("GaIT")."""
MAX_BYTES = 256_000_000

FIRST = """
CREATE TABLE book (place INTEGER NOT NULL PRIMARY KEY CHECK (place = 0),
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
CREATE TABLE ancestors (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
CREATE TABLE trees (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
CREATE TABLE rules (name TEXT NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE instances (rule TEXT NOT NULL REFERENCES rules (name),
    sign INTEGER NOT NULL CHECK (sign IN (-1, 1)), place INTEGER NOT NULL,
    content TEXT NOT NULL, seal BLOB NOT NULL,
    PRIMARY KEY (rule, sign, place)) STRICT, WITHOUT ROWID;
CREATE TABLE wishes (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
CREATE TABLE steps (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
CREATE TABLE events (step INTEGER NOT NULL REFERENCES steps (place), place INTEGER NOT NULL,
    content TEXT NOT NULL, seal BLOB NOT NULL,
    PRIMARY KEY (step, place)) STRICT, WITHOUT ROWID;
"""

PUPIL = """
CREATE TABLE pupil (place INTEGER NOT NULL PRIMARY KEY CHECK (place = 0),
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
"""

PROFILES = """
CREATE TABLE profiles (name TEXT NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT, WITHOUT ROWID;
"""

TRUST = """
CREATE TABLE trust (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
"""

OPERATORS = """
CREATE TABLE operators (place INTEGER NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT;
"""

MAPS = """
CREATE TABLE maps (place TEXT NOT NULL PRIMARY KEY,
    content TEXT NOT NULL, seal BLOB NOT NULL) STRICT, WITHOUT ROWID;
"""

MIGRATIONS: tuple[str, ...] = (FIRST, PUPIL, PROFILES, TRUST, OPERATORS, MAPS)
"""What makes each version from the one before. Books of every version load forever: only ever append."""

LIMITS = {
    sqlite3.SQLITE_LIMIT_LENGTH: 100_000_000,
    sqlite3.SQLITE_LIMIT_SQL_LENGTH: 100_000,
    sqlite3.SQLITE_LIMIT_COLUMN: 64,
    sqlite3.SQLITE_LIMIT_EXPR_DEPTH: 64,
    sqlite3.SQLITE_LIMIT_COMPOUND_SELECT: 16,
    sqlite3.SQLITE_LIMIT_ATTACHED: 0,
    sqlite3.SQLITE_LIMIT_TRIGGER_DEPTH: 1,
    sqlite3.SQLITE_LIMIT_VARIABLE_NUMBER: 64,
    sqlite3.SQLITE_LIMIT_WORKER_THREADS: 0,
}


def connected(path: Path | str, mode: str) -> sqlite3.Connection:
    """A connection that trusts nothing in the file and never waits; `mode` as in SQLite's file names.

    Nothing but SQLite may open the file: closing a descriptor drops the locks of the whole process.
    """
    name = f"{path.as_uri()}?mode={mode}" if isinstance(path, Path) else path
    db = sqlite3.connect(name, uri=True, isolation_level=None, timeout=0.0)
    try:
        for limit, most in LIMITS.items():
            db.setlimit(limit, most)
        for pragma in ("trusted_schema=OFF", "cell_size_check=ON", "foreign_keys=ON", "synchronous=FULL"):
            db.execute(f"PRAGMA {pragma}")
    except sqlite3.Error:
        db.close()
        raise
    return db


def number(db: sqlite3.Connection, pragma: str) -> int:
    return db.execute(f"PRAGMA {pragma}").fetchone()[0]


@contextmanager
def sentences(path: Path) -> Iterator[None]:
    """What SQLite finds wrong, as a `BadFile` with a sentence."""
    try:
        yield
    except sqlite3.OperationalError as error:
        if "locked" in str(error):
            raise BadFile(f"{path} is in use by another process that teaches or replaces it") from None
        raise BadFile(f"{path} cannot be used: {error}") from None
    except (sqlite3.Error, UnicodeDecodeError, OverflowError) as error:
        raise BadFile(f"{path} is no skillbook, or a damaged one: {error}") from None


def located(path: str | Path) -> Path:
    """The file that a path leads to. Raises `BadFile` where there is none of a size that may be read."""
    try:
        real = Path(path).resolve()
        if not real.exists():
            raise BadFile(f"there is no skillbook {path}")
        if not real.is_file():
            raise BadFile(f"{path} is not a file")
        size = real.stat().st_size
    except (OSError, RuntimeError, ValueError) as error:  # a loop of links, a name that is none
        raise BadFile(f"{path} cannot be opened: {error}") from None
    if not size:
        raise BadFile(f"{path} is empty: it is no skillbook")
    log = real.with_name(f"{real.name}-wal")
    size += log.stat().st_size if log.is_file() else 0
    if size > MAX_BYTES:
        raise BadFile(f"{path} has {size / 1e6:.0f} MB; a skillbook may have {MAX_BYTES / 1e6:g}")
    return real


def version_of(db: sqlite3.Connection, path: Path) -> int:
    """The version of a skillbook whose tables are sound and its own. Raises `BadFile`."""
    if number(db, "application_id") != APPLICATION:
        raise BadFile(f"{path} is an SQLite file, but no skillbook")
    version = number(db, "user_version")
    if version > len(MIGRATIONS):
        raise BadFile(
            f"{path} was written by a newer Gaitwright: book version {version}, this one reads up to "
            f"{len(MIGRATIONS)}"
        )
    if version < 1:
        raise BadFile(f"{path} has the book version {version}, which never was")
    if _tables(db) != _tables_of(version):
        raise BadFile(f"{path} has other tables than a skillbook of version {version}")
    faults = [row[0] for row in db.execute("PRAGMA quick_check(1)")]
    if faults != ["ok"]:
        raise BadFile(f"{path} is damaged: {' '.join(str(faults[0]).split())}")
    if db.execute("PRAGMA foreign_key_check").fetchone():
        raise BadFile(f"{path} is damaged: it has instances or events of nothing")
    return version


def migrate(db: sqlite3.Connection, version: int) -> None:
    """Brings the tables from a version to the newest; the caller's transaction makes it all or nothing."""
    for script in MIGRATIONS[version:]:
        for statement in script.split(";"):
            if statement.strip():
                db.execute(statement)
    db.execute(f"PRAGMA user_version={len(MIGRATIONS)}")


def make(db: sqlite3.Connection) -> None:
    """The newest tables in an empty file."""
    db.execute(f"PRAGMA application_id={APPLICATION}")
    migrate(db, 0)


def _tables(db: sqlite3.Connection) -> list[tuple]:
    return db.execute("SELECT type, name, tbl_name, sql FROM sqlite_schema ORDER BY name").fetchall()


def _tables_of(version: int) -> list[tuple]:
    """The tables that a version has when it is made afresh."""
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as db:
        for script in MIGRATIONS[:version]:
            db.executescript(script)
        return _tables(db)
