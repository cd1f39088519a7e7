"""The caller's mistakes, as exceptions with one clear sentence and the exit code of the command line.

The world's failures (a fall, an unreachable goal) are not here: they are values with a sentence.
"""

import errno
import re
from collections.abc import Iterable
from difflib import get_close_matches

LONGEST_NAME = 200
"""At most so many letters of a name are told in a sentence."""
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""What the system says where there is no room."""


def printable(text: str) -> str:
    """Text that does nothing to a terminal: control characters, and what is no text, as escapes."""
    return "".join(
        c if c.isprintable() else c.encode("unicode_escape", "surrogatepass").decode() for c in text
    )


def short(name: str) -> str:
    """A name of at most `LONGEST_NAME` letters: of a longer one the beginning and the end."""
    if len(name) <= LONGEST_NAME:
        return name
    return f"{name[: LONGEST_NAME - 61]}…{name[-60:]}"


def told(sentence: str) -> str:
    """A sentence as it may be printed, every long name in it short; those with spaces are the caller's."""
    return re.sub(rf"\S{{{LONGEST_NAME + 1},}}", lambda name: short(name[0]), printable(sentence))


class GaitwrightError(Exception):
    """A mistake of the caller, told in one sentence that may be printed."""

    exit_code = 2

    def __init__(self, sentence: str = "") -> None:
        super().__init__(told(sentence))


class WrongUse(GaitwrightError):
    """Something was asked that does not exist or makes no sense (exit code 2)."""

    exit_code = 2


class BadFile(GaitwrightError):
    """A model, scene or skillbook that cannot be used (exit code 3)."""

    exit_code = 3


class NoRoom(GaitwrightError):
    """A disk that is full, or a file that may not grow."""


def unknown(kind: str, asked: str, known: Iterable[str]) -> WrongUse:
    """The error for a name that does not exist: it names what was asked, what there is, and a near miss."""
    names = list(known)
    near = get_close_matches(asked, names, n=1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return WrongUse(f"no {kind} {asked!r}; there is: {', '.join(names)}{hint}")


def is_interrupt(error: BaseException | None) -> bool:
    """Whether an error is the user's Ctrl-C: met in a compiled kernel, it comes out as a `SystemError`."""
    while isinstance(error, SystemError):
        error = error.__cause__
    return isinstance(error, KeyboardInterrupt)
