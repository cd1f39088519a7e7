"""Traversals beside each other: the terrain with the path above, the learned map below (figure 6.11)."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.navigation.piece_rows import FELT, KIND
from gaitwright.pictures import Sheet
from gaitwright.pictures.ground import GROUND, HIGH, draw_things
from gaitwright.pictures.learned_map import FREE, KINDS, UNKNOWN, draw_learned_map
from gaitwright.pictures.style import INK, LEFT, WIDTH, dress
from gaitwright.reproduce.traversals import Place, Traversal

PATH, POINT = "#1971c2", "#1d2733"
TOP, APART, BETWEEN, BELOW, HEAD, LEGEND = 1.0, 0.45, 0.62, 0.7, 0.64, 0.35
"""Above all; between columns, between terrain and map, below a map; for a row's name, for the legend [in]."""


def draw_traversals(
    path: Path,
    words: tuple[str, str],
    world: tuple[Robot, Scene, Mapping[int, Place]],
    rows: Mapping[str, Sequence[tuple[str, str, Traversal]]],
) -> None:
    """Draws a PNG under a title and a line of `words`; `rows`: by what is said of them traversals in their
    order, each with the titles of its terrain and of its map."""
    x_min, y_min, x_max, y_max = world[1].bounds
    columns = max(len(row) for row in rows.values())
    wide = (WIDTH - LEFT - 0.2 - APART * (columns - 1)) / columns
    high = wide * (y_max - y_min) / (x_max - x_min)
    each = HEAD + 2 * high + BETWEEN + BELOW
    sheet = Sheet(height=TOP + len(rows) * each + LEGEND)
    sheet.head(*words)
    for r, (name, row) in enumerate(rows.items()):
        top = TOP + r * each
        at = 1 - (top + 0.22) / sheet.height
        sheet.figure.text(LEFT / WIDTH, at, name, fontsize=14, fontweight="bold", color=INK)
        for c, (of_terrain, of_map, one) in enumerate(row):
            left = LEFT + c * (wide + APART)
            above = sheet.axes(left, top + HEAD, wide, high)
            draw_terrain(above, world, one)
            below = sheet.axes(left, top + HEAD + high + BETWEEN, wide, high)
            draw_learned_map(below, one.known)
            for ax, title in ((above, of_terrain), (below, of_map)):
                dress(ax, title)
                ax.grid(False)
                ax.set(ylabel="" if c else "y [m]", xlabel="x [m]" if ax is below else "")
    maps = [one.known for row in rows.values() for *_, one in row]
    corner = (LEFT / WIDTH - 0.008, 0.0)
    sheet.figure.legend(
        handles=handles(any((known.rows[:, KIND] >= FELT).any() for known in maps)),
        loc="lower left", ncols=8, frameon=False, fontsize=11, bbox_to_anchor=corner,
    )  # fmt: skip
    sheet.figure.savefig(path, format="png")


def draw_terrain(ax: Axes, world: tuple[Robot, Scene, Mapping[int, Place]], one: Traversal) -> None:
    """The terrain as it is, and the path of a traversal from point to point."""
    robot, scene, points = world
    x_min, y_min, x_max, y_max = scene.bounds
    ax.set_facecolor(GROUND)
    draw_things(ax, scene, scene.obstacles(robot.step_limit))
    ax.plot(*one.way.T, color=PATH, linewidth=2.2, zorder=4)
    ax.scatter(*one.way[-1], s=36, marker="o" if one.arrived else "X", color=PATH, zorder=4.5)
    for number in one.route:
        x, y = points[number]
        ax.scatter(x, y, s=170, color=POINT, edgecolors="white", zorder=5)
        ax.text(x, y - 0.01, str(number), ha="center", va="center", fontsize=9, color="white", zorder=6)
    ax.set(xlim=(x_min, x_max), ylim=(y_min, y_max), aspect="equal")


def handles(felt: bool) -> list[Artist]:
    """The legend."""
    found: list[Artist] = [
        Line2D([], [], color=PATH, linewidth=2.2, label="path"),
        Patch(**HIGH, label="walked around"),
        Patch(facecolor=FREE, edgecolor="#b6bec7", label="seen to be free"),
        Patch(facecolor=UNKNOWN, label="unknown"),
    ]
    for _, (name, colour, line) in list(KINDS.items())[: 3 if felt else 1]:
        found.append(Line2D([], [], color=colour, linestyle=line, linewidth=2.4, label=f"edges, {name}"))
    return [*found, Line2D([], [], color="#a5d8ff", linewidth=2.2, label="ways walked before")]
