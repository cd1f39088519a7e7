"""What a claim is measured with: starts and seconds, workers, and a voice."""

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

from rich.console import Console
from rich.status import Status

from gaitwright.bench.trial import DT, Outcome, Trial, simulate
from gaitwright.numerics.compiled import is_warm
from gaitwright.workers import Found, Given, Workers

EVERY = 15.0
"""Where no terminal shows a moving line, progress comes this often [s]."""


class Voice:
    """Progress on the standard error: a moving line on a terminal, else a line now and then."""

    def __init__(self) -> None:
        self.began = perf_counter()
        self.spoke = float("-inf")
        self.status: Status | None = None
        if sys.stderr.isatty():
            self.status = Console(stderr=True, highlight=False).status("")
            self.status.start()

    def say(self, text: str, now: bool = True) -> None:
        """Says where we are; with `now` false only when it was quiet for a while."""
        at = perf_counter()
        if self.status:
            self.status.update(f"{text} ({at - self.began:.0f} s)")
        elif now or at - self.spoke >= EVERY:
            self.spoke = at
            print(f"bench: {text} ({at - self.began:.0f} s)", file=sys.stderr, flush=True)

    def close(self) -> None:
        if self.status:
            self.status.stop()


@dataclass
class Context:
    """One run of the bench."""

    workers: Workers
    quick: bool = False
    seed: int = 0
    """The first of the seeds that vary the starts."""
    robots: Path | None = None
    """A folder of robot files that a person named."""
    voice: Voice = field(default_factory=Voice)

    def __enter__(self) -> "Context":
        return self

    def __exit__(self, *_: object) -> None:
        self.voice.close()

    def seeds(self, starts: int, quick: int = 2) -> range:
        """Seeds of the starts; at most `quick` of them where it has to be quick."""
        return range(self.seed, self.seed + (min(quick, starts) if self.quick else starts))

    def seconds(self, seconds: float, quick: float) -> float:
        """How long to simulate [s]."""
        return min(seconds, quick) if self.quick else seconds

    def outcomes(self, what: str, trials: Sequence[Trial]) -> list[Outcome]:
        """What became of the trials, in their order."""
        self.voice.say(f"{what}: {len(trials)} starts")
        return self.workers.each(
            simulate,
            trials,
            lambda done: self.voice.say(f"{what}: {done} of {len(trials)} starts", now=False),
        )

    def each(self, what: str, task: Callable[[Given], Found], given: Sequence[Given]) -> list[Found]:
        """What the workers make of each thing given, in their order."""
        self.voice.say(f"{what}: {len(given)} to do")
        return self.workers.each(
            task, given, lambda done: self.voice.say(f"{what}: {done} of {len(given)}", now=False)
        )

    def warm_up(self) -> None:
        """Compiles the kernels, or loads them, before workers do so side by side."""
        self.voice.say(
            "loading kernels" if is_warm() else "compiling kernels (first run only, up to two minutes)"
        )
        simulate(Trial("go2", "flat", 3 * DT, 0, speed=0.4))
