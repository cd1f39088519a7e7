"""Sentences for the standard error: no terminal breaks them within a word.

Imports nothing heavy: help and errors are told before anything is loaded.
"""

import sys
from shutil import get_terminal_size
from textwrap import wrap


def fitted(sentence: str) -> str:
    """A sentence for the standard error: on a terminal broken between words, elsewhere one line."""
    if not sys.stderr.isatty():
        return sentence
    return "\n".join(between_words(sentence, get_terminal_size().columns))


def between_words(text: str, width: int, indent: str = "") -> list[str]:
    """Lines of a text, the later ones indented as far as every word fits; one longer than a line is whole."""
    longest = max(map(len, text.split()), default=0)
    indent = indent[: max(0, width - longest)]
    return wrap(text, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
