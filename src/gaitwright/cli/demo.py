"""`gaitwright demo`: the main job from end to end, without arguments."""

from argparse import Namespace

from gaitwright.cli import trips
from gaitwright.cli.output import numbered_folder
from gaitwright.signals import Mission
from gaitwright.skills.chooser import DefaultChooser

GOAL = (6.0, 0.0)
SECONDS = 60.0


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    robot = trips.find_robot("go2")
    setting = trips.set_up(robot, trips.find_scene("blocks", args.seed, robot), DefaultChooser(robot), "qp")
    args.seconds = SECONDS
    folder = None if args.out else numbered_folder("runs/demo")
    args.out = args.out or str(folder)
    try:
        return trips.run(setting, Mission((GOAL,)), args)
    finally:
        if folder and not any(folder.iterdir()):
            folder.rmdir()
