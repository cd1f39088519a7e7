"""`gaitwright mission`: take a robot to a goal."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import replace

from gaitwright.cli import trips
from gaitwright.cli.book_files import rulebook_of
from gaitwright.cli.console import remark
from gaitwright.cli.driving import BY_BOOK, balance_for, by_book, profiles_for, profiles_to_play
from gaitwright.cli.guidance_arguments import SECONDS, check_strategy, guidance_of
from gaitwright.cli.mission_book import book_of, keep_map, with_map
from gaitwright.cli.sight_arguments import sight_of
from gaitwright.control.balance_rules import BalanceRules
from gaitwright.control.takeover import LEARNED
from gaitwright.driving import Memories
from gaitwright.errors import WrongUse, short
from gaitwright.ground.scene import Scene
from gaitwright.learning.growth import Returns
from gaitwright.learning.practice import after_trip
from gaitwright.missions import Programme, Steering
from gaitwright.model.robot import Robot
from gaitwright.record.recording import Recording
from gaitwright.signals import Mission
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.commanded import check_velocity
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.stages import Chooser

NOTHING = "nothing went wrong that the robot noticed: nothing was learned, and trust has no other grade"


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    check_book(args)
    check_strategy(args)
    balance, guidance = balance_for(args), guidance_of(args)  # a file that cannot be read is told at once
    robot = trips.find_robot(args.robot, args.package)
    sight = sight_of(args, robot)
    scene = trips.find_scene(args.scene, args.seed, robot, args.start)
    mission, name = mission_of(args, robot, scene, guidance), f"{scene.name} (seed {args.seed})"
    args.seconds = args.seconds or (guidance.ends if isinstance(guidance, Steering) else None) or SECONDS
    with book_of(args, robot) as ledger:  # from the beginning: nobody else teaches it meanwhile
        chooser = chooser_of(robot, args, ledger)
        plain = trips.set_up(robot, scene, chooser, args.distribution, args.sensing, sight)
        setting = with_profiles(plain, args, balance)
        if args.strategy:
            setting = replace(setting, brain=setting.brain.with_strategy(args.strategy))
        if ledger is not None and args.sight == "camera":
            setting = with_map(setting, ledger, name)

        def after(recording: Recording, memories: Memories) -> None:
            if ledger is not None and args.sight == "camera":
                keep_map(ledger, recording, memories, name)
            if ledger is not None and args.learn:
                learn(ledger, recording, memories.drive.handed_back, name)

        return trips.run(setting, mission, args, after=after)


def mission_of(args: Namespace, robot: Robot, scene: Scene, guidance: Programme | Steering | None) -> Mission:
    """What is asked for. Raises `WrongUse` for what lies outside the scene, or beyond the robot's reach."""
    if isinstance(guidance, Steering):
        for row, velocity in enumerate(guidance.velocities, start=1):
            in_row(args.velocity, row, lambda v=velocity: check_velocity(robot, v))
        return Mission((), driver=args.driver, guidance=guidance)
    chooser = DefaultChooser(robot)
    if args.speed is not None:
        chooser.gait_for(args.speed)  # refuses a speed beyond the robot's reach
    if isinstance(guidance, Programme):
        for row, stop in enumerate(guidance.stops, start=1):
            in_row(args.route, row, lambda s=stop: trips.check_inside("stop", (s.x, s.y), scene))
            in_row(args.route, row, lambda s=stop: chooser.gait_for(s.speed or 0.0))
        return Mission((), args.speed, args.driver, guidance)
    points = tuple(args.waypoints or [tuple(args.goal)])
    for point in points[:-1]:
        trips.check_inside("way-point", point, scene)
    trips.check_inside("goal", points[-1], scene)
    return Mission(points, args.speed, args.driver)


def in_row(path: str, row: int, check: Callable[[], object]) -> None:
    """Raises what a check raises, with the row of the file in front."""
    try:
        check()
    except WrongUse as error:
        raise WrongUse(f"{short(path)}, row {row}: {error}") from None


def check_book(args: Namespace) -> None:
    """`WrongUse` for a book that nobody needs, or that is needed and not there."""
    needed, named = args.driver in BY_BOOK, args.skillbook is not None
    if args.learn and not (needed and named):
        raise WrongUse(
            "--learn: a robot learns into a book, so driver hybrid and --skillbook FILE go with it"
        )
    if args.learn and args.velocity:
        raise WrongUse(
            "--learn: a robot learns from what it does of itself, not from what --velocity told it"
        )
    if needed != named and (needed or args.sight != "camera"):
        raise WrongUse(
            f"drivers {' and '.join(BY_BOOK)} and --skillbook FILE go together: its rules choose the skills; "
            "with --sight camera any driver may have one, for the map"
        )


def with_profiles(setting: trips.Setting, args: Namespace, rules: BalanceRules | None) -> trips.Setting:
    """The same with the terrain operators of a book, and a learned controller that plays its profiles, its
    balance by `rules`, where it is driven by the book. Raises `WrongUse` for driver learned where it has
    none."""
    if args.driver not in BY_BOOK:
        return setting
    find = profiles_to_play if args.driver == LEARNED else profiles_for
    profiles = find(setting.robot, args.skillbook)
    brain = by_book(setting.brain, args.skillbook, profiles)
    return replace(setting, brain=brain.with_balance(rules))


def learn(ledger: Ledger, recording: Recording, handed_back: Returns, name: str) -> None:
    """What the robot's own mistakes teach it, and what the trip does to the trust in it: into the book."""
    for sentence in after_trip(ledger, recording, handed_back, name) or [NOTHING]:
        remark(sentence)


def chooser_of(robot: Robot, args: Namespace, ledger: Ledger | None) -> Chooser:
    """Who chooses the skills: the rules of a skillbook where it is driven by one, else the plain ones."""
    if args.driver not in BY_BOOK:
        return DefaultChooser(robot)
    return RuleChooser(robot, ledger.book.rulebook if ledger else rulebook_of(args.skillbook))
