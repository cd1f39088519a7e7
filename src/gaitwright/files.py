"""Files that are complete or not there at all, and the door through which those of users come in."""

import json
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, TypeVar

import msgspec

from gaitwright.errors import FULL, BadFile, NoRoom, short

T = TypeVar("T")


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A draft to write; it becomes the file at `path` when all went well, and is gone otherwise."""
    path.parent.mkdir(parents=True, exist_ok=True)
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield draft
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


@contextmanager
def fitting(path: Path | str) -> Iterator[None]:
    """Raises `NoRoom` where what is written to `path` meets a full disk."""
    try:
        yield
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise NoRoom(f"no room for {path}: {error.strerror}") from error


# --- files of users --------------------------------------------------------------------------------
def is_there(path: Path | str) -> bool:
    """Whether a path leads anywhere."""
    try:
        return Path(path).exists()
    except (OSError, ValueError):  # a name that is too long, or none
        return False


def opened_file(path: Path | str, what: str, most: int) -> BinaryIO:
    """A file of at most `most` bytes, open for reading; `what` it is wanted for begins the sentence.

    Raises `BadFile` for what is no file: a folder, a pipe or a device, which is not waited for.
    """
    name = f"{what} {short(str(path))}"
    try:
        file = open(path, "rb", opener=without_waiting)  # noqa: SIM115 - the caller closes it
    except (OSError, ValueError) as error:  # a name with a null byte is a ValueError
        raise BadFile(f"{name} cannot be read: {getattr(error, 'strerror', None) or error}") from None
    found = os.fstat(file.fileno())
    if not stat.S_ISREG(found.st_mode):
        file.close()
        raise BadFile(f"{name} cannot be read: it is a {kind_of(found.st_mode)}, not a file")
    if found.st_size > most:
        file.close()
        raise BadFile(f"{name} is larger than the limit of {size_text(most)}")
    return file


def without_waiting(path: str, flags: int) -> int:
    """Opens a path; a pipe that nobody writes to is opened at once."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0))


def content_of(path: Path | str, what: str, most: int, first: int | None = None) -> bytes:
    """All of a file of at most `most` bytes, or the `first` of them. Raises `BadFile`."""
    with opened_file(path, what, most) as file:
        try:
            content = file.read(most + 1 if first is None else first)
        except OSError as error:
            raise BadFile(f"{what} {short(str(path))} cannot be read: {error.strerror}") from None
    if len(content) > most:
        raise BadFile(f"{what} {short(str(path))} is larger than the limit of {size_text(most)}")
    return content


def text_of(content: bytes, name: str) -> str:
    """Content as text. Raises `BadFile`, `name` in front, where it is no UTF-8."""
    try:
        return content.decode()
    except UnicodeDecodeError as error:
        raise BadFile(f"{name} is no text in UTF-8: {error.reason} at byte {error.start}") from None


def json_of(content: bytes, kind: type[T], name: str) -> T:
    """JSON as a value of a kind, every key once.

    Raises `BadFile`, `name` in front, where it is no JSON, and msgspec's `ValidationError` where it is
    another kind of value.
    """
    try:
        text_of(content, "it")
    except BadFile as error:
        raise BadFile(f"{name} is not JSON: {error}") from None
    told_twice = twice_in(content)
    if told_twice:
        raise BadFile(f"{name}: {told_twice!r} is told twice")
    try:
        return msgspec.json.decode(content, type=kind)
    except msgspec.ValidationError:
        raise
    except (msgspec.DecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not JSON: {error}") from None


def twice_in(content: bytes) -> str:
    """The first key that an object of a JSON text has twice; none where there is none, or it is no JSON."""
    found = ""

    def look(pairs: list[tuple[str, object]]) -> None:
        nonlocal found
        seen: set[str] = set()
        for key, _ in pairs:
            found = found or (key if key in seen else "")
            seen.add(key)

    try:
        json.loads(content, object_pairs_hook=look)
    except (ValueError, RecursionError):
        return ""
    return found


def kind_of(mode: int) -> str:
    """What is no file, in words."""
    kinds = ((stat.S_ISDIR, "folder"), (stat.S_ISFIFO, "pipe"), (stat.S_ISSOCK, "socket"))
    return next((name for is_one, name in kinds if is_one(mode)), "device")


def size_text(size: int) -> str:
    """A limit in words."""
    return f"{size / 1e6:g} MB" if size >= 1_000_000 else f"{size / 1e3:g} kB"
