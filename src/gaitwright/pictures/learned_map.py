"""A learned map from above: what is known of obstacles, which ground is free, which ways were walked."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from gaitwright.files import whole
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.piece_rows import CORNERS, FELT, KIND, SEEN, SUPPOSED
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import INK, LEFT, WIDTH, dress

FREE, UNKNOWN = "#fbfaf6", "#d5d9de"
KINDS: dict[float, tuple[str, str, Any]] = {
    SEEN: ("seen", INK, "-"),
    FELT: ("felt", "#e8590c", "-"),
    SUPPOSED: ("supposed", "#e8590c", ":"),
}
WAYS = ("#a5d8ff", "#1971c2")
"""From the first way to the last."""
TALLEST, ABOVE, BELOW = 12.0, 1.25, 0.6
"""Of the field, and beyond it [in]."""


def learned_map_picture(learned: LearnedMap, place: str, path: Path) -> Path:
    """Draws a map as PNG."""
    x_min, y_min, x_max, y_max = learned.bounds
    width = WIDTH - LEFT - 0.35
    height = min(max(width * (y_max - y_min) / (x_max - x_min), 2.0), TALLEST)
    sheet = Sheet(height=ABOVE + height + BELOW)
    at, top = LEFT / WIDTH, sheet.height
    sheet.figure.text(at, 1 - 0.45 / top, f"The map of {place}", fontsize=19, fontweight="bold", color=INK)
    told = f"lengths in metres; learned by a disc of {2.0 * learned.radius:.2f} m"
    sheet.figure.text(at, 1 - 0.78 / top, told, fontsize=12, color=INK)
    ax = sheet.axes(LEFT, ABOVE, width, height)
    draw_learned_map(ax, learned)
    sheet.figure.legend(
        handles=handles_of(learned),
        loc="upper right",
        bbox_to_anchor=(1 - 0.35 / WIDTH, 1 - 0.3 / top),
        ncols=5,
        frameon=False,
        fontsize=11,
    )
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path


def draw_learned_map(ax: Axes, learned: LearnedMap) -> None:
    """Free ground light, unknown ground grey; pieces with dots where they end at corners; ways over them."""
    x_min, y_min, x_max, y_max = learned.bounds
    (x, y, cell), cells = learned.raster
    extent = (x, x + cell * cells.shape[1], y, y + cell * cells.shape[0])
    two = ListedColormap([UNKNOWN, FREE])
    ax.imshow(cells, extent=extent, origin="lower", cmap=two, vmin=0, vmax=1, interpolation="nearest")
    for kind, (_, colour, line) in KINDS.items():
        rows = learned.rows[learned.rows[:, KIND] == kind]
        ax.add_collection(
            LineCollection(
                list(rows[:, :4].reshape(-1, 2, 2)), colors=colour, linewidths=2.4, linestyles=line
            )
        )
        ends = rows[:, :4].reshape(-1, 2)[rows[:, CORNERS].ravel() > 0.0]
        ax.scatter(*ends.T, s=14, color=colour, zorder=3)
    for way, colour in zip(learned.trips, colours(len(learned.trips)), strict=True):
        ax.plot(*np.array(way).T, color=colour, linewidth=2.2, solid_capstyle="round", zorder=4)
        ax.scatter(*way[0], s=45, color=colour, edgecolors="white", zorder=5)
        ax.scatter(*way[-1], s=110, marker="*", color=colour, edgecolors="white", zorder=5)
    ax.add_patch(
        Rectangle((x_min, y_min), x_max - x_min, y_max - y_min, fill=False, edgecolor=INK, clip_on=False)
    )
    ax.set(xlim=(x_min, x_max), ylim=(y_min, y_max), aspect="equal", xlabel="x [m]", ylabel="y [m]")
    ax.set_anchor("NW")
    dress(ax, None)
    ax.grid(False)


def colours(number: int) -> Sequence[Any]:
    """A colour for each way, the last one strongest."""
    first, last = (np.array([int(c[k : k + 2], 16) / 255 for k in (1, 3, 5)]) for c in WAYS)
    return [last + (first - last) * (1.0 - (k + 1) / number) for k in range(number)]


def handles_of(learned: LearnedMap) -> list[Artist]:
    """The legend: what is on the map."""
    frame: dict[str, Any] = {"edgecolor": "#b6bec7"}
    handles: list[Artist] = [
        Patch(facecolor=FREE, label="free", **frame),
        Patch(facecolor=UNKNOWN, label="unknown"),
    ]
    there = set(learned.rows[:, KIND])
    handles += [
        Line2D([], [], color=colour, linestyle=line, linewidth=2.4, label=name)
        for kind, (name, colour, line) in KINDS.items()
        if kind in there
    ]
    ways = colours(len(learned.trips))
    named = {"first way": ways[:1], "last way": ways[1:][-1:]}
    return handles + [
        Line2D([], [], color=colour, linewidth=2.2, label=name)
        for name, some in named.items()
        for colour in some
    ]
