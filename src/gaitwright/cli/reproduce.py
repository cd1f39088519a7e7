"""`gaitwright reproduce`: tables and figures of the thesis."""

from argparse import Namespace

from gaitwright import reproduce
from gaitwright.cli.output import check_json, settled


def run(args: Namespace) -> int:
    check_json(args.json)
    return reproduce.run(args.names, str(settled(args.out, "--out")), args.json)
