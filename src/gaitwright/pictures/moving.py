"""What moves, from above: where each thing is first, the way it goes with arrows, and when it is there."""

import math
from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from gaitwright.ground.moving import Mover, Point
from gaitwright.ground.scene import Scene

MOVES = "#d9480f"
LOOK = {"facecolor": "#ffd8a8", "edgecolor": MOVES, "linewidth": 1.0, "linestyle": "--"}
"""A thing where it is first."""
FEW = 7
"""Of more things it is not written how fast they go, and when."""


def draw_moving(ax: Axes, scene: Scene) -> None:
    """All moving things of a scene."""
    for mover in scene.movers:
        ax.add_patch(Polygon(mover.solid.corners(), zorder=2.4, **LOOK))
        for k, (begin, end) in enumerate(pairwise(mover.path)):
            if mover.gone_at[k] < mover.gone_at[k + 1]:
                draw_stretch(ax, begin, end)
        if len(scene.movers) <= FEW:
            x, y = mover.path[0]
            at = (x, y + mover.solid.reach)
            text = {"fontsize": 8, "color": MOVES, "ha": "center", "zorder": 3, "clip_on": True}
            ax.annotate(words(mover), at, (0, 2), textcoords="offset points", **text)


def draw_stretch(ax: Axes, begin: Point, end: Point) -> None:
    """A stretch of a way, with an arrow two thirds along it."""
    (x0, y0), (x1, y1) = begin, end
    ax.plot((x0, x1), (y0, y1), color=MOVES, linewidth=1.2, alpha=0.7, zorder=2.3)
    middle = ((x0 + 2.0 * x1) / 3.0, (y0 + 2.0 * y1) / 3.0)
    arrow = {"arrowstyle": "-|>", "color": MOVES, "linewidth": 1.2, "mutation_scale": 11.0}
    drawn = ax.annotate("", middle, begin, arrowprops=arrow | {"shrinkA": 0.0, "shrinkB": 0.0}, zorder=2.5)
    drawn.arrow_patch.set_clip_path(ax.patch)  # pyright: ignore[reportOptionalMemberAccess] - it has an arrow


def words(mover: Mover) -> str:
    """How fast a thing goes, and when it is there."""
    said = [f"{mover.speed:.2g} m/s"] if mover.along else []
    if mover.begins > 0.0 and mover.along:
        said.append(f"from {mover.begins:g} s")
    if math.isfinite(mover.vanishes):
        said.append(f"there {mover.appears:.2g} to {mover.vanishes:.2g} s")
    elif mover.appears > 0.0:
        said.append(f"there from {mover.appears:.2g} s")
    return ", ".join(said)
