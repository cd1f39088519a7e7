"""The options of `gaitwright scanner`."""

import argparse

from gaitwright.cli.arg_types import finite


def add_scanner(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("recording", metavar="RECORDING", help="recording.npz of a run with --out")
    parser.add_argument("--at", type=finite, metavar="T", help="at this moment, in seconds (its end)")
    parser.add_argument("--plot", action="store_true", help="draw it, see --out")
    parser.add_argument("--out", metavar="FILE.png", help="where to draw (runs/scanner.png)")
