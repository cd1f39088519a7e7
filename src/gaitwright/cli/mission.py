"""`gaitwright mission`: take a robot to a goal."""

from argparse import Namespace
from dataclasses import replace

from gaitwright.cli import trips
from gaitwright.cli.book_files import rulebook_of
from gaitwright.cli.console import remark
from gaitwright.cli.driving import balance_for, by_book, profiles_for, profiles_to_play
from gaitwright.cli.sight_arguments import sight_of
from gaitwright.control.balance_rules import BalanceRules
from gaitwright.control.takeover import HYBRID, LEARNED
from gaitwright.errors import WrongUse
from gaitwright.learning.growth import Returns
from gaitwright.learning.practice import after_trip
from gaitwright.model.robot import Robot
from gaitwright.record.recording import Recording
from gaitwright.signals import Mission
from gaitwright.skillbook.writer import Ledger, open_for_learning
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.stages import Chooser

NOTHING = "nothing went wrong that the robot noticed: nothing was learned, and trust has no other grade"
BY_BOOK = (HYBRID, LEARNED)
"""Drivers that go by a skillbook."""


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    if (args.driver in BY_BOOK) != (args.skillbook is not None):
        raise WrongUse(
            f"drivers {' and '.join(BY_BOOK)} and --skillbook FILE go together: its rules choose the skills"
        )
    balance = balance_for(args)  # a file that cannot be read is told before anything is made
    robot = trips.find_robot(args.robot, args.package)
    sight = sight_of(args, robot)
    scene = trips.find_scene(args.scene, args.seed, robot, args.start)
    points = tuple(args.waypoints or [tuple(args.goal)])
    for point in points[:-1]:
        trips.check_inside("way-point", point, scene)
    trips.check_inside("goal", points[-1], scene)
    if args.speed is not None:
        DefaultChooser(robot).gait_for(args.speed)  # refuses a speed beyond the robot's reach
    mission = Mission(points, args.speed, args.driver)
    if not args.learn:
        plain = trips.set_up(robot, scene, chooser_of(robot, args), args.distribution, args.sensing, sight)
        setting = with_profiles(plain, args, balance)
        return trips.run(setting, mission, args)
    if args.skillbook is None:
        raise WrongUse(
            "--learn: a robot learns into a book, so driver hybrid and --skillbook FILE go with it"
        )
    with open_for_learning(args.skillbook) as ledger:  # from the beginning: nobody else teaches it meanwhile
        chooser = RuleChooser(robot, ledger.book.rulebook)
        plain = trips.set_up(robot, scene, chooser, args.distribution, args.sensing, sight)
        setting = with_profiles(plain, args, balance)
        name = f"{scene.name} (seed {args.seed})"
        return trips.run(setting, mission, args, after=lambda trip, back: learn(ledger, trip, back, name))


def with_profiles(setting: trips.Setting, args: Namespace, rules: BalanceRules | None) -> trips.Setting:
    """The same with the terrain operators of a book, and a learned controller that plays its profiles, its
    balance by `rules`. Raises `WrongUse` for driver learned where it has none."""
    if not args.skillbook:
        return setting
    find = profiles_to_play if args.driver == LEARNED else profiles_for
    profiles = find(setting.robot, args.skillbook)
    brain = by_book(setting.brain, args.skillbook, profiles)
    return replace(setting, brain=brain.with_balance(rules))


def learn(ledger: Ledger, recording: Recording, handed_back: Returns, name: str) -> None:
    """What the robot's own mistakes teach it, and what the trip does to the trust in it: into the book."""
    for sentence in after_trip(ledger, recording, handed_back, name) or [NOTHING]:
        remark(sentence)


def chooser_of(robot: Robot, args: Namespace) -> Chooser:
    """Who chooses the skills: the rules of a skillbook where the driver is hybrid, else the plain ones."""
    return RuleChooser(robot, rulebook_of(args.skillbook)) if args.skillbook else DefaultChooser(robot)
