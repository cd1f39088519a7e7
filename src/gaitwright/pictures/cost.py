"""Cost of transport over speed, a curve for each gait."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from gaitwright.files import whole
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import LEFT, SKILLS, dress

MARKS = "osD^vPX<>"
"""Curves are told apart by their marks as well as by their colours."""


def cost_picture(curves: Mapping[str, Sequence[tuple[float, float]]], path: Path) -> Path:
    """Draws as PNG the cost of transport of each gait over its speed [m/s]."""
    sheet = Sheet(height=7.6)
    ax = sheet.axes(LEFT, 0.6, 12.3, 6.3)
    for (name, points), mark in zip(curves.items(), MARKS, strict=False):
        if points:
            speed, cost = zip(*points, strict=True)
            ax.plot(speed, cost, mark + "-", color=SKILLS[name], linewidth=1.8, markersize=6, label=name)
    top = max((min(cost for _, cost in points) for points in curves.values() if points), default=1.0)
    ax.set(xlabel="speed [m/s]", xlim=(0.0, None), ylim=(0.0, 2.5 * top))
    dress(ax, "cost of transport, ∫ Σ|τ q̇| dt / (m g distance)")
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False, fontsize=11)
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path
