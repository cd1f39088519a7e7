"""Claim: Go2 does every skill for 20 s without a fall, at the speed asked for; the fast ones fast."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from gaitwright.bench.claims.walks import failure
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least, at_most, count
from gaitwright.bench.trial import Outcome, Trial

SECONDS, STARTS = 20.0, 20
UPRIGHT = 0.95
"""Share of the starts that must go to the end."""
HELD, HELD_FAST = 0.90, 0.85
"""Share of the velocity that must be held; of skills with a flight phase, less."""
LIMITS = at_most(1.0)
"""Joints may go beyond their limits by so much [°]."""


@dataclass(frozen=True, slots=True)
class Row:
    """A skill at a speed; `None`: the speed it is meant for."""

    skill: str
    speed: float | None = None
    held: float = HELD
    robot: str = "go2"

    @property
    def what(self) -> str:
        speed = "" if self.speed is None else f" {self.speed:g} m/s"
        return f"{self.robot} {self.skill}{speed}"


ROWS = (
    Row("stand"),
    Row("stop"),
    Row("walk"),
    Row("walk-backward"),
    Row("walk-sideways"),
    Row("climb"),
    Row("descend"),
    Row("trot"),
    Row("trot", 0.9),
    Row("turn-left"),
    Row("turn-right"),
    Row("turn-in-place"),
    Row("rack"),
    Row("pace"),
    Row("pace", 1.1),
    Row("run", held=HELD_FAST),
    Row("run", 2.0, HELD_FAST),
    Row("pronk", held=HELD_FAST),
    Row("pronk", 1.1, HELD_FAST),
    Row("bound", held=HELD_FAST),
    Row("bound", 1.4, HELD_FAST),
    Row("gallop", held=HELD_FAST),
    Row("gallop", 1.7, HELD_FAST),
    Row("rotary-gallop", held=HELD_FAST),
    Row("rotary-gallop", 1.4, HELD_FAST),
    *(
        Row(skill, robot="hexapod")
        for skill in ("tripod", "ripple", "wave", "turn-in-place", "walk-sideways")
    ),
)


def measure(context: Context) -> Iterator[Figure]:
    """Falls and speed of every skill, and how far joints went."""
    beyond = []
    for row in ROWS:
        seconds = context.seconds(SECONDS, 6.0)
        trials = [
            Trial(row.robot, "flat", seconds, seed, row.skill, row.speed, None)
            for seed in context.seeds(STARTS)
        ]
        outcomes = context.outcomes(row.what, trials)
        beyond += [outcome.beyond for outcome in outcomes if outcome.kept_up]
        yield from figures(row, seconds, outcomes)
    yield Figure("farthest any joint went beyond its limits", max(beyond), "°", LIMITS, len(beyond))


def figures(row: Row, seconds: float, outcomes: Sequence[Outcome]) -> Iterator[Figure]:
    """Starts without a fall, and the share of the velocity that they held on average."""
    good = [outcome for outcome in outcomes if outcome.kept_up]
    starts, every = len(outcomes), {"each": [outcome.plain() for outcome in outcomes]}
    note = failure(outcomes) or "speed " + ", ".join(
        f"{word} {value:.2f}"
        for word, value in (
            ("held by the worst start", min(o.held for o in good)),
            ("cost of transport", sum(o.report.cost_of_transport for o in good) / len(good)),
        )
    )
    yield count(f"{row.what}: {seconds:g} s without a fall", len(good), starts, UPRIGHT, note, every)
    share = sum(o.held for o in good) / len(good) if good else float("nan")
    yield Figure(f"{row.what}: share of the velocity held, mean", share, "", at_least(row.held), len(good))
