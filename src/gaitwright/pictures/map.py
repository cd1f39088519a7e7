"""The map: the ground from above, what stands on it, and the way."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon, Rectangle

from gaitwright.ground.holes import filled
from gaitwright.ground.scene import Scene
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from gaitwright.pictures.ground import HIGH, LOW_EDGE, PIT, draw_things
from gaitwright.pictures.moving import LOOK, draw_moving
from gaitwright.pictures.style import EARTH, INK, MAP, SKILLS, dress
from gaitwright.pictures.thin import shown
from gaitwright.record.metrics import heading_over_time, stretches, touchdowns
from gaitwright.record.recording import Recording
from gaitwright.record.rows import parts

BODIES = 300
"""Outlines of the body at most."""
NAMED = 11
"""Things in a line of the legend at most."""
AT_ONCE = 8192
"""Ticks that are searched for footfalls at once."""


def draw_map(ax: Axes, r: Recording, scene: Scene) -> None:
    """The ground from above, what stands on it, footprints, and the way in the colours of the skills."""
    way, skill = shown(r.channel("position_w"))[:, :2], shown(r.channel("skill"))
    bounds = view(r, way)
    draw_ground(ax, r, scene, bounds)
    draw_footprints(ax, r)
    draw_bodies(ax, r, way)
    ax.plot(*way.T, color="white", linewidth=5.0, zorder=4, solid_capstyle="round")
    for start, end in stretches(skill):
        piece = way[start : end + 1]
        colour = SKILLS.get(r.skills[int(skill[start])], INK)
        ax.add_collection(LineCollection([piece], colors=colour, linewidths=2.6, zorder=5, capstyle="round"))
    ends = {"edgecolors": "white", "linewidths": 1.2, "zorder": 6}
    ax.scatter(*way[0], s=110, marker="o", c=INK, **ends)
    ax.scatter(*way[-1], s=230, marker="*" if r.arrived else "X", c=INK, **ends)
    ax.set(xlim=bounds[::2], ylim=bounds[1::2], aspect="equal", xlabel="x [m]", ylabel="y [m]")
    dress(ax, None)
    ax.grid(False)
    marker: dict[str, Any] = {"color": "none", "markerfacecolor": INK, "markeredgecolor": "white"}
    done = "arrived" if r.arrived else "end"
    handles: list[Artist] = [
        *(Line2D([], [], color=SKILLS.get(name, INK), linewidth=3, label=name) for name in r.skills),
        Line2D([], [], marker="o", markersize=10, label="start", **marker),
        Line2D([], [], marker="*" if r.arrived else "X", markersize=14, label=done, **marker),
        Line2D([], [], marker=".", color="none", markerfacecolor=INK, markeredgewidth=0, label="footfalls"),
    ]
    around = scene.obstacles(r.robot.step_limit)
    if any(solid not in around for solid in scene.solids):
        handles.append(Patch(facecolor="#d9c9a8", edgecolor=LOW_EDGE, label="low: stepped on"))
    if scene.holes:
        handles.append(Patch(facecolor=PIT, label="hole"))
    if scene.movers:
        handles.append(Patch(**LOOK, label="moves"))
    if around:
        handles.append(Patch(**HIGH, label="high: walked around"))
    rows = -(-len(handles) // NAMED)
    ax.legend(
        handles=handles,
        loc="upper left",
        ncols=-(-len(handles) // rows),
        frameon=True,
        framealpha=0.92,
        edgecolor="none",
    )


def view(r: Recording, way: np.ndarray) -> tuple[float, float, float, float]:
    """What the map shows: the way with some room, as wide as its axes; x_min, y_min, x_max, y_max [m]."""
    (x_min, y_min), (x_max, y_max) = way.min(axis=0), way.max(axis=0)
    room, wide = 2.2 * r.robot.body_length, MAP[0] / MAP[1]
    height = max(y_max - y_min + 3 * room, (x_max - x_min + 2 * room) / wide)
    x, y = (x_min + x_max) / 2, (y_min + y_max) / 2
    return x - height * wide / 2, y - height / 2, x + height * wide / 2, y + height / 2


def draw_ground(ax: Axes, r: Recording, scene: Scene, bounds: tuple[float, float, float, float]) -> None:
    """Height as shade, low boxes as plates, obstacles hatched."""
    ax.set_facecolor("#f4f1ea")
    extent = (bounds[0], bounds[2], bounds[1], bounds[3])
    x, y = np.linspace(*extent[:2], 600), np.linspace(*extent[2:], 300)
    level = filled(scene.surface, scene.holes)  # holes are drawn by their outlines
    height = np.asarray(level.height(x[None, :], y[:, None]))
    if np.ptp(height) > 1e-6:
        image = ax.imshow(height, extent=extent, origin="lower", cmap=EARTH, interpolation="bilinear")
        bar = ax.figure.colorbar(image, cax=ax.inset_axes((0.975, 0.06, 0.008, 0.8)))
        bar.ax.yaxis.set_ticks_position("left")
        ax.add_patch(
            Rectangle((0.935, 0.02), 0.063, 0.93, transform=ax.transAxes, color="white", alpha=0.85, zorder=4)
        )
        bar.ax.set_title("z [m]", fontsize=9, color=INK)
        bar.ax.tick_params(labelsize=9, colors=INK, length=2)
        bar.outline.set_visible(False)
    draw_things(ax, scene, scene.obstacles(r.robot.step_limit))
    draw_moving(ax, scene)


def draw_footprints(ax: Axes, r: Recording) -> None:
    """A dot wherever a foot came down."""
    dots = np.array(list(footprints(r))).reshape(-1, 2)
    ax.scatter(*dots.T, s=7, c=INK, alpha=0.45, linewidths=0, zorder=3)


def draw_bodies(ax: Axes, r: Recording, way: np.ndarray) -> None:
    """The outline of the body at even distances, for its size and heading; of a long way some of them."""
    corners = trunk_corners(r.robot)
    yaw = heading_over_time(shown(r.channel("orientation_wb")))
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])
    apart = max(2.5 * r.robot.body_length, gone[-1] / BODIES)
    for tick in np.searchsorted(gone, np.arange(0.0, gone[-1], apart)):
        c, s = np.cos(yaw[tick]), np.sin(yaw[tick])
        outline = corners @ np.array([[c, s], [-s, c]]) + way[tick]
        ax.add_patch(Polygon(outline, facecolor=INK, edgecolor=INK, alpha=0.2, linewidth=0, zorder=3.5))


def trunk_corners(robot: Robot) -> np.ndarray:
    """The outline of a robot's trunk seen from above, base axes x, y `(4, 2)` [m]."""
    (cx, cy, _), (hx, hy, _) = robot.trunk
    return np.array([[cx + sx * hx, cy + sy * hy] for sx, sy in ((1, 1), (-1, 1), (-1, -1), (1, -1))])


def footprints(r: Recording) -> Iterator[tuple[float, float]]:
    """Where the feet came down, as x, y [m]."""
    channels = [r.channel(name) for name in ("stance", "q", "position_w", "orientation_wb")]
    for part in parts(len(r), AT_ONCE):
        before = max(0, part.start - 1)
        stance, q, position, orientation = (channel[before : part.stop] for channel in channels)
        for tick, leg in touchdowns(stance > 0.5):
            if tick == 0 and part.start > 0:  # the tick before this part: it was looked at with its own
                continue
            foot_b = feet(r.robot, np.ascontiguousarray(q[tick].reshape(-1, 3)))[leg]
            foot = position[tick] + rotation(np.ascontiguousarray(orientation[tick])) @ foot_b
            yield float(foot[0]), float(foot[1])
