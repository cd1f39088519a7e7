"""What a run of the bench shows: a table for each group on the screen, and all numbers as JSON."""

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.text import Text

from gaitwright.bench.machine import line
from gaitwright.bench.measurement import Figure
from gaitwright.files import whole
from gaitwright.screen import Cell, Column, paragraph, table, width_of
from gaitwright.screen import show as show_lines

COLUMNS = (
    Column("what", prose=True),
    Column("measured", right=True),
    Column("wanted", right=True),
    Column("reached?"),
    Column("starts", right=True),
    Column(prose=True, style="dim"),
)


@dataclass(frozen=True)
class Section:
    """A claim, and its figures as far as they were measured."""

    claim: str
    group: str
    figures: Sequence[Figure]
    note: str = ""
    """How it was measured, where that has to be known."""


@dataclass(frozen=True)
class Result:
    """One run of the bench."""

    machine: dict[str, Any]
    quick: bool
    seed: int
    sections: Sequence[Section]
    interrupted: bool = False

    @property
    def reached(self) -> bool:
        """Whether every figure that is wanted was reached, and none is missing."""
        return not self.interrupted and all(f.reached is not False for s in self.sections for f in s.figures)

    def to_json(self) -> str:
        """Every number, as JSON."""
        plain = {
            "machine": self.machine,
            "quick": self.quick,
            "seed": self.seed,
            "interrupted": self.interrupted,
            "reached": self.reached,
            "claims": [
                {
                    "claim": section.claim,
                    "group": section.group,
                    "note": section.note,
                    "figures": [figure.plain() for figure in section.figures],
                }
                for section in self.sections
            ],
        }
        return json.dumps(plain, indent=1, ensure_ascii=False)


def show(result: Result, to_stderr: bool) -> None:
    """Prints a table for each group, and what has to be known about it."""
    file = sys.stderr if to_stderr else sys.stdout
    width = width_of(file)
    lines: list[Cell] = [*paragraph(Text(line(result.machine), "dim"), width)]
    if result.quick:
        look = "QUICK: fewer starts and seconds than the claims are about. A look, not a result."
        lines += paragraph(Text(look, "yellow"), width)
    measured = [section for section in result.sections if section.figures]
    for group in dict.fromkeys(section.group for section in measured):
        sections = [section for section in measured if section.group == group]
        lines += ["", Text(group, "italic"), *table(COLUMNS, rows_of(sections), width), ""]
        for note in (section.note for section in sections if section.note):
            lines += paragraph(Text(note, "dim"), width)
    show_lines([*lines, *paragraph(Text(verdict(result), "bold"), width)], file)


def rows_of(sections: Sequence[Section]) -> list[tuple[Cell, ...]]:
    """The figures of a group, an empty line between two claims."""
    marks = {True: "green", False: "bold red", None: ""}
    rows: list[tuple[Cell, ...]] = []
    for section in sections:
        rows += [()] if rows else []
        rows += [
            (
                figure.what,
                figure.measured_text,
                figure.wanted_text,
                Text(figure.reached_text, marks[figure.reached]),
                str(figure.starts),
                figure.note,
            )
            for figure in section.figures
        ]
    return rows


def verdict(result: Result) -> str:
    """The last line."""
    wanted = [f.reached for s in result.sections for f in s.figures if f.reached is not None]
    said = f"{sum(wanted)} of {len(wanted)} wanted figures reached"
    if result.interrupted:
        said += "; interrupted: only what was finished is shown"
    return said + (" (quick: a look, not a result)" if result.quick else "")


def write(result: Result, where: str | None) -> None:
    """Writes the JSON to a file, or to the standard output for `-`."""
    if where is None:
        return
    path = Path(where)
    if where == "-":
        print(result.to_json())
    elif path.exists() and not path.is_file():  # a device or a pipe, which nothing may replace
        path.write_text(result.to_json() + "\n", encoding="utf-8")
    else:
        with whole(path.resolve()) as draft:
            draft.write_text(result.to_json() + "\n", encoding="utf-8")
