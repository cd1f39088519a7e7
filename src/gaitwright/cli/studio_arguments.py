"""The options of `gaitwright studio` and `gaitwright replay`."""

import argparse

from gaitwright.cli.arg_types import driver, one_of, seed

sight = one_of("sight", ("known", "camera"))


def port(text: str) -> int:
    if not text.isdecimal() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a port, a whole number from 0 to 65535")
    return int(text)


def add_studio(parser: argparse.ArgumentParser) -> None:
    robot = "a name that `gaitwright robots` lists, or an MJCF or URDF file (go2)"
    parser.add_argument("--robot", default="go2", metavar="NAME|FILE", help=robot)
    where = "a name that `gaitwright scenes` lists, a JSON or a PNG file (blocks)"
    parser.add_argument("--scene", default="blocks", metavar="NAME|FILE", help=where)
    who = "who computes the torques at first (hybrid)"
    parser.add_argument("--driver", type=driver, default="hybrid", metavar="NAME", help=who)
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="draws the scene and the start (0)")
    ground = "what the robot knows of the ground: known, or what its camera shows (known)"
    parser.add_argument("--sight", type=sight, default="known", metavar="known|camera", help=ground)
    book = "the book that it goes by and learns into (studio.skills in --out, begun where it is not there)"
    parser.add_argument("--skillbook", metavar="FILE", help=book)
    where = "a folder for the book and for recordings (runs/studio)"
    parser.add_argument("--out", default="runs/studio", metavar="DIR", help=where)
    parser.add_argument("--port", type=port, default=8737, metavar="N", help="0: any that is free (8737)")
    name = "the address to serve on (127.0.0.1: this machine alone)"
    parser.add_argument("--host", default="127.0.0.1", metavar="ADDRESS", help=name)
    parser.add_argument("--no-browser", action="store_true", help="only say where it is")


def add_replay(parser: argparse.ArgumentParser) -> None:
    page = "the page, or, with .mcap at its end, what Foxglove and Rerun open (RECORDING.html, together.html)"
    several = "a recording (.npz) of a trip; several (20 at most) are shown on the ground of the first"
    parser.add_argument("recordings", metavar="RECORDING", nargs="+", help=several)
    parser.add_argument("--out", metavar="FILE", help=page)
    where = "the scene that it was recorded in (the one that it names)"
    parser.add_argument("--scene", metavar="NAME|FILE", help=where)
    parser.add_argument("--open", action="store_true", help="open it in the browser")
