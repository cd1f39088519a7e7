"""`gaitwright robots`: the robots that come along; with `--check`, whether a robot is one that we run."""

import json
import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from time import perf_counter

import numpy as np
from rich.text import Text

from gaitwright import compiled_ahead
from gaitwright.assess.suitability import Finding, runs, suitability, summary
from gaitwright.cli.console import EVERY, remark, show_table, working
from gaitwright.cli.output import check_json, write_json
from gaitwright.description.load import load_robot, load_robot_and_notes
from gaitwright.errors import BadFile
from gaitwright.model.catalogue import ROBOTS
from gaitwright.model.robot import Robot
from gaitwright.screen import Cell, paragraph, screen, show, width_of

HEAD = ("name", "legs", "mass", "height", "leg", "torque limits", "about")
FOUND = ("what", "verdict", "found")
NEEDED = (
    "needed: an MJCF or URDF file with one floating body and 4, 6 or 8 legs, in pairs left and right, "
    "each of three hinges and links with masses"
)
TITLES = {
    "file": "the file",
    "body": "the body",
    "motors": "what skills need",
    "trial": "in simulation",
}


def run(args: Namespace) -> int:
    check_json(args.json)
    return list_all(args) if args.check is None else check(args)


def list_all(args: Namespace) -> int:
    """The table of all robots."""
    with working("loading the robots", worth_a_line=False):
        facts = [facts_of(name, about) for name, about in ROBOTS.items()]
    if args.json != "-":
        show_table(HEAD, [row(fact) for fact in facts], right=HEAD[1:6], prose=("about",))
    write_json(args.json, json.dumps(facts, indent=2, ensure_ascii=False))
    return 0


def facts_of(name: str, about: str) -> dict:
    robot = load_robot(name)
    torque = [float(limit) for limit in np.max(robot.tau_max, axis=0)]
    return {
        "name": name,
        "legs": robot.n,
        "mass_kg": round(robot.total_mass, 3),
        "height_m": round(robot.height, 3),
        "leg_length_m": round(robot.leg_length, 3),
        "torque_limits_nm": torque,
        "about": about,
    }


def row(fact: dict) -> tuple[str, ...]:
    return (
        fact["name"],
        str(fact["legs"]),
        f"{fact['mass_kg']:.1f} kg",
        f"{fact['height_m']:.2f} m",
        f"{fact['leg_length_m']:.2f} m",
        ", ".join(f"{limit:.4g}" for limit in fact["torque_limits_nm"]) + " N·m",
        fact["about"],
    )


# --- does it run my robot? -------------------------------------------------------------------------
def check(args: Namespace) -> int:
    """Examines one robot; 0: it stands, walks and trots, 1: it does not."""
    robot, notes = found(args.check, args.package)
    if compiled_ahead.begin():
        remark("compiling kernels (first run only, up to two minutes) …")
    with told_now_and_then() as tell:
        findings = suitability(robot, notes, tell)
    sentence, good = summary(robot, findings), runs(findings)
    if args.json != "-":
        show_table(FOUND, finding_rows(findings), prose=FOUND[2:])
        show(paragraph(sentence, width_of(sys.stdout)))
    report = {
        "robot": robot.name,
        "runs": good,
        "summary": sentence,
        "notes": list(notes),
        "findings": [asdict(finding) for finding in findings],
    }
    write_json(args.json, json.dumps(report, indent=2, ensure_ascii=False))
    return int(not good)


def found(asked: str, packages: list[tuple[str, str]]) -> tuple[Robot, tuple[str, ...]]:
    """The robot, and what its file left open; a file that is none is told with what would be one."""
    with working(f"loading {asked}", worth_a_line=False):
        try:
            return load_robot_and_notes(asked, dict(packages))
        except BadFile as error:
            raise BadFile(f"{error} ({NEEDED})") from error


def finding_rows(findings: list[Finding]) -> Iterator[tuple[Cell, ...]]:
    """A row for each finding, a line with its kind before the first one of it."""
    last = None
    for finding in findings:
        if finding.kind != last:
            yield (Text(TITLES[finding.kind], "bold"), "", "")
        yield (f"  {finding.what}", finding.verdict, finding.sentence)
        last = finding.kind


@contextmanager
def told_now_and_then():
    """Something to call with what is being done: a moving line on a terminal, else a line now and then."""
    if sys.stderr.isatty():
        with screen(sys.stderr).status("") as status:
            yield status.update
        return
    spoke = perf_counter()

    def tell(what: str) -> None:
        nonlocal spoke
        if perf_counter() - spoke >= EVERY:
            spoke = perf_counter()
            remark(f"{what} …")

    yield tell
