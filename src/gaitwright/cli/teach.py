"""`gaitwright teach`: a scripted teacher makes a skillbook for a robot."""

import json
from argparse import Namespace
from collections import Counter
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from time import perf_counter
from typing import Any

from gaitwright.cli.book_files import is_skillbook, new_file, skillbook_of
from gaitwright.cli.console import remark, show_pairs, working
from gaitwright.cli.output import check_json, settled, write_json
from gaitwright.cli.trips import find_robot
from gaitwright.errors import WrongUse
from gaitwright.knowledge.rules import Rulebook, status
from gaitwright.knowledge.told import Told
from gaitwright.learning.analogies import proposals
from gaitwright.learning.exam import Result, examined, held_out
from gaitwright.learning.notes import pupil_as_noted, settle
from gaitwright.learning.older_books import told_by
from gaitwright.learning.policy_file import policy_in
from gaitwright.learning.school import SchoolReport, attend, trip_of
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher, teacher_for
from gaitwright.model.robot import Robot
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import all_told
from gaitwright.skillbook.writer import Ledger, open_for_learning
from gaitwright.skills.book_trees import up_to_date
from gaitwright.skills.situation import FOREST

EXAM = 1000
"""Situations that the pupil is asked about at the end."""
TRIPS = 40
"""Trips of a school, unless so many are named."""
EVERY = 10.0
"""Progress is told this often [s]."""


def run(args: Namespace) -> int:
    check_json(args.json)
    check_live(args)
    robot, path = find_robot(args.robot, args.package), settled(args.out, "--out")
    teacher = teacher_for(robot) if args.policy is None else ScriptedTeacher(policy_in(args.policy, robot))
    is_new = not is_book_of(robot, path, args)
    if args.lesson == "practice":
        import_module("gaitwright.cli.teach_practice").check(args.start if is_new else args.out, robot, args)
    if is_new:
        begun(robot, new_file(args.out, "skillbook").stem, args).save(path)
    ledger = None
    try:
        with open_for_learning(path) as ledger:
            told_again(ledger)
            if args.live:
                import_module("gaitwright.cli.teach_live").run(robot, ledger, args)
            else:
                teach(robot, teacher, ledger, args)
    except KeyboardInterrupt:
        remark(f"gaitwright: interrupted; what was learned so far is in {path}: the same command goes on")
        return 130
    finally:
        if is_new and (ledger is None or is_blank(ledger.book)):
            path.unlink()
    return 0


def is_blank(book: Skillbook) -> bool:
    """Whether nothing was learned."""
    return len(book.steps) == 1 and not book.profiles and not book.operators


def teach(robot: Robot, teacher: ScriptedTeacher, ledger: Ledger, args: Namespace) -> None:
    """The lessons that were asked for."""
    figures = {}
    if args.lesson in ("skills", "all"):
        figures |= go_to_school(robot, teacher, ledger, args)
    if args.lesson in ("operators", "all"):
        figures["operators"] = import_module("gaitwright.cli.teach_operators").run(robot, ledger, args)
    if args.lesson == "practice":
        figures["practice"] = import_module("gaitwright.cli.teach_practice").run(robot, ledger, args)
    if args.lesson in ("profiles", "all"):
        figures["torque_profiles"] = import_module("gaitwright.cli.teach_profiles").run(robot, ledger, args)
        suggest(ledger.book, args)
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))


def suggest(book: Skillbook, args: Namespace) -> None:
    """Says how profiles are played, where there are any."""
    skills = sorted({notes.skill for notes in book.profiles}, key=lambda skill: (skill != "trot", skill))
    if skills:
        driven = f"--robot {args.robot} --skillbook {args.out}"
        remark(f"next: gaitwright skill --driver learned {driven} --skill {skills[0]}")


def check_live(args: Namespace) -> None:
    """`WrongUse` for options that do not go together."""
    asked = {"scene": args.scene, "goal": args.goal, "start": args.place, "speed": args.speed}
    where = [name for name, value in {**asked, "recording": args.recording}.items() if value is not None]
    if args.lesson in ("profiles", "operators") and (args.trips is not None or args.policy is not None):
        raise WrongUse(
            f"{args.lesson} come from the numerical controller, without trips: leave --trips and --policy out"
        )
    if args.lesson == "practice" and args.policy is not None:
        raise WrongUse("practice goes by the rules that the book holds: leave --policy out")
    if args.live and args.lesson != "skills":
        raise WrongUse("with --live a person teaches skills: leave --lesson out")
    if not args.live and where:
        raise WrongUse(f"--{where[0]} is where a person teaches: add --live")
    if not args.live:
        return
    if args.policy is not None or args.trips is not None or args.json is not None:
        raise WrongUse("with --live a person teaches: leave --policy, --trips and --json out")
    if args.recording is not None and where != ["recording"]:
        raise WrongUse(
            "a recording has its own scene and goal: leave --scene, --goal, --start and --speed out"
        )
    if args.recording is None and args.goal is None:
        raise WrongUse(
            "teach where? name a mission by --scene NAME --goal X Y, or one that was by --recording"
        )
    args.scene = args.scene or "flat"


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
    check_teachable(book, path)
    return True


def begun(robot: Robot, name: str, args: Namespace) -> Skillbook:
    """The book that the school begins with: an empty one, or what an earlier school left."""
    if args.start is None:
        return Skillbook.new(FOREST, robot.name, name, args.seed)
    old = skillbook_of(args.start)
    check_teachable(old, args.start)  # before there is a new one
    book = replace(old.forked(name), robot=robot.name, seed=args.seed)
    if old.robot != robot.name:
        return replace(book, profiles=(), trust=(), operators=())
    return book if book.profiles else replace(book, trust=())


def check_teachable(book: Skillbook, path: Path | str) -> None:
    """`WrongUse` for a book about something else, or whose rules rest on no lessons with measurements."""
    up_to_date(book.rulebook)
    if book.rulebook.rules and not all_told(book.steps) and not told_by(book):
        raise WrongUse(
            f"the rules of {path} rest on no lessons with measurements: they can drive a robot, but nobody "
            "can go on learning from them; name a new skillbook"
        )


# --- the school ------------------------------------------------------------------------------------
def go_to_school(robot: Robot, teacher: ScriptedTeacher, ledger: Ledger, args: Namespace) -> dict[str, Any]:
    """The school and its exam, and what came of them, as figures."""
    began = perf_counter()
    pupil, report = taught(robot, teacher, ledger, args)
    with working("the exam", worth_a_line=False):
        result = examined(pupil, teacher, held_out(robot, teacher, args.seed, EXAM))
    return tell(pupil, ledger.book.rulebook, report, result, perf_counter() - began, args)


def taught(
    robot: Robot, teacher: ScriptedTeacher, ledger: Ledger, args: Namespace
) -> tuple[SkillPupil, SchoolReport]:
    """The school, with progress, every lesson in the ledger before the next."""
    spoke, began, trips = -EVERY, perf_counter(), args.trips or TRIPS

    def progress(report: SchoolReport) -> None:
        nonlocal spoke
        settle(ledger, pupil)
        now = perf_counter() - began
        if now - spoke >= EVERY or report.trips == trips:
            spoke = now
            remark(f"trips: {report.trips} of {trips}, {wrong_in(report)} ({now:.0f} s)")

    pupil, first, known = ready(ledger, args.seed)
    report = attend(pupil, robot, teacher, args.seed, trips, first, ledger.tell, progress, known=known)
    settle(ledger, pupil)
    return pupil, report


def ready(ledger: Ledger, seed: int) -> tuple[SkillPupil, int, dict[str, Told]]:
    """The pupil of a book, the school's trip that she goes on with, and what she was told on it already."""
    pupil, rest = pupil_as_noted(ledger.book)
    told = all_told(ledger.book.steps)
    first = after_last(told[: len(told) - len(rest)], seed)
    if any(trip_of(one, seed) != first for one in rest):  # told by somebody else
        for one in rest:
            pupil.hear(one)
        return pupil, after_last(told, seed), {}
    return pupil, first, {one.id: one for one in rest}


def after_last(told: list[Told], seed: int) -> int:
    """The first trip of a school of this seed after all those that taught something."""
    trips = [trip for one in told if (trip := trip_of(one, seed)) is not None]
    return max(trips, default=-1) + 1


def told_again(ledger: Ledger) -> None:
    """Tells a pupil what an older book taught, where nobody has yet."""
    book = ledger.book
    if book.pupil is None and not all_told(book.steps):
        for told in told_by(book):
            ledger.tell(told)


# --- what came of it -------------------------------------------------------------------------------
def wrong_in(report: SchoolReport) -> str:
    """How often the teacher stepped in on the last trips."""
    last = report.corrected[-10:]
    return f"{sum(last)} corrections in the last {len(last)}"


def tell(
    pupil: SkillPupil,
    rulebook: Rulebook,
    report: SchoolReport,
    result: Result,
    seconds: float,
    args: Namespace,
) -> dict[str, Any]:
    """What came of it, told, and as figures."""
    rules, given = rulebook.rules, report.given
    each = Counter(rule.action.skill for rule in rules)
    offered = [proposal.sentence for proposal in proposals(pupil)]
    aside = [told.id for told in pupil.aside()]
    numbers = {
        "book": args.out,
        "rules": [rule.name for rule in rules],
        "rules_of_skill": dict(each),
        "proposed": offered,
        "trips": report.trips,
        "moments": report.moments,
        "shown": given["shown"],
        "confirmed": given["confirmed"],
        "corrected": given["corrected"],
        "interventions": report.corrected,
        "lessons": rulebook.lessons,
        "set_aside": aside,
        "right_on_held_out": result.right,
        "sure_on_held_out": result.sure,
        "wrong_while_sure": result.wrong_while_sure,
        "seconds": seconds,
    }
    states = ", ".join(f"{rule.name} ({status(rule)})" for rule in rules)
    came = f"{given['shown']} shown, {given['confirmed']} confirmed, {given['corrected']} corrected"
    rows = [
        ("rules", states),
        ("rules of a skill", ", ".join(f"{skill} {n}" for skill, n in each.items())),
        ("trips", f"{report.trips}, with {report.moments} moments of decision"),
        ("lessons", f"{rulebook.lessons} ({came} now)"),
        *([("set aside", f"{len(aside)}: {', '.join(aside[:3])}")] if aside else []),
        ("right on new situations", f"{result.right:.1%} of {EXAM}"),
        ("sure there", f"{result.sure:.0%}, and wrong in {result.wrong_while_sure:.1%} of all"),
        *(("proposed", sentence) for sentence in offered),
        ("took", f"{seconds:.0f} s"),
        ("next", f"gaitwright explain {args.out}"),
    ]
    show_pairs(f"{args.out} holds what was learned", rows, to_stderr=args.json == "-")
    return numbers
