"""Where a mission leads, or who says so: `--goal`, `--waypoints`, `--route`, `--velocity`, `--strategy`."""

import argparse
from argparse import Namespace
from typing import TYPE_CHECKING

from gaitwright.cli.arg_types import finite, one_of, point
from gaitwright.errors import WrongUse

if TYPE_CHECKING:
    from gaitwright.missions import Programme, Steering

STRATEGIES = {
    "optimistic": "what was not seen is taken for free",
    "thesis": "along the edges of what is in the way, from corner to corner",
}
"""How a way is chosen where the map is blank."""
SECONDS = 120.0
"""Longest time of a mission, where its commands do not say [s]."""


def add_guidance(parser: argparse.ArgumentParser) -> None:
    """The options of `mission`."""
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--goal", type=finite, nargs=2, metavar=("X", "Y"), help="where to go [m]")
    through = "points to pass in this order; the last one is the goal"
    where.add_argument("--waypoints", type=point, nargs="+", metavar="X,Y", help=through)
    written = (
        "a way that is walked as it is written, with no planning around: CSV of x,y,speed,wait (m, m, m/s, "
        "s; speed and wait may be left out), or JSON"
    )
    where.add_argument("--route", metavar="FILE", help=written)
    steered = (
        "a person's commands: CSV of time,forward,left,turn (s, m/s, m/s, rad/s), each until the next one, "
        "the last one all 0, or JSON"
    )
    where.add_argument("--velocity", metavar="FILE", help=steered)
    how = "; ".join(f"{name}, {what}" for name, what in STRATEGIES.items())
    parser.add_argument(
        "--strategy",
        type=one_of("strategy", STRATEGIES),
        metavar="NAME",
        help=f"--sight camera: how a way is chosen through ground that was not seen: {how} (optimistic)",
    )


def check_strategy(args: Namespace) -> None:
    """`WrongUse` for a strategy where there is nothing to choose."""
    if args.strategy is None:
        return
    written = "--route" if args.route else "--velocity" if args.velocity else None
    if written:
        raise WrongUse(f"--strategy chooses a way, and with {written} the way is not the robot's to choose")
    if args.sight != "camera":
        raise WrongUse(
            "--strategy is for ground that is seen on the way: it goes with --sight camera, not with --sight "
            f"{args.sight}"
        )


def guidance_of(args: Namespace) -> "Programme | Steering | None":
    """What the files of `--route` and `--velocity` say. Raises `BadFile`, and `WrongUse` for a speed beside
    velocities."""
    from gaitwright.navigation.guidance_files import (  # noqa: PLC0415 - the help reads no files
        load_programme,
        load_steering,
    )

    if args.route:
        return load_programme(args.route)
    if not args.velocity:
        return None
    if args.speed is not None:
        raise WrongUse("--speed is a wish for a way; with --velocity the file says how fast")
    return load_steering(args.velocity)
