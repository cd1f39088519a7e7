"""Rows of numbers that users write by hand, as CSV or JSON: limited, finite, every fault with its row.

CSV has a line of names and then a row a line; JSON an object with one list of objects, `{"stops": [{"x": 2,
"y": 1}]}`. What a row leaves out has the value that is usual.
"""

import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Generic, TypeVar

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, short, told
from gaitwright.files import content_of, json_of, text_of

MAX_BYTES = 1_000_000
MOST_ROWS = 10_000
LARGEST = 1e6
"""No number is beyond this."""
Number = Annotated[float, Meta(ge=-LARGEST, le=LARGEST)]
Row = TypeVar("Row", bound=msgspec.Struct)


@dataclass(frozen=True)
class Kind(Generic[Row]):
    """What a file of rows holds."""

    what: str
    """What it is called in sentences."""
    rows: str
    """The name of the list in JSON."""
    row: type[Row]
    entry: type[msgspec.Struct]
    """A whole JSON file."""


def read_rows(path: str | Path, kind: Kind[Row]) -> list[Row]:
    """The rows of a file, at least one. Raises `BadFile` with one sentence."""
    asked = f"{kind.what} {short(str(path))}"
    content = content_of(path, kind.what, MAX_BYTES).removeprefix(b"\xef\xbb\xbf")  # some editors begin so
    if content.lstrip()[:1] in (b"{", b"["):
        try:
            rows = getattr(json_of(content, kind.entry, asked), kind.rows)
        except msgspec.ValidationError as error:
            raise BadFile(f"{asked}{placed(str(error))}") from None
    else:
        rows = from_csv(text_of(content, asked), kind, asked)
    if not 0 < len(rows) <= MOST_ROWS:
        raise BadFile(f"{asked} has {len(rows) or 'no'} {kind.rows}, and may have 1 to {MOST_ROWS}")
    return rows


def from_csv(text: str, kind: Kind[Row], asked: str) -> list[Row]:
    """The rows of a CSV text; lines that are empty or begin with # do not count. Raises `BadFile`."""
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    try:
        table = [[cell.strip() for cell in line] for line in csv.reader(io.StringIO("\n".join(lines)))]
    except csv.Error as error:
        raise BadFile(f"{asked} is no table: {error}") from None
    names, known = table[0] if table else [], kind.row.__struct_fields__
    strange = next((name for name in names if name not in known), None)
    if strange is not None:
        raise BadFile(
            f"{asked}: no column is called {told(repr(strange[:60]))}; there is: {', '.join(known)}"
        )
    if len(set(names)) < len(names):
        raise BadFile(f"{asked} names a column twice")
    return [row_of(cells, names, kind, f"{asked}, row {count}") for count, cells in enumerate(table[1:], 1)]


def row_of(cells: list[str], names: list[str], kind: Kind[Row], where: str) -> Row:
    """A row of CSV; empty cells are left out. Raises `BadFile`."""
    if len(cells) != len(names):
        raise BadFile(f"{where} has {len(cells)} numbers under {len(names)} names")
    numbers = {}
    for name, cell in zip(names, cells, strict=True):
        try:
            numbers |= {name: float(cell)} if cell else {}
        except ValueError:
            raise BadFile(f"{where}, {name}: {told(repr(cell[:60]))} is no number") from None
    try:
        return msgspec.convert(numbers, kind.row)
    except msgspec.ValidationError as error:
        raise BadFile(f"{where}{placed(str(error))}") from None


def placed(message: str) -> str:
    """msgspec's "Expected … - at `$.stops[0].x`" with row and name in front."""
    found = re.fullmatch(r"(.*?)(?: - at `\$(?:\.?\w*\[(\d+)\])?(?:\.(\w+))?`)?", message)
    if not found:
        return f": {message}"
    what, row, name = found.groups()
    where = f", row {int(row) + 1}" if row else ""
    return f"{where}{f', {name}' if name else ''}: {what[0].lower()}{what[1:]}"
