"""`gaitwright skills`: the skills, with their periods and speeds on a robot."""

import json
from argparse import Namespace

from gaitwright.cli.console import remark, show_table
from gaitwright.cli.output import check_json, write_json
from gaitwright.cli.trips import find_robot
from gaitwright.model.robot import Robot
from gaitwright.skills.library import fastest, find_skill, gait_of, skill_names, speed_scale

HEAD = ("name", "period", "duty", "phases", "meant for", "at most", "about")


def run(args: Namespace) -> int:
    check_json(args.json)
    robot = find_robot(args.robot)
    facts = [facts_of(name, robot) for name in skill_names(robot.n)]
    if args.json != "-":
        remark(f"for {robot.name}, whose body is {robot.height:.2f} m above its feet:")
        show_table(HEAD, [row(fact) for fact in facts], right=HEAD[1:6])
    write_json(args.json, json.dumps({"robot": robot.name, "skills": facts}, indent=2, ensure_ascii=False))
    return 0


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
