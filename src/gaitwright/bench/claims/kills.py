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
from gaitwright.bench.evidence.learner import LESSONS, begun, lesson_of, taught
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.errors import BadFile
from gaitwright.skillbook.book import Skillbook

KILLS = 200
LATEST = 0.25
"""A kill comes at most so long after the child was asked to learn [s]: it opens the book within this too."""
NOTE = (
    "SIGKILL at random moments, opening and closing included; what the system holds for the disk survives "
    "that, so a loss of power is not measured here"
)


@dataclass
class Tally:
    """What became of the kills so far."""

    runs: int = 0
    kills: int = 0
    kept: int = 0
    same: int = 0
    lessons: int = 0
    lost: int = 0
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
        "runs that leave the book of an unkilled one", tally.same, tally.runs, 1.0, tally.first, numbers
    )
    yield Figure("a lesson durable, longest", tally.longest_ms, "ms", at_most(100.0), tally.lessons)


def kill_through(path: Path, seed: int, wanted: int, tally: Tally) -> None:
    """Teaches one book to its end through kill after kill, and compares it with the book without any."""
    whole = begun()
    whole.save(path)
    moments = random.Random(f"moments {seed}")
    done = 0
    while tally.kills < wanted and done < LESSONS:
        acknowledged, killed = learn_and_kill(path, seed, moments.uniform(0.0, LATEST), tally)
        tally.kills += killed
        tally.runs += 1
        try:
            book = Skillbook.load(path)
        except BadFile as error:
            tally.lost += acknowledged
            tally.first = tally.first or str(error)
            return
        tally.kept += 1
        stored = len(book.steps) - 1
        tally.lost += max(0, acknowledged - stored)
        for place in range(done, stored):
            whole = taught(whole, lesson_of(seed, place))
        tally.same += book == whole
        if book != whole:
            tally.first = tally.first or f"seed {seed}: another book after lesson {stored}"
            return
        tally.lessons += stored - done
        done = stored


def learn_and_kill(path: Path, seed: int, after: float, tally: Tally) -> tuple[int, bool]:
    """Starts a learner and kills it so long after it began; how many lessons it acknowledged in all so far,
    and whether the kill came before its end."""
    command = [sys.executable, "-m", "gaitwright.bench.evidence.learner", str(path), str(seed)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdin is not None and child.stdout is not None
        child.stdout.readline()  # imported, and about to open the book
        child.stdin.write("learn\n")
        child.stdin.flush()
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
