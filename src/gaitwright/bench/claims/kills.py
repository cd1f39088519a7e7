"""A learner killed at any moment loses no lesson it acknowledged, and its book goes on as if unkilled."""

import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.children import ChildFailed
from gaitwright.bench.evidence.learner import LESSONS, begun, lesson_of, rules_of
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.errors import BadFile
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import all_told

KILLS = 200
LATEST = 0.25
"""A kill comes at most so long after the child was asked to learn [s]: it opens the book within this too."""
NOTE = (
    "SIGKILL at random moments, opening and closing included; what the system holds for the disk survives "
    "that, so a loss of power is not measured here"
)


@dataclass
class Tally:
    """What became of the kills so far; `same` are books that hold what an unkilled one would."""

    runs: int = 0
    kills: int = 0
    kept: int = 0
    same: int = 0
    lessons: int = 0
    lost: int = 0
    books: int = 0
    alike: int = 0
    """Of the books, those whose rules at the end are those of a pupil whom nobody killed."""
    longest_ms: float = 0.0
    first: str = ""


def measure(context: Context) -> Iterator[Figure]:
    """Kills, figures of what they lost, and how long a lesson takes to be durable."""
    if not hasattr(signal, "SIGKILL"):
        yield Figure("kills without a loss", float("nan"), note="this system has no SIGKILL")
        return
    wanted = 20 if context.quick else KILLS
    tally = Tally()
    with tempfile.TemporaryDirectory(prefix="gaitwright-kills-") as folder:
        book = 0
        while tally.kills < wanted:
            try:
                kill_through(Path(folder) / f"{book}.skills", context.seed + book, wanted, tally)
            except ChildFailed as failure:
                yield Figure("runs after which the book loads", float("nan"), note=str(failure))
                return
            context.voice.say(f"kills: {tally.kills} of {wanted}", now=False)
            book += 1
    numbers = {"books": book, "lessons": tally.lessons, "kills": tally.kills}
    yield Figure(
        "acknowledged lessons lost", float(tally.lost), "", at_most(0.0), wanted, tally.first, numbers
    )
    yield count("runs after which the book loads", tally.kept, tally.runs, 1.0, tally.first, numbers)
    yield count(
        "runs that leave the lessons of an unkilled one", tally.same, tally.runs, 1.0, tally.first, numbers
    )
    what = "books that end with the rules of an unkilled pupil"
    yield count(what, tally.alike, tally.books, 1.0, tally.first, numbers)
    yield Figure("a lesson durable, longest", tally.longest_ms, "ms", at_most(100.0), tally.lessons)


def kill_through(path: Path, seed: int, wanted: int, tally: Tally) -> None:
    """Teaches one book to its end through kill after kill, and compares it with a book without any."""
    book = begun()
    book.save(path)
    moments = random.Random(f"moments {seed}")
    done, killed = 0, True
    while killed:
        after = moments.uniform(0.0, LATEST) if tally.kills < wanted else None
        acknowledged, killed = learn_and_kill(path, seed, after, tally)
        tally.kills += killed
        tally.runs += 1
        try:
            book = Skillbook.load(path)
        except BadFile as error:
            tally.lost += acknowledged
            tally.first = tally.first or str(error)
            return
        told = all_told(book.steps)
        tally.kept += 1
        tally.lost += max(0, acknowledged - len(told))
        if told != [lesson_of(seed, place) for place in range(len(told))]:
            tally.first = tally.first or f"seed {seed}: other lessons than an unkilled one has"
            return
        tally.same += 1
        tally.lessons += len(told) - done
        done = len(told)
    tally.books += 1
    tally.alike += done == LESSONS and book.rulebook.rules == rules_of(seed)
    if tally.alike < tally.books:
        tally.first = tally.first or f"seed {seed}: other rules at the end than an unkilled one has"


def learn_and_kill(path: Path, seed: int, after: float | None, tally: Tally) -> tuple[int, bool]:
    """Starts a learner and kills it so long after it began [s], or never; how many lessons it acknowledged in
    all so far, and whether the kill came before its end."""
    command = [sys.executable, "-m", "gaitwright.bench.evidence.learner", str(path), str(seed)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdin is not None and child.stdout is not None
        child.stdout.readline()  # imported, and about to open the book
        child.stdin.write("learn\n")
        child.stdin.flush()
        if after is not None:
            time.sleep(after)
            child.send_signal(signal.SIGKILL)
        lines = [
            line.split() for line in child.stdout.read().splitlines(keepends=True) if line.endswith("\n")
        ]
        code = child.wait()
        if code not in (0, -signal.SIGKILL):
            raise ChildFailed(f"the learner ended with exit code {code}")
    tally.longest_ms = max([tally.longest_ms, *(float(took) for _, took in lines)])
    return max((int(number) for number, _ in lines), default=0), code != 0
