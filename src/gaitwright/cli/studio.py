"""`gaitwright studio`: the page in a browser from which a person watches, drives and teaches."""

import importlib.util
import json
import webbrowser
from argparse import Namespace
from pathlib import Path

from gaitwright.cli.output import check_json, settled, write_json
from gaitwright.errors import WrongUse
from gaitwright.studio.page_build import ready_page
from gaitwright.studio.robot_process import RobotProcess
from gaitwright.studio.setup import Setup

NEEDED = ("starlette", "uvicorn", "websockets")
BOOK = "studio.skills"


def run(args: Namespace) -> int:
    lacking = [name for name in NEEDED if not importlib.util.find_spec(name)]
    if lacking:
        raise WrongUse(f"the studio needs {', '.join(lacking)}: `pip install 'gaitwright[studio]'`")
    check_json(args.json)
    folder = settled(args.out, "--out")
    book = Path(args.skillbook) if args.skillbook else folder / BOOK
    setup = Setup(args.robot, args.scene, args.seed, args.sight, args.driver)
    with RobotProcess(setup, book, folder, begins=args.skillbook is None) as robot:
        # While it begins: these take a second to import.
        from gaitwright.cli.console import remark, working  # noqa: PLC0415
        from gaitwright.studio.serving import Serving, serve  # noqa: PLC0415 - an extra

        with working("looking for the page", worth_a_line=None):
            page = ready_page(remark)
        what = Serving(folder, page, args.host, args.port)
        serve(robot, what, lambda address, once: tell(address, once, args))
    return 0


def tell(address: str, once: str, args: Namespace) -> None:
    """Says where the studio is, and opens it where that was not forbidden, by an address good `once`."""
    if args.json != "-":
        print(f"The studio is open at {address}\nCtrl-C closes it.", flush=True)
    write_json(args.json, json.dumps({"address": address}))
    if not args.no_browser:
        webbrowser.open(once)
