"""How a help is laid out: broken between words, examples as a shell takes them."""

import argparse
import re
from collections.abc import Iterable

from gaitwright.cli.sentences import between_words


class WholeWords(argparse.RawDescriptionHelpFormatter):
    """Breaks the help of options between words, never within `turn-right`."""

    def _format_usage(
        self,
        usage: str | None,
        actions: Iterable[argparse.Action],
        groups: Iterable[argparse._MutuallyExclusiveGroup],
        prefix: str | None,
    ) -> str:
        """Options of which one is to be named stand over several lines where they are too wide for one."""
        lines = super()._format_usage(usage, actions, groups, prefix).split("\n")
        return "\n".join(part for line in lines for part in choice_lines(line, self._width))

    def _split_lines(self, text: str, width: int) -> list[str]:
        return between_words(" ".join(text.split()), width)


class Wrapped(WholeWords):
    """Wraps the description too, and the examples where a shell would take them so."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if text.startswith("examples:"):
            return "\n".join(part for line in text.split("\n") for part in example_lines(line, width))
        return "\n".join(between_words(" ".join(text.split()), width))


def example_lines(example: str, width: int) -> list[str]:
    """An example that is wider than the screen: what is said of it above, the command over several lines."""
    if len(example) <= width:
        return [example]
    command, _, about = (part.rstrip() for part in example.partition("#"))
    lines = [""]
    for option in re.split(r" (?=--)", command):
        if lines[-1] and len(lines[-1]) + len(option) + 3 > width:
            lines[-1] += " \\"
            lines.append(" " * 6 + option)
        else:
            lines[-1] += " " * bool(lines[-1]) + option
    return [*([f"  #{about}"] if about else []), *lines]


def choice_lines(line: str, width: int) -> list[str]:
    """A line that is wider than the screen, broken before the choices in it."""
    lines = [""]
    for choice in re.split(r"(?<=\S)(?= \| )", line):
        if lines[-1].strip() and len(lines[-1]) + len(choice) > width:
            lines.append(" " * (len(line) - len(line.lstrip())))
        lines[-1] += choice
    return lines
