"""What the user sees: tables on the standard output, progress and remarks on the standard error."""

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from threading import Timer
from time import perf_counter

from rich.progress import BarColumn, Progress, TextColumn
from rich.text import Text

from gaitwright.cli.sentences import fitted
from gaitwright.errors import told
from gaitwright.locomotion import Lap
from gaitwright.screen import Column, Row, paragraph, screen, show, table, width_of

EVERY = 5.0
"""Where no terminal shows a moving bar, a line of progress comes this often [s]."""
PATIENCE = 1.0
"""What takes longer says what it is [s]."""
REFRESH = 0.2
"""The moving bar is drawn this often [s]."""
NAMES = 19
"""Columns of the names beside values, at least."""


def remark(text: str) -> None:
    """A sentence on the standard error."""
    print(fitted(told(text)), file=sys.stderr, flush=True)


def show_table(
    head: Sequence[str], rows: Iterable[Row], right: Sequence[str] = (), prose: Sequence[str] = ()
) -> None:
    """A table on the standard output; the columns in `right` are flush right, those in `prose` may wrap."""
    columns = [Column(name, name in right, name in prose) for name in head]
    show(["", *table(columns, rows, width_of(sys.stdout)), ""])


def show_pairs(title: str, pairs: Iterable[tuple[str, str]], to_stderr: bool) -> None:
    """A title, where there is one, and lines of name and value."""
    file = sys.stderr if to_stderr else sys.stdout
    width = width_of(file)
    heading = ["", *(Text(line.plain, "bold") for line in paragraph(told(title), width))] if title else []
    columns = (Column(style="dim"), Column(prose=True))
    rows = [(f"{name:{NAMES}}", value) for name, value in pairs]
    show([*heading, *(table(columns, rows, width, head=False) if rows else [])], file)


def show_prose(text: str, indent: int = 0, to_stderr: bool = False) -> None:
    """A paragraph."""
    file = sys.stderr if to_stderr else sys.stdout
    show(paragraph(text, width_of(file), indent), file)


def show_heading(text: str) -> None:
    """A bold line after an empty one."""
    show(["", Text(text, "bold")])


@contextmanager
def working(what: str, worth_a_line: bool | None = True) -> Iterator[None]:
    """Says what is being done: a spinner on a terminal, else a line where it is worth one; `None`: once it
    has taken a second."""
    if sys.stderr.isatty():
        with screen(sys.stderr).status(what):
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
                BarColumn(30), text, console=screen(sys.stderr), auto_refresh=False, transient=True
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
