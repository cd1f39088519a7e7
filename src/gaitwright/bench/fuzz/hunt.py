"""Many cases, each watched: by workers that are killed where one hangs, and begun anew where one dies."""

import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import msgspec

from gaitwright.bench.fuzz.case import Outcome

LONGEST = 20.0
"""A case that takes longer hangs [s]."""
BEGIN = 300.0
"""A worker may compile kernels first [s]."""
READY, DIED = b"ready\n", "its process died"
MOST_MB = 2000.0
"""A case that takes more memory is a fault."""


@dataclass
class Found:
    """What became of the cases of a kind."""

    kind: str
    cases: int = 0
    refused: int = 0
    tracebacks: dict[int, str] = field(default_factory=dict)
    """What the numbers of cases ended in."""
    hangs: list[int] = field(default_factory=list)
    greedy: list[int] = field(default_factory=list)
    slowest_s: float = 0.0
    peak_mb: float = 0.0

    @property
    def faults(self) -> int:
        return len(self.tracebacks) + len(self.hangs) + len(self.greedy)

    def add(self, outcome: Outcome) -> None:
        """Takes an outcome."""
        self.cases += 1
        self.refused += outcome.refused
        self.slowest_s = max(self.slowest_s, outcome.seconds)
        self.peak_mb = max(self.peak_mb, outcome.peak_mb)
        if outcome.fault:
            self.tracebacks[outcome.number] = outcome.fault
        if outcome.seconds > LONGEST:
            self.hangs.append(outcome.number)
        if outcome.peak_mb > MOST_MB:
            self.greedy.append(outcome.number)


def hunt(kind: str, seed: int, cases: int, tell: Callable[[int], None] = lambda _: None) -> Found:
    """Takes so many cases of a kind; `tell` hears how many are done."""
    found, number = Found(kind), 0
    while number < cases:
        for outcome in outcomes(kind, seed, number, cases):
            number = outcome.number + 1
            found.add(outcome)
            tell(number)
            if outcome.peak_mb > MOST_MB:  # memory that was taken is never given back: another worker
                break
    return found


def outcomes(kind: str, seed: int, first: int, beyond: int) -> Iterator[Outcome]:
    """The outcomes that one worker tells of; the last is ours where it hung or died."""
    with tempfile.TemporaryDirectory(prefix="gaitwright-fuzz-") as folder:
        words = [kind, str(seed), str(first), str(beyond), folder]
        command = [sys.executable, "-m", "gaitwright.bench.fuzz.worker", *words]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as worker:
            try:
                yield from told_by(worker, first, beyond)
            finally:
                worker.kill()


def told_by(worker: subprocess.Popen[bytes], first: int, beyond: int) -> Iterator[Outcome]:
    """The outcomes that a worker tells of, each waited for no longer than it may take."""
    lines: queue.Queue[bytes] = queue.Queue()
    pipe = worker.stdout
    assert pipe is not None

    def listen() -> None:
        for line in pipe:
            lines.put(line)
        lines.put(b"")

    threading.Thread(target=listen, daemon=True).start()
    assert lines.get(timeout=BEGIN) == READY, "a worker of the hunt did not begin"
    for number in range(first, beyond):
        try:
            line = lines.get(timeout=LONGEST + 5.0)
        except queue.Empty:
            yield Outcome(number, seconds=LONGEST + 5.0)
            return
        if not line:
            yield Outcome(number, fault=f"{DIED} with code {worker.wait()}")
            return
        yield msgspec.json.decode(line, type=Outcome)
