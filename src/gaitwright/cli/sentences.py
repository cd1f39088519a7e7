"""Sentences for the standard error: names that are too long are cut, and no terminal breaks the others.

Imports nothing heavy: help and errors are told before anything is loaded.
"""

import re
import sys
from shutil import get_terminal_size
from textwrap import wrap

MOST = 200
"""Letters of a name in a sentence."""


def tell(text: str) -> None:
    """A sentence on the standard error: on a terminal broken between words, elsewhere one line."""
    text = cut(text)
    if sys.stderr.isatty():
        text = "\n".join(between_words(text, get_terminal_size().columns))
    print(text, file=sys.stderr, flush=True)


def cut(text: str) -> str:
    """A sentence with the middle of every name left out that has more than `MOST` letters."""
    return re.sub(
        rf"\S{{{MOST + 1},}}", lambda long: f"{long[0][: MOST // 2]}…{long[0][1 - MOST // 2 :]}", text
    )


def between_words(text: str, width: int, indent: str = "") -> list[str]:
    """Lines of a text, the later ones indented as far as every word fits; one longer than a line is whole."""
    longest = max(map(len, text.split()), default=0)
    indent = indent[: max(0, width - longest)]
    return wrap(text, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
