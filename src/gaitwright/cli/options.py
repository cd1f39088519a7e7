"""The commands, their options and their help. Imports neither numpy nor MuJoCo.

Plain argparse, by measurement: it is there in 0.03 s where `import tyro` alone takes 0.2 to 0.3 s, and
every `--help` has 0.3 s.
"""

import argparse
import difflib
import re
from typing import NoReturn

from gaitwright.cli.arguments import ADD
from gaitwright.cli.commands import COMMANDS
from gaitwright.cli.help_format import WholeWords, Wrapped
from gaitwright.errors import WrongUse, unknown

HIDDEN = ("--version",)
"""Options that no command's help shows."""

EPILOG = """\
exit codes: 0 done, 1 the robot failed, 2 wrong use, 3 a bad input file,
  130 interrupted

examples:
  gaitwright demo
  gaitwright mission --robot go2 --scene blocks --goal 6 0
  gaitwright skill --skill trot --speed 0.5 --seconds 10

`gaitwright COMMAND --help` tells more about a command."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence, without the usage."""

    def error(self, message: str) -> NoReturn:
        raise WrongUse(f"{message} (`{self.prog} --help` tells more)")


def read(argv: list[str]) -> argparse.Namespace:
    """The options in `argv`. Raises `WrongUse`; prints help and exits where that is asked for."""
    asked = next((word for word in argv if not word.startswith("-")), None)
    if asked is not None and asked not in COMMANDS:
        raise unknown("command", asked, COMMANDS)
    top, parsers = all_parsers()
    if not argv:
        top.print_help()
        top.exit()
    if asked is not None:
        check_options(argv, parsers[asked])
    # A space before it tells argparse that -1,2 and -1e-3 are values, not options.
    return top.parse_args([re.sub(r"^-(?=[\d.]|inf|nan)", " -", word) for word in argv])


def check_options(argv: list[str], parser: argparse.ArgumentParser) -> None:
    """`WrongUse` with a near miss for an option that a command does not have."""
    known = {*re.findall(r"--[a-z]+(?:-[a-z]+)*", parser.format_help()), *HIDDEN}
    for word in argv:
        option = word.partition("=")[0]
        if option.startswith("--") and option not in known:
            near = difflib.get_close_matches(option, known, n=1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise WrongUse(f"no option {option}{hint} (`{parser.prog} --help` tells more)")


def all_parsers() -> tuple[Parser, dict[str, argparse.ArgumentParser]]:
    """The parser of the whole command line, and that of each command."""
    top = Parser(
        "gaitwright",
        description="Teaches legged robots to move, by rules you can read.",
        epilog=EPILOG,
        formatter_class=WholeWords,
        allow_abbrev=False,
    )
    top.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", title="commands", required=True)
    parsers = {}
    for name, command in COMMANDS.items():
        examples = "\n".join(f"  {example}" for example in command.examples)
        parser = parsers[name] = commands.add_parser(
            name,
            help=command.line,
            description=command.more,
            epilog=f"examples:\n{examples}",
            formatter_class=Wrapped,
            allow_abbrev=False,
        )
        ADD[name](parser)
        parser.add_argument(
            "--json", metavar="FILE|-", help="write the figures as JSON; - is the standard output"
        )
    return top, parsers


class Version(argparse.Action):
    """Looks up the version only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib import metadata  # noqa: PLC0415 - costs more than all the rest of a --help

        try:
            parser.exit(message=f"gaitwright {metadata.version('gaitwright')}\n")
        except metadata.PackageNotFoundError:
            parser.exit(message="gaitwright, run from its sources\n")
