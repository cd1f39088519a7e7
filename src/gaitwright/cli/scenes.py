"""`gaitwright scenes`: the scenes that come along; pictures of them and of others are in `scene_pictures`."""

import json
from argparse import Namespace

from gaitwright.cli.console import show_table
from gaitwright.cli.output import check_json, check_picture, write_json
from gaitwright.ground.scenes_list import OFFERS

HEAD = ("name", "about", "number after a colon")


def run(args: Namespace) -> int:
    check_json(args.json)
    args.out = check_picture(args.out)
    if args.plot is not None or args.out is not None:
        from gaitwright.cli.scene_pictures import draw  # noqa: PLC0415 - slow to import

        draw(args.plot or list(OFFERS), args)
    elif args.json != "-":
        rows = ((name, offer.line, takes(offer)) for name, offer in OFFERS.items())
        show_table(HEAD, rows, prose=HEAD[1:])
    facts = [{"name": name, **offer._asdict()} for name, offer in OFFERS.items()]
    write_json(args.json, json.dumps(facts, indent=2, ensure_ascii=False))
    return 0


def takes(offer) -> str:
    return (
        f"{offer.takes}, {offer.low:g} to {offer.high:g}; {offer.default:g} if left out"
        if offer.takes
        else ""
    )
