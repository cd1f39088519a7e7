"""The commands, their options and their help. Imports neither numpy nor MuJoCo.

Plain argparse, by measurement: it is there in 0.03 s where `import tyro` alone takes 0.2 to 0.3 s, and
every `--help` has 0.3 s.
"""

import argparse
import difflib
import re
from typing import NamedTuple, NoReturn

from gaitwright.cli.arg_types import (
    BOOK_TASKS,
    DRIVERS,
    book_task,
    count,
    distribution,
    driver,
    duration,
    finite,
    integrator,
    plant,
    point,
    positive,
    seed,
)
from gaitwright.errors import WrongUse, unknown
from gaitwright.plant.names import INTEGRATORS, PLANTS


class Command(NamedTuple):
    """A command as `gaitwright --help` shows it."""

    line: str
    more: str
    examples: tuple[str, ...]


COMMANDS = {
    "demo": Command(
        "a robot crosses a field of blocks; leaves a picture and a recording in runs/",
        "Without arguments and without network: go2 walks from (0, 0) to (6, 0) among blocks, over the low "
        "ones and around the high ones. Prints the figures of the trip and leaves a picture, the recording "
        "and the report in a new folder runs/demo-NNN.",
        ("gaitwright demo", "gaitwright demo --seed 3 --out runs/three", "gaitwright demo --json -"),
    ),
    "mission": Command(
        "take a robot to a goal",
        "Takes a robot through a scene to a goal and reports how it went. Exit code 0: it stands at the "
        "goal; 1: it does not, and `stopped_because` says why. The scenes that come along are made for "
        "robots up to 0.6 m tall; for a taller one every length of the scene is multiplied by its height / "
        "0.29 m, rounded (9 for `thesis`).",
        (
            "gaitwright mission --goal 6 0",
            "gaitwright mission --scene rough:0.03 --waypoints 2,1 4,-1 6,0 --speed 0.5 --out runs/rough",
            "gaitwright mission --robot thesis --goal 54 0 --seed 1 --json -",
        ),
    ),
    "skill": Command(
        "one skill for a time",
        "Holds one skill at one velocity for a time and reports how well. Exit code 0: it walked for that "
        "time; 1: it fell or stopped, and `stopped_because` says why. `gaitwright skills` lists the skills.",
        (
            "gaitwright skill --skill walk --lateral 0.1 --turn 0.3 --seconds 20 --json walk.json",
            "gaitwright skill --skill trot --speed 0.5 --push 0.5 90     # pushed to the left after 5 s",
            "gaitwright skill --robot thesis --skill walk --plant armstrong --check     # the thesis's plant",
        ),
    ),
    "robots": Command(
        "the robots that come along; --check: does it run mine?",
        "The built-in robots with their sizes. Other robots come from MJCF or URDF files: --robot FILE. With "
        "--check: what a robot's file leaves open, what its motors can do, and how it stands, walks, trots, "
        "turns and goes sideways in simulation; takes about a minute. Exit code 0: it stands, walks and "
        "trots; 1: it does not.",
        ("gaitwright robots", "gaitwright robots --check my_robot.urdf", "gaitwright robots --json -"),
    ),
    "scenes": Command(
        "the scenes that come along",
        "The built-in scenes. Some take a number after a colon. Other scenes come from JSON files: "
        "--scene FILE.json.",
        ("gaitwright scenes", "gaitwright mission --scene stairs:0.08 --goal 6 0"),
    ),
    "skills": Command(
        "the skills, with their speeds for a robot",
        "The skills with their gaits. Periods and speeds grow with the square root of a robot's height. "
        "--plot draws their leg cycles: the path of a foot as points, and when which foot is down. --cycle "
        "checks a leg cycle in each skill, or in the one it is named after, and names the point and the leg "
        "that are wrong. Exit code 1: the robot can walk it in none of them.",
        (
            "gaitwright skills",
            "gaitwright skills --robot hexapod --plot",
            "gaitwright skills --cycle mine.json --out mine.png",
        ),
    ),
    "teach": Command(
        "the school: a scripted teacher makes a skillbook for a robot",
        "A scripted teacher shows which skill she uses where, then lets the rules choose, trip after trip, "
        "and steps in where they are wrong. Trips are situations along a way, without physics; what was "
        "learned drives real ones. Every lesson is in the file before the next trip begins, and an interrupt "
        "keeps it.",
        (
            "gaitwright teach --lesson skills --robot go2 --out go2.skills",
            "gaitwright explain go2.skills",
            "gaitwright mission --driver hybrid --skillbook go2.skills --scene stairs --goal 6.5 0",
        ),
    ),
    "explain": Command(
        "why a rule fires or not, and what moved its marks",
        "Tells what a rulebook knows: its rules in order, each in a sentence. With a situation: which rule "
        "fires, why, why not another, what would have to be different, and which lessons moved its marks. "
        "A tree that is left out of the situation is taken as the last lesson had it, and that is said; a "
        "value may be a number where the tree has intervals. --recording takes what it can from a recorded "
        "moment.",
        (
            "gaitwright explain garden.json",
            "gaitwright explain garden.json --situation ground=gravel speed=0.8 --not trot",
            "gaitwright explain garden.json --rule trot --plot     # its trees as a picture",
        ),
    ),
    "books": Command(
        "skillbooks: two joined to one; one as text, and back",
        "merge: teaches OURS what THEIRS was taught since they went apart, into a new book; what the two "
        "teach differently is told in a sentence each, and there ours stays. export: a skillbook as text, "
        "one thing a line, the same text for the same book, for reading, diff and version control. import: "
        "a skillbook from such a text, or one that begins with a rulebook as JSON. No file is ever written "
        "over.",
        (
            "gaitwright books merge mine.skills yours.skills --out both.skills",
            "gaitwright books export mine.skills --out mine.txt     # without --out: to the standard output",
            "gaitwright books import mine.txt --out again.skills",
        ),
    ),
    "bench": Command(
        "every claim, measured",
        "Measures what this project claims about itself, on this machine. Without names: everything.",
        ("gaitwright bench", "gaitwright bench --quick", "gaitwright bench tick --json bench.json"),
    ),
    "reproduce": Command(
        "tables and figures of the thesis",
        "Computes tables and figures of the thesis anew and holds them against what it says: what agrees, "
        "what does not, and what cannot. Prints them and leaves each as Markdown, the figures as PNG too, "
        "over those of an earlier run. Names: table-6.1, table-6.2, figure-6.5, figure-6.6; without names: "
        "all. Exit code 0: every claim agrees that can; 1: one does not.",
        (
            "gaitwright reproduce",
            "gaitwright reproduce table-6.1",
            "gaitwright reproduce figure-6.6 --out here",
        ),
    ),
    "doctor": Command(
        "what is installed, what is missing, how to mend it",
        "Looks at Python, the packages and the folder, and names the one command that mends what is missing. "
        "Exit code 0: everything needed is there; 1: something is not.",
        ("gaitwright doctor", "gaitwright doctor --json -"),
    ),
}

HIDDEN = ("--version",)
"""Options that no command's help shows."""

EPILOG = """\
exit codes: 0 done, 1 the robot failed, 2 wrong use, 3 a bad input file, 130 interrupted

examples:
  gaitwright demo
  gaitwright mission --robot go2 --scene blocks --goal 6 0
  gaitwright skill --skill trot --speed 0.5 --seconds 10

`gaitwright COMMAND --help` tells more about a command."""


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one sentence, without the usage."""

    def error(self, message: str) -> NoReturn:
        raise WrongUse(f"{message} (`{self.prog} --help` tells more)")


def read(argv: list[str]) -> argparse.Namespace:
    """The options in `argv`. Raises `WrongUse`; prints help and exits where that is asked for."""
    asked = next((word for word in argv if not word.startswith("-")), None)
    if asked is not None and asked not in COMMANDS:
        raise unknown("command", asked, COMMANDS)
    top, parsers = all_parsers()
    if not argv:
        top.print_help()
        top.exit()
    if asked is not None:
        check_options(argv, parsers[asked])
    # A space before it tells argparse that -1,2 and -1e-3 are values, not options.
    return top.parse_args([re.sub(r"^-(?=[\d.]|inf|nan)", " -", word) for word in argv])


def check_options(argv: list[str], parser: argparse.ArgumentParser) -> None:
    """`WrongUse` with a near miss for an option that a command does not have."""
    known = {*re.findall(r"--[a-z]+", parser.format_help()), *HIDDEN}
    for word in argv:
        option = word.partition("=")[0]
        if option.startswith("--") and option not in known:
            near = difflib.get_close_matches(option, known, n=1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise WrongUse(f"no option {option}{hint} (`{parser.prog} --help` tells more)")


def all_parsers() -> tuple[Parser, dict[str, argparse.ArgumentParser]]:
    """The parser of the whole command line, and that of each command."""
    top = Parser(
        "gaitwright",
        description="Teaches legged robots to move, by rules you can read.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    top.add_argument("--version", action=Version, nargs=0, help="show the version and exit")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", title="commands", required=True)
    parsers = {}
    for name, command in COMMANDS.items():
        examples = "\n".join(f"  {example}" for example in command.examples)
        parser = parsers[name] = commands.add_parser(
            name,
            help=command.line,
            description=command.more,
            epilog=f"examples:\n{examples}",
            formatter_class=Wrapped,
            allow_abbrev=False,
        )
        ADD[name](parser)
        parser.add_argument(
            "--json", metavar="FILE|-", help="write the figures as JSON; - is the standard output"
        )
    return top, parsers


class Wrapped(argparse.RawDescriptionHelpFormatter):
    """Wraps the description, leaves the examples alone."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if text.startswith("examples:"):
            return super()._fill_text(text, width, indent)
        return argparse.HelpFormatter._fill_text(self, text, width, indent)


class Version(argparse.Action):
    """Looks up the version only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from importlib import metadata  # noqa: PLC0415 - costs more than all the rest of a --help

        try:
            parser.exit(message=f"gaitwright {metadata.version('gaitwright')}\n")
        except metadata.PackageNotFoundError:
            parser.exit(message="gaitwright, run from its sources\n")


# --- options by command ----------------------------------------------------------------------------
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
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--goal", type=finite, nargs=2, metavar=("X", "Y"), help="where to go [m]")
    through = "points to pass in this order; the last one is the goal"
    where.add_argument("--waypoints", type=point, nargs="+", metavar="X,Y", help=through)
    fitting = "wished speed in m/s (what the robot trots at)"
    parser.add_argument("--speed", type=positive, metavar="V", help=fitting)
    rules = "driver hybrid: the rules that choose the skills, as a school left them"
    parser.add_argument("--skillbook", metavar="FILE", help=rules)
    add_run(parser, seconds=120.0)


def add_skill(parser: argparse.ArgumentParser) -> None:
    add_robot_and_scene(parser, scene="flat")
    parser.add_argument(
        "--skill", default="trot", metavar="NAME", help="a name that `gaitwright skills` lists (trot)"
    )
    parser.add_argument(
        "--speed", type=finite, metavar="V", help="along the skill's way, in m/s (what it is meant for)"
    )
    parser.add_argument("--lateral", type=finite, default=0.0, metavar="V", help="to the left, in m/s (0)")
    parser.add_argument(
        "--turn",
        type=finite,
        metavar="W",
        help="yaw rate to the left, in rad/s (what the skill is meant for)",
    )
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
    where = f"a name that `gaitwright scenes` lists, or a JSON file ({scene})"
    parser.add_argument("--scene", default=scene, metavar="NAME|FILE", help=where)


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
    random = "draws the random parts of the scene and small differences of the start (0)"
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help=random)
    parser.add_argument("--out", metavar="DIR", help="a new folder for picture, recording and report")
    add_plant(parser)


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


def add_skills(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--robot", default="go2", metavar="NAME|FILE", help="the robot whose speeds to show (go2)"
    )
    parser.add_argument("--plot", action="store_true", help="draw the leg cycles, see --out")
    cycle = "check and draw this leg cycle: climb, trot, walk, or a JSON file"
    parser.add_argument("--cycle", metavar="NAME|FILE", help=cycle)
    parser.add_argument("--out", metavar="FILE", help="where to draw (runs/skills-ROBOT.png)")


def add_teach(parser: argparse.ArgumentParser) -> None:
    lesson = "what is taught: skills, which to use where (skills)"
    parser.add_argument("--lesson", choices=["skills"], default="skills", metavar="NAME", help=lesson)
    robot = "a name that `gaitwright robots` lists, or an MJCF or URDF file (go2)"
    parser.add_argument("--robot", default="go2", metavar="NAME|FILE", help=robot)
    parser.add_argument("--out", required=True, metavar="BOOK", help="a new skillbook, e.g. go2.skills")
    start = "go on from this skillbook, also an older one; it stays as it is (begin with no rules)"
    parser.add_argument("--from", dest="start", metavar="BOOK", help=start)
    trips = "trips that the rules make with the teacher watching (60)"
    parser.add_argument("--trips", type=count, default=60, metavar="N", help=trips)
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="draws the trips (0)")


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
    parser.add_argument("files", nargs="+", metavar="FILE", help="the books, or the text to import")
    out = "the new book, or where the text goes (export: the standard output)"
    parser.add_argument("--out", metavar="FILE|-", help=out)
    base = "merge: the book that both come from (found without being named, checked where it is)"
    parser.add_argument("--base", metavar="BOOK", help=base)


def add_bench(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("names", nargs="*", metavar="NAME", help="what to measure (everything)")
    parser.add_argument("--quick", action="store_true", help="fewer repetitions: a look, not a result")


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
    "scenes": add_nothing,
    "skills": add_skills,
    "teach": add_teach,
    "explain": add_explain,
    "books": add_books,
    "bench": add_bench,
    "reproduce": add_reproduce,
    "doctor": add_nothing,
}
