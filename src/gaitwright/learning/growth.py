"""What a trip does to the trust in the learned controller: motion bugs, and how long it drove without one.

Trust falls for what the learned controller drove into. What a mistake says of the rules is another matter:
that is a lesson (`learning.own_mistakes`).
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool

from gaitwright.control.takeover import LEARNED, NUMERICAL
from gaitwright.knowledge.trust import APPRENTICE, PARTNER, Experience, Grade, How, grades_in
from gaitwright.learning.live_sources import Played
from gaitwright.learning.own_mistakes import BEFORE, Mistake, motion_bugs_in
from gaitwright.record.recording import Recording
from gaitwright.skillbook.writer import Ledger

SHORT = 0.5
"""Less than this driven on a trip says nothing of a skill [s]."""
FOREIGN = "handed back for not being the taught situation"
Returns = Sequence[tuple[float, str]]
"""When which skill was handed back for not being the taught situation [s], as `Drive.handed_back`."""


class Bug(NamedTuple):
    """A motion bug under the learned controller, or a hand-back."""

    skill: str
    time: float
    sentence: str


def lived_through(
    recording: Recording, name: str, handed_back: Returns = (), grades: Mapping[str, Grade] | None = None
) -> list[Experience]:
    """What the learned controller went through on a trip called `name`, skill by skill.

    Of a skill with a motion bug the first one alone: what came after may be its consequence; so of its
    hand-backs. `grades`: so far, for what an apprentice watches.
    """
    trip, apprentices = recording.of_trip().sound(), apprentices_in(grades or {})
    bugs = {bug.skill: bug for bug in reversed(bugs_in(trip))}
    returns = {skill: Bug(skill, time, f"{FOREIGN} at {time:.1f} s") for time, skill in reversed(handed_back)}
    found = [with_facts(recording, name, "bug", bug) for bug in bugs.values()]
    for skill, (drove, watched) in seconds_of(trip).items():
        if skill not in bugs and drove >= SHORT:
            found.append(Experience(skill, "drove", round(drove, 3), why=name))
        elif skill in apprentices and watched >= SHORT and not trip.fell:
            found.append(Experience(skill, "watched", round(watched, 3), why=name))
    return found + [with_facts(recording, name, "returned", bug) for bug in returns.values()]


def with_facts(recording: Recording, name: str, how: How, bug: Bug) -> Experience:
    """The entry of a bug or a hand-back, with all that was measured at its moment."""
    played = Played(recording, name)
    played.at(bug.time)
    facts = dict(played.here().moment.facts)
    return Experience(bug.skill, how, why=f"{name}: {bug.sentence}", facts=facts)


def grown(ledger: Ledger, lived: Sequence[Experience]) -> list[str]:
    """Stores what was lived through; a sentence for each skill that has another grade now, or had a bug."""
    if not lived:
        return []
    before = grades_in(ledger.book.trust)
    after, said = grades_in(ledger.trust(lived).trust), []
    for skill, entry in {entry.skill: entry for entry in lived}.items():
        was, now = before.get(skill, PARTNER), after[skill]
        if was != now or entry.how in ("bug", "returned"):
            change = f"{was} → {now}" if was != now else f"still {now}"
            said.append(f"trust in {skill}: {change} ({entry.why})")
    return said


def apprentices_in(grades: Mapping[str, Grade]) -> set[str]:
    return {skill for skill, grade in grades.items() if grade == APPRENTICE}


def seconds_of(trip: Recording) -> dict[str, tuple[float, float]]:
    """How long the learned controller drove each skill, and the numerical one [s]."""
    skill, learned, numerical = trip["skill"], driven_by(trip, LEARNED), driven_by(trip, NUMERICAL)
    return {
        name: (
            float(trip.dt * (learned & (skill == k)).sum()),
            float(trip.dt * (numerical & (skill == k)).sum()),
        )
        for k, name in enumerate(trip.skills)
    }


def driven_by(trip: Recording, driver: str) -> Bool[np.ndarray, " ticks"]:
    """At which ticks somebody drove."""
    return trip["driver"] == (trip.drivers.index(driver) if driver in trip.drivers else -1)


def bugs_in(trip: Recording) -> list[Bug]:
    """The motion bugs that began under the learned controller, in order."""
    return [bug for mistake in motion_bugs_in(trip) if (bug := blamed(trip, mistake))]


def blamed(trip: Recording, mistake: Mistake) -> Bug | None:
    """The bug of the skill that the learned controller drove when a mistake began, if it did."""
    time = np.array(trip["time"])
    ticks = np.flatnonzero(
        driven_by(trip, LEARNED) & (time >= mistake.time) & (time <= mistake.time + BEFORE)
    )
    if not len(ticks):
        return None
    return Bug(trip.skills[int(trip.at("skill", int(ticks[0])))], mistake.time, mistake.sentence)
