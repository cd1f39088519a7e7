"""What each part of the learned controller's law is for: the same starts with parts of it left out."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import handed_over
from gaitwright.bench.evidence.played_without import LeftOut
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Outcome, Push, Trial

STARTS, SECONDS = 20, 6.0
PARTS = {
    "nothing": LeftOut(),
    "the taught forces": LeftOut(forces=True),
    "the taught free torque": LeftOut(free=True),
    "both": LeftOut(forces=True, free=True),
    "the teacher's own errors": LeftOut(errors=True),
    "the pull on stance legs": LeftOut(stance=True),
    "the pull on swing legs": LeftOut(swing=True),
    "regulation": LeftOut(linear=True, angular=True),
    "its linear part": LeftOut(linear=True),
    "its angular part": LeftOut(angular=True),
    "the weight along a slope": LeftOut(slope=True),
    "pull and regulation": LeftOut(stance=True, swing=True, linear=True, angular=True),
}
"""With the last of them the torque alone is played; its forces still go through the legs as they are."""
NOTE = (
    "Handed over after two seconds of six, by seeds that vary start and phase. Beside each case the starts "
    "without a fall and the share of the speed that they held. Parts are left out by what is played, not by "
    "switches in the law: the row of a tick holds nothing, or the errors of this very moment."
)


@dataclass(frozen=True, slots=True)
class Case:
    """What is tried without a part."""

    name: str
    skill: str
    scene: str = "flat"
    push: Push | None = None


CASES = (
    *(Case(skill, skill) for skill in ("walk", "trot", "pronk", "bound", "gallop")),
    Case("trot pushed", "trot", push=Push(0.9, 90.0, 3.0)),
    Case("trot on 10°", "trot", "slope:10"),
    Case("trot on rough", "trot", "rough:0.05"),
)


def measure(context: Context) -> Iterator[Figure]:
    """One row for each part."""
    parts = dict(list(PARTS.items())[:3]) if context.quick else PARTS
    for part, left_out in parts.items():
        cases = CASES[1:2] if context.quick else CASES
        trials = [trial(case, seed, left_out) for case in cases for seed in context.seeds(STARTS)]
        outcomes = context.outcomes(f"without {part}", trials)
        each = len(trials) // len(cases)
        told = [in_short(case, outcomes[k * each :][:each]) for k, case in enumerate(cases)]
        good = sum(outcome.kept_up for outcome in outcomes)
        every = {"each": [outcome.plain() for outcome in outcomes]}
        least = None if any(left_out) else 0.98
        what = f"without {part}" if any(left_out) else "with all of the law"
        yield count(f"{what}: no fall", good, len(trials), least, ", ".join(told), every)


def trial(case: Case, seed: int, left_out: LeftOut) -> Trial:
    """A start of a case without a part; every second one is pushed to the other side, at another phase."""
    push = case.push
    if push is not None:
        push = replace(push, direction=push.direction * (-1) ** seed, phase=seed // 2 % 10 / 10)
    return replace(handed_over(case.skill, seed, SECONDS, case.scene), push=push, without=left_out)


def in_short(case: Case, outcomes: Sequence[Outcome]) -> str:
    """How many went to the end, and the share of the speed that these held."""
    good = [outcome.held for outcome in outcomes if outcome.kept_up]
    held = f" ({np.mean(good):.2f})" if good else ""
    return f"{case.name} {len(good)}{held}"
