"""`gaitwright skills`: the skills, with their periods, speeds and leg cycles on a robot."""

import json
import re
from argparse import Namespace
from pathlib import Path

from gaitwright.cli import profiles
from gaitwright.cli.console import remark, show_table, working
from gaitwright.cli.output import check_json, check_picture, write_json
from gaitwright.cli.trips import find_robot, has
from gaitwright.errors import WrongUse
from gaitwright.gait.leg_cycles.check import Fault, check_cycle
from gaitwright.gait.leg_cycles.files import cycle_of, load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.model.robot import Robot
from gaitwright.skills.library import fastest, find_skill, gait_of, skill_names, speed_scale

HEAD = ("name", "period", "duty", "phases", "meant for", "at most", "about")
FOUND = ("skill", "speed", "what was found")


def run(args: Namespace) -> int:
    check_json(args.json)
    if args.profile is not None:
        profiles.show(find_robot(args.robot, args.package), args)
        return 0
    if args.skillbook is not None or args.speed is not None or args.turn is not None:
        raise WrongUse("--skillbook, --speed and --turn say which profile to show: add --profile SKILL")
    args.out = check_picture(args.out)
    cycle = load_cycle(args.cycle) if args.cycle else None
    robot = find_robot(args.robot, args.package)
    figures: dict = {"robot": robot.name, "skills": [facts_of(name, robot) for name in skill_names(robot.n)]}
    aside, drawn = args.json == "-", args.plot or args.out is not None or cycle is not None
    if not aside and not cycle:
        remark(f"for {robot.name}, whose body is {robot.height:.2f} m above its feet:")
        show_table(HEAD, [row(fact) for fact in figures["skills"]], right=HEAD[1:6], prose=("about",))
    found = {name: faults_of(name, robot, cycle) for name in skills_with(cycle, robot)} if drawn else {}
    if cycle:
        figures["leg_cycle"] = {"name": cycle.name, "faults": as_figures(found)}
        if not aside:
            remark(f"leg cycle {cycle.name} on {robot.name}, {len(cycle.points)} points:")
            show_table(FOUND, rows(found, robot), prose=FOUND[2:])
    if drawn and has("matplotlib", "the picture", "plot"):
        figures["picture"] = picture(args.out, robot, cycle, found)
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    return 1 if cycle and all(found.values()) else 0


def facts_of(name: str, robot: Robot) -> dict:
    skill = find_skill(name, robot)
    gait = gait_of(skill, robot)
    return {
        "name": name,
        "period_s": gait.period,
        "duty": gait.duty,
        "phases": gait.offsets,
        "speed_mps": skill.speed * speed_scale(robot),
        "fastest_mps": fastest(skill, robot),
        "about": skill.about,
    }


def row(fact: dict) -> tuple[str, ...]:
    return (
        fact["name"],
        f"{fact['period_s']:.2f} s",
        f"{fact['duty']:.2f}",
        " ".join(f"{phase:.2f}" for phase in fact["phases"]),
        f"{fact['speed_mps']:.2f} m/s",
        f"{fact['fastest_mps']:.2f} m/s",
        fact["about"],
    )


# --- leg cycles ------------------------------------------------------------------------------------
def skills_with(cycle: LegCycle | None, robot: Robot) -> list[str]:
    """The skills that are checked and drawn: the one a cycle is named after, else all that lift a foot."""
    names = [name for name in skill_names(robot.n) if find_skill(name, robot).duty < 1.0]
    return [cycle.name] if cycle and cycle.name in names else names


def walking_speed(name: str, robot: Robot) -> float:
    """The speed a skill is meant for, or where that is none the fastest one [m/s]."""
    skill = find_skill(name, robot)
    return skill.speed * speed_scale(robot) or fastest(skill, robot)


def faults_of(name: str, robot: Robot, cycle: LegCycle | None) -> tuple[Fault, ...]:
    """What a robot cannot do of a cycle, or of a skill's own one, in that skill."""
    gait = gait_of(find_skill(name, robot), robot)
    return check_cycle(cycle or cycle_of(name), robot, gait, walking_speed(name, robot))


def as_figures(found: dict[str, tuple[Fault, ...]]) -> dict[str, list[dict]]:
    """The faults in each skill, for the JSON."""
    return {name: [fault._asdict() for fault in faults] for name, faults in found.items()}


def rows(found: dict[str, tuple[Fault, ...]], robot: Robot) -> list[tuple[str, str, str]]:
    """A line per fault, or the word that it fits."""
    return [
        (name, f"{walking_speed(name, robot):.2f} m/s", words)
        for name, faults in found.items()
        for words in [fault.sentence for fault in faults] or ["fits"]
    ]


def picture(
    out: str | None, robot: Robot, cycle: LegCycle | None, found: dict[str, tuple[Fault, ...]]
) -> str:
    """Draws the cycles of the skills in `found`, or that one cycle in each; says where."""
    path = Path(out or f"runs/skills-{re.sub(r'[^A-Za-z0-9_-]+', '-', robot.name)}.png")
    with working("drawing the leg cycles", worth_a_line=False):
        from gaitwright.pictures.cycles import Panel, cycles_picture  # noqa: PLC0415 - an extra

        panels = [
            Panel(
                gait_of(find_skill(name, robot), robot),
                cycle or cycle_of(name),
                walking_speed(name, robot),
                faults,
            )
            for name, faults in found.items()
        ]
        cycles_picture(robot, panels, path)
    remark(f"picture: {path}")
    return str(path)
