"""`gaitwright teach --live`: a person teaches in a terminal, on a mission that runs or that was recorded."""

import sys
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from gaitwright.cli import trips
from gaitwright.cli.live_room import Room
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.live import LiveLessons
from gaitwright.learning.live_sources import Played, Running
from gaitwright.learning.notes import pupil_of
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.record.recording import load
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.rule_chooser import RuleChooser


def run(robot: Robot, ledger: Ledger, args: Namespace) -> None:
    """The lesson, until the person has had enough."""
    source = played(args) if args.recording else running(robot, ledger.book.rulebook, args)
    room = Room(robot, source, LiveLessons(ledger, pupil_of(ledger.book)))
    try:
        room.welcome()
        for line in lines():
            if not room.hears(line):
                break
    finally:
        room.leave()


def running(robot: Robot, rulebook: Rulebook, args: Namespace) -> Running:
    """A mission that begins now."""
    scene = trips.find_scene(args.scene, args.seed, robot, args.place)
    goal = (float(args.goal[0]), float(args.goal[1]))
    trips.check_inside("goal", goal, scene)
    setting = trips.set_up(robot, scene, RuleChooser(robot, rulebook), "qp")
    plant, mission = make_plant("mujoco", robot, scene, DT), Mission((goal,), args.speed, "hybrid")
    trips.warm_up(setting, plant, mission)
    session = Session(setting.brain, plant, mission, args.seconds, args.seed)
    return Running(session, f"{scene.name} (seed {args.seed})")


def played(args: Namespace) -> Played:
    """A mission that was recorded."""
    return Played(load(args.recording), Path(args.recording).name)


def lines() -> Iterator[str]:
    """What the person types, until the end of the file."""
    shows = sys.stdin.isatty()
    while True:
        if shows:
            print("> ", end="", file=sys.stderr, flush=True)
        line = sys.stdin.readline()
        if not line:
            return
        yield line
