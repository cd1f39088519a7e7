"""A rulebook as a picture: every rule in every tree as a strip, and the trees of one rule with their marks.

A strip has a box for each leaf: filled where the rule was seen right, shaded where nobody knows, empty where
it may not fire. Needs the extra `plot`.
"""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from gaitwright.errors import WrongUse
from gaitwright.files import whole
from gaitwright.knowledge.consult import Decision
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.rules import Marks, Rule, Rulebook, status
from gaitwright.knowledge.trees import ROOT, FeatureTree
from gaitwright.pictures import Sheet
from gaitwright.pictures.rule_trees import ABOVE, CHARACTER, FREE, HERE, draw_trees, layout, shortened
from gaitwright.pictures.style import FAINT, INK, LEFT, WIDTH

GAP = 0.3
"""Between one strip and the next tree's [in]."""
ROW, WIDEST = 0.36, 0.32
"""Height of a rule in the overview, and greatest width of a leaf [in]."""
READABLE = 0.125
"""Leaves narrower than this have no labels [in]; as many trees stand side by side as keep this width."""
LETTER, LONGEST = 0.062, 19
"""Height of a letter of a leaf's label [in], and letters of one that fit."""
NAMES = 2.05
"""Room for the rules' names [in]."""
TOP, HEAD, BOTTOM = 1.0, 0.5, 0.3
"""Above the strips, for the trees' names, and below all [in]."""
INSIDE, GREY = "#51a86b", "#c9ced4"


def forest_picture(
    book: Rulebook, path: str | Path, rule: str = "", decision: Decision | None = None
) -> Path:
    """Draws a rulebook as PNG: an overview, and below it the trees of `rule` where one is named.

    `decision` shows the situation that was decided. Raises `WrongUse` for a rule that does not exist, or for
    a book of none.
    """
    if not book.rules:
        raise WrongUse("the rulebook has no rules yet: there is nothing to draw")
    chosen = book[rule] if rule else None
    situation = decision.situation if decision else None
    columns = layout(book.forest.trees) if chosen else []
    rows = bands(book.forest.trees)
    overview = TOP + sum(band_height(band, len(book.rules)) for band in rows)
    below = ABOVE + max(height for _, height in columns) if chosen else 0.0
    sheet = Sheet(height=overview + below + BOTTOM)
    heading(sheet, book, decision)
    top = TOP
    for band in rows:
        draw_band(sheet, top, book, band, situation, rule)
        top += band_height(band, len(book.rules))
    if chosen:
        draw_trees(sheet, overview, columns, chosen, situation)
    with whole(Path(path)) as draft:
        sheet.figure.savefig(draft, format="png")
    return Path(path)


def heading(sheet: Sheet, book: Rulebook, decision: Decision | None) -> None:
    """What the picture shows, and what its colours mean."""
    counted = f"{len(book.rules)} rules over {len(book.forest.names)} trees, from {book.lessons} lessons"
    if decision:
        counted += f": {decision.rule or 'no rule'} fires here"
    left = LEFT / WIDTH
    sheet.figure.text(left, 1 - 0.42 / sheet.height, counted, fontsize=19, fontweight="bold", color=INK)
    handles: list[Artist] = [
        Patch(facecolor=INSIDE, label="seen right"),
        Patch(facecolor=FREE, label="seen right at any value"),
        Patch(facecolor=GREY, edgecolor="white", hatch="////", label="grey: nobody has seen it"),
        Patch(facecolor="white", edgecolor=FAINT, label="may not fire"),
    ]
    if decision:
        handles.append(
            Line2D([], [], color=HERE, marker="o", markersize=6, linestyle="", label="the situation")
        )
    sheet.figure.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(left - 0.008, 1 - 0.58 / sheet.height),
        ncols=5, frameon=False, fontsize=11,
    )  # fmt: skip


# --- all rules in all trees ------------------------------------------------------------------------
def bands(trees: Sequence[FeatureTree]) -> list[list[FeatureTree]]:
    """The trees in order, as many side by side as leave every leaf a readable width."""
    found: list[list[FeatureTree]] = [[]]
    for tree in trees:
        leaves = sum(len(other.leaves) for other in (*found[-1], tree))
        wide = READABLE * leaves + GAP * (len(found[-1]) + 1)
        if found[-1] and wide > WIDTH - 2 * LEFT - NAMES:
            found.append([])
        found[-1].append(tree)
    return found


def box_width(band: Sequence[FeatureTree]) -> float:
    """How wide a leaf is [in]."""
    room = WIDTH - 2 * LEFT - NAMES - GAP * len(band)
    return min(WIDEST, room / sum(len(tree.leaves) for tree in band))


def band_height(band: Sequence[FeatureTree], rules: int) -> float:
    """Names, strips and labels of trees that stand side by side [in]."""
    longest = max(len(leaf) for tree in band for leaf in tree.leaves)
    labels = LETTER * min(longest, LONGEST) if box_width(band) >= READABLE else 0.0
    return HEAD + ROW * rules + labels + 0.35


def draw_band(
    sheet: Sheet,
    top: float,
    book: Rulebook,
    band: Sequence[FeatureTree],
    situation: Situation | None,
    chosen: str,
) -> None:
    """A row for each rule, a strip for each tree; the axes are in inches, top down."""
    width, height = WIDTH - 2 * LEFT, band_height(band, len(book.rules))
    ax = sheet.axes(LEFT, top, width, height)
    ax.set(xlim=(0.0, width), ylim=(height, 0.0))
    ax.axis("off")
    for row, rule in enumerate(book.rules):
        named(ax, rule, HEAD + ROW * row, rule.name == chosen)
    left, box, end = NAMES, box_width(band), HEAD + ROW * len(book.rules)
    for tree in band:
        room = int((box * len(tree.leaves) + 0.8 * GAP) / (1.15 * CHARACTER))
        name = "\n".join(two_lines(tree.name, room))
        ax.text(left, HEAD - 0.11, name, fontsize=10, fontweight="bold", color=INK, linespacing=1.0)
        for row, rule in enumerate(book.rules):
            strip(ax, tree, rule.marks_in(tree.name), (left, HEAD + ROW * row, box), rule.may_fire)
        if box >= READABLE:
            leaf_labels(ax, tree, (left, end, box))
        if situation and situation[tree.name] is not None:
            here = left + box * (tree.leaf_place[str(situation[tree.name])] + 0.5)
            ax.plot((here, here), (HEAD - 0.02, end), color=HERE, linewidth=1.3, zorder=4)
            ax.plot(here, HEAD - 0.02, "o", color=HERE, markersize=5, zorder=4)
        left += box * len(tree.leaves) + GAP


def two_lines(text: str, room: int) -> list[str]:
    """The text in one line, or cut at a space into two, each shortened to its room."""
    if len(text) <= room or " " not in text:
        return [shortened(text, room)]
    cuts = [k for k, letter in enumerate(text) if letter == " "]
    cut = min(cuts, key=lambda k: max(k, len(text) - k - 1))
    return [shortened(text[:cut], room), shortened(text[cut + 1 :], room)]


def named(ax: Axes, rule: Rule, top: float, chosen: bool) -> None:
    """A rule's name and how far it has come, before its strips."""
    if chosen:
        ax.add_patch(Rectangle((-0.1, top), ax.get_xlim()[1] + 0.2, ROW, facecolor="#eef4fb", zorder=0))
    name = shortened(rule.name, int(NAMES / CHARACTER) - 4)
    weight = "bold" if chosen else "normal"
    ax.text(0.0, top + 0.4 * ROW, name, fontsize=10, fontweight=weight, color=INK, va="center")
    ax.text(0.0, top + 0.79 * ROW, status(rule), fontsize=7.5, color=FAINT, va="center")


def strip(ax: Axes, tree: FeatureTree, marks: Marks, place: tuple[float, float, float], fires: bool) -> None:
    """The leaves of a tree under one rule's marks; `place`: left, top and width of a leaf [in]."""
    left, top, box = place
    height, count = 0.62 * ROW, len(tree.leaves)
    frame = {"edgecolor": FAINT, "linewidth": 0.6}
    top += 0.19 * ROW
    ax.add_patch(Rectangle((left, top), box * count, height, facecolor="white", **frame))
    if not fires:
        return
    for mark, colour, hatch in ((marks.upper, GREY, "////"), (marks.lower, INSIDE, None)):
        if mark is None:
            continue
        paint = FREE if mark == marks.lower == ROOT else colour
        first, end = leaf_span(tree, mark)
        place_at, size = (left + box * first, top), box * (end - first)
        ax.add_patch(Rectangle(place_at, size, height, facecolor=paint, hatch=hatch, edgecolor="white", lw=0))
    between = [left + box * leaf for leaf in range(1, count)]
    ax.vlines(between, top, top + height, color="white" if box < READABLE else FAINT, linewidth=0.3)
    ax.add_patch(Rectangle((left, top), box * count, height, fill=False, **frame))


def leaf_labels(ax: Axes, tree: FeatureTree, place: tuple[float, float, float]) -> None:
    """The names of the leaves below the last strip."""
    left, top, box = place
    for k, leaf in enumerate(tree.leaves):
        ax.text(
            left + box * (k + 0.5), top + 0.06, shortened(leaf, LONGEST), fontsize=7.5, color=INK,
            rotation=90, ha="center", va="top",
        )  # fmt: skip


def leaf_span(tree: FeatureTree, mark: str) -> tuple[int, int]:
    """The first of the leaves below a mark and one past the last: branches stand together."""
    below = tree.leaves_below(mark)
    first = tree.leaf_place[below[0]]
    return (first, first + len(below))
