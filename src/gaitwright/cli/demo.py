"""`gaitwright demo`: the whole story without arguments. The numerical controller crosses a field that it has
never seen, by its camera; rules and torque profiles are learned; the learned controller crosses another field
by them, and then finds its way round a bay: once with nothing known, and once more by the map it has made."""

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from gaitwright.cli import driving, maps, trips
from gaitwright.cli.console import remark, working
from gaitwright.cli.driving import profiles_for
from gaitwright.cli.mission_book import keep_map, with_map
from gaitwright.cli.output import numbered_folder
from gaitwright.cli.teach import taught
from gaitwright.cli.teach_operators import run as over_obstacles
from gaitwright.cli.teach_profiles import learned
from gaitwright.cli.trip_rows import show_trips
from gaitwright.control.takeover import HYBRID, LEARNED, NUMERICAL
from gaitwright.driving import Memories
from gaitwright.errors import WrongUse
from gaitwright.learning.map_books import learned_map_of
from gaitwright.learning.practice import after_trip
from gaitwright.learning.teacher import teacher_for
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.record.metrics import Report
from gaitwright.record.recording import Recording
from gaitwright.signals import Mission
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.map_notes import place_of
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import FOREST
from gaitwright.stages import Chooser
from gaitwright.studio.page_build import ready_page

SECONDS = 90.0
SCHOOL = 20
"""Trips of the school after the first crossing."""
SKILLS = ("stand", "stop", "walk", "trot", "turn-in-place", "turn-left", "turn-right")
"""Skills that the fields ask for: their profiles are taken."""
FIRST = (
    "1. The numerical controller crosses a field of blocks where it has never been: a camera sees what is "
    "near, and it solves dynamics 500 times a second."
)
SCHOOLING = (
    "2. The learning controller goes to school: rules which skill to use where, and the torques of each."
)
INTERRUPTED = 130
"""Exit code of a trip that the user broke off."""
UNSURE = 0.05
"""Who drives less of a crossing than this was not trusted with it."""


class Act(NamedTuple):
    """A trip by what was learned."""

    name: str
    said: str
    scene: str
    later: int
    """What is added to the seed."""

    def place(self, seed: int) -> str:
        """What its map is called in the book."""
        return f"{self.scene} (seed {seed + self.later})"


SECOND = Act(
    "second",
    "3. The learned controller crosses another field where it has never been, by its rules and profiles "
    "where it knows the case.",
    "blocks",
    1,
)
THIRD = Act(
    "third", "4. A bay lies in its way. Nothing is known of it: it goes in, and out again.", "bugtrap", 0
)
FOURTH = Act("fourth", "5. The same way again, by the map of it that is in its skillbook now.", "bugtrap", 0)
Driven = dict[str, Report]
"""The figures of the trips, in their order."""


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    robot = trips.find_robot("go2")
    folder = None if args.out else numbered_folder("runs/demo")
    args.seconds, args.out = SECONDS, args.out or str(folder)
    try:
        return story(robot, args)
    finally:
        if folder and not any(folder.iterdir()):
            folder.rmdir()


def story(robot: Robot, args: Namespace) -> int:
    """All trips and the school; returns 0 where every trip arrives."""
    out, driven = Path(args.out), Driven()
    remark(FIRST)
    build_page()
    codes = [first(robot, args, driven)]
    if codes[0] == INTERRUPTED:
        return INTERRUPTED
    remark(SCHOOLING)
    book = learn(robot, out / "go2.skills", args)
    for act in (SECOND, THIRD, FOURTH):
        remark(act.said)
        codes.append(by_book(robot, book, act, args, driven))
        if codes[-1] == INTERRUPTED:
            return INTERRUPTED
    conclude(driven, args)
    draw_map(out, FOURTH.place(args.seed))
    return max(codes)


def build_page() -> None:
    """What replays are made of, where it can be had: in a clone it is built once, in seconds."""
    try:
        with working("building the page of replays (first run only)", worth_a_line=None):
            ready_page(lambda told: None)
    except WrongUse as error:
        remark(f"replays are left out: {str(error).splitlines()[0]}")


# --- trips -----------------------------------------------------------------------------------------
def first(robot: Robot, args: Namespace, driven: Driven) -> int:
    """The crossing by the numerical controller."""
    setting = seeing(robot, trips.find_scene("blocks", args.seed, robot), DefaultChooser(robot))

    def after(recording: Recording, _: Memories) -> None:
        driven["first"] = recording.report()

    return trips.run(setting, to_goal(setting, NUMERICAL), beside(args, "first"), after=after)


def by_book(robot: Robot, path: Path, act: Act, args: Namespace, driven: Driven) -> int:
    """A trip by what was learned, and what it does to the book: trust, and the map of the place."""
    scene, place = trips.find_scene(act.scene, args.seed + act.later, robot), act.place(args.seed)
    with open_for_learning(path) as ledger:
        setting = seeing(robot, scene, RuleChooser(robot, ledger.book.rulebook))
        brain = driving.by_book(setting.brain, str(path), profiles_for(robot, str(path)))
        setting = with_map(replace(setting, brain=brain), ledger, place)

        def after(recording: Recording, memories: Memories) -> None:
            driven[act.name] = recording.report()
            keep_map(ledger, recording, memories, place)
            for sentence in after_trip(ledger, recording, memories.drive.handed_back, f"the {act.name} trip"):
                remark(sentence)

        files = args if act is SECOND else beside(args, act.name)
        return trips.run(setting, to_goal(setting, HYBRID), files, after=after)


def seeing(robot: Robot, scene: trips.Scene, chooser: Chooser) -> trips.Setting:
    """The robot in a scene of which it knows what its camera shows."""
    return trips.set_up(robot, scene, chooser, "qp", sight=Camera.for_robot(robot))


def to_goal(setting: trips.Setting, driver: str) -> Mission:
    """To where the scene leads."""
    assert setting.scene.goal is not None, "the demo's fields lead somewhere"
    return Mission((setting.scene.goal,), driver=driver)


def beside(args: Namespace, name: str) -> Namespace:
    """The same for a trip whose files go into a folder of their own, and whose figures are no result."""
    own = {"out": str(Path(args.out) / name), "json": None, "aside": args.json == "-"}
    return Namespace(**vars(args) | own)


# --- what is learned ---------------------------------------------------------------------------------
def learn(robot: Robot, path: Path, args: Namespace) -> Path:
    """A skillbook with rules from a school, how a leg gets over obstacles, and the profiles of the skills
    that the fields ask for."""
    Skillbook.new(FOREST, robot.name, "demo", args.seed).save(path)
    with open_for_learning(path) as ledger:
        taught(robot, teacher_for(robot), ledger, Namespace(trips=SCHOOL, seed=args.seed))
        over_obstacles(robot, ledger, args)
        learned(robot, ledger, SKILLS, args.seed)
    return path


# --- the end ---------------------------------------------------------------------------------------
def conclude(driven: Driven, args: Namespace) -> None:
    """The trips side by side, and what came of the story."""
    show_trips(driven.items(), to_stderr=args.json == "-")
    for sentence in lessons_of(driven):
        remark(sentence)


def lessons_of(driven: Driven) -> list[str]:
    """What the figures of the trips say of the story, in sentences."""
    said = []
    share = driven["second"].driver_share.get(LEARNED, 0.0)
    if share < UNSURE:
        said.append("The numerical controller drove in the second field: no rule stands firm enough yet.")
    else:
        said.append(f"The learned controller drove {share:.0%} of the way through the second field.")
    once, again = driven["third"], driven["fourth"]
    if once.arrived and again.arrived:
        said.append(
            f"Past the bay it went {once.distance_m:.1f} m in {once.duration_s:.0f} s with nothing known, "
            f"and {again.distance_m:.1f} m in {again.duration_s:.0f} s by its map."
        )
    return said


def draw_map(out: Path, place: str) -> None:
    """What the book knows of a place, as a picture."""
    notes = next(notes for notes in Skillbook.load(out / "go2.skills").maps if place_of(notes) == place)
    maps.draw(learned_map_of(notes), place, out / "map.png")
