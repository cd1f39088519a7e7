"""Terrain operators as a picture: the path of a foot with and without, and the force that it takes."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from gaitwright.files import whole
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.gait.leg_cycles.leg_cycle import sampled
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.model.robot import Robot
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import INK, JOINTS, LEFT, WIDTH, dress

TALL, BETWEEN, TOP, GAP = 2.6, 1.6, 1.6, 0.9
"""Height of a panel, below it, above the first one, between two [in]."""
SKILL = "trot"
"""Whose swing is drawn."""
SHOWN = (0.0, 0.5, 1.0)
"""Obstacles that are drawn, as shares of the largest."""
AT = np.linspace(0.0, 1.0, SHARES)


def operators_picture(robot: Robot, operators: Sequence[Operator], path: Path) -> Path:
    """Draws operators as PNG, one a row, in the order in which they are tried."""
    sheet = Sheet(height=TOP + len(operators) * (TALL + BETWEEN) - 0.9)
    edge = LEFT / WIDTH
    title = f"{robot.name}: terrain operators, on a swing of {SKILL}"
    sheet.figure.text(edge, 1 - 0.42 / sheet.height, title, fontsize=17, fontweight="bold", color=INK)
    width = (WIDTH - LEFT - 0.35 - GAP) / 2
    for row, one in enumerate(operators):
        top = TOP + row * (TALL + BETWEEN)
        below = f"{', '.join(one.kinds)} up to {one.largest:.3f} m; it {one.strategy}; taught {one.taught}"
        sheet.figure.text(edge, 1 - (top - 0.82) / sheet.height, one.name, fontsize=13, color=INK)
        sheet.figure.text(edge, 1 - (top - 0.56) / sheet.height, below, fontsize=10, color=INK)
        draw_path(sheet.axes(LEFT, top, width, TALL), robot, one)
        draw_force(sheet.axes(LEFT + width + GAP, top, width, TALL), one)
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path


def draw_path(ax: Axes, robot: Robot, one: Operator) -> None:
    """The path of a foot, seen from the side, over obstacles of some sizes."""
    usual = sampled(cycle_of(SKILL), AT)
    for share in SHOWN:
        size = share * one.largest
        way = usual[:, 0] + size * one.path[:, 0] + size * one.landing * usual[:, 0]
        height = 100.0 * (robot.height * usual[:, 3] + size * one.path[:, 1])
        ax.plot(way, height, color=INK, linewidth=0.8 + share, alpha=0.35 + 0.65 * share,
                label=f"{100.0 * size:.1f} cm" if share else "no obstacle")  # fmt: skip
    ax.legend(fontsize=9, frameon=False, loc="upper left")
    ax.set_xlabel("share of the way")
    dress(ax, "height of the foot [cm]")


def draw_force(ax: Axes, one: Operator) -> None:
    """What it takes beyond the usual, per centimetre of obstacle."""
    for line, name, (_, colour) in zip(one.force.T, ("forward", "left", "up"), JOINTS, strict=True):
        ax.plot(AT, line / 100.0, color=colour, linewidth=1.3, label=name)
    ax.legend(fontsize=9, frameon=False, ncols=3, loc="upper right")
    ax.set_xlabel("share of the swing")
    dress(ax, "force on the foot [N per cm]")
