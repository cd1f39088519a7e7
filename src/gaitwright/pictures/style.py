"""What all parts of a picture share: sizes, colours, the quiet frame."""

from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap

WIDTH, DPI = 16.0, 100
"""1600 pixels, and as many as it takes from top to bottom."""
CYCLES = 5.0
"""Cycles of the gait that the torques are shown for."""
LEFT = 0.75
"""Left margin [in]."""
MAP = (15.0, 5.6)
"""Width and height of the map [in]."""
EARTH = LinearSegmentedColormap.from_list("earth", ["#fbfaf6", "#e8dcc0", "#b39b6d", "#7d6a45"])
"""From low to high."""
INK, FAINT = "#1d2733", "#8a94a0"
SKILLS = {
    "stand": "#6b7280",
    "walk": "#2f9e44",
    "trot": "#1971c2",
    "turn-in-place": "#e8590c",
    "run": "#c2255c",
    "pace": "#0c8599",
    "rack": "#5f3dc4",
    "pronk": "#e67700",
    "bound": "#862e9c",
    "gallop": "#a61e4d",
    "rotary-gallop": "#d6336c",
    "stop": "#868e96",
    "walk-backward": "#66a80f",
    "walk-sideways": "#37b24d",
    "climb": "#099268",
    "descend": "#1098ad",
    "turn-left": "#f76707",
    "turn-right": "#fd7e14",
    "tripod": "#1c7ed6",
    "ripple": "#40c057",
    "wave": "#74b816",
}
"""Every skill has its colour, the same in every picture."""
DRIVERS = ("#495057", "#2f9e44", "#e8590c", "#862e9c", "#1971c2")
JOINTS = (("hip 1", "#1971c2"), ("hip 2", "#e8590c"), ("knee", "#2f9e44"))
STYLE = {"color": FAINT, "linewidth": 0.8}


def dress(ax: Axes, title: str | None) -> None:
    """The same quiet frame for every axis."""
    ax.grid(True, color="#e3e7eb", linewidth=0.7)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_color("#b6bec7")
    ax.tick_params(colors=INK, labelsize=10, length=3)
    ax.xaxis.label.set(color=INK, size=10)
    ax.yaxis.label.set(color=INK, size=10)
    if title:
        ax.set_title(title, loc="left", fontsize=11, fontweight="bold", color=INK)
