"""`gaitwright scanner`: what the terrain scanner held at a moment of a recording: told, drawn, as JSON."""

import json
import math
from argparse import Namespace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from gaitwright.cli.console import remark, show_pairs, show_table, working
from gaitwright.cli.output import check_json, check_picture, write_json
from gaitwright.cli.trips import has
from gaitwright.errors import WrongUse, short
from gaitwright.ground.scene import Scene
from gaitwright.perception.reach_outline import area_in
from gaitwright.perception.terrain_preview import TerrainPreview, corners_of
from gaitwright.record.preview_facts import facts_of, names_of
from gaitwright.record.previews import preview_at, times_of
from gaitwright.record.recording import Recording, load
from gaitwright.record.scene_of import scene_of

HEAD = ("foot", "at x, y [m]", "carries", "lands at [m]", "reaches", "slope ahead", "z ahead")
"""The last two: mean slope, uphill positive, and height of the ground ahead, along the heading."""


def run(args: Namespace) -> int:
    check_json(args.json)
    out = check_picture(args.out)
    recording = load(args.recording)
    held = held_at(recording, args.recording, args.at)
    if args.json != "-":
        tell(recording, held)
    facts = {"recording": args.recording, "robot": recording.robot.name, **facts_of(recording.robot, held)}
    if args.plot or out is not None:
        picture(recording, held, Path(out or "runs/scanner.png"))
    write_json(args.json, json.dumps(facts, indent=2, ensure_ascii=False))
    return 0


def held_at(recording: Recording, path: str, at: float | None) -> TerrainPreview:
    """The preview nearest to a moment [s], by default the last one. Raises `WrongUse` where there is none."""
    if recording.previews is None:
        raise WrongUse(
            f"{short(path)} has nothing of the terrain scanner: `mission` and `skill` record it with --out "
            "since they have this command beside them"
        )
    times = times_of(recording.previews)
    if at is not None and not times[0] <= at <= times[-1]:
        raise WrongUse(f"--at {at:g}: the terrain scanner was recorded from {times[0]:g} to {times[-1]:g} s")
    return preview_at(recording.previews, float(times[-1]) if at is None else at)


def tell(recording: Recording, held: TerrainPreview) -> None:
    """The seven outputs, and the ground ahead of each foot."""
    robot = recording.robot
    roll, pitch = math.degrees(held.roll), math.degrees(held.pitch)
    x, y = held.centre_w
    pairs = [
        ("supporting feet", ", ".join(names_of(robot, held.supporting)) or "none"),
        ("support polygon", points(corners_of(held.support_w))),
        ("all feet lowered", points(corners_of(held.lowered_w))),
        ("coming polygon", points(corners_of(held.coming_w))),
        ("centre of gravity", f"({x:.3f}, {y:.3f}), {where(held.margin)}"),
        ("critical feet", ", ".join(names_of(robot, held.critical)) or "none"),
        ("pitch, roll", f"{pitch:.2f}° (nose down is positive), {roll:.2f}° (right side down is positive)"),
    ]
    show_pairs(f"{robot.name} in {recording.scene} at {held.time:.2f} s", pairs, to_stderr=False)
    show_table(HEAD, [row_of(recording, held, leg) for leg in range(robot.n)], right=HEAD[4:])


def where(margin: float) -> str:
    """How far inside the support polygon a margin [m] is."""
    if math.isnan(margin):
        return "no foot is on the ground"
    return f"{abs(margin):.3f} m {'inside' if margin >= 0.0 else 'outside'} the support polygon"


def points(corners: Float[np.ndarray, "n 2"]) -> str:
    """The corners of a polygon."""
    return " ".join(f"({x:.3f}, {y:.3f})" for x, y in corners) or "none"


def row_of(recording: Recording, held: TerrainPreview, leg: int) -> tuple[str, ...]:
    """A line of the table."""
    (x, y, _), (hold_x, hold_y, _) = held.feet_w[leg], held.footholds_w[leg]
    slope, height = held.slope[leg], held.elevation[leg]
    area = area_in(held.reach_w[leg])
    carries = "yes, critical" if held.critical[leg] else "yes" if held.supporting[leg] else "–"
    return (
        recording.robot.legs[leg],
        f"{x:.2f}, {y:.2f}",
        carries,
        f"{hold_x:.2f}, {hold_y:.2f}" if math.isfinite(hold_x) else "–",
        f"{area:.3g} m²" if area else "–",
        f"{round(math.degrees(slope), 1) + 0.0:.1f}°" if math.isfinite(slope) else "not known",
        f"{round(height, 3) + 0.0:.3f} m" if math.isfinite(height) else "not known",
    )


def picture(recording: Recording, held: TerrainPreview, path: Path) -> None:
    """Draws it; says where, and why without the ground where that is not to be had."""
    if not has("matplotlib", "the picture", "plot"):
        return
    ground = scene_of(recording)
    scene = ground if isinstance(ground, Scene) else None
    if not isinstance(ground, Scene):
        remark(f"drawn without the ground: {ground}")
    with working("drawing the terrain scanner", worth_a_line=False):
        from gaitwright.pictures.scanner import scanner_picture  # noqa: PLC0415 - an extra

        scanner_picture(recording, held, scene, path)
    remark(f"picture: {path}")
