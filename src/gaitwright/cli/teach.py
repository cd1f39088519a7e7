"""`gaitwright teach`: a scripted teacher makes a skillbook for a robot."""

import json
from argparse import Namespace
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, replace
from pathlib import Path
from time import perf_counter

from gaitwright.cli.book_files import is_skillbook, new_file, skillbook_of
from gaitwright.cli.console import remark, show_pairs, working
from gaitwright.cli.output import check_json, settled, write_json
from gaitwright.cli.trips import find_robot
from gaitwright.errors import GaitwrightError, WrongUse
from gaitwright.knowledge.modifier import Learned
from gaitwright.knowledge.rules import Rulebook, status
from gaitwright.learning.analogies import proposals
from gaitwright.learning.apprentice import Studied
from gaitwright.learning.exam import held_out, right_share
from gaitwright.learning.school import Schooled, attend, catch_up, keep, reached_in
from gaitwright.learning.teacher import teacher_for
from gaitwright.model.robot import Robot
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import Ledger, open_for_learning
from gaitwright.skills.book_trees import up_to_date
from gaitwright.skills.situation import FOREST

EXAM = 200
"""Situations that the rules are asked about at the end."""
EVERY = 10.0
"""Progress is told this often [s]."""


def run(args: Namespace) -> int:
    check_json(args.json)
    robot, path = find_robot(args.robot, args.package), settled(args.out, "--out")
    is_new = not is_book_of(robot, path, args)
    if is_new:
        begun(robot, new_file(args.out, "skillbook").stem, args).save(path)
    began = perf_counter()
    try:
        with open_for_learning(path) as ledger:
            schooled = taught(robot, ledger, args)
            offered = [offer.events[0].why for offer in offer_analogies(ledger)]
    except KeyboardInterrupt:
        remark(f"gaitwright: interrupted; what was learned so far is in {path}: the same command goes on")
        return 130
    except GaitwrightError:
        if is_new and len(Skillbook.load(path).steps) == 1:  # nothing was learned
            path.unlink()
        raise
    teacher = teacher_for(robot)
    with working("the exam", worth_a_line=False):
        right = right_share(schooled.rulebook, teacher, held_out(robot, teacher, args.seed, EXAM))
    tell(schooled, offered, right, perf_counter() - began, args)
    return 0


def is_book_of(robot: Robot, path: Path, args: Namespace) -> bool:
    """Whether a file is a skillbook of this robot, to go on with. Raises `WrongUse` for another robot's, or
    where another book is named to begin with."""
    if not path.is_file() or not is_skillbook(str(path)):
        return False
    if args.start is not None:
        raise WrongUse(f"{path} exists, and goes on from itself: leave --from out, or name a new skillbook")
    book = Skillbook.load(path)
    if book.robot != robot.name:
        taught_on = f"the robot {book.robot}" if book.robot else "no robot"
        raise WrongUse(f"{path} exists and was taught on {taught_on}, not {robot.name}: name a new skillbook")
    up_to_date(book.rulebook)
    return True


def begun(robot: Robot, name: str, args: Namespace) -> Skillbook:
    """The book that the school begins with: an empty one, or what an earlier school left."""
    if args.start is None:
        return Skillbook.new(FOREST, robot.name, name, args.seed)
    old = skillbook_of(args.start)
    up_to_date(old.rulebook)  # refuses a book that is about something else before there is a new one
    return replace(old.forked(name), robot=robot.name, seed=args.seed)


def taught(robot: Robot, ledger: Ledger, args: Namespace) -> Schooled:
    """The school, with progress, every step in the ledger."""
    spoke = -EVERY
    began = perf_counter()

    def progress(what: str, done: int, of: int) -> None:
        nonlocal spoke
        now = perf_counter() - began
        if now - spoke >= EVERY or done == of:
            spoke = now
            remark(f"{what}: {done} of {of} ({now:.0f} s)")

    def school(start: Rulebook, put_away: Callable[[Studied], None]) -> Schooled:
        reached = reached_in(ledger.book.steps, args.seed)
        return attend(
            robot,
            seed=args.seed,
            trips_watched=args.trips,
            progress=progress,
            keep=put_away,
            start=start,
            reached=reached,
        )

    known, book = catch_up(ledger), ledger.book
    first = book.steps[0].rulebook
    if first and not book.ancestors and book.seed == args.seed and not reached_in(book.steps, args.seed):
        with suppress(Otherwise):  # cut off among the demonstrations: the same again, and on from there
            return school(first, Onwards(ledger))
    return school(known, lambda studied: keep(ledger, studied))


class Otherwise(Exception):
    """What a book holds is not what this school begins with."""


class Onwards:
    """Puts away what is learned, but for the steps that a book has already. Raises `Otherwise`, before it
    adds anything, where these are others."""

    def __init__(self, ledger: Ledger) -> None:
        self.ledger, self.done = ledger, ledger.book.steps[1:]

    def __call__(self, studied: Studied) -> None:
        held, self.done = self.done[: len(studied.steps)], self.done[len(studied.steps) :]
        for step, learned in zip(held, studied.steps, strict=False):
            lesson = step.lesson or learned.lesson
            if step.how != learned.how or (lesson.id, lesson.rule) != (
                learned.lesson.id,
                learned.lesson.rule,
            ):
                raise Otherwise
        keep(self.ledger, replace(studied, steps=studied.steps[len(held) :]))


def offer_analogies(ledger: Ledger) -> tuple[Learned, ...]:
    """Rules by analogy, put away as proposals: they fire once they are confirmed or seen right."""
    made = proposals(ledger.book.rulebook)
    for learned in made:
        ledger.edit(learned.rulebook, learned.events[0].why)
    return made


def tell(schooled: Schooled, offered: list[str], right: float, seconds: float, args: Namespace) -> None:
    """What came of it; `offered`: the rules proposed by analogy, in sentences."""
    report, rules = schooled.report, schooled.rulebook.rules
    states = ", ".join(f"{rule.name} ({status(rule)})" for rule in rules)
    numbers = {
        "book": args.out,
        "proposed": offered,
        "rules": [rule.name for rule in rules],
        "right_on_held_out": right,
        "seconds": seconds,
        **asdict(report),
    }
    write_json(args.json, json.dumps(numbers, indent=2, ensure_ascii=False))
    rows = [
        ("rules", states),
        ("demonstrations", ", ".join(f"{name} {n}" for name, n in report.demonstrations.items())),
        ("trips watched", f"{report.trips}, interventions {sum(report.interventions)}"),
        ("lessons", str(report.lessons)),
        ("firm trees", f"{report.firm:.0%}"),
        ("right on new situations", f"{right:.1%} of {EXAM}"),
        *(("proposed", sentence) for sentence in offered),
        ("took", f"{seconds:.0f} s"),
        ("next", f"gaitwright explain {args.out}"),
    ]
    show_pairs(f"{args.out} holds what was learned", rows, to_stderr=args.json == "-")
