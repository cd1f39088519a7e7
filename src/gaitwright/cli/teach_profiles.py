"""`gaitwright teach --lesson profiles`: the numerical controller drives every skill, and that is noted."""

from argparse import Namespace
from collections.abc import Iterator, Sequence
from time import perf_counter
from typing import Any

from gaitwright.cli.console import remark, show_table, working
from gaitwright.errors import BadFile
from gaitwright.learning.profile_books import Playable, playable
from gaitwright.learning.profile_school import STARTS, Learned, Task, learn, lived
from gaitwright.model.robot import Robot
from gaitwright.skillbook.profile_notes import ProfileNotes
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.library import skill_names
from gaitwright.workers import Workers

HEAD = ("skill", "profiles", "speeds [m/s]", "turns [rad/s]", "repeats", "played", "held", "stayed up")


def run(robot: Robot, ledger: Ledger, args: Namespace) -> dict[str, Any]:
    """Teaches what the book does not hold yet or is out of date; the figures of what was learned."""
    began, source = perf_counter(), ledger.path.name
    known = known_in(ledger, robot)
    for sentence in known.outdated.values():
        remark(f"{sentence}: they are taught again")
    wanted = [name for name in skill_names(robot.n) if name not in known.profiles]
    if known.profiles:
        remark(f"{len(known.profiles)} skills are in {source} already: {', '.join(known.profiles)}")
    found = learned(robot, ledger, wanted, args.seed)
    found.sort(key=lambda learned: wanted.index(learned.skill))
    if args.json != "-" and found:
        show_table(HEAD, [row_of(learned) for learned in found if learned.found], right=HEAD[1:])
    return {
        "skills": {learned.skill: figures_of(learned) for learned in found},
        "profiles": len(ledger.book.profiles),
        "seconds": perf_counter() - began,
    }


def known_in(ledger: Ledger, robot: Robot) -> Playable:
    """The profiles that the book holds already; none where another version wrote them."""
    try:
        return playable(ledger.book, robot, ledger.path.name)
    except BadFile as error:
        remark(f"{error}: all are taught again")
        return Playable({}, {})


def learned(robot: Robot, ledger: Ledger, wanted: Sequence[str], seed: int) -> list[Learned]:
    """Skills learned side by side, each in the book as soon as it is."""
    began, found = perf_counter(), []
    with Workers() as workers:
        for one in each_learned(workers, [Task(robot, name, seed) for name in wanted]):
            keep(ledger, one)
            found.append(one)
            took = f"({perf_counter() - began:.0f} s)"
            remark(f"profiles: {len(found)} of {len(wanted)}, {said(one)} {took}")
    return found


def each_learned(workers: Workers, tasks: list[Task]) -> Iterator[Learned]:
    """What comes of each task, as soon as it is there; of the first one before several processes begin, for
    it compiles the kernels of all."""
    if tasks:
        with working("loading kernels, or compiling them", worth_a_line=None):
            first = learn(tasks[0])
        yield first
    yield from workers.as_done(learn, tasks[1:])


def keep(ledger: Ledger, learned: Learned) -> None:
    """Puts the profiles of a skill into the book, in place of those that were there."""
    others = [notes for notes in ledger.book.profiles if notes.skill != learned.skill]
    ledger.keep_profiles([*others, *learned.profiles], lived(learned))


def said(learned: Learned) -> str:
    """What came of a skill, in a few words."""
    if learned.found is None:
        return f"{learned.skill}: {learned.why}"
    good = learned.found.kept_up
    also = "" if good == STARTS else f", which fell in {STARTS - good} of {STARTS} tries"
    return f"{learned.skill}: {len(learned.profiles)}{also}"


def figures_of(learned: Learned) -> dict[str, Any]:
    """The same as plain values."""
    if learned.found is None:
        return {"profiles": 0, "why": learned.why}
    tried = learned.found._asdict()
    return {"profiles": len(learned.profiles), "starts": STARTS, **tried, "repeat": repeat(learned.profiles)}


def row_of(learned: Learned) -> tuple[str, ...]:
    """A line of the table."""
    assert learned.found is not None
    speeds = [max(profile.command[:2], key=abs) for profile in learned.profiles]
    turns = [profile.command[2] for profile in learned.profiles]
    tried = learned.found
    return (
        learned.skill,
        str(len(learned.profiles)),
        span(speeds),
        span(turns),
        f"{100.0 * repeat(learned.profiles):.1f} %",
        f"{100.0 * tried.played:.0f} %",
        f"{100.0 * tried.held:.1f} %",
        f"{tried.kept_up} of {STARTS}",
    )


def repeat(profiles: tuple[ProfileNotes, ...]) -> float:
    """How far the teacher is off from one start to another, in the middle of the profiles."""
    ordered = sorted(profile.repeat for profile in profiles)
    return ordered[len(ordered) // 2]


def span(values: list[float]) -> str:
    """From the least to the greatest."""
    low, high = min(values), max(values)
    return f"{low + 0.0:.2f}" if high - low < 1e-6 else f"{low + 0.0:.2f} … {high + 0.0:.2f}"
