"""What a robot knows of the ground: `--sight`, and the settings of its camera."""

import argparse
import math
from argparse import Namespace
from dataclasses import replace
from typing import TYPE_CHECKING

from gaitwright.cli.arg_types import finite, one_of
from gaitwright.errors import WrongUse, unknown

if TYPE_CHECKING:
    from gaitwright.model.camera import Camera
    from gaitwright.model.robot import Robot

SIGHTS = {
    "known": "the whole scene, from the start",
    "camera": "what it sees and feels on the way",
    "blind": "what must be walked around, and what its feet feel",
}
SETTINGS = {
    "range": "m",
    "across": "degrees",
    "upright": "degrees",
    "height": "m over the base",
    "tilt": "degrees down",
    "rate": "Hz",
    "noise": "m",
    "dropouts": "share",
    "rows": "",
    "columns": "",
}
"""Settings of a camera that can be given, with their units."""
IN_DEGREES, WHOLE = ("across", "upright", "tilt"), ("rows", "columns")


def add_sight(parser: argparse.ArgumentParser) -> None:
    """The options of `mission` and `skill`."""
    ground = "what the robot knows of the ground: " + "; ".join(f"{a}, {b}" for a, b in SIGHTS.items())
    parser.add_argument(
        "--sight", type=one_of("sight", SIGHTS), default="known", metavar="NAME", help=f"{ground} (known)"
    )
    units = ", ".join(f"{name} [{unit}]" if unit else name for name, unit in SETTINGS.items())
    how = f"settings of its camera, e.g. range=2 noise=0.02 dropouts=0.3: {units} (one that fits the robot)"
    parser.add_argument("--camera", type=setting, nargs="+", metavar="KEY=NUMBER", help=how)


def setting(text: str) -> tuple[str, float]:
    """KEY=NUMBER."""
    name, equals, number = text.partition("=")
    if not equals:
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a setting; write KEY=NUMBER")
    if name not in SETTINGS:
        raise unknown("setting of a camera", name, SETTINGS)
    return name, finite(number)


def sight_of(args: Namespace, robot: "Robot") -> "Camera | str":
    """`known`, `blind`, or the camera that the robot carries. Raises `WrongUse` for settings without a
    camera, and for a camera that makes no sense."""
    if args.camera and args.sight != "camera":
        raise WrongUse(f"--camera goes with --sight camera, not with --sight {args.sight}")
    if args.sight != "camera":
        return args.sight
    from gaitwright.model.camera import Camera  # noqa: PLC0415 - the help needs no numbers

    camera = Camera.for_robot(robot)
    asked = dict(args.camera or ())
    changes = {
        name: math.radians(value) if name in IN_DEGREES else whole(name, value) if name in WHOLE else value
        for name, value in asked.items()
        if name != "height"
    }
    x, y, z = camera.mount
    return replace(camera, mount=(x, y, asked.get("height", z)), **changes)


def whole(name: str, value: float) -> int:
    """A number of pixels."""
    if value != round(value):
        raise WrongUse(f"a camera has a whole number of {name}, not {value:g}")
    return round(value)
