"""A reproduction on the screen, as Markdown, and as JSON."""

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from gaitwright.files import whole
from gaitwright.reproduce.claim import Claim, Grid, Reproduction

WIDE = 180
"""Columns of a table that goes to a file or a pipe."""
STYLES = {"agrees": "green", "DIFFERS": "bold red", "cannot": "yellow"}
HEAD = ("what", "the thesis", "ours", "agrees?", "")


# --- the screen ------------------------------------------------------------------------------------
def show(result: Reproduction, to_stderr: bool) -> None:
    """Prints a reproduction: its claims, its grids, and how many claims agree."""
    file = sys.stderr if to_stderr else sys.stdout
    console = Console(
        file=file, width=None if file.isatty() else WIDE, highlight=False, soft_wrap=not file.isatty()
    )
    console.print(Text(f"\n{result.title}", style="bold"))
    for grid in result.grids:
        console.print(grid_table(grid))
    console.print(claim_table(result.claims))
    console.print(Text(verdict(result), style="bold"))


def grid_table(grid: Grid) -> Table:
    """A grid of numbers."""
    table = Table(
        title=grid.title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0)
    )
    for k, name in enumerate(grid.head):
        table.add_column(name, justify="left" if k < grid.left else "right", overflow="fold")
    for row in grid.rows:
        table.add_row(*(Text(cell) for cell in row))
    return table


def claim_table(claims: Sequence[Claim]) -> Table:
    """What the thesis says, and what we get."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for name in HEAD:
        table.add_column(name, overflow="fold", style="dim" if not name else "", no_wrap=name == "agrees?")
    for claim in claims:
        mark = Text(claim.verdict, style=STYLES[claim.verdict])
        table.add_row(Text(claim.what), Text(claim.thesis), Text(claim.ours), mark, Text(claim.because))
    return table


def verdict(result: Reproduction) -> str:
    """How many claims agree."""
    can = [claim.agrees for claim in result.claims if claim.agrees is not None]
    cannot = len(result.claims) - len(can)
    return f"{result.name}: {sum(can)} of {len(can)} claims agree" + (f"; {cannot} cannot" if cannot else "")


# --- Markdown --------------------------------------------------------------------------------------
def markdown(result: Reproduction, drawn: Sequence[str]) -> str:
    """The whole reproduction as a page; `drawn`: names of the pictures that were drawn beside it."""
    parts = [f"# {result.title}", *result.about]
    parts += [f"![{picture.caption}]({picture.name})\n\n*{picture.caption}*"
              for picture in result.pictures if picture.name in drawn]  # fmt: skip
    parts += [f"## What agrees\n\n{verdict(result)}."]
    rows = [(c.what, c.thesis, c.ours, c.verdict, c.because) for c in result.claims]
    parts += [pipe_table(HEAD, rows, left=len(HEAD))]
    for grid in result.grids:
        parts += [f"## {grid.title[0].upper()}{grid.title[1:]}", pipe_table(grid.head, grid.rows, grid.left)]
    return "\n\n".join(parts) + "\n"


def pipe_table(head: Sequence[str], rows: Sequence[Sequence[str]], left: int) -> str:
    """A table of Markdown."""
    rule = ["---" if k < left else "---:" for k in range(len(head))]
    cells = [head, rule, *([cell.replace("|", "\\|") for cell in row] for row in rows)]
    cells[0] = [cell.replace("|", "\\|") for cell in head]
    return "\n".join(f"| {' | '.join(row)} |" for row in cells)


# --- JSON ------------------------------------------------------------------------------------------
def to_json(results: Sequence[Reproduction]) -> str:
    """Everything, as JSON."""
    plain = {
        "agrees": all(result.agrees for result in results),
        "reproduced": [result.plain() for result in results],
    }
    return json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False)


def write_text(path: Path, text: str) -> None:
    """Writes a file, complete or not at all; a device or a pipe is written to."""
    if path.exists() and not path.is_file():
        path.write_text(text, encoding="utf-8")
    else:
        with whole(path.resolve()) as draft:
            draft.write_text(text, encoding="utf-8")
