"""`gaitwright bench`: every claim, measured."""

from argparse import Namespace

from gaitwright import bench
from gaitwright.cli.output import check_json


def run(args: Namespace) -> int:
    check_json(args.json)
    return bench.run(args.names, args.quick, args.json, robots=args.robots)
