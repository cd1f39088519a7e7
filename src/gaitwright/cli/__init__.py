"""The command `gaitwright`: a shell around the package that decides nothing.

Exit codes: 0 done, 1 the robot failed, 2 wrong use or no place for what comes out, 3 bad input file, 70 a
defect of ours, 130 interrupted.
"""

import io
import os
import sys
import traceback
from contextlib import suppress
from importlib import import_module

from gaitwright.cli.options import read
from gaitwright.cli.sentences import fitted
from gaitwright.errors import (
    FULL,
    LONGEST_NAME,
    GaitwrightError,
    WrongUse,
    is_interrupt,
    printable,
    short,
    told,
)

DEFECT, INTERRUPTED, NOT_WRITTEN = 70, 130, 2
UNREAD = "nobody reads the output any more"


def main(argv: list[str] | None = None) -> int:
    """Runs one command and returns its exit code."""
    argv = sys.argv[1:] if argv is None else argv
    try:
        prepare_streams()
        code = run(argv)
        sys.stdout.flush()
        return code
    except GaitwrightError as error:
        return ended(error.exit_code, shortened(str(error), argv))
    except KeyboardInterrupt:
        return ended(INTERRUPTED, "interrupted")
    except OSError as error:
        return ended(NOT_WRITTEN, shortened(told(of_the_system(error)), argv))
    except SystemExit:  # what prints tables ends so where nobody reads them
        return ended(NOT_WRITTEN, UNREAD)
    except MemoryError:
        return ended(NOT_WRITTEN, "this takes more memory than there is")
    except Exception as error:  # the last door: whatever comes here is our mistake and shown in full
        if is_interrupt(error):
            return ended(INTERRUPTED, "interrupted")
        traceback.print_exc()
        return ended(DEFECT, "this is a defect; please report it with the lines above and the command")


def prepare_streams() -> None:
    """Streams that take every letter: what they have no code for comes as an escape. Raises `WrongUse` where
    the standard output is closed."""
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115 - for as long as this process lives
    if sys.stdout is None:
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
        raise WrongUse("the standard output is closed")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="backslashreplace")


def ended(code: int, sentence: str) -> int:
    """Says a last sentence, if anyone reads it. What is left in a stream that nobody reads, or that takes no
    more, is thrown away: Python would stumble over it at its end."""
    for stream, last in ((sys.stdout, ""), (sys.stderr, f"{fitted(f'gaitwright: {sentence}')}\n")):
        try:
            stream.write(last)
            stream.flush()
        except (OSError, ValueError):
            with suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    return code


def of_the_system(error: OSError) -> str:
    """What the system refused, in words."""
    if isinstance(error, BrokenPipeError):
        return UNREAD
    what = f"{error.filename} " if error.filename else "the output "
    if error.errno in FULL:
        return f"no room for {what.strip()}: {error.strerror}"
    return f"{what}cannot be used: {error.strerror or error}"


def shortened(sentence: str, argv: list[str]) -> str:
    """A sentence in which no word of the command line takes more than its share."""
    for word in filter(lambda word: len(word) > LONGEST_NAME, argv):
        sentence = sentence.replace(printable(word), short(printable(word)))
    return sentence


def run(argv: list[str]) -> int:
    """The command that `argv` asks for; its module, and all that is heavy, is imported only now."""
    try:
        args = read(argv)
    except SystemExit as end:  # argparse has printed a help or a version
        return int(end.code or 0)
    say("loading gaitwright …")
    command = import_module(f"gaitwright.cli.{args.command}")
    say("")
    return command.run(args)


def say(what: str) -> None:
    """A passing word on a terminal, in place of the last one: numba and MuJoCo take seconds to import."""
    if sys.stderr.isatty():
        print(f"\r{what:30}\r", end="", file=sys.stderr, flush=True)
