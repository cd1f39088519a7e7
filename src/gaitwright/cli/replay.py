"""`gaitwright replay`: recordings as one HTML page that opens by a double click, or one as MCAP."""

import json
import webbrowser
from argparse import Namespace
from importlib.util import find_spec
from pathlib import Path

from gaitwright.cli.console import remark, show_pairs, working
from gaitwright.cli.output import check_json, settled, write_json
from gaitwright.cli.trips import find_scene
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.record.recording import Recording, load
from gaitwright.studio.page_build import ready_page
from gaitwright.studio.replay import write_replay

MCAP = ".mcap"
TOGETHER = "together.html"


def run(args: Namespace) -> int:
    check_json(args.json)
    first = Path(args.recordings[0])
    usual = first.with_suffix(".html") if len(args.recordings) == 1 else first.with_name(TOGETHER)
    out = settled(args.out or str(usual), "--out")
    if out.is_dir() or not out.parent.is_dir():
        raise WrongUse(f"--out {out}: name a file in a folder that is there")
    if out.suffix == MCAP and len(args.recordings) > 1:
        raise WrongUse(f"{MCAP} holds one recording: name one, or a page for all of them")
    with working("reading what was recorded", worth_a_line=None):
        recording, *others = map(load, args.recordings)
    if any((one.scene, one.seed) != (recording.scene, recording.seed) for one in others):
        remark(f"all are shown on the ground of the first: {recording.scene}, seed {recording.seed}")
    scene = find_scene(args.scene, recording.seed, recording.robot) if args.scene else None
    with working(f"writing {out.name}", worth_a_line=None):
        if out.suffix == MCAP:
            write_mcap(recording, out, scene)
        else:
            write_replay(recording, out, ready_page(remark), scene, others)
    size = out.stat().st_size
    seconds = max(len(one) * one.dt for one in (recording, *others))
    write_json(args.json, json.dumps({"page": str(out), "bytes": size, "seconds": seconds}))
    rows = [
        ("for Foxglove, Rerun" if out.suffix == MCAP else "page", str(out)),
        *([("recordings", str(1 + len(others)))] if others else []),
        ("length", f"{seconds:.1f} s"),
        ("size", f"{size / 1e6:.1f} MB"),
    ]
    show_pairs("", rows, to_stderr=args.json == "-")
    if args.open:
        webbrowser.open(out.absolute().as_uri())
    return 0


def write_mcap(recording: Recording, out: Path, scene: Scene | None) -> None:
    """Writes it for Foxglove and Rerun. Raises `WrongUse` where the extra is lacking."""
    if not find_spec("mcap_ros2"):
        raise WrongUse("a recording for Foxglove and Rerun needs `pip install 'gaitwright[record]'`")
    from gaitwright.record.mcap_export import export_mcap  # noqa: PLC0415 - an extra

    export_mcap(recording, out, scene)
