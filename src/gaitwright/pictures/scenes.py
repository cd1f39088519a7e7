"""Scenes from above, several in one picture: relief, holes, what is walked around, start and goal."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gaitwright.files import whole
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Flat, Slope
from gaitwright.pictures import Sheet
from gaitwright.pictures.ground import HIGH, LOW_EDGE, PIT, draw_relief, draw_things
from gaitwright.pictures.moving import LOOK, draw_moving
from gaitwright.pictures.style import INK, LEFT, WIDTH, dress

ACROSS = 3
"""Scenes side by side."""
TOP, GAP, BELOW, TITLE = 1.15, 0.55, 0.5, 0.35
"""Above the first row, between panels, below each, for its name [in]."""
TALLEST = 6.5
"""Of a panel [in]."""
WIDEST = 16.0
"""Of an empty plane so much is shown around the start [m]."""


def scenes_picture(scenes: Sequence[Scene], step: float, path: str | Path) -> Path:
    """Draws scenes as PNG, for a robot that steps up or down by `step` [m]."""
    across = min(ACROSS, len(scenes))
    width = (WIDTH - LEFT - 0.35 - GAP * (across - 1)) / across
    rows = [scenes[k : k + across] for k in range(0, len(scenes), across)]
    heights = [min(max(width * _aspect(scene) for scene in row), TALLEST) for row in rows]
    sheet = Sheet(height=TOP + sum(heights) + (TITLE + BELOW) * len(rows))
    _head(sheet, scenes, step)
    top = TOP
    for row, height in zip(rows, heights, strict=True):
        for column, scene in enumerate(row):
            ax = sheet.axes(LEFT + column * (width + GAP), top + TITLE, width, height)
            draw_scene(ax, scene, step)
        top += TITLE + height + BELOW
    with whole(Path(path)) as draft:
        sheet.figure.savefig(draft, format="png")
    return Path(path)


def draw_scene(ax: Axes, scene: Scene, step: float) -> None:
    """One scene."""
    x_min, x_max, y_min, y_max = extent = view(scene)
    draw_relief(ax, scene, extent)
    draw_things(ax, scene, scene.obstacles(step))
    draw_moving(ax, scene)
    x, y, yaw = scene.start
    reach = 0.05 * max(x_max - x_min, y_max - y_min)
    tip = (x + reach * math.cos(yaw), y + reach * math.sin(yaw))
    ax.annotate("", tip, (x, y), arrowprops={"color": INK, "width": 2, "headwidth": 8}, zorder=5)
    ends = {"edgecolors": "white", "linewidths": 1.0, "zorder": 6}
    ax.scatter(x, y, s=60, marker="o", c=INK, **ends)
    if scene.goal:
        ax.scatter(*scene.goal, s=170, marker="*", c=INK, **ends)
    dress(ax, f"{scene.name}   seed {scene.seed}")
    ax.set(xlim=extent[:2], ylim=extent[2:], aspect="equal")
    ax.set_anchor("NW")
    ax.grid(False)


def view(scene: Scene) -> tuple[float, float, float, float]:
    """What is shown of a scene, x_min, x_max, y_min, y_max [m]: all, but of an empty plane."""
    x_min, y_min, x_max, y_max = scene.bounds
    if scene.solids or scene.movers or scene.goal or not isinstance(scene.surface, Flat | Slope):
        return x_min, x_max, y_min, y_max
    x, y, half = *scene.start[:2], WIDEST / 2
    return max(x_min, x - half), min(x_max, x + half), max(y_min, y - half / 2), min(y_max, y + half / 2)


def _aspect(scene: Scene) -> float:
    x_min, x_max, y_min, y_max = view(scene)
    return (y_max - y_min) / (x_max - x_min)


def _head(sheet: Sheet, scenes: Sequence[Scene], step: float) -> None:
    """Title and legend."""
    title = "Scene" if len(scenes) == 1 else f"{len(scenes)} scenes"
    at = LEFT / WIDTH
    sheet.figure.text(
        at, 1 - 0.45 / sheet.height, f"{title} from above", fontsize=19, fontweight="bold", color=INK
    )
    told = f"lengths in metres; what rises by more than {step:.2f} m within as much is walked around"
    sheet.figure.text(at, 1 - 0.78 / sheet.height, told, fontsize=12, color=INK)
    marker: dict[str, Any] = {"color": "none", "markerfacecolor": INK, "markeredgecolor": "white"}
    handles: list[Artist] = [
        Line2D([], [], marker="o", markersize=9, label="start", **marker),
        Line2D([], [], marker="*", markersize=14, label="goal", **marker),
        Patch(facecolor="#d9c9a8", edgecolor=LOW_EDGE, label="stepped on"),
        Patch(**HIGH, label="walked around"),
        Patch(facecolor=PIT, label="hole"),
    ]
    if any(scene.movers for scene in scenes):
        handles.append(Patch(**LOOK, label="moves"))
    sheet.figure.legend(
        handles=handles,
        loc="upper right",
        bbox_to_anchor=(1 - 0.35 / WIDTH, 1 - 0.3 / sheet.height),
        ncols=len(handles),
        frameon=False,
        fontsize=11,
    )
