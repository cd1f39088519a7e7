"""Where figures and files go: complete or not at all, and never over what is there."""

import errno
import os
import sys
from pathlib import Path

from gaitwright.errors import WrongUse
from gaitwright.files import fitting, whole


def settled(where: str, option: str) -> Path:
    """The path that `where` leads to, to be checked and then written: as it was typed where it is plain, else
    without `..` and links. Raises `WrongUse` for a name that no new file can have."""
    if not where or not where.isprintable():
        raise WrongUse(f"{option} {where}: a new file's name is of letters that can be printed")
    try:
        path = Path(where)
        real = path.resolve()
        real.exists()
    except (OSError, RuntimeError, ValueError) as error:
        raise WrongUse(f"{option} {where}: {getattr(error, 'strerror', None) or error}") from None
    return path if real == path.absolute() else real


def check_json(where: str | None) -> None:
    """`WrongUse` where `--json` names what cannot be written; asked before a long run, not after it."""
    if where is None or where == "-":
        return
    path = settled(where, "--json")
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
    text = text.encode("utf-8", "backslashreplace").decode()  # as JSON escapes what is no text
    if where == "-":
        print(text)
    elif is_special(Path(where)):
        write_special(Path(where), text + "\n")
    else:
        write_whole(Path(where).resolve(), text + "\n")


def write_special(path: Path, text: str) -> None:
    """Writes to a device or a pipe. Raises `WrongUse` for a pipe that nobody reads: it is not waited for."""
    try:
        place = os.open(path, os.O_WRONLY | getattr(os, "O_NONBLOCK", 0))
    except OSError as error:
        if error.errno == errno.ENXIO:
            raise WrongUse(f"{path} is a pipe, and nobody reads it") from None
        raise
    os.set_blocking(place, True)
    with fitting(path), open(place, "w", encoding="utf-8") as file:
        file.write(text)


def write_whole(path: Path, text: str) -> None:
    """Writes a file, complete or not at all."""
    with fitting(path), whole(path) as draft:
        draft.write_text(text, encoding="utf-8")


def is_special(path: Path) -> bool:
    """Whether a path is a device or a pipe, which nothing may replace."""
    return path.exists() and not path.is_file()


def check_folder(where: str | None) -> str | None:
    """The folder that `--out` leads to; `WrongUse` where it holds files already or cannot be made."""
    if where is None:
        return None
    path = settled(where, "--out")
    if path.exists() and not path.is_dir():
        raise WrongUse(f"--out {where} is a file; name a new folder")
    if path.is_dir() and any(path.iterdir()):
        raise WrongUse(f"--out {where} holds files already; name a new folder")
    nearest = next(parent for parent in [path.absolute(), *path.absolute().parents] if parent.exists())
    if not (nearest.is_dir() and os.access(nearest, os.W_OK)):
        raise WrongUse(f"--out {where}: no permission to write to {nearest}")
    return str(path)


def check_picture(where: str | None) -> str | None:
    """The path that `--out` leads to; `WrongUse` where it names what cannot be written as a picture."""
    if where is None:
        return None
    path = settled(where, "--out").absolute()
    if path.suffix.lower() != ".png" or path.is_dir():
        raise WrongUse(f"--out {where}: the picture is a PNG file; name one that ends in .png")
    nearest = next(parent for parent in path.parents if parent.exists())
    if not (nearest.is_dir() and os.access(nearest, os.W_OK)):
        raise WrongUse(f"--out {where}: no permission to write to {nearest}")
    return str(settled(where, "--out"))


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
