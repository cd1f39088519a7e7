"""What happened over time: speed, attitude, and the torques of every leg."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gaitwright.pictures.style import CYCLES, DRIVERS, INK, JOINTS, LEFT, MAP, STYLE, WIDTH, dress
from gaitwright.pictures.thin import column, shown, spread, step
from gaitwright.record.metrics import attitude, stretches
from gaitwright.record.recording import Recording
from gaitwright.record.rows import Lazy, Series, filled


def draw_speed(ax: Axes, r: Recording) -> None:
    """What was asked for, what was done, tick by tick and averaged over a cycle."""
    time, command, moved = shown(r.channel("time")), shown(r.channel("command")), r.motion()
    forward = column(moved, 0)
    ax.plot(*spread(r.channel("time"), forward), color="#1971c2", alpha=0.28, linewidth=0.8)
    ax.plot(time, smooth(forward, r), color="#1971c2", linewidth=1.8, label="forward, mean of a cycle")
    if np.abs(command[:, 1]).max() > 1e-3:
        left = smooth(column(moved, 1), r)
        ax.plot(time, left, color="#2f9e44", linewidth=1.8, label="left, mean of a cycle")
        ax.plot(time, command[:, 1], color=INK, linewidth=1.2, linestyle=(0, (4, 2)))
    ax.plot(time, command[:, 0], color=INK, linewidth=1.2, linestyle=(0, (4, 2)), label="asked for")
    draw_drivers(ax, r)
    over_time(ax, r, "speed [m/s]")


def draw_drivers(ax: Axes, r: Recording) -> None:
    """Who drove when, as a band along the bottom."""
    band = ax.get_xaxis_transform()  # x in seconds, y in shares of the axis
    last = float(r.at("time", len(r) - 1))
    for start, end in stretches(r.channel("driver")):
        number = int(r.at("driver", start))
        left, right = float(r.at("time", start)), float(r.at("time", end - 1))
        ax.fill_between(
            [left, right], 0.0, 0.09, transform=band, color=DRIVERS[number % len(DRIVERS)], linewidth=0
        )
        if right - left > 0.12 * last:
            text = f"driver: {r.drivers[number]}"
            ax.text(
                (left + right) / 2,
                0.043,
                text,
                transform=band,
                ha="center",
                va="center",
                fontsize=9,
                color="white",
            )


def draw_attitude(ax: Axes, r: Recording) -> None:
    orientation = r.channel("orientation_wb")
    angles = Lazy(len(r), lambda ticks: np.degrees(attitude(orientation[ticks])).T)
    for number, (name, colour) in enumerate((("roll", "#1971c2"), ("pitch", "#e8590c"))):
        line = spread(r.channel("time"), column(angles, number))
        ax.plot(*line, color=colour, linewidth=0.9, label=name)
    over_time(ax, r, "attitude [°]")


def over_time(ax: Axes, r: Recording, title: str) -> None:
    ax.set(xlim=(0.0, max(float(r.at("time", len(r) - 1)), r.dt)), xlabel="time [s]")
    ax.axhline(0.0, zorder=0, **STYLE)
    ax.margins(y=0.22)
    ax.legend(loc="upper right", ncols=3, frameon=True, framealpha=0.85, edgecolor="none", borderaxespad=0.2)
    dress(ax, title)


def smooth(values: Series, r: Recording) -> np.ndarray:
    """Mean over the last cycle of the gait, at the ticks that are drawn."""
    ticks = max(1, min(len(values), round(float(np.median(r["period"])) / r.dt)))
    total = np.zeros(len(values) + 1)
    np.cumsum(filled(values), out=total[1:])
    last = np.arange(0, len(values), step(len(values))) + 1
    first = np.maximum(last - ticks, 0)
    return (total[last] - total[first]) / (last - first)


def draw_torques(ax: Axes, r: Recording, leg: int) -> None:
    """The three torques of a leg as shares of their limits, over some cycles; stance is shaded."""
    part = window(r)
    time, stance = r.channel("time")[part], r.channel("stance")[part][:, leg] > 0.5
    share = r.channel("tau")[part][:, 3 * leg : 3 * leg + 3] / r.robot.tau_max[leg] * 100.0
    for start, end in stretches(stance):
        if stance[start]:
            ax.axvspan(time[start], time[end - 1], color="#e9ecef", linewidth=0, zorder=0)
    for joint, (name, colour) in enumerate(JOINTS):
        ax.plot(time, share[:, joint], color=colour, linewidth=1.3, label=name)
    for limit in (-100.0, 100.0):
        ax.axhline(limit, color="#c92a2a", linewidth=1.1, linestyle=(0, (5, 2)))
    ax.axhline(0.0, zorder=1, **STYLE)
    ax.set(xlim=(time[0], max(time[-1], time[0] + r.dt)), ylim=(-118, 118), yticks=(-100, -50, 0, 50, 100))
    ax.set_xlabel("time [s]")
    ax.locator_params(axis="x", nbins=6)
    dress(ax, f"{r.robot.legs[leg]}   torque [% of limit]" if leg == 0 else r.robot.legs[leg])
    if leg == 0:
        handles = [
            *ax.get_legend_handles_labels()[0],
            Line2D([], [], color="#c92a2a", linestyle=(0, (5, 2)), label="limit"),
            Patch(facecolor="#e9ecef", label="stance"),
        ]
        corner = ((LEFT + MAP[0]) / WIDTH, 0.004)
        ax.figure.legend(handles=handles, loc="lower right", bbox_to_anchor=corner, ncols=5, frameon=False)


def window(r: Recording) -> slice:
    """Some cycles in the middle of the longest stretch of one skill."""
    start, end = max(stretches(r.channel("skill")), key=lambda part: part[1] - part[0])
    ticks = round(CYCLES * float(r.at("period", start)) / r.dt)
    first = max(start, (start + end - ticks) // 2)
    return slice(first, min(first + ticks, end))
