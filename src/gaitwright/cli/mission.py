"""`gaitwright mission`: take a robot to a goal."""

from argparse import Namespace

from gaitwright.cli import trips
from gaitwright.cli.book_files import rulebook_of
from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.signals import Mission
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.stages import Chooser


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    if (args.driver == "hybrid") != (args.skillbook is not None):
        raise WrongUse("driver hybrid and --skillbook FILE go together: the rules choose the skills")
    robot = trips.find_robot(args.robot, args.package)
    scene = trips.find_scene(args.scene, args.seed, robot, args.start)
    points = tuple(args.waypoints or [tuple(args.goal)])
    for point in points[:-1]:
        trips.check_inside("way-point", point, scene)
    trips.check_inside("goal", points[-1], scene)
    if args.speed is not None:
        DefaultChooser(robot).gait_for(args.speed)  # refuses a speed beyond the robot's reach
    chooser = chooser_of(robot, args)
    setting = trips.set_up(robot, scene, chooser, args.distribution)
    return trips.run(setting, Mission(points, args.speed, args.driver), args)


def chooser_of(robot: Robot, args: Namespace) -> Chooser:
    """Who chooses the skills: the rules of a skillbook where the driver is hybrid, else the plain ones."""
    return RuleChooser(robot, rulebook_of(args.skillbook)) if args.skillbook else DefaultChooser(robot)
