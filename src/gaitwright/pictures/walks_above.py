"""Ways of several walkers among polygons, seen from above, world beside world."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from gaitwright.files import whole
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import INK, LEFT, WIDTH, dress

COLOURS = ("#e8590c", "#1971c2", "#2f9e44", "#862e9c", "#495057")
ACROSS = 3
SIDE = 4.6
"""Of a world [in]."""


@dataclass(frozen=True)
class Walks:
    """One world and the ways in it."""

    title: str
    outlines: Sequence[Sequence[tuple[float, ...]]]
    """Of obstacles [m]."""
    start: tuple[float, float]
    goal: tuple[float, float]
    ways: Mapping[str, np.ndarray]
    """Places `(n, 2)` [m] by what is said of them."""


def walks_picture(worlds: Sequence[Walks], path: Path) -> Path:
    """Draws worlds as PNG."""
    rows = -(-len(worlds) // ACROSS)
    sheet = Sheet(height=0.4 + rows * (SIDE + 1.5))
    apart = (WIDTH - LEFT) / ACROSS
    for k, one in enumerate(worlds):
        row, column = divmod(k, ACROSS)
        draw_walks(sheet.axes(LEFT + column * apart, 0.5 + row * (SIDE + 1.5), SIDE, SIDE), one)
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path


def draw_walks(ax: Axes, one: Walks) -> None:
    """One world."""
    ax.add_collection(
        PolyCollection([np.array(rim) for rim in one.outlines], facecolor="#c9ced6", edgecolor="none")
    )
    for k, (name, way) in enumerate(one.ways.items()):
        ax.plot(*way.T, color=COLOURS[k % len(COLOURS)], linewidth=1.6, alpha=0.85, label=name)
    ends = {"color": INK, "edgecolors": "white", "zorder": 5}
    ax.scatter(*one.start, s=70, marker="o", **ends)
    ax.scatter(*one.goal, s=170, marker="*", **ends)
    ax.set(aspect="equal")
    ax.autoscale_view()
    dress(ax, one.title)
    ax.grid(False)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=1, frameon=False, fontsize=9)
