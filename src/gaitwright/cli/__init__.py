"""The command `gaitwright`: a shell around the package that decides nothing.

Exit codes: 0 done, 1 the robot failed, 2 wrong use, 3 bad input file, 70 a defect of ours, 130 interrupted.
"""

import os
import sys
import traceback
from importlib import import_module

from gaitwright.cli.options import read
from gaitwright.errors import GaitwrightError, is_interrupt

DEFECT, INTERRUPTED, BROKEN_PIPE = 70, 130, 141


def main(argv: list[str] | None = None) -> int:
    """Runs one command and returns its exit code."""
    try:
        code = run(sys.argv[1:] if argv is None else argv)
        sys.stdout.flush()
    except GaitwrightError as error:
        print(f"gaitwright: {error}", file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt:
        print("gaitwright: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # Nobody reads any more; what is left in the buffer must not be written when Python ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except Exception as error:  # the last door: whatever comes here is our mistake and shown in full
        if is_interrupt(error):
            print("gaitwright: interrupted", file=sys.stderr)
            return INTERRUPTED
        traceback.print_exc()
        print(
            "gaitwright: this is a defect; please report it with the lines above and the command",
            file=sys.stderr,
        )
        return DEFECT
    return code


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
