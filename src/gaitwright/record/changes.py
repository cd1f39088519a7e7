"""Recording → when skill, driver or rule changed, and to what."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from gaitwright.record.metrics import stretches
from gaitwright.record.moment import call_at
from gaitwright.record.notes import WHY
from gaitwright.record.recording import Recording
from gaitwright.skills.vocabulary import RULE_IN_USE


class Change(NamedTuple):
    """What is so from a time on [s], and why; no rule, or nothing known: empty."""

    time: float
    skill: str
    driver: str
    rule: str
    because: str = ""


def changes_of(recording: Recording) -> Iterator[Change]:
    """One for each moment at which one of them changed, the first at the beginning."""
    several = np.stack([recording[name] for name in ("skill", "driver", "memory")], axis=1)
    _, numbers = np.unique(np.nan_to_num(several, nan=-1.0), axis=0, return_inverse=True)
    reasons = {note.time: note.sentence for note in recording.notes if note.kind == WHY}
    before = None
    for start, _ in stretches(numbers.ravel()):
        call = call_at(recording, start)
        now = call.skill, call.driver, str(call.memory.get(RULE_IN_USE, ""))
        if now != before:
            time = float(recording.at("time", start))
            yield Change(time, *now, reasons.get(time, ""))
        before = now
