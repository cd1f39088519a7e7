"""The doors to books in files: what is read is checked, what is written is new."""

import os
from dataclasses import asdict
from pathlib import Path

from gaitwright.cli.output import settled
from gaitwright.errors import BadFile, WrongUse, short
from gaitwright.files import content_of, is_there
from gaitwright.knowledge.json_form import MAX_BYTES, loads
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.told import Told
from gaitwright.skillbook.book import Skillbook, content_hash
from gaitwright.skillbook.history import that_count
from gaitwright.skillbook.schema import MAX_BYTES as BOOK_BYTES

SQLITE = b"SQLite format 3"
"""How a skillbook begins; anything else is taken for a rulebook as JSON."""


def rulebook_of(path: str) -> Rulebook:
    """The rulebook in a skillbook, or in a JSON file. Raises `BadFile` for a file that is none."""
    return rules_and_lessons(path)[0]


def rules_and_lessons(path: str) -> tuple[Rulebook, list[Told]]:
    """The rulebook in a file, and what a pupil was told in it and still counts: nothing in a file with rules
    alone. Raises `BadFile` for a file that is neither."""
    if is_skillbook(path):
        book = Skillbook.load(path)
        return book.rulebook, that_count(book.steps)
    return loads(content_of(path, "rulebook", MAX_BYTES), short(path)), []


def skillbook_of(path: str) -> Skillbook:
    """The skillbook in a file. Raises `BadFile` for a file that is none, and says what to do with text."""
    if not is_skillbook(path):
        raise BadFile(
            f"{short(path)} is no skillbook; what was exported, or rules as JSON, becomes one by "
            f"`gaitwright books import {short(path)} --out {short(Path(path).stem)}.skills`"
        )
    return Skillbook.load(path)


def is_skillbook(path: str) -> bool:
    """Whether a file begins as skillbooks do. Raises `BadFile` where there is none, or it cannot be read."""
    check_there(path, "a book")
    return content_of(path, "book", BOOK_BYTES, len(SQLITE)) == SQLITE


def check_there(path: str, what: str) -> None:
    """Raises `BadFile` where there is nothing, and says what is wanted."""
    if not is_there(path):
        raise BadFile(f"no file {short(path)}: {what} is wanted")


def new_file(where: str, what: str, option: str = "--out") -> Path:
    """The path of a file that is to be made. Raises `WrongUse` where it is there already, or cannot be
    made."""
    path = settled(where, option)
    if path.exists() or path.is_symlink():
        raise WrongUse(f"{path} exists: name a new {what}, or remove that one")
    if not path.parent.is_dir():
        raise WrongUse(f"there is no folder {path.parent} for {path.name}")
    if not os.access(path.parent, os.W_OK):
        raise WrongUse(f"no permission to write {path.name} to {path.parent}")
    return path


def facts_of(book: Skillbook, path: str) -> dict:
    """A book as figures."""
    rules = book.rulebook
    return {
        "book": path,
        "name": book.name,
        "robot": book.robot,
        "rules": [rule.name for rule in rules.rules],
        "lessons": rules.lessons,
        "steps": len(book.steps),
        "ancestors": [asdict(ancestor) for ancestor in book.ancestors],
        "hash": content_hash(book),
    }
