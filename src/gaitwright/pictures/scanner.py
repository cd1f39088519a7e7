"""What the terrain scanner held at a moment, as a picture: from above, its attitude, and the ground ahead."""

import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon
from matplotlib.path import Path as Outline

from gaitwright.files import whole
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.perception.reach_outline import area_in, separate
from gaitwright.perception.terrain_preview import AHEAD, TerrainPreview, corners_of
from gaitwright.pictures import Sheet
from gaitwright.pictures.ground import Extent, draw_relief, draw_things
from gaitwright.pictures.map import trunk_corners
from gaitwright.pictures.style import FAINT, INK, LEFT, WIDTH, dress
from gaitwright.record.previews import PREFIX, series_of
from gaitwright.record.recording import Recording

LEGS = ("#1971c2", "#e8590c", "#2f9e44", "#862e9c", "#0c8599", "#c2255c", "#66a80f", "#e67700")
NOW, COMING, CRITICAL = "#2f9e44", "#1971c2", "#e03131"
ABOVE, SIDE, TALL = 1.5, 9.3, 8.6
"""Over the view from above, its width and height [in]."""
COLUMNS = ("foot", "carries", "critical", "reaches", "slope ahead", "z ahead")
PLACES = (0.0, 0.12, 0.27, 0.58, 0.81, 1.0)
"""Columns of the table, and where they stand: the first three from there on, the others up to there."""
ROOM = 0.12
"""Beside what is reached, as a share of it."""


def scanner_picture(recording: Recording, held: TerrainPreview, scene: Scene | None, path: Path) -> Path:
    """Draws one of the previews of a recording as PNG. `scene`: the ground, where it is to be had."""
    robot = recording.robot
    sheet = Sheet(height=ABOVE + TALL + 0.6)
    at, top = LEFT / WIDTH, sheet.height
    title = f"{robot.name} in {recording.scene or 'a scene'} at {held.time:.2f} s: {standing(robot, held)}"
    sheet.figure.text(at, 1 - 0.45 / top, title, fontsize=19, fontweight="bold", color=INK)
    sheet.figure.text(at, 1 - 0.78 / top, summary(robot, held), fontsize=12, color=INK)
    draw_above(sheet.axes(LEFT, ABOVE, SIDE, TALL), robot, held, scene)
    sheet.figure.legend(
        handles=handles(), loc="upper left", bbox_to_anchor=(at - 0.008, 1 - 0.88 / top), ncols=9,
        frameon=False, fontsize=10, handlelength=1.4, columnspacing=1.1,
    )  # fmt: skip
    left, width = LEFT + SIDE + 1.0, WIDTH - SIDE - LEFT - 1.4
    half = (width - 0.4) / 2
    draw_tilt(sheet.axes(left, ABOVE + 0.3, half, 1.5), robot, "pitch", held.pitch)
    draw_tilt(sheet.axes(left + half + 0.4, ABOVE + 0.3, half, 1.5), robot, "roll", held.roll)
    draw_ahead(sheet.axes(left, ABOVE + 2.45, width, 2.0), robot, held)
    draw_table(sheet.axes(left, ABOVE + 5.0, width, 0.3 * (robot.n + 1)), robot, held)
    under = ABOVE + 5.5 + 0.3 * (robot.n + 1)
    draw_margin(sheet.axes(left, under, width, ABOVE + TALL - under), recording, held)
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path


def standing(robot: Robot, held: TerrainPreview) -> str:
    """Whether it stands statically, and which feet it may not lift."""
    if not held.supporting.any():
        return "in the air"
    if held.margin < 0.0:
        return f"centre of gravity {cm(-held.margin)} outside its support"
    critical = [name for name, is_so in zip(robot.legs, held.critical, strict=True) if is_so]
    told = f"may not lift {', '.join(critical)}" if critical else "may lift any foot"
    return f"{cm(held.margin)} inside its support, {told}"


def summary(robot: Robot, held: TerrainPreview) -> str:
    """Attitude, and the mean of the ground ahead."""
    known = np.isfinite(held.slope)
    ground = "ground ahead not known"
    if known.any():
        mean, height = held.slope[known].mean(), round(held.elevation[known].mean(), 3) + 0.0
        ground = f"ground ahead on average {degrees(mean)} uphill, at z {height:.3f} m"
    return (
        f"supporting feet: {int(held.supporting.sum())} of {robot.n}   ·   pitch {degrees(held.pitch)}   ·   "
        f"roll {degrees(held.roll)}   ·   {ground}"
    )


def degrees(angle: float) -> str:
    """An angle [rad] with its sign."""
    return f"{round(math.degrees(angle), 1) + 0.0:+.1f}°" if math.isfinite(angle) else "?"


def cm(length: float) -> str:
    """A length [m]."""
    return f"{100.0 * length:.1f} cm"


# --- from above ------------------------------------------------------------------------------------
def draw_above(ax: Axes, robot: Robot, held: TerrainPreview, scene: Scene | None) -> None:
    """Feet, polygons, centre of gravity, reachable areas and heading, over the ground."""
    extent = view(robot, held)
    if scene is not None:
        draw_relief(ax, scene, extent)
        draw_things(ax, scene, scene.obstacles(robot.step_limit))
    ax.set(xlim=extent[:2], ylim=extent[2:], aspect="equal", xlabel="x [m]", ylabel="y [m]")
    dress(ax, None)
    ax.grid(False)
    for leg, outline in enumerate(held.reach_w):
        draw_reach(ax, outline, LEGS[leg % len(LEGS)])
    draw_body(ax, robot, held)
    polygons: tuple[tuple[np.ndarray, dict[str, Any]], ...] = (
        (held.lowered_w, {"edgecolor": FAINT, "linewidth": 1.4, "linestyle": ":", "facecolor": "none"}),
        (held.support_w, {"edgecolor": NOW, "linewidth": 3.2, "facecolor": (0.18, 0.62, 0.27, 0.18)}),
        (held.coming_w, {"edgecolor": COMING, "linewidth": 2.0, "linestyle": "--", "facecolor": "none"}),
    )
    for order, (polygon, style) in enumerate(polygons):
        corners = corners_of(polygon)
        if len(corners) > 1:
            ax.add_patch(Polygon(corners, closed=True, zorder=5.0 + 0.1 * order, **style))
    for leg in range(robot.n):
        draw_foot(ax, robot, held, leg)
    ax.plot(*held.centre_w, marker="o", color="white", markeredgecolor=INK, markersize=13, zorder=8)
    ax.plot(*held.centre_w, marker="+", color=INK, markersize=13, markeredgewidth=1.6, zorder=8.1)


def view(robot: Robot, held: TerrainPreview) -> Extent:
    """What is shown: all that is reached, as wide as the axes; x_min, x_max, y_min, y_max [m]."""
    around = held.position_w[:2] + robot.leg_length * np.array([[-1.0, -1.0], [1.0, 1.0]])
    points = np.concatenate(
        [held.reach_w.reshape(-1, 2), held.feet_w[:, :2], held.footholds_w[:, :2], around]
    )
    points = points[np.isfinite(points).all(axis=1)]
    (x_min, y_min), (x_max, y_max) = points.min(axis=0), points.max(axis=0)
    tall = (1.0 + ROOM) * max(y_max - y_min, (x_max - x_min) * TALL / SIDE)
    x, y, wide = (x_min + x_max) / 2, (y_min + y_max) / 2, tall * SIDE / TALL
    return x - wide / 2, x + wide / 2, y - tall / 2, y + tall / 2


def draw_reach(ax: Axes, outline: np.ndarray, shade: str) -> None:
    """The area that a foot reaches, without its holes."""
    rings = separate(outline)
    if not rings:
        return
    codes = [
        code
        for ring in rings
        for code in (Outline.MOVETO, *(len(ring) - 2) * [Outline.LINETO], Outline.CLOSEPOLY)
    ]
    area = Outline(np.concatenate(rings), codes)
    ax.add_patch(PathPatch(area, facecolor=shade, edgecolor="none", alpha=0.13, zorder=3))
    ax.add_patch(PathPatch(area, facecolor="none", edgecolor=shade, linewidth=1.1, alpha=0.8, zorder=3.1))


def draw_body(ax: Axes, robot: Robot, held: TerrainPreview) -> None:
    """The trunk's outline, and where it heads."""
    corners, (c, s) = trunk_corners(robot), (math.cos(held.yaw), math.sin(held.yaw))
    turn, (x, y) = np.array([[c, s], [-s, c]]), corners[[0, 3]].mean(axis=0)
    ax.add_patch(Polygon(corners @ turn + held.position_w[:2], facecolor=INK, alpha=0.10, zorder=4))
    nose = np.array([[x, y], [x + 0.45 * robot.height, y]]) @ turn + held.position_w[:2]
    ax.annotate(
        "", nose[1], nose[0], arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 2.0}, zorder=7
    )


def draw_foot(ax: Axes, robot: Robot, held: TerrainPreview, leg: int) -> None:
    """One foot: full where it supports, ringed where it may not be lifted; with its way where it swings."""
    shade, place = LEGS[leg % len(LEGS)], held.feet_w[leg, :2]
    face = shade if held.supporting[leg] else "white"
    ax.plot(*place, "o", color=face, markeredgecolor=shade, markersize=12, markeredgewidth=2.0, zorder=7)
    if held.critical[leg]:
        ax.plot(
            *place, "o", color="none", markeredgecolor=CRITICAL, markersize=22, markeredgewidth=2.4, zorder=7
        )
    style: dict[str, Any] = {"fontsize": 12, "fontweight": "bold", "color": shade, "zorder": 9}
    ax.annotate(robot.legs[leg], (place[0], place[1]), (9, 9), textcoords="offset points", **style)
    hold = held.footholds_w[leg, :2]
    if np.isfinite(hold).all():
        ax.plot(*np.stack([place, hold]).T, color=shade, linewidth=1.2, linestyle=":", zorder=6.5)
        ax.plot(*hold, "X", color=shade, markersize=10, markeredgecolor="white", zorder=7)


def handles() -> list[Artist]:
    """What the signs mean."""
    return [
        sign("supports", markerfacecolor=INK),
        sign("in the air", markerfacecolor="white"),
        sign("critical: may not be lifted", markerfacecolor="none", markeredgecolor=CRITICAL),
        sign("will land", marker="X", markerfacecolor=INK, markeredgecolor="white"),
        sign("centre of gravity", marker="$\\oplus$", markersize=13),
        Line2D([], [], color=NOW, linewidth=3.2, label="support polygon"),
        Line2D([], [], color=COMING, linewidth=2.0, linestyle="--", label="the coming one"),
        Line2D([], [], color=FAINT, linewidth=1.4, linestyle=":", label="all feet lowered at once"),
        Patch(facecolor=FAINT, alpha=0.3, edgecolor=FAINT, label="reached by a foot"),
    ]


def sign(label: str, **style: Any) -> Line2D:
    """A mark of the legend."""
    usual: dict[str, Any] = {"color": "none", "marker": "o", "markeredgecolor": INK, "markersize": 10}
    return Line2D([], [], label=label, **usual | style)


# --- beside it -------------------------------------------------------------------------------------
def draw_tilt(ax: Axes, robot: Robot, name: str, angle: float) -> None:
    """The trunk seen from the right (pitch) or from behind (roll), and its angle."""
    _, (hx, hy, hz) = robot.trunk
    half = hx if name == "pitch" else hy
    # Seen from the right x points right, from behind y points left: both turn clockwise on the page.
    c, s = math.cos(angle), math.sin(angle)
    box = np.array([[-half, -hz], [half, -hz], [half, hz], [-half, hz]]) @ np.array([[c, -s], [s, c]])
    reach = 1.25 * math.hypot(half, hz)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, linestyle=":")
    ax.add_patch(Polygon(box, facecolor="#dbe4ee", edgecolor=INK, linewidth=1.4))
    ax.plot([0.0, c * reach], [0.0, -s * reach], color=CRITICAL, linewidth=1.4)
    ax.set(xlim=(-reach, reach), ylim=(-0.8 * reach, 0.8 * reach), aspect="equal", xticks=[], yticks=[])
    side = ("nose down", "nose up") if name == "pitch" else ("right side down", "left side down")
    told = f"{name} {degrees(angle)}" + ("" if abs(angle) < 1e-3 else f", {side[angle < 0.0]}")
    ax.set_title(told, loc="left", fontsize=11, fontweight="bold", color=INK)
    for spine in ax.spines.values():
        spine.set_color("#b6bec7")


def draw_ahead(ax: Axes, robot: Robot, held: TerrainPreview) -> None:
    """Feet from the side, and mean height and slope of the ground ahead of each."""
    far, heading = AHEAD * robot.height, np.array([math.cos(held.yaw), math.sin(held.yaw)])
    along = (held.feet_w[:, :2] - held.position_w[:2]) @ heading
    for leg, place in enumerate(along):
        shade, slope, mean = LEGS[leg % len(LEGS)], held.slope[leg], held.elevation[leg]
        rise = 0.5 * far * math.tan(slope) if math.isfinite(slope) else math.nan
        ax.plot((place, place + far), (mean - rise, mean + rise), color=shade, linewidth=2.2)
        face = shade if held.supporting[leg] else "white"
        ax.plot(place, held.feet_w[leg, 2], "o", color=face, markeredgecolor=shade, markersize=8)
    low, high = ax.get_ylim()
    middle, least = (low + high) / 2, 0.4 * robot.height
    ax.set_ylim(min(low, middle - least / 2), max(high, middle + least / 2))
    ax.set(xlabel="along the heading from the base [m]", ylabel="z [m]")
    dress(ax, "ground ahead of each foot, from the side")


def draw_table(ax: Axes, robot: Robot, held: TerrainPreview) -> None:
    """A line for each foot."""
    ax.axis("off")
    ax.set(xlim=(0.0, 1.0), ylim=(robot.n + 1.0, 0.0))
    for row, cells in enumerate([COLUMNS, *(line_of(robot, held, leg) for leg in range(robot.n))]):
        for column, (place, cell) in enumerate(zip(PLACES, cells, strict=True)):
            shade = LEGS[(row - 1) % len(LEGS)] if row and not column else INK
            weight = "normal" if row and column else "bold"
            side = "right" if column > 2 else "left"
            ax.text(place, row + 0.5, cell, fontsize=11, color=shade, va="center", ha=side, fontweight=weight)


def line_of(robot: Robot, held: TerrainPreview, leg: int) -> tuple[str, ...]:
    """What the table says of a foot."""
    mean, area = held.elevation[leg], area_in(held.reach_w[leg])
    return (
        robot.legs[leg],
        "yes" if held.supporting[leg] else "–",
        "yes" if held.critical[leg] else "–",
        f"{area:.3g} m²" if area else "–",
        degrees(held.slope[leg]),
        f"{round(mean, 3) + 0.0:.3f} m" if math.isfinite(mean) else "?",
    )


def draw_margin(ax: Axes, recording: Recording, held: TerrainPreview) -> None:
    """How far inside the support polygon the centre of gravity was, over the run."""
    assert recording.previews is not None
    series = series_of(recording.previews, recording.robot.n)
    time, margin = (series[PREFIX + name][:] for name in ("time", "margin"))
    ax.axhline(0.0, color=FAINT, linewidth=0.8)
    ax.plot(time, margin, color=NOW, linewidth=1.2)
    ax.axvline(held.time, color=CRITICAL, linewidth=1.2)
    ax.set(xlabel="t [s]", ylabel="[m]", xlim=(time[0], max(time[-1], time[0] + 1e-3)))
    dress(ax, "centre of gravity inside its support, over the run")
