"""How foot forces jump: the normal force of one foot, and how often jumps of which size occur."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from gaitwright.files import whole
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import LEFT, dress

COLOURS = ("#1971c2", "#2f9e44", "#e8590c")
SMALLEST = 1e-3
"""Jumps below this are drawn as this [N]."""
BINS = 36
JUMP = f"jump of a foot's force from one control step to the next [N]; smaller ones at {SMALLEST:g}"


def jumps_picture(
    forces: Mapping[str, np.ndarray], jumps: Mapping[str, np.ndarray], dt: float, path: Path
) -> Path:
    """Draws as PNG the normal force of a foot `(ticks,)` and all jumps [N], both by name."""
    sheet, first = Sheet(height=7.6), None
    for row, (name, colour) in enumerate(zip(forces, COLOURS, strict=False)):
        ax = sheet.axes(LEFT, 0.55 + 2.35 * row, 8.6, 1.75)
        if first is not None:
            ax.sharey(first)
        first = first or ax
        time = dt * np.arange(len(forces[name]))
        ax.plot(time, forces[name], color=colour, linewidth=1.1)
        ax.set(xlim=(0.0, dt * len(time)), xlabel="time [s]" if row == len(forces) - 1 else "")
        dress(ax, f"{name}: normal force of one foot [N]")
    ax = sheet.axes(LEFT + 9.4, 0.55, 5.5, 6.45)
    most = max(float(jump.max()) for jump in jumps.values())
    bins = np.geomspace(SMALLEST, max(1.1 * most, 10 * SMALLEST), BINS)
    for (name, jump), colour in zip(jumps.items(), COLOURS, strict=False):
        share = np.full(len(jump), 100.0 / len(jump))
        ax.hist(
            np.maximum(jump, SMALLEST), bins=list(bins), weights=share, histtype="step", color=colour,
            linewidth=1.8, label=name,
        )  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel=JUMP)
    ax.legend(loc="upper right", frameon=False)
    dress(ax, "share of all jumps [%]")
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path
