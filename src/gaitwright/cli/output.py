"""Where figures and files go: complete or not at all, and never over what is there."""

import os
import sys
from pathlib import Path

from gaitwright.errors import WrongUse
from gaitwright.files import whole


def check_json(where: str | None) -> None:
    """`WrongUse` where `--json` names what cannot be written; asked before a long run, not after it."""
    if where is None or where == "-":
        return
    path = Path(where).resolve()
    if path.is_dir():
        raise WrongUse(f"--json {where} is a folder; name a file in it")
    if not path.parent.is_dir():
        raise WrongUse(f"--json {where}: there is no folder {path.parent}")
    place = path if is_special(path) else path.parent
    if not os.access(place, os.W_OK):
        raise WrongUse(f"--json {where}: no permission to write to {place}")


def write_json(where: str | None, text: str) -> None:
    """Writes `text` to where `--json` says."""
    if where is None:
        return
    if where == "-":
        print(text)
    elif is_special(Path(where)):
        Path(where).write_text(text + "\n", encoding="utf-8")
    else:
        write_whole(Path(where).resolve(), text + "\n")


def write_whole(path: Path, text: str) -> None:
    """Writes a file, complete or not at all."""
    with whole(path) as draft:
        draft.write_text(text, encoding="utf-8")


def is_special(path: Path) -> bool:
    """Whether a path is a device or a pipe, which nothing may replace."""
    return path.exists() and not path.is_file()


def check_folder(where: str | None) -> None:
    """`WrongUse` where `--out` names what holds files already or cannot be made."""
    if where is None:
        return
    path = Path(where)
    if path.exists() and not path.is_dir():
        raise WrongUse(f"--out {where} is a file; name a new folder")
    if path.is_dir() and any(path.iterdir()):
        raise WrongUse(f"--out {where} holds files already; name a new folder")
    nearest = next(parent for parent in [path.absolute(), *path.absolute().parents] if parent.exists())
    if not (nearest.is_dir() and os.access(nearest, os.W_OK)):
        raise WrongUse(f"--out {where}: no permission to write to {nearest}")


def numbered_folder(stem: str) -> Path:
    """The first folder `stem`-001, `stem`-002, … that is not there yet; makes it."""
    for number in range(1, sys.maxsize):
        path = Path(f"{stem}-{number:03d}")
        try:
            path.mkdir(parents=True)
        except FileExistsError:
            continue
        except OSError as error:
            raise WrongUse(f"cannot make the folder {path}: {error.strerror}") from None
        return path
    raise AssertionError("more folders than numbers")
