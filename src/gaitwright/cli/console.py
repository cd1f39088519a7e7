"""What the user sees: tables on the standard output, progress and remarks on the standard error."""

import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from threading import Timer
from time import perf_counter

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from gaitwright.locomotion import Lap

EVERY = 5.0
"""Where no terminal shows a moving bar, a line of progress comes this often [s]."""
PATIENCE = 1.0
"""What takes longer says what it is [s]."""
REFRESH = 0.2
"""The moving bar is drawn this often [s]."""
WIDE = 180
"""Columns of a table that goes to a file or a pipe."""
PROSE = 100
"""Letters of a line of prose."""


def console(file=None) -> Console:
    """A console on the standard output, or on `file`."""
    file = file or sys.stdout
    return Console(
        file=file, width=None if file.isatty() else WIDE, highlight=False, soft_wrap=not file.isatty()
    )


def remark(text: str) -> None:
    """A line on the standard error."""
    print(text, file=sys.stderr, flush=True)


def show_table(head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[str] = ()) -> None:
    """A table on the standard output; the columns in `right` are flush right."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, header_style="bold")
    for name in head:
        table.add_column(
            name, justify="right" if name in right else "left", overflow="fold", no_wrap=name in right
        )
    for row in rows:
        table.add_row(*row)
    console().print(table)


def show_pairs(title: str, pairs: Iterable[tuple[str, str]], to_stderr: bool) -> None:
    """A title, where there is one, and lines of name and value."""
    screen = console(sys.stderr if to_stderr else sys.stdout)
    if title:
        screen.print(f"\n{title}", style="bold", markup=False)
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(style="dim", no_wrap=True, min_width=19)
    table.add_column(overflow="fold")
    for pair in pairs:
        table.add_row(*pair)
    screen.print(table)


def show_prose(text: str, indent: str = "", to_stderr: bool = False) -> None:
    """A paragraph of at most `PROSE` letters a line."""
    screen = console(sys.stderr if to_stderr else sys.stdout)
    lines = textwrap.wrap(text, min(PROSE, screen.width), initial_indent=indent, subsequent_indent=2 * indent)
    screen.print("\n".join(lines), markup=False)


@contextmanager
def working(what: str, worth_a_line: bool | None = True) -> Iterator[None]:
    """Says what is being done: a spinner on a terminal, else a line where it is worth one; `None`: once it
    has taken a second."""
    if sys.stderr.isatty():
        with console(sys.stderr).status(what):
            yield
    elif worth_a_line:
        remark(f"{what} …")
        yield
    elif worth_a_line is None:
        with told_if_slow(what):
            yield
    else:
        yield


@contextmanager
def told_if_slow(what: str) -> Iterator[None]:
    """Says what is being done once it has taken a second."""
    timer = Timer(PATIENCE, remark, [f"{what} …"])
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


class Simulating:
    """Shows how far a simulation is; called with every lap."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self.began = self.shown = perf_counter()
        self.bar: Progress | None = None

    def __enter__(self) -> "Simulating":
        if sys.stderr.isatty():
            text = TextColumn(
                "simulating {task.fields[at]:.1f} of {task.total:g} s, {task.fields[pace]:.1f} × real time"
            )
            # Drawn by this thread alone: another one would disturb the ticks that are being timed.
            self.bar = Progress(
                BarColumn(30), text, console=console(sys.stderr), auto_refresh=False, transient=True
            )
            self.bar.start()
            self.task = self.bar.add_task("", total=self.seconds, at=0.0, pace=0.0)
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar:
            self.bar.stop()

    def __call__(self, lap: Lap) -> None:
        now = perf_counter()
        if now - self.shown < (REFRESH if self.bar else EVERY):
            return
        self.shown, at = now, lap.sensed.time
        if self.bar:
            self.bar.update(self.task, completed=at, at=at, pace=at / (now - self.began), refresh=True)
        else:
            remark(f"simulating {at:.1f} of {self.seconds:g} s")
