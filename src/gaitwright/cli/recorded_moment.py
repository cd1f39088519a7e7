"""What a recording tells of one moment, as facts that a situation can be read from."""

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Fact, Memory, remembered
from gaitwright.record.metrics import attitude
from gaitwright.record.moment import call_at, route_at, sensed_at
from gaitwright.record.recording import Recording, load
from gaitwright.skills.measured import measured
from gaitwright.skills.situation import named
from gaitwright.skills.vocabulary import KEPT, VOCABULARY
from gaitwright.skills.wording import NUMBERS


def recorded_facts(path: str, at: float | None) -> tuple[float, Memory]:
    """The moment [s] nearest to `at` (`None`: the last one) and what was so then, by the names of facts.

    Raises `BadFile` for a file that is no recording, `WrongUse` for a moment that was not recorded.
    """
    recording = load(path).of_trip().sound()
    time = recording["time"]
    if at is not None and not time[0] <= at <= time[-1]:
        raise WrongUse(f"--at {at:g}: the recording goes from {time[0]:g} to {time[-1]:g} s")
    tick = len(time) - 1 if at is None else int(np.abs(time - at).argmin())
    now = slice(tick, tick + 1)
    roll, pitch = (float(angle[0]) for angle in attitude(recording.channel("orientation_wb")[now]))
    forward, left, turn = recording.motion()[now][0].tolist()
    call = call_at(recording, tick)
    facts = {
        "skill": call.skill,
        "driver": call.driver,
        "speed": forward,
        "lateral speed": left,
        "turn rate": turn,
        "wished speed": call.velocity[0],
        "wished turn rate": call.turn,
        "roll": roll,
        "pitch": pitch,
        "feet down": float(recording.at("stance", tick).sum()),
    }
    return float(time[tick]), remembered(facts | situation_at(recording, tick))


def situation_at(recording: Recording, tick: int) -> dict[str, Fact]:
    """The leaf of each tree of our own situation space, or the number that it is read from, and all numbers
    that a rule may go by; nothing where an older recording does not tell."""
    route = route_at(recording, tick)
    if route is None:
        return {}
    before = call_at(recording, max(0, tick - 1))  # what it had been doing when it chose
    raw = measured(recording.robot, route, sensed_at(recording, tick), before)
    leaves = {tree: leaf for tree, leaf in named(raw, before).items() if leaf is not None}
    notes = {name: fact for name, fact in before.memory.items() if name not in KEPT}
    numbers = {column.name: column.read(raw) for column in VOCABULARY.columns if not column.values}
    return {
        **notes,
        **leaves,
        **{tree: VOCABULARY.columns[k].read(raw) for tree, k in NUMBERS.items()},
        **numbers,
    }
