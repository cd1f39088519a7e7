"""The caller's mistakes, as exceptions with one clear sentence and the exit code of the command line.

The world's failures (a fall, an unreachable goal) are not here: they are values with a sentence.
"""

from collections.abc import Iterable
from difflib import get_close_matches


class GaitwrightError(Exception):
    """A mistake of the caller, told in one sentence."""

    exit_code = 2


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
