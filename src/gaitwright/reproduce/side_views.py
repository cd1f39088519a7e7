"""Feet over the ground seen from the side: terrain curve and trajectories (figures 6.9 and 6.10)."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MultipleLocator

from gaitwright.pictures import Sheet
from gaitwright.pictures.style import INK, LEFT, WIDTH, dress
from gaitwright.reproduce.curves import LOOKS
from gaitwright.reproduce.seen_walk import SeenWalk, leans
from gaitwright.reproduce.strides import Stride
from gaitwright.reproduce.terrain_curve import rests

EARTH, BODY = "#e6ddc8", "#2f9e44"
HIGHER = 2.0
"""Heights are drawn so many times as large as lengths."""
SHARP = 0.002
"""From place to place of the ground [m]."""
ROOM = 0.03
"""Below the lowest and above the highest thing [m]."""
TOP, BETWEEN, APART, ZOOM, LEANING, LEGEND = 1.25, 0.95, 0.75, 2.9, 1.5, 0.1
"""Above the first view, between views, between closer looks; height of a closer look and of the leans; room
for the legend [in]."""
TICKS = 0.05
"""[m]"""
AROUND = 0.09
"""A closer look shows so much on either side [m]."""


class Side(NamedTuple):
    """One side of the robot."""

    title: str
    legs: tuple[int, int]
    """The front foot and the hind one."""


def draw_side_views(
    path: Path,
    words: tuple[str, str],
    walk: SeenWalk,
    closer: Sequence[tuple[str, Stride]],
    leaning: bool = False,
) -> None:
    """Draws a PNG under a title and a line of `words`: the left side, the right one or how the body leans,
    and two strides from close by."""
    ends, (low, high) = way_shown(walk), heights_shown(walk, leaning)
    across = WIDTH - LEFT - 0.25
    tall = HIGHER * (high - low) * across / (ends[1] - ends[0])
    second = LEANING if leaning else tall
    sheet = Sheet(height=TOP + tall + second + 2 * BETWEEN + ZOOM + BETWEEN + LEGEND)
    sheet.head(*words)
    places = (sheet.axes(LEFT, TOP, across, tall), sheet.axes(LEFT, TOP + tall + BETWEEN, across, second))
    left, right = sides_of(walk)
    draw_side(places[0], walk, left, leaning)
    if leaning:
        draw_leans(places[1], walk)
    else:
        draw_side(places[1], walk, right, leaning)
    for ax in places:
        ax.set(xlim=ends, xlabel="x [m]")
    share = (across - APART * (len(closer) - 1)) / max(len(closer), 1)
    for k, (title, stride) in enumerate(closer):
        top = TOP + tall + second + 2 * BETWEEN
        ax = sheet.axes(LEFT + k * (share + APART), top, share, ZOOM)
        draw_stride(ax, walk, stride)
        dress(ax, title)
    corner = (LEFT / WIDTH - 0.008, 0.0)
    sheet.figure.legend(
        handles=handles(leaning), loc="lower left", ncols=7, frameon=False, fontsize=11, bbox_to_anchor=corner
    )
    sheet.figure.savefig(path, format="png")


def draw_side(ax: Axes, walk: SeenWalk, side: Side, body: bool) -> None:
    """One side: the ground, the curve, two feet, and the body where it is asked for."""
    draw_ground(ax, walk, side.legs[0])
    if body:
        place = walk.recording["position_w"]
        ax.plot(place[:, 0], place[:, 2], color=BODY, linewidth=1.6)
    for leg, (colour, _, _), thick in zip(side.legs[::-1], LOOKS[::-1], (1.0, 1.7), strict=True):
        way = walk.feet.place_w[:, leg]
        ax.plot(way[:, 0], way[:, 2], color=colour, linewidth=thick, zorder=4)
    ax.scatter(*rests(walk.feet, side.legs[0]).T, s=16, color=LOOKS[0][0], zorder=5)
    ax.set(ylim=heights_shown(walk, body), ylabel="height [m]")
    ax.yaxis.set_major_locator(MultipleLocator(TICKS))
    dress(ax, side.title)


def draw_leans(ax: Axes, walk: SeenWalk) -> None:
    """How the ground under the robot leans, and the body."""
    x, ground, body, _ = leans(walk)
    ax.plot(x, ground, color=INK, linewidth=1.2, linestyle=(0, (4, 2)))
    ax.plot(x, body, color=BODY, linewidth=1.6)
    ax.set_ylabel("lean [°]")
    dress(ax, "lean along the way, uphill positive")


def draw_ground(ax: Axes, walk: SeenWalk, leg: int) -> None:
    """The ground under a leg, as it is and as it was seen."""
    curve = walk.curve_of(leg)
    x = np.arange(curve.x[0], curve.x[-1], SHARP)
    ground = np.asarray(walk.scene.height(x, np.full_like(x, curve.y)), dtype=float)
    ax.fill_between(x, ground.min() - 1.0, ground, color=EARTH, linewidth=0, zorder=1)
    ax.plot(curve.x, curve.seen, color=INK, linewidth=1.6, zorder=3)


def draw_stride(ax: Axes, walk: SeenWalk, stride: Stride) -> None:
    """One stride from close by, as large in height as in length; A, B, C, D as in the thesis's figure 5.2."""
    draw_ground(ax, walk, stride.leg)
    ax.plot(stride.x, stride.z, color=LOOKS[0][0], linewidth=2.2, zorder=4)
    b, c = stride.corners
    middle = 0.5 * (stride.x[0] + stride.x[-1])
    for name, k in (("A", 0), ("B", b), ("C", c), ("D", -1)):
        x, z = float(stride.x[k]), float(stride.z[k])
        side = -1.0 if x < middle else 1.0
        ax.scatter(x, z, s=34, color=LOOKS[0][0], zorder=5)
        ax.annotate(
            name, (x, z), (9 * side, 4), textcoords="offset points", fontsize=13, fontweight="bold",
            color=INK, ha="right" if side < 0 else "left", zorder=6,
        )  # fmt: skip
    low, high = float(min(stride.ground.min(), stride.z.min())) - ROOM, float(stride.z.max()) + ROOM
    box = ax.get_window_extent()
    wide = max((high - low) * box.width / box.height, np.ptp(stride.x) + 2.0 * AROUND)
    high = max(high, low + wide * box.height / box.width)
    ax.set(xlim=(middle - 0.5 * wide, middle + 0.5 * wide), ylim=(low, high))
    ax.set(xlabel="x [m]", ylabel="height [m]")
    ax.yaxis.set_major_locator(MultipleLocator(TICKS))


# --- what is shown ----------------------------------------------------------------------------------
def sides_of(walk: SeenWalk) -> tuple[Side, Side]:
    """The left side and the right one."""
    feet, names = walk.robot.nominal_feet, walk.robot.legs

    def side(title: str, sign: float) -> Side:
        own = [leg for leg in range(walk.robot.n) if sign * feet[leg, 1] > 0.0]
        front, hind = sorted(own, key=lambda leg: -float(feet[leg, 0]))[:2]
        return Side(f"{title}   ({names[front]}, {names[hind]})", (front, hind))

    return side("left feet", 1.0), side("right feet", -1.0)


def way_shown(walk: SeenWalk) -> tuple[float, float]:
    """From where to where along x [m]."""
    x = walk.feet.place_w[..., 0]
    return float(x.min()) - AROUND, float(x.max()) + AROUND


def heights_shown(walk: SeenWalk, body: bool) -> tuple[float, float]:
    """From where to where in height [m]."""
    z = walk.feet.place_w[..., 2]
    top = walk.recording["position_w"][:, 2].max() if body else z.max()
    return float(min(z.min(), *(curve.true.min() for curve in walk.curves))) - ROOM, float(top) + ROOM


def handles(leaning: bool) -> list[Artist]:
    """The legend."""
    (front, _, _), (hind, _, _) = LOOKS
    feet: list[Artist] = [
        Line2D([], [], color=INK, linewidth=1.6, label="terrain curve, as scanned"),
        Patch(facecolor=EARTH, label="the ground"),
        Line2D([], [], color=front, linewidth=1.7, marker="o", markersize=4, label="front foot, footholds"),
        Line2D([], [], color=hind, linewidth=1.0, label="hind foot"),
    ]
    if not leaning:
        return feet
    lean = Line2D([], [], color=INK, linewidth=1.2, linestyle=(0, (4, 2)), label="lean of the ground")
    return [*feet, Line2D([], [], color=BODY, linewidth=1.6, label="body"), lean]
