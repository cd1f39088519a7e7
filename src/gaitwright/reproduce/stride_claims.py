"""What the thesis says of feet among small obstacles (5.4.1, 6.5), held against strides of ours."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from jaxtyping import Float

from gaitwright.ground.elevation import SPACING
from gaitwright.model.robot import Robot
from gaitwright.record.metrics import attitude, heading_over_time
from gaitwright.reproduce.claim import Claim, Grid
from gaitwright.reproduce.seen_walk import SeenWalk
from gaitwright.reproduce.strides import ALONG, OFF, ONTO, OVER, Stride
from gaitwright.reproduce.terrain_curve import agreement, rests, seen_at

NEAR = 0.01
"""A height agrees within this [m]."""
CELLS = 1.5
"""An edge agrees within so many cells of the map."""
MOST = 0.95
"""Share of the heights that must agree."""
FIRST, LAST = 1 / 3, 2 / 3
"""A foot goes up first where it is free within the first third of its way, and down last where it is still up
in the last third."""
STRAIGHT = 5.0
"""A robot keeps its heading within this [°]."""
OBSTACLES = (OVER, ONTO)


def curve_claim(walk: SeenWalk) -> Claim:
    """The terrain curve beside the ground."""
    way = way_of(walk)
    found = [agreement(curve, way) for curve in walk.curves]
    off, edges = (np.concatenate([getattr(one, name) for one in found]) for name in ("off", "edges"))
    known = float(np.mean([one.known for one in found]))
    worst, near = float(np.quantile(off, MOST)), CELLS * SPACING * walk.robot.height
    told = f"known for {known:.0%} of the way; {MOST:.0%} of its heights within {mm(worst)} of the ground"
    if len(edges):
        told += f", {len(edges)} edges within {mm(np.max(edges))}, median {mm(np.median(edges))}"
    return Claim(
        "the terrain curve",
        "generated off-line from the information of the terrain scanner",
        told,
        bool(worst <= NEAR and (edges <= near).all()),
        f"away from edges {MOST:.0%} within {mm(NEAR)}, every edge within {mm(near)}: {CELLS:g} cells",
        {"known": known, "off_m": worst, "edges_m": [None if np.isnan(e) else float(e) for e in edges]},
    )


def rests_claim(walk: SeenWalk) -> Claim:
    """Where the feet stood, beside the terrain curve."""
    off = np.concatenate(
        [rest[:, 1] - seen_at(walk.curve_of(leg), rest[:, 0])
         for leg in range(walk.robot.n) if len(rest := rests(walk.feet, leg))]
    )  # fmt: skip
    off = np.abs(off[~np.isnan(off)])
    sunk = float(max(0.0, -over_ground(walk).min()))
    share = float((off <= NEAR).mean())
    return Claim(
        "the surface from the feet",
        "its level was computed from where the foot was and how high",
        f"{len(off)} footholds: {share:.0%} within {mm(NEAR)} of the terrain curve, "
        f"median {mm(np.median(off))}",
        share >= MOST,
        f"{MOST:.0%} within {mm(NEAR)}; the ground of the physics gives: landing, a foot sinks in by up to "
        f"{mm(sunk)}",
        {"footholds": len(off), "share": share, "median_m": float(np.median(off)), "sunk_m": sunk},
    )


def room_claim(strides: Sequence[Stride], thesis: str) -> Claim:
    """Whether feet were above what they went over when they came to it."""
    met = [stride for stride in strides if stride.does in OBSTACLES]
    if not met:
        return none_met("an obstacle within the forward stroke", thesis)
    room = np.array([stride.room for stride in met])
    hit = sum(stride.hit for stride in met)
    touched = f"; {hit} touched it on the way up" if hit else "; none touched it before"
    return Claim(
        "an obstacle within the forward stroke",
        thesis,
        f"{len(met)} strides of all legs over or onto one: over its edge the foot is {mm(room.min())} to "
        f"{mm(room.max())} above it{touched}",
        bool((room > 0.0).all()),
        "above it in every one",
        {"strides": len(met), "room_m": room.tolist(), "touched": hit},
    )


def order_claim(strides: Sequence[Stride]) -> Claim:
    """Whether a foot goes up, forward and down, in this order."""
    forward = np.array([stride.forward for stride in strides if stride.does in OBSTACLES])
    if not len(forward):
        return none_met("its order", "up, forward, down")
    up, down = forward[:, 0] <= FIRST, forward[:, 1] >= LAST
    b, c = np.median(forward, axis=0)
    return Claim(
        "its order: up (A to B), forward (to C), down (to D)",
        "up until the path is free, then forward to the end of the stroke, then down",
        f"free of it after {b:.0%} of the way forward, still up at {c:.0%} (medians); in this order in "
        f"{(up & down).mean():.0%} of the strides",
        bool(b <= FIRST and c >= LAST),
        "by the medians: free within the first third of the way, still up in the last third",
        {"free": forward[:, 0].tolist(), "up_until": forward[:, 1].tolist()},
    )


def tracking_claim(strides: Sequence[Stride]) -> Claim:
    """Whether feet go over level ground at one height, and again after an obstacle."""
    heights = np.array([stride.height for stride in strides if stride.is_usual])
    again = np.array(
        [b.height for a, b in pairwise(strides) if a.leg == b.leg and a.does != ALONG and b.is_usual]
    )
    if not len(again):
        return none_met("tracking of the ground", "behind an obstacle the leg switches back")
    middle = float(np.median(heights))
    return Claim(
        "tracking of the ground where nothing is in the way",
        "a constant distance between foot and ground is maintained; behind an obstacle the leg switches back",
        f"{len(heights)} strides along the ground rise {mm(heights.min())} to {mm(heights.max())}, "
        f"{len(again)} first ones behind an obstacle {mm(again.min())} to {mm(again.max())}",
        bool((np.abs(again - middle) <= NEAR).all()),
        f"these within {mm(NEAR)} of the median; our feet rise and fall: their greatest distance is constant",
        {"level_m": heights.tolist(), "behind_m": again.tolist()},
    )


def hind_claim(strides: Sequence[Stride], robot: Robot) -> Claim:
    """The same of the hind legs, which the camera does not see."""
    hind = [s for s in strides if s.does in OBSTACLES and robot.nominal_feet[s.leg, 0] < 0.0]
    if not hind:
        return none_met("hind legs", "do as the front ones")
    room = np.array([stride.room for stride in hind])
    return Claim(
        "hind legs",
        "extrapolate where they will meet the obstacles, and do as the front ones",
        f"{len(hind)} strides over or onto one, {mm(room.min())} to {mm(room.max())} above it",
        bool((room > 0.0).all()),
        "ours remember the ground: the map keeps what the camera saw before",
        {"strides": len(hind), "room_m": room.tolist()},
    )


def balance_claim(walk: SeenWalk, thesis: str) -> Claim:
    """Whether the robot kept its balance and its heading."""
    recording = walk.recording
    turned = recording.channel("orientation_wb")
    roll, pitch = (np.degrees(np.abs(angle).max()) for angle in attitude(turned))
    heading = float(np.degrees(np.abs(heading_over_time(turned)).max()))
    aside = float(np.abs(recording["position_w"][:, 1]).max())
    kept = recording.arrived and not recording.fell
    return Claim(
        "balance and heading",
        thesis,
        f"{recording.stopped_because}; roll up to {roll:.1f}°, pitch {pitch:.1f}°, heading within "
        f"{heading:.1f}°, {mm(aside)} off the line at most",
        bool(kept and heading <= STRAIGHT),
        f"no fall, heading within {STRAIGHT:g}°",
        {"roll_deg": float(roll), "pitch_deg": float(pitch), "heading_deg": heading, "aside_m": aside},
    )


def over_ground(walk: SeenWalk) -> Float[np.ndarray, "n legs"]:
    """Height of the feet's lowest points over the true ground straight below [m]."""
    x, y, z = np.moveaxis(walk.feet.place_w, -1, 0)
    return z - np.asarray(walk.scene.height(x, y), dtype=float)


def none_met(what: str, thesis: str) -> Claim:
    """A claim of a walk that met no obstacle: it ended before."""
    return Claim(what, thesis, "no stride came over or onto one", False)


# --- for the page -----------------------------------------------------------------------------------
def stride_grid(strides: Sequence[Stride], robot: Robot) -> Grid:
    """The strides of each leg, counted."""
    rows = []
    for leg, name in enumerate(robot.legs):
        own = [stride for stride in strides if stride.leg == leg]
        counts = (sum(stride.does == what for stride in own) for what in (ALONG, OVER, ONTO, OFF))
        heights = (
            np.array([1e3 * s.height for s in own if (s.does in OBSTACLES) == met]) for met in (False, True)
        )
        spans = (f"{h.min():.0f} … {h.max():.0f}" if len(h) else "–" for h in heights)
        rows.append((name, *map(str, counts), *spans))
    head = ("leg", "along", "over", "onto", "off", "rises on the others [mm]", "and over or onto")
    return Grid("strides by what they do, and how high the foot rises", head, rows)


def way_of(walk: SeenWalk) -> tuple[float, float]:
    """From where to where the feet went along x [m]."""
    x = walk.feet.place_w[..., 0]
    return float(x.min()), float(x.max())


def mm(length: float) -> str:
    """A length in millimetres."""
    return f"{1e3 * length:.0f} mm"
