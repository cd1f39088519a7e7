"""`gaitwright robots`: the robots that come along."""

import json
from argparse import Namespace

import numpy as np

from gaitwright.cli.console import show_table, working
from gaitwright.cli.output import check_json, write_json
from gaitwright.model.catalogue import ROBOTS
from gaitwright.plant.models import load_robot

HEAD = ("name", "legs", "mass", "height", "leg", "torque limits", "about")


def run(args: Namespace) -> int:
    check_json(args.json)
    with working("loading the robots", worth_a_line=False):
        facts = [facts_of(name, about) for name, about in ROBOTS.items()]
    if args.json != "-":
        show_table(HEAD, [row(fact) for fact in facts], right=HEAD[1:6])
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
