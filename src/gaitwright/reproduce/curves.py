"""The twelve joint torques over a cycle as one picture: legs side by side, joints below each other."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.typing import LineStyleType

from gaitwright.gait.desired_cycle import DesiredCycle
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import LEFT, STYLE, WIDTH, dress
from gaitwright.reproduce.patterns import KNEE, PSI, THETA

ROWS = (
    (THETA, r"hip elevation  $\tau_\theta$"),
    (KNEE, r"knee  $\tau_k$"),
    (PSI, r"hip azimuth  $\tau_\psi$"),
)
"""From the top, as they matter."""
LOOKS: tuple[tuple[str, LineStyleType, float], ...] = (
    ("#0072b2", "-", 2.0),
    ("#d55e00", (0, (4, 1.5)), 1.8),
)
"""Colour, dashes and width of the robots: blue and vermilion, told apart by the colour-blind too."""
SWING, LIMIT = "#e9ecef", "#6b7280"
GAP, TOP, ROW, BOTTOM = 0.55, 1.35, 2.25, 0.2
"""Between the legs, above the first row, from row to row, below the last [in]."""


class Curves(NamedTuple):
    """One robot's torques in the thesis's sense."""

    label: str
    torques: np.ndarray
    """`(steps, 4, 3)` as (ψ, θ_h, θ_k) [N·m]."""


def draw_curves(
    path: Path, words: tuple[str, str], cycle: DesiredCycle, robots: Sequence[Curves], limit: float
) -> None:
    """Draws a PNG under a title and a line of `words`; the swing phases of `cycle` are shaded."""
    sheet = Sheet(height=TOP + 3 * ROW + BOTTOM)
    sheet.head(*words)
    width = (WIDTH - LEFT - 0.3 - 3 * GAP) / 4
    for row, (joint, name) in enumerate(ROWS):
        low, high = span(robots, joint, limit)
        for leg in range(4):
            ax = sheet.axes(LEFT + leg * (width + GAP), TOP + row * ROW, width, ROW - 0.72)
            draw_joint(ax, cycle, robots, leg, joint)
            ax.set_ylim(low, high)
            if high > limit:
                ax.axhline(limit, color=LIMIT, linewidth=1.1, linestyle=(0, (2, 2)))
            over = f"leg {leg + 1} ({cycle.robot.legs[leg]})"
            dress(ax, f"{over}   {name} [N·m]" if row == 0 else f"{name} [N·m]")
            ax.set_xlabel("time [s]" if row == 2 else "")
    handles = [
        *(Line2D([], [], color=c, linestyle=d, linewidth=w, label=robot.label)
          for robot, (c, d, w) in zip(robots, LOOKS, strict=False)),
        Patch(facecolor=SWING, label="swing"),
        Line2D([], [], color=LIMIT, linestyle=(0, (2, 2)), label="limit of the motors"),
    ]  # fmt: skip
    corner = (LEFT / WIDTH - 0.008, 0.0)
    sheet.figure.legend(
        handles=handles, loc="lower left", bbox_to_anchor=corner, ncols=4, frameon=False, fontsize=11
    )
    sheet.figure.savefig(path, format="png")


def draw_joint(ax: Axes, cycle: DesiredCycle, robots: Sequence[Curves], leg: int, joint: int) -> None:
    """One torque of one leg, over swing phases shaded."""
    period = cycle.gait.period
    time = np.append(cycle.time, period)
    swings = ~cycle.stance[:, leg]
    for part in np.split(np.arange(cycle.steps), np.flatnonzero(np.diff(swings)) + 1):
        if swings[part[0]]:
            ax.axvspan(float(time[part[0]]), float(time[part[-1] + 1]), color=SWING, linewidth=0, zorder=0)
    ax.axhline(0.0, zorder=1, **STYLE)
    for robot, (colour, dashes, thick) in zip(robots, LOOKS, strict=False):
        values = robot.torques[:, leg, joint].round(3)
        ax.plot(
            time,
            np.append(values, values[-1]),
            color=colour,
            linestyle=dashes,
            linewidth=thick,
            drawstyle="steps-post",
        )
    ax.set(xlim=(0.0, period), xticks=np.linspace(0.0, period, 5))


def span(robots: Sequence[Curves], joint: int, limit: float) -> tuple[float, float]:
    """Lower and upper end of the axes of one joint, the same for all legs."""
    low = min(0.0, *(float(np.nanmin(robot.torques[..., joint])) for robot in robots))
    high = max(0.0, *(float(np.nanmax(robot.torques[..., joint])) for robot in robots))
    room = max(0.1 * (high - low), 0.01 * limit)
    return low - room, max(high + room, 1.13 * limit if high > 0.6 * limit else high + room)
