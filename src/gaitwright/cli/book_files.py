"""The doors to books in files: what is read is checked, what is written is new."""

import os
from pathlib import Path

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.json_form import MAX_BYTES, loads
from gaitwright.knowledge.rules import Rulebook
from gaitwright.skillbook.book import Skillbook

SQLITE = b"SQLite format 3"
"""How a skillbook begins; anything else is taken for a rulebook as JSON."""


def rulebook_of(path: str) -> Rulebook:
    """The rulebook in a skillbook, or in a JSON file. Raises `BadFile` for a file that is none."""
    if is_skillbook(path):
        return Skillbook.load(path).rulebook
    return loads(content_of(path, "a rulebook"), path)


def skillbook_of(path: str) -> Skillbook:
    """The skillbook in a file. Raises `BadFile` for a file that is none, and says what to do with text."""
    if not is_skillbook(path):
        raise BadFile(
            f"{path} is no skillbook; what was exported, or rules as JSON, becomes one by "
            f"`gaitwright books import {path} --out {Path(path).stem}.skills`"
        )
    return Skillbook.load(path)


def is_skillbook(path: str) -> bool:
    """Whether a file begins as skillbooks do. Raises `BadFile` where there is none, or it cannot be read."""
    if not Path(path).is_file():
        raise BadFile(f"no file {path}: a book is wanted")
    try:
        with Path(path).open("rb") as opened:
            return opened.read(len(SQLITE)) == SQLITE
    except OSError as error:
        raise BadFile(f"{path} cannot be read: {error.strerror}") from None


def content_of(path: str, what: str) -> bytes:
    """All of a file of no more than `MAX_BYTES`. Raises `BadFile`."""
    file = Path(path)
    if not file.is_file():
        raise BadFile(f"no file {path}: {what} is wanted")
    if file.stat().st_size > MAX_BYTES:
        raise BadFile(f"{path} is larger than the limit of {MAX_BYTES / 1e6:g} MB")
    try:
        return file.read_bytes()
    except OSError as error:
        raise BadFile(f"{path} cannot be read: {error.strerror}") from None


def new_file(where: str, what: str) -> Path:
    """The path of a file that is to be made. Raises `WrongUse` where it is there already, or cannot be
    made."""
    path = Path(where)
    if path.exists() or path.is_symlink():
        raise WrongUse(f"{path} exists: name a new {what}, or remove that one")
    if not path.parent.is_dir():
        raise WrongUse(f"there is no folder {path.parent} for {path.name}")
    if not os.access(path.parent, os.W_OK):
        raise WrongUse(f"no permission to write {path.name} to {path.parent}")
    return path
