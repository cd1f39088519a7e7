"""`gaitwright demo`: the whole story without arguments. The numerical controller crosses a field, rules and
torque profiles are learned, and then the learned controller crosses another field by them."""

from argparse import Namespace
from dataclasses import replace
from pathlib import Path

from gaitwright.cli import driving, trips
from gaitwright.cli.console import remark
from gaitwright.cli.driving import profiles_for
from gaitwright.cli.output import numbered_folder
from gaitwright.cli.teach import taught
from gaitwright.cli.teach_operators import run as over_obstacles
from gaitwright.cli.teach_profiles import learned
from gaitwright.cli.trip_rows import show_trips
from gaitwright.control.takeover import HYBRID, NUMERICAL
from gaitwright.driving import Memories
from gaitwright.learning.practice import after_trip
from gaitwright.learning.teacher import teacher_for
from gaitwright.model.robot import Robot
from gaitwright.record.metrics import Report
from gaitwright.record.recording import Recording
from gaitwright.signals import Mission
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import FOREST

GOAL = (6.0, 0.0)
SECONDS = 60.0
SCHOOL = 20
"""Trips of the school between the two crossings."""
SKILLS = ("stand", "stop", "walk", "trot", "turn-in-place", "turn-left", "turn-right")
"""Skills that a field of blocks asks for: their profiles are taken."""
FIRST = "1. The numerical controller crosses a field of blocks: it solves dynamics 500 times a second."
SCHOOLING = (
    "2. The learning controller goes to school: rules which skill to use where, and the torques of each."
)
SECOND = "3. The learned controller crosses another field, by its rules and profiles where it knows the case."


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    robot = trips.find_robot("go2")
    folder = None if args.out else numbered_folder("runs/demo")
    args.seconds, args.out = SECONDS, args.out or str(folder)
    try:
        remark(FIRST)
        before = Namespace(
            **vars(args) | {"out": str(Path(args.out) / "first"), "json": None, "aside": args.json == "-"}
        )
        setting, driven = trips.set_up(robot, field(robot, args.seed), DefaultChooser(robot), "qp"), []

        def keep(recording: Recording, _: Memories) -> None:
            driven.append(("first", recording.report()))

        code = trips.run(setting, Mission((GOAL,), driver=NUMERICAL), before, after=keep)
        if code == 130:
            return code
        remark(SCHOOLING)
        book = learn(robot, Path(args.out) / "go2.skills", args)
        remark(SECOND)
        return second(robot, book, args, driven)
    finally:
        if folder and not any(folder.iterdir()):
            folder.rmdir()


def second(robot: Robot, book: Path, args: Namespace, driven: list[tuple[str, Report]]) -> int:
    """The crossing by what was learned, what it does to the book, and both crossings side by side."""

    def after(recording: Recording, memories: Memories) -> None:
        driven.append(("second", recording.report()))
        with open_for_learning(book) as ledger:
            for sentence in after_trip(ledger, recording, memories.drive.handed_back, "the second crossing"):
                remark(sentence)
        show_trips(driven, to_stderr=args.json == "-")

    return trips.run(by_book(robot, book, args), Mission((GOAL,), driver=HYBRID), args, after=after)


def field(robot: Robot, seed: int) -> trips.Scene:
    """A field of blocks."""
    return trips.find_scene("blocks", seed, robot)


def learn(robot: Robot, path: Path, args: Namespace) -> Path:
    """A skillbook with rules from a school, how a leg gets over obstacles, and the profiles of the skills
    that the field asks for."""
    Skillbook.new(FOREST, robot.name, "demo", args.seed).save(path)
    with open_for_learning(path) as ledger:
        taught(robot, teacher_for(robot), ledger, Namespace(trips=SCHOOL, seed=args.seed))
        over_obstacles(robot, ledger, args)
        learned(robot, ledger, SKILLS, args.seed)
    return path


def by_book(robot: Robot, path: Path, args: Namespace) -> trips.Setting:
    """The robot in another field, with what it has learned."""
    chooser = RuleChooser(robot, Skillbook.load(path).rulebook)
    setting = trips.set_up(robot, field(robot, args.seed + 1), chooser, "qp")
    profiles = profiles_for(robot, str(path))
    return replace(setting, brain=driving.by_book(setting.brain, str(path), profiles))
