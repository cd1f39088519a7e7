"""A reproduction on the screen, as Markdown, and as JSON."""

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from rich.text import Text

from gaitwright.files import whole
from gaitwright.reproduce.claim import Claim, Grid, Reproduction
from gaitwright.screen import Cell, Column, folded, paragraph, table, width_of, wrapped
from gaitwright.screen import show as show_lines

STYLES = {"agrees": "green", "DIFFERS": "bold red", "cannot": "yellow"}
HEADS = 9
"""Columns of a screen that the name of a column of numbers has in any case."""
HEAD = ("what", "the thesis", "ours", "agrees?", "")


# --- the screen ------------------------------------------------------------------------------------
def show(result: Reproduction, to_stderr: bool) -> None:
    """Prints a reproduction: its claims, its grids, and how many claims agree."""
    file = sys.stderr if to_stderr else sys.stdout
    width = width_of(file)
    lines: list[Cell] = ["", *paragraph(Text(result.title, "bold"), width)]
    for grid in result.grids:
        lines += ["", *paragraph(Text(grid.title, "italic"), width), *grid_table(grid, width)]
    lines += ["", *claim_table(result.claims, width), ""]
    show_lines([*lines, *paragraph(Text(verdict(result), "bold"), width)], file)


def grid_table(grid: Grid, width: int) -> list[Text]:
    """A grid of numbers, long names of columns in several lines."""
    columns = []
    for k, name in enumerate(grid.head):
        wide = max(HEADS, *(len(row[k]) for row in grid.rows))
        lines = [line.plain for line in wrapped(name, wide)]
        columns.append(Column("\n".join(lines), right=k >= grid.left))
    return folded(columns, grid.rows, width, grid.left, grid.together)


def claim_table(claims: Sequence[Claim], width: int) -> list[Text]:
    """What the thesis says, and what we get."""
    columns = [Column(name, prose=name != "agrees?", style="" if name else "dim") for name in HEAD]
    rows = [
        (claim.what, claim.thesis, claim.ours, Text(claim.verdict, STYLES[claim.verdict]), claim.because)
        for claim in claims
    ]
    return table(columns, rows, width)


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
