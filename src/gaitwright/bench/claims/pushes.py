"""Claim: Go2 in a trot survives a push to the side, at whatever phase of its gait."""

from collections.abc import Iterator

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
ENOUGH = 0.9
"""Share of the starts that makes a push one that is survived."""
STEP, MOST = 0.15, 3.0
"""Rungs of the search for the largest push, and its end [N·s/kg]."""


def measure(context: Context) -> Iterator[Figure]:
    """Pushes sideways and forward; then the largest that are survived."""
    for name, directions, impulse, least in (
        ("sideways", SIDEWAYS, 1.0, ENOUGH),
        ("forward", FORWARD, 1.5, ENOUGH),
    ):
        what = f"go2 trot {SPEED:g} m/s: survived {impulse:g} N·s/kg {name}"
        outcomes = pushed(context, what, impulse, directions, starts=20)
        good, every = sum(o.kept_up for o in outcomes), [o.plain() for o in outcomes]
        note = failure(outcomes) or "at phases spread over the cycle"
        yield count(what, good, len(outcomes), least, note, {"each": every})
        if not context.quick:
            yield largest(context, name, directions, impulse)


def pushed(
    context: Context, what: str, impulse: float, directions: tuple[float, float], starts: int
) -> list[Outcome]:
    """What became of pushed robots: phases spread over the cycle, each in both directions."""
    seeds = context.seeds(starts, quick=2)
    phases = max(1, len(seeds) // 2)
    trials = [
        Trial(
            "go2",
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
