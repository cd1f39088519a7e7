"""What a recording tells of one moment, as facts that a situation can be read from."""

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Memory, remembered
from gaitwright.record.metrics import attitude
from gaitwright.record.recording import load


def recorded_facts(path: str, at: float | None) -> tuple[float, Memory]:
    """The moment [s] nearest to `at` (`None`: the last one) and what was so then, by the names of facts.

    Raises `BadFile` for a file that is no recording, `WrongUse` for a moment that was not recorded.
    """
    recording = load(path)
    time = recording["time"]
    if at is not None and not time[0] <= at <= time[-1]:
        raise WrongUse(f"--at {at:g}: the recording goes from {time[0]:g} to {time[-1]:g} s")
    tick = len(time) - 1 if at is None else int(np.abs(time - at).argmin())
    roll, pitch = (float(angle[tick]) for angle in attitude(recording["orientation_wb"]))
    forward, left, turn = recording.moved()[tick].tolist()
    facts = {
        "skill": recording.skills[int(recording["skill"][tick])],
        "driver": recording.drivers[int(recording["driver"][tick])],
        "speed": forward,
        "lateral speed": left,
        "turn rate": turn,
        "wished speed": float(recording["command"][tick, 0]),
        "wished turn rate": float(recording["command"][tick, 2]),
        "roll": roll,
        "pitch": pitch,
        "feet down": float(recording["stance"][tick].sum()),
    }
    return float(time[tick]), remembered(facts)
