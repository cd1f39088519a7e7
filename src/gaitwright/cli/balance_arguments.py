"""The options of `gaitwright balance`."""

import argparse

from gaitwright.cli.arg_types import count, seed


def add_balance(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE.json", help="the rules; --learn: a new file for them")
    book = "learn them from pushed runs with the torque profiles of this book"
    parser.add_argument("--learn", metavar="BOOK", help=book)
    runs = "--learn: so many pushed runs, each tried with every action (160)"
    parser.add_argument("--runs", type=count, metavar="N", help=runs)
    parser.add_argument("--seed", type=seed, default=0, metavar="N", help="--learn: draws the runs (0)")
    forget = "take this rule out; --out says into which new file the others go"
    parser.add_argument("--forget", metavar="NAME", help=forget)
    parser.add_argument("--out", metavar="FILE.json", help="--forget: the new file")
