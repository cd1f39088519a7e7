"""The door to rulebooks in files."""

from pathlib import Path

from gaitwright.errors import BadFile
from gaitwright.knowledge.json_form import MAX_BYTES, loads
from gaitwright.knowledge.rules import Rulebook
from gaitwright.skillbook.book import Skillbook

SQLITE = b"SQLite format 3"
"""How a skillbook begins; anything else is taken for a rulebook as JSON."""


def rulebook_of(path: str) -> Rulebook:
    """The rulebook in a skillbook, or in a JSON file. Raises `BadFile` for a file that is none."""
    file = Path(path)
    if not file.is_file():
        raise BadFile(f"no file {path}: a rulebook is wanted")
    if file.stat().st_size > MAX_BYTES:
        raise BadFile(f"{path} is larger than the limit of {MAX_BYTES / 1e6:g} MB")
    try:
        with file.open("rb") as opened:
            is_book = opened.read(len(SQLITE)) == SQLITE
        if is_book:
            return Skillbook.load(file).rulebook
        content = file.read_bytes()
    except OSError as error:
        raise BadFile(f"{path} cannot be read: {error.strerror}") from None
    return loads(content, path)
