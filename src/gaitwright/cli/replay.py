"""`gaitwright replay`: a recording as one HTML page that opens by a double click, or as MCAP."""

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


def run(args: Namespace) -> int:
    check_json(args.json)
    out = settled(args.out or str(Path(args.recording).with_suffix(".html")), "--out")
    if out.is_dir() or not out.parent.is_dir():
        raise WrongUse(f"--out {out}: name a file in a folder that is there")
    with working("reading the recording", worth_a_line=None):
        recording = load(args.recording)
    scene = find_scene(args.scene, recording.seed, recording.robot) if args.scene else None
    with working(f"writing {out.name}", worth_a_line=None):
        if out.suffix == MCAP:
            write_mcap(recording, out, scene)
        else:
            write_replay(recording, out, ready_page(remark), scene)
    size = out.stat().st_size
    seconds = len(recording) * recording.dt
    write_json(args.json, json.dumps({"page": str(out), "bytes": size, "seconds": seconds}))
    rows = [
        ("for Foxglove, Rerun" if out.suffix == MCAP else "page", str(out)),
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
