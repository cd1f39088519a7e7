"""The school: a teacher demonstrates, then lets the rules decide and steps in at the first wrong choice.

Everything here runs on kinematic trips (`learning.kinematic`), so that a whole school takes seconds; what was
learned then drives real ones.
"""

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import groupby

import numpy as np

from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.apprentice import (
    Studied,
    confirmed,
    corrected,
    only_goes_on,
    outranked,
    step_of,
    study,
)
from gaitwright.learning.courses import course
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.exam import firm_share, is_right
from gaitwright.learning.kinematic import moments_of
from gaitwright.learning.teacher import ScriptedTeacher, Teacher, teacher_for
from gaitwright.learning.trips import SCHOOL, teacher_drives, trips
from gaitwright.model.robot import Robot
from gaitwright.skillbook.history import Step
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.book_trees import up_to_date
from gaitwright.skills.situation import FOREST

KINDS_OF_RULES = 13
"""So many rules are looked for before there are demonstrations enough."""
MOST_TRIPS = 400_000
"""Trips by rules of one seed: beyond these lie the courses of the next."""
AT_FIRST = 2
"""Demonstrations of each skill before the rules may try."""


@dataclass(frozen=True, slots=True)
class Demonstration:
    """A stretch of a teacher's trip in which she uses one skill."""

    rule: str
    moments: tuple[DecisionPoint, ...]


@dataclass(frozen=True, slots=True)
class SchoolReport:
    """What came of a school."""

    demonstrations: dict[str, int]
    """How many of each skill."""
    shown: int
    """Moments in them."""
    trips: int
    """Trips that the rules drove with the teacher watching."""
    interventions: tuple[int, ...]
    """How often she stepped in, trip by trip."""
    lessons: int
    open: int
    """Contradictions that nobody could mend."""
    firm: float
    """Share of the trees in which the two marks of a rule meet."""


@dataclass(frozen=True, slots=True)
class Reached:
    """How far an interrupted school came: so many trips, so many moments of the next, and how often each rule
    was corrected on them."""

    trip: int = 0
    moment: int = 0
    corrected: Counter[str] = field(default_factory=Counter)


@dataclass(frozen=True, slots=True)
class Schooled:
    """A rulebook and how it came to be."""

    rulebook: Rulebook
    report: SchoolReport


def demonstrations(
    robot: Robot, teacher: Teacher, seed: int, per_skill: int = 5, longest: int = 4
) -> tuple[Demonstration, ...]:
    """Stretches of the teacher's trips, up to `per_skill` of each skill and from as many trips, at most
    `longest` moments each, evenly taken."""
    found: dict[str, list[Demonstration]] = {}
    kinds = len(teacher.policy) if isinstance(teacher, ScriptedTeacher) else KINDS_OF_RULES
    for trip in trips(robot, teacher, SCHOOL * 1000 + seed):
        shown_here = set()
        for rule, stretch in groupby(trip, key=lambda moment: teacher.ideal(moment.raw).rule):
            moments = tuple(stretch)
            enough = found.setdefault(rule, [])
            if len(enough) < per_skill and rule not in shown_here:
                shown_here.add(rule)
                enough.append(Demonstration(rule, spread(moments, longest)))
        if found and all(len(enough) >= per_skill for enough in found.values()) and len(found) >= kinds:
            break
    return tuple(shown for row in found.values() for shown in row)


def spread(moments: Sequence[DecisionPoint], most: int) -> tuple[DecisionPoint, ...]:
    """At most so many of them, from the first on, evenly."""
    places = np.unique(np.linspace(0, len(moments) - 1, most).round().astype(int))
    return tuple(moments[int(k)] for k in places)


def demonstrate(
    rulebook: Rulebook, teacher: Teacher, shown: Sequence[Demonstration], passes: int = 3
) -> Studied:
    """The rulebook after demonstrations: one of each skill in turn, then the next of each."""
    order: dict[str, int] = {}
    turns = []
    for one in shown:
        order[one.rule] = order.get(one.rule, -1) + 1
        turns.append((order[one.rule], one))
    moments = [moment for _, one in sorted(turns, key=lambda turn: turn[0]) for moment in one.moments]
    return study(rulebook, teacher, moments, passes)


def correct(rulebook: Rulebook, teacher: Teacher, moment: DecisionPoint) -> Studied:
    """The rulebook after the teacher looked at one moment: confirmed, or corrected once."""
    step, shown = step_of(rulebook, moment), teacher.ideal(moment.raw)
    correction = teacher.judge(step.action, moment.raw)
    if correction is not None:
        return corrected(rulebook, moment, correction)
    if not shown.clear or step.action != shown.action or only_goes_on(step):
        return Studied(rulebook)
    studied = confirmed(rulebook, step)
    return studied.then(outranked(studied.rulebook, teacher, moment))


def attend(  # noqa: PLR0913 - a whole school; every setting has its default
    robot: Robot,
    teacher: Teacher | None = None,
    seed: int = 0,
    per_skill: int = 5,
    trips_watched: int = 40,
    progress: Callable[[str, int, int], None] | None = None,
    keep: Callable[[Studied], None] | None = None,
    start: Rulebook | None = None,
    reached: Reached | None = None,
) -> Schooled:
    """The whole school: demonstrations first, then trips that the rules decide and the teacher watches.

    She shows each skill at most `per_skill` times: some of these at first, the others where the rules go
    wrong. `progress` is told what is going on, how much of it is done, and how much there is; `keep` gets
    what was learned since it was last called, to put it away before anything else is learned; `start` has
    rules that are known already (none), and `reached` says how far an interrupted school came with them.
    """
    teacher = teacher or teacher_for(robot)
    tell = progress or (lambda what, done, of: None)
    shown = demonstrations(robot, teacher, seed, min(AT_FIRST, per_skill))
    tell("demonstrations", 0, len(shown))
    begun = up_to_date(start or Rulebook(FOREST))
    studied = demonstrate(begun, teacher, shown) if reached is None else Studied(begun)
    tell("demonstrations", len(shown), len(shown))
    keep = keep or (lambda _: None)
    keep(studied)
    times = Counter(one.rule for one in shown)
    reached = reached or Reached()
    times.update(reached.corrected)
    interventions = []
    for k in range(reached.trip, trips_watched):
        after = reached.moment if k == reached.trip else 0
        watched = watch(studied.rulebook, robot, teacher, first_trip(seed) + k, times, per_skill, after)
        interventions.append(watched.corrections)
        studied = studied.then(watched)
        keep(watched)
        tell("trips by rules", k + 1, trips_watched)
    report = SchoolReport(
        dict(times),
        sum(len(one.moments) for one in shown),
        trips_watched,
        tuple(interventions),
        studied.lessons,
        len(studied.open),
        firm_share(studied.rulebook),
    )
    return Schooled(studied.rulebook, report)


def keep(ledger: Ledger, studied: Studied) -> None:
    """Puts every step of what was studied away in a skillbook, each durable before the next."""
    for step in studied.steps:
        if step.how == "edited":
            ledger.edit(step.result.rulebook, "a new feature, named by the teacher")
        else:
            ledger.record(step.lesson, step.result, step.how)


def catch_up(ledger: Ledger) -> Rulebook:
    """The rulebook of a ledger, over today's trees: those that came after it was begun are put away first.
    Raises `WrongUse` for a book that is about something else."""
    old = ledger.book.rulebook
    new = up_to_date(old)
    if new is not old:
        later = ", ".join(new.forest.names[len(old.forest.names) :])
        ledger.edit(new, f"{later}: known since this book was made")
    return new


def first_trip(seed: int) -> int:
    """The number of the course of the first trip that the rules make."""
    return (SCHOOL * 1000 + seed) * 1_000_000 + 500_000


def reached_in(steps: Sequence[Step], seed: int) -> Reached | None:
    """How far a school of this seed came, by the lessons in a book; `None` before the rules made a trip.

    What a moment taught is in the book in whole, or it ends in a contradiction: then it is taught again.
    """
    corrected: dict[tuple[str, str], None] = {}
    last: tuple[int, int, bool] | None = None
    for step in steps:
        found = re.search(r"\(seed (\d+)\), moment (\d+)$", step.lesson.id) if step.lesson else None
        trip = int(found[1]) - first_trip(seed) if found else -1
        if found is None or step.lesson is None or not 0 <= trip < MOST_TRIPS:
            continue
        if step.how == "taught":
            corrected[step.lesson.id, step.lesson.rule] = None
        last = trip, int(found[2]), bool(step.note) and step.how != "mended"
    if last is None:
        return None
    trip, moment, is_open = last
    return Reached(trip, moment - is_open, Counter(rule for _, rule in corrected))


def watch(  # noqa: PLR0913 - a trip, and how far it was watched before
    rulebook: Rulebook,
    robot: Robot,
    teacher: Teacher,
    number: int,
    times: Counter[str],
    per_skill: int,
    after: int = 0,
) -> Studied:
    """One trip: at each moment the rules choose; what is right is confirmed, what is wrong corrected once.

    The teacher takes over at a wrong choice, so the trip goes on as she would have it. `times` counts how
    often she showed each skill; beyond `per_skill` she lets a mistake pass. The first `after` moments were
    watched before.
    """
    rng = np.random.default_rng([number, 7])
    studied = Studied(rulebook)
    for moment in moments_of(course(robot, number), teacher_drives(robot, teacher), rng)[after:]:
        rule = teacher.ideal(moment.raw).rule
        if times[rule] >= per_skill and not is_right(studied.rulebook, teacher, moment):
            continue
        taught = correct(studied.rulebook, teacher, moment)
        times[rule] += taught.corrections
        studied = studied.then(taught)
    return studied
