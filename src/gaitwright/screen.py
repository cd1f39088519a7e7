"""What goes to a person's screen: tables and paragraphs that fit it, with no name broken in the middle.

Rich draws the styles, but its own tables break words where they are too wide. Here a column of prose becomes
narrower as far as it reads well, and what does not fit goes below its row, indented.
"""

import os
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from gaitwright.errors import printable

WIDTH = 80
"""Columns of what goes to a file or a pipe, unless `COLUMNS` says otherwise."""
LEAST, MOST = 24, 100
"""A narrower column of prose goes below its row; a line of prose is not longer."""
GAP, INDENT = 2, 4
"""Columns between two columns, and before what stands below a row."""

Cell = str | Text
Row = Sequence[Cell]
"""A cell for each column; none at all is an empty line."""


@dataclass(frozen=True)
class Column:
    """A column of a table."""

    name: str = ""
    right: bool = False
    """Flush right: numbers."""
    prose: bool = False
    """Wraps at words; others stay on one line."""
    style: str = ""


def width_of(file) -> int:
    """Columns of a terminal, `WIDTH` elsewhere; `COLUMNS` is believed everywhere."""
    said = os.environ.get("COLUMNS", "")
    if said.isdecimal() and 0 < int(said) < 10_000:
        return int(said)
    try:
        return os.get_terminal_size(file.fileno()).columns or WIDTH
    except (OSError, ValueError):  # no terminal; a file that has no number
        return WIDTH


def screen(file=None) -> Console:
    """A console on the standard output, or on `file`; it breaks no lines."""
    file = file or sys.stdout
    return Console(file=file, width=width_of(file), highlight=False, markup=False, soft_wrap=True)


def show(lines: Iterable[Cell], file=None) -> None:
    """Prints lines as they are."""
    console = screen(file)
    for line in lines:
        console.print(line)


# --- prose -----------------------------------------------------------------------------------------
def wrapped(text: Cell, width: int) -> list[Text]:
    """The lines of a text, broken between words; one that is longer than a line stands whole on its own."""
    lines = []
    for line in _text(text).split(allow_blank=True) or [Text()]:
        breaks, used = [], 0
        for word in re.finditer(r"\S+\s*", line.plain):
            wide = cell_len(word[0].rstrip())
            if used and used + wide > width:
                breaks.append(word.start())
                used = 0
            used += cell_len(word[0])
        lines += line.divide(breaks)
    for line in lines:
        line.rstrip()
    return lines


def paragraph(text: Cell, width: int, indent: int = 0) -> list[Text]:
    """A paragraph, its first line indented once and the others twice."""
    first, *more = wrapped(text, min(MOST, width) - 2 * indent)
    return [_after(indent, first), *(_after(2 * indent, line) for line in more)]


# --- tables ----------------------------------------------------------------------------------------
def table(columns: Sequence[Column], rows: Iterable[Row], width: int, head: bool = True) -> list[Text]:
    """The lines of a table of at most `width` columns, unless a word is longer."""
    names = [Text(column.name, "bold") for column in columns]
    cells = [[_styled(cell, column) for cell, column in zip(row, columns, strict=bool(row))] for row in rows]
    rows_in_use = [names, *filter(None, cells)]
    natural = [max(map(_wide, column)) for column in zip(*rows_in_use, strict=True)]
    widths = places(columns, natural, width)
    below = [k for k in range(len(columns)) if k not in widths]
    labels = [f"{column.name}: " if len(below) > 1 and column.name else "" for column in columns]
    body: list[Text] = []
    for row in cells:
        body += _beside(columns, widths, row, width) if row else [Text()]
        for k in below:
            body += _below(row[k], width, labels[k]) if row and row[k] else []
    if not head:
        return body
    top = _beside(columns, widths, names, width) + [
        line for k in below if len(below) == 1 and columns[k].name for line in _below(names[k], width)
    ]
    longest = max(line.cell_len for line in [*top, *body])
    return [*top, Text("─" * min(longest, width)), *body]


def folded(
    columns: Sequence[Column], rows: Sequence[Row], width: int, left: int = 1, together: int = 1
) -> list[Text]:
    """A table of numbers, cut between columns where it is too wide into parts that stand below each other.

    The first `left` columns come again in every part; of the others `together` at a time are not parted.
    """
    named = [[column.name for column in columns], *rows]
    natural = [max(_wide(_text(cell)) for cell in column) for column in zip(*named, strict=True)]
    kept = list(range(left))
    parts: list[list[int]] = []
    for first in range(left, len(columns), together):
        block = list(range(first, min(first + together, len(columns))))
        if not parts or sum(natural[k] + GAP for k in [*kept, *parts[-1], *block]) - GAP > width:
            parts.append([])
        parts[-1] += block
    lines: list[Text] = []
    for part in parts:
        taken = [*kept, *part]
        lines += [Text()] if lines else []
        lines += table([columns[k] for k in taken], [[row[k] for k in taken] for row in rows], width)
    return lines


def places(columns: Sequence[Column], natural: Sequence[int], width: int) -> dict[int, int]:
    """The columns that stand beside each other, with their widths; the others go below."""
    beside = list(range(len(columns)))
    while True:
        widths = _shared({k: natural[k] for k in beside}, [k for k in beside if columns[k].prose], width)
        if widths or len(beside) == 1:
            return widths or {0: min(natural[0], width) if columns[0].prose else natural[0]}
        later = beside[1:]
        widest = max(later, key=natural.__getitem__)
        beside.remove(next((k for k in reversed(later) if columns[k].prose), widest))


def _shared(natural: Mapping[int, int], prose: Sequence[int], width: int) -> dict[int, int]:
    """Widths with which columns fit, those of prose as equal as can be; empty where they do not."""
    widths = dict(natural)
    left = width - GAP * (len(natural) - 1) - sum(wide for k, wide in natural.items() if k not in prose)
    if left < sum(min(natural[k], LEAST) for k in prose):
        return {}
    for count, k in enumerate(sorted(prose, key=natural.__getitem__)):  # the narrow ones first
        widths[k] = min(natural[k], left // (len(prose) - count))
        left -= widths[k]
    return widths


def _beside(columns: Sequence[Column], widths: Mapping[int, int], row: Row, width: int) -> list[Text]:
    """The lines of a row, its cells beside each other; a cell with a word that is too long goes below."""
    low = [k for k in widths if columns[k].prose and _longest_word(row[k]) > widths[k]]
    cells = {
        k: [] if k in low else wrapped(row[k], wide) if columns[k].prose else list(_text(row[k]).split())
        for k, wide in widths.items()
    }
    lines = []
    for number in range(max(map(len, cells.values()))):
        line = Text()
        for k, wide in widths.items():
            part = cells[k][number] if number < len(cells[k]) else Text()
            room = " " * (wide - part.cell_len)
            line.append(" " * (GAP if k else 0) + (room if columns[k].right else ""))
            line.append_text(part).append("" if columns[k].right else room)
        line.rstrip()
        lines.append(line)
    return lines + [line for k in low for line in _below(row[k], width)]


def _below(cell: Cell, width: int, label: str = "") -> list[Text]:
    """The lines of what stands below its row."""
    text = _after(0, cell, label)
    text.stylize_before("dim")
    return [_after(INDENT, line) for line in wrapped(text, min(MOST, width) - INDENT)]


def _wide(cell: Text) -> int:
    """Columns of the longest line of a cell."""
    return max(map(cell_len, cell.plain.split("\n")))


def _longest_word(cell: Cell) -> int:
    return max(map(cell_len, _text(cell).plain.split()), default=0)


def harmless(text: str) -> str:
    """Text that does nothing to a terminal but begin new lines."""
    return "\n".join(map(printable, text.split("\n")))


def _text(cell: Cell) -> Text:
    return cell if isinstance(cell, Text) else Text(harmless(cell))


def _styled(cell: Cell, column: Column) -> Text:
    """A cell in its column's style, unless it has one of its own."""
    return cell if isinstance(cell, Text) else Text(harmless(cell), column.style)


def _after(indent: int, cell: Cell, label: str = "") -> Text:
    return Text(" " * indent + label).append_text(_text(cell))
