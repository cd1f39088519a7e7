"""Recordings of a studio in a folder: kept under names of their own, listed, found again."""

import re
from collections.abc import Collection
from datetime import datetime
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from gaitwright.errors import WrongUse

NAME = re.compile(r"[a-z0-9][a-z0-9_.-]{0,99}\.(npz|mcap|html)")
"""What a file of this folder may be called."""
MOST = 1000


@runtime_checkable
class Kept(Protocol):
    """A recording, to one who only keeps it."""

    def save(self, path: Path) -> Path: ...


def plain_name(name: str) -> str:
    """A name for a file: small letters, digits, and a few signs in the place of others."""
    return re.sub(r"[^a-z0-9_.-]", "-", name.lower())[:80].strip(".") or "-"


class Shelf:
    """A folder of recordings."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def keep(self, recording: Kept, name: str) -> Path:
        """Writes a recording under a name of `free_name`, whole or not at all."""
        self.folder.mkdir(parents=True, exist_ok=True)
        return recording.save(self.folder / f"{name}.npz")

    def free_name(self, robot: str, taken: Collection[str] = ()) -> str:
        """A name for a recording that is made now, without an ending: nothing that is there, or `taken`, has
        it."""
        stem = plain_name(f"{datetime.now():%Y-%m-%d_%H-%M-%S}_{robot}")
        names = (stem, *(f"{stem}_{k}" for k in range(2, MOST)))
        return next(one for one in names if one not in taken and not (self.folder / f"{one}.npz").exists())

    def listed(self) -> list[dict[str, Any]]:
        """Name and size of each, the newest first."""
        if not self.folder.is_dir():
            return []
        files = [path for path in self.folder.iterdir() if NAME.fullmatch(path.name) and path.is_file()]
        files.sort(key=lambda path: path.stat().st_mtime, reverse=True)
        return [{"name": path.name, "bytes": path.stat().st_size} for path in files[:MOST]]

    def has(self, name: str) -> bool:
        """Whether there is a file of that name."""
        return bool(NAME.fullmatch(name)) and (self.folder / name).is_file()

    def path(self, name: str) -> Path:
        """The file of that name. Raises `WrongUse` for one that is not there, or no name of this folder's."""
        if not self.has(name):
            raise WrongUse(f"there is no recording {name[:100]!r}")
        return self.folder / name

    def place(self, name: str) -> Path:
        """Where a file of that name is, or would be. Raises `WrongUse` for what is no name."""
        if not NAME.fullmatch(name):
            raise WrongUse(f"there is no recording {name[:100]!r}")
        return self.folder / name
