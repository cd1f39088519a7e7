"""The trees of one rule, each as an indented list with the rule's marks and its grey area."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.rules import Marks, Rule, status
from gaitwright.knowledge.trees import FeatureTree
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import DPI, FAINT, INK, LEFT, WIDTH

ACROSS = 4
"""Trees side by side."""
GAP = 0.3
"""Between trees [in]."""
LINE = 0.21
"""Height of a value of a tree [in]."""
ABOVE = 0.95
"""Room for the title [in]."""
CHARACTER = 0.073
"""Width of a letter of a value's label [in], at most on average."""
FREE, UPPER, LOWER, HERE = "#d3ead9", "#c2255c", "#1b6e35", "#1971c2"
"""Colours: below the lower mark, the marks, the situation."""


def layout(trees: Sequence[FeatureTree]) -> list[tuple[list[tuple[FeatureTree, float]], float]]:
    """The trees shared out to columns, each with its distance from the top; and each column's height [in]."""
    columns: list[list[tuple[FeatureTree, float]]] = [[] for _ in range(min(ACROSS, len(trees)))]
    heights = [0.0] * len(columns)
    for tree in trees:
        shortest = heights.index(min(heights))
        columns[shortest].append((tree, heights[shortest]))
        heights[shortest] += LINE * (len(tree.values) + 1) + GAP
    return list(zip(columns, heights, strict=True))


def draw_trees(
    sheet: Sheet,
    top: float,
    columns: Sequence[tuple[list[tuple[FeatureTree, float]], float]],
    rule: Rule,
    situation: Situation | None,
) -> None:
    """All trees of a rule below a title."""
    what = f"{rule.name}: {status(rule)}, seen {len(rule.positives)} times right, {len(rule.negatives)} wrong"
    place = (LEFT / WIDTH, 1 - (top + 0.3) / sheet.height)
    sheet.figure.text(*place, what, fontsize=15, fontweight="bold", color=INK)
    legend = [
        Line2D([], [], color=UPPER, marker="^", linestyle="", label="upper mark: outside it may not fire"),
        Line2D([], [], color=LOWER, marker="v", linestyle="", label="lower mark: below it it was seen right"),
    ]
    sheet.figure.legend(
        handles=legend, loc="upper left",
        bbox_to_anchor=(place[0] - 0.008, place[1] - 0.1 / sheet.height),
        ncols=2, frameon=False, fontsize=11,
    )  # fmt: skip
    width = (WIDTH - 2 * LEFT - GAP * (ACROSS - 1)) / ACROSS
    for number, (column, _) in enumerate(columns):
        for tree, down in column:
            size = (width, LINE * (len(tree.values) + 1))
            ax = sheet.axes(LEFT + number * (width + GAP), top + ABOVE + down, *size)
            ax.set(xlim=(0.0, width), ylim=(size[1], 0.0))
            ax.axis("off")
            value = situation[tree.name] if situation else None
            draw_tree(ax, tree, rule.marks_in(tree.name), value if rule.may_fire or value else None)


def draw_tree(ax: Axes, tree: FeatureTree, marks: Marks, here: str | None) -> None:
    """A tree as an indented list, one value a line, with its marks; `here` is the situation's leaf."""
    width = ax.get_xlim()[1]
    name = shortened(tree.name, int(width / CHARACTER))
    ax.text(0.0, 0.5 * LINE, name, fontsize=11, fontweight="bold", color=INK, va="center")
    shade(ax, tree, marks)
    way = tree.path(here) if here is not None else ()
    for line, value in enumerate(tree.values):
        depth, y = len(tree.path(value)) - 1, LINE * (line + 1.5)
        x = 0.08 + 0.19 * depth
        if depth:
            elbow(ax, LINE * (tree.parents[line] + 1.5), (x, y), value in way)
        signs = [(UPPER, "^")] * (value == marks.upper) + [(LOWER, "v")] * (value == marks.lower)
        room = int((width - x - 0.2 - 0.17 * len(signs)) / CHARACTER)
        colour = INK if tree.is_below(value, marks.upper) or value in tree.path(marks.upper) else FAINT
        weight, paint = ("bold", HERE) if value == here else ("normal", colour)
        text = shortened(value, room)
        told = ax.text(x + 0.06, y, text, fontsize=9, va="center", zorder=5, color=paint, fontweight=weight)
        if value == here:
            ax.plot(x, y, "o", color=HERE, markersize=5, zorder=6)
        beside = x + 0.2 + (told.get_window_extent().width / DPI if signs else 0.0)
        for k, (sign, shape) in enumerate(signs):
            ax.plot(beside + 0.16 * k, y, shape, color=sign, markersize=6.5, zorder=6)


def elbow(ax: Axes, above: float, end: tuple[float, float], taken: bool) -> None:
    """The link from a value's parent, at height `above`, to it."""
    x, y = end
    look = {"color": HERE, "linewidth": 1.6, "zorder": 4} if taken else {"color": FAINT, "linewidth": 0.8}
    ax.plot((x - 0.14, x - 0.14, x - 0.02), (above + 0.35 * LINE, y, y), solid_joinstyle="miter", **look)


def shade(ax: Axes, tree: FeatureTree, marks: Marks) -> None:
    """The grey area below the upper mark, and in it what is below the lower one."""
    width = ax.get_xlim()[1]
    for mark, colour, hatch in ((marks.upper, "#eceff2", "////"), (marks.lower, FREE, None)):
        if mark is None:
            continue
        first, end = lines_below(tree, mark)
        left = 0.19 * (len(tree.path(mark)) - 1)
        box = Rectangle(
            (left, LINE * (first + 1)), width - left, LINE * (end - first), facecolor=colour, hatch=hatch,
            edgecolor="white", linewidth=0, zorder=0,
        )  # fmt: skip
        ax.add_patch(box)


def lines_below(tree: FeatureTree, mark: str) -> tuple[int, int]:
    """The place of a mark and one past the last value below it: a branch stands together."""
    first = tree.at(mark)
    below = [k for k, value in enumerate(tree.values) if tree.is_below(value, mark)]
    return (first, first + len(below))


def shortened(text: str, room: int) -> str:
    """The text, or as much of it as has room with an ellipsis at its end."""
    return text if len(text) <= room else f"{text[: max(1, room - 1)].rstrip()}…"
