"""`gaitwright balance`: rules that answer what is off while profiles are played: shown, learned, dropped."""

import json
from argparse import Namespace
from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter

from gaitwright.cli.book_files import new_file, skillbook_of
from gaitwright.cli.console import remark, show_prose
from gaitwright.cli.driving import profiles_to_play
from gaitwright.cli.output import check_json, write_json
from gaitwright.cli.trips import find_robot
from gaitwright.control.balance_file import as_text, load_balance
from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.learned.profile import Profile
from gaitwright.errors import WrongUse, short
from gaitwright.files import fitting, whole
from gaitwright.learning.balance_lessons import ANYTHING, RUNS, Lesson, counted, learned
from gaitwright.learning.balance_trials import SKILLS, Run, Trial, pushed
from gaitwright.model.robot import Robot
from gaitwright.workers import Workers

EVERY = 15.0
"""Progress is told this often [s]."""
FIRST = 100_000
"""Runs of a seed are numbered from so many times it on."""


def run(args: Namespace) -> int:
    check_json(args.json)
    check(args)
    if args.learn is not None:
        rules = learn(args)
        written(args.file, rules)
    else:
        rules = load_balance(args.file)
    if args.forget is not None:
        rules = rules.without(args.forget)
        written(args.out, rules)
        remark(f"{args.forget} is not in {short(args.out)}")
    tell(rules, args)
    facts = [{"name": rule.name, "sentence": rule.sentence} for rule in rules.rules]
    figures = {"bands": dict(rules.bands), "rules": facts}
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    return 0


def check(args: Namespace) -> None:
    """`WrongUse` for options that do not go together."""
    if args.runs is not None and args.learn is None:
        raise WrongUse("--runs says how much is learned from: add --learn BOOK")
    if args.learn is not None and args.forget is not None:
        raise WrongUse("one thing at a time: --learn and --forget do not go together")
    if (args.forget is None) != (args.out is None):
        raise WrongUse("--forget NAME and --out FILE go together: no file is written over")
    for name in (args.file if args.learn is not None else None, args.out):
        if name is not None:
            new_file(name, "balance")


def tell(rules: BalanceRules, args: Namespace) -> None:
    """The rules, in the order in which they are asked."""
    if not rules.rules:
        remark("there are no rules: nothing that was tried is better than to go on")
    for number, rule in enumerate(rules.rules, start=1):
        show_prose(f"{number}. {rule.name}: {rule.sentence}.", 2, to_stderr=args.json == "-")


def written(path: str, rules: BalanceRules) -> None:
    """Writes rules into a new file."""
    with fitting(path), whole(Path(path)) as draft:
        draft.write_text(as_text(rules), encoding="utf-8")


# --- learning --------------------------------------------------------------------------------------
def learn(args: Namespace) -> BalanceRules:
    """Rules from pushed runs of the robot that a book was taught on."""
    robot = robot_of(args.learn)
    profiles = played_by(robot, args.learn)
    with Workers() as workers:
        rules, lessons = learned(robot, profiles, FIRST * args.seed, args.runs or RUNS, side_by_side(workers))
    tell_tried(lessons)
    return rules


def robot_of(path: str) -> Robot:
    """The robot that a book was taught on."""
    return find_robot(skillbook_of(path).robot or "go2")


def played_by(robot: Robot, path: str) -> dict[str, list[Profile]]:
    """The profiles of the skills that are pushed. Raises `WrongUse` where one is missing."""
    found = profiles_to_play(robot, path)
    missing = [skill for skill in SKILLS if skill not in found]
    if missing:
        raise WrongUse(f"{short(path)} has no profiles of {', '.join(missing)}, which are pushed to learn")
    return {skill: found[skill] for skill in SKILLS}


def side_by_side(workers: Workers) -> Callable[[Sequence[Trial]], list[Run]]:
    """Who makes runs, with progress."""
    began, spoke = perf_counter(), 0.0

    def make(trials: Sequence[Trial]) -> list[Run]:
        def tell(done: int) -> None:
            nonlocal spoke
            now = perf_counter() - began
            if done == len(trials) or now - spoke >= EVERY:
                spoke = now
                remark(f"runs: {done} of {len(trials)} ({now:.0f} s)")

        return workers.each(pushed, trials, tell)

    return make


def tell_tried(lessons: Sequence[Lesson]) -> None:
    """What each action did when it was always taken."""
    fell = sum(one.fell for one in lessons)
    remark(f"without an answer {fell} of {len(lessons)} fell; with always the same")
    for action in ACTIONS:
        always = counted(BalanceRule(ANYTHING, action), lessons)
        remark(f"  {action}: {always.saved} saved, {always.lost} lost")
