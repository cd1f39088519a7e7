"""What a run of the bench shows: a table for each group on the screen, and all numbers as JSON."""

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from gaitwright.bench.machine import line
from gaitwright.bench.measurement import Figure
from gaitwright.files import whole

WIDE = 180
"""Columns of a table that goes to a file or a pipe."""


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
    console = Console(
        file=file, width=None if file.isatty() else WIDE, highlight=False, soft_wrap=not file.isatty()
    )
    console.print(Text(line(result.machine), style="dim"))
    if result.quick:
        console.print(
            Text("QUICK: fewer starts and seconds than the claims are about. A look, not a result.", "yellow")
        )
    measured = [section for section in result.sections if section.figures]
    for group in dict.fromkeys(section.group for section in measured):
        sections = [section for section in measured if section.group == group]
        console.print(table_of(group, sections))
        for note in (section.note for section in sections if section.note):
            console.print(Text(note, style="dim"))
    console.print(Text(verdict(result), style="bold"))


def table_of(group: str, sections: Sequence[Section]) -> Table:
    """The figures of a group, claim by claim."""
    table = Table(title=group, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, header_style="bold")
    table.add_column("what", overflow="fold")
    table.add_column("measured", justify="right", no_wrap=True)
    table.add_column("wanted", justify="right", no_wrap=True)
    table.add_column("reached?", no_wrap=True)
    table.add_column("starts", justify="right", no_wrap=True)
    table.add_column("", style="dim", overflow="fold")
    for section in sections:
        for figure in section.figures:
            mark = {True: "green", False: "bold red", None: ""}[figure.reached]
            table.add_row(
                Text(figure.what),
                figure.measured_text,
                figure.wanted_text,
                Text(figure.reached_text, style=mark),
                str(figure.starts),
                Text(figure.note),
            )
        table.add_section()
    return table


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
