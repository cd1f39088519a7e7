"""The options of `gaitwright operators`."""

import argparse

from gaitwright.cli.arg_types import finite, positive, seed
from gaitwright.gait.kinds import KINDS


def add_operators(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("book", metavar="BOOK", help="the skillbook")
    parser.add_argument(
        "--size",
        type=positive,
        metavar="M",
        help="teach one: how large the obstacle is [m]; the rest says how",
    )
    kind = f"obstacle that it is for, one or more: {', '.join(KINDS)} (block, step up, step down)"
    parser.add_argument("--kind", action="append", metavar="NAME", help=kind)
    shown = "where it is shown (trot, the first leg)"
    parser.add_argument("--skill", metavar="NAME", help=shown)
    parser.add_argument("--leg", metavar="NAME", help="see --skill")
    path = (
        "path of the foot over it: a leg cycle as `gaitwright skills` has them (as the controller raises it)"
    )
    parser.add_argument("--cycle", metavar="NAME|FILE.json", help=path)
    parser.add_argument(
        "--landing", type=finite, metavar="M", help="how much farther along its way the foot lands [m] (0)"
    )
    parser.add_argument("--name", metavar="NAME", help="what to call it (over a KIND)")
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="draws the starts (0)")
    taken = "take it in, after it was shown in physics (only show it)"
    parser.add_argument("--accept", action="store_true", help=taken)
    parser.add_argument("--first", metavar="NAME", help="try this operator before all others")
    parser.add_argument("--forget", metavar="NAME", help="take an operator out of the book again")
    played = "say which legs were under which operator in this recording"
    parser.add_argument("--recording", metavar="FILE.npz", help=played)
    parser.add_argument(
        "--at", type=finite, metavar="T", help="--recording: at this time [s] (the whole trip)"
    )
    parser.add_argument("--out", metavar="FILE.png", help="draw them")
