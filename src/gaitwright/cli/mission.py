"""`gaitwright mission`: take a robot to a goal."""

from argparse import Namespace

from gaitwright.cli import trips
from gaitwright.signals import Mission
from gaitwright.skills.chooser import PlainChooser


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    robot = trips.find_robot(args.robot)
    scene = trips.find_scene(args.scene, args.seed, robot, args.start)
    points = tuple(args.waypoints or [tuple(args.goal)])
    for point in points[:-1]:
        trips.check_inside("way-point", point, scene)
    trips.check_inside("goal", points[-1], scene)
    chooser = PlainChooser(robot)
    if args.speed is not None:
        chooser.gait_for(args.speed)  # refuses a speed beyond the robot's reach
    setting = trips.set_up(robot, scene, chooser, args.distribution)
    return trips.run(setting, Mission(points, args.speed, args.driver), args)
