"""Leg cycles as a picture: each skill's closed foot path with its points, and when which foot is down."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from gaitwright.files import whole
from gaitwright.gait.leg_cycles.check import Fault
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, sampled, seen_from_hip
from gaitwright.model.robot import Robot
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import FAINT, INK, LEFT, SKILLS, STYLE, WIDTH, dress
from gaitwright.signals import Gait

ACROSS = 4
"""Most skills side by side."""
GAP, TOP, CURVE, BETWEEN, BAR, BELOW = 0.62, 1.85, 1.75, 0.62, 0.17, 1.05
"""Between panels, above the first row, height of a curve, from curve to bars, a bar, below the bars [in]."""
WIDEST = 6.5
"""Greatest width of a panel [in]."""
WRONG = "#c92a2a"
OTHER = "#1971c2"
"""Colour of a skill that has none of its own."""
LABEL = 0.15
"""Distance of a number from its point [in]."""
AIR = np.linspace(0.0, 1.0, 201)


class Panel(NamedTuple):
    """One skill as it is drawn."""

    gait: Gait
    cycle: LegCycle
    speed: float
    """The speed at which it was checked [m/s]."""
    faults: tuple[Fault, ...] = ()


def cycles_picture(robot: Robot, panels: Sequence[Panel], path: str | Path) -> Path:
    """Draws the leg cycles of some skills of a robot as PNG."""
    across = min(ACROSS, len(panels))
    rows = -(-len(panels) // across)
    bars = BAR * robot.n
    sheet = Sheet(height=TOP + rows * (CURVE + BETWEEN + bars + BELOW) - 0.35)
    heading(sheet, robot, panels)
    width = min(WIDEST, (WIDTH - LEFT - 0.35 - GAP * (across - 1)) / across)
    highest = max(
        point[2] for panel in panels for hind in (False, True) for point in panel.cycle.points_of(hind)
    )
    for number, panel in enumerate(panels):
        row, column = divmod(number, across)
        left, top = LEFT + column * (width + GAP), TOP + row * (CURVE + BETWEEN + bars + BELOW)
        ax = sheet.axes(left, top, width, CURVE)
        ax.set(xlim=(-0.56, 0.56), ylim=(-0.16 * highest, 1.2 * highest), xticks=(-0.5, -0.25, 0, 0.25, 0.5))
        draw_curve(ax, panel, (width, CURVE))
        ax.set_ylabel("height [body heights]" if column == 0 else "")
        draw_phases(sheet.axes(left, top + CURVE + BETWEEN, width, bars), panel, robot)
    with whole(Path(path)) as draft:
        sheet.figure.savefig(draft, format="png")
    return Path(path)


def heading(sheet: Sheet, robot: Robot, panels: Sequence[Panel]) -> None:
    """Title, what the axes mean, and the legend."""
    names = list(dict.fromkeys(panel.cycle.name for panel in panels))
    what = f"Leg cycle{'s' if len(names) > 1 else ''} of {robot.name}: {', '.join(names)}"
    about = (
        f"Paths of the feet seen from the hip, {robot.height:.2f} m over the ground, as points "
        "(share of the swing, forward, height)"
    )
    left = LEFT / WIDTH
    sheet.figure.text(left, 1 - 0.42 / sheet.height, what, fontsize=19, fontweight="bold", color=INK)
    sheet.figure.text(left, 1 - 0.75 / sheet.height, about, fontsize=12, color=INK)
    handles: list[Artist] = [
        Line2D([], [], color=INK, linewidth=3.2, label="support: foot on the ground"),
        Line2D(
            [], [], color=OTHER, linewidth=1.8, marker="o", markersize=5, label="transfer, with its points"
        ),
    ]
    if any(panel.cycle.hind is not None for panel in panels):
        dashes = {"linestyle": (0, (4, 2)), "marker": "o", "markersize": 5, "markerfacecolor": "white"}
        handles.append(
            Line2D([], [], color=OTHER, linewidth=1.4, label="transfer of the hind legs", **dashes)
        )
    if any(panel.faults for panel in panels):
        ring = {"marker": "o", "markersize": 10, "markerfacecolor": "none", "linestyle": ""}
        handles.append(Line2D([], [], color=WRONG, label="what the robot cannot do", **ring))
    handles.append(Patch(facecolor=INK, label="bars: foot on the ground, by phase of the gait"))
    corner = (left - 0.008, 1 - 0.87 / sheet.height)
    sheet.figure.legend(
        handles=handles, loc="upper left", bbox_to_anchor=corner, ncols=5, frameon=False, fontsize=11
    )


# --- the closed path -------------------------------------------------------------------------------
def draw_curve(ax: Axes, panel: Panel, size: tuple[float, float]) -> None:
    """One closed path, its points numbered; `size`: of the axes [in]."""
    gait, cycle = panel.gait, panel.cycle
    half = 0.5 * gait.duty
    colour = SKILLS.get(gait.name, OTHER)
    ax.axvline(0.0, zorder=0, linestyle=(0, (1, 3)), **STYLE)
    ax.text(0.012, 0.05, "hip", transform=ax.get_xaxis_transform(), fontsize=9, color=FAINT, va="center")
    ax.plot((half, -half), (0.0, 0.0), color=INK, linewidth=3.2, solid_capstyle="butt", zorder=2)
    arrow(ax, (0.25 * half, 0.0), (-0.25 * half, 0.0), INK)
    for hind in (False, True) if cycle.hind is not None else (False,):
        x, z = place(panel, AIR, hind)
        ax.plot(x, z, color=colour, linewidth=1.4 if hind else 1.8, linestyle=(0, (4, 2)) if hind else "-")
        if not hind:
            arrow(ax, (x[84], z[84]), (x[88], z[88]), colour)
        draw_points(ax, panel, hind, size)
    dress(ax, gait.name)
    ax.set_xlabel("forward of the hip [strides]")
    figures = f"{panel.speed:.2f} m/s, stride {panel.speed * gait.period:.2f} m"
    ax.text(1.0, 1.045, figures, transform=ax.transAxes, ha="right", fontsize=10, color=INK)
    if panel.faults:
        words = "\n".join(f"{fault.kind} at {fault.point}" for fault in panel.faults)
        ax.text(0.012, 0.97, words, transform=ax.transAxes, va="top", fontsize=9, color=WRONG)


def place(panel: Panel, s: np.ndarray, hind: bool) -> tuple[np.ndarray, np.ndarray]:
    """Forward [strides] and height [body heights] at shares `s` of the swing, seen from the hip."""
    table = seen_from_hip(sampled(panel.cycle, s, hind), s, panel.gait.duty)
    return table[:, 0], table[:, 3]


def draw_points(ax: Axes, panel: Panel, hind: bool, size: tuple[float, float]) -> None:
    """The points with their numbers: outside the path those of the front legs, inside those of the hind."""
    x, z = place(panel, np.array([point[0] for point in panel.cycle.points_of(hind)]), hind)
    colour = SKILLS.get(panel.gait.name, OTHER)
    fill = "white" if hind else colour
    ax.plot(x, z, "o", markersize=5, color=colour, markerfacecolor=fill, zorder=3)
    (x_min, x_max), (z_min, z_max) = ax.get_xlim(), ax.get_ylim()
    inch = np.array([size[0] / (x_max - x_min), size[1] / (z_max - z_min)])
    away = (np.stack([x, z], axis=1) - (0.0, 0.4 * z.max())) * inch
    away *= (-1.0 if hind else 1.0) / np.maximum(np.linalg.norm(away, axis=1), 1e-9)[:, None]
    away[[0, -1]] = (0.0, -1.0)
    for i, (dx, dz) in enumerate(72.0 * LABEL * away):
        if hind and i in {0, len(x) - 1}:  # those of the front legs stand there
            continue
        ax.annotate(
            str(i + 1), (x[i], z[i]), (dx, dz), textcoords="offset points", ha="center", va="center",
            fontsize=9, color=INK, path_effects=[withStroke(linewidth=2.5, foreground="white")], zorder=5,
        )  # fmt: skip
    wrong = [fault.point - 1 for fault in panel.faults if fault.hind == hind]
    ax.plot(x[wrong], z[wrong], "o", markersize=10, markerfacecolor="none", color=WRONG, zorder=4)


def arrow(ax: Axes, start: tuple[float, float], end: tuple[float, float], colour: str) -> None:
    """An arrow head that says which way the foot goes."""
    look = {"arrowstyle": "-|>", "color": colour, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", end, start, arrowprops=look, zorder=3)


# --- the phases ------------------------------------------------------------------------------------
def draw_phases(ax: Axes, panel: Panel, robot: Robot) -> None:
    """A gait diagram after Hildebrand: a bar where a foot is down, over one cycle."""
    for leg, offset in enumerate(panel.gait.offsets):
        for start in (-offset % 1.0 - 1.0, -offset % 1.0):
            left, right = max(start, 0.0), min(start + panel.gait.duty, 1.0)
            if right > left:
                ax.barh(leg, right - left, left=left, height=0.62, color=INK, linewidth=0)
    ax.set(xlim=(0.0, 1.0), ylim=(robot.n - 0.45, -0.55), yticks=range(robot.n), yticklabels=robot.legs)
    ax.set(xticks=(0, 0.25, 0.5, 0.75, 1), xlabel="phase of the gait")
    dress(ax, None)
    ax.grid(False, axis="y")
    ax.tick_params(axis="y", length=0, labelsize=9)
