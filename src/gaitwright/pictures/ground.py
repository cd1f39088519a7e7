"""The ground from above: its relief, holes and patches, and what stands on it. Shared by trips and scenes."""

from collections.abc import Collection

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LightSource, Normalize
from matplotlib.patches import Polygon

from gaitwright.ground.holes import Hole, filled
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Solid
from gaitwright.pictures.style import EARTH, INK

GROUND, PIT, ICE = "#f4f1ea", "#6e5a3c", "#4dabf7"
HIGH = {"facecolor": "#c9ced6", "edgecolor": INK, "hatch": "////", "linewidth": 1.0}
"""What is walked around."""
LOW_EDGE = "#a8946c"
FINE = 700
"""Points of the relief along the longer side."""
LIGHT = LightSource(azdeg=315, altdeg=45)
FLATTEST = 1e-6
"""Ground that rises and falls by less has no relief [m]."""

Extent = tuple[float, float, float, float]
"""x_min, x_max, y_min, y_max [m], as matplotlib has it."""


def draw_relief(ax: Axes, scene: Scene, extent: Extent) -> None:
    """Ground and what slants on it, lit from the upper left; level ground is left plain."""
    ax.set_facecolor(GROUND)
    wide, high = extent[1] - extent[0], extent[3] - extent[2]
    columns = max(round(FINE * min(1.0, wide / high)), 2)
    rows = max(round(FINE * min(1.0, high / wide)), 2)
    x, y = np.linspace(*extent[:2], columns), np.linspace(*extent[2:], rows)
    heights = np.asarray(scene.height(x[None, :], y[:, None]), dtype=float)
    level = filled(scene.surface, scene.holes)  # holes are drawn by their outlines
    ground = np.asarray(level.height(x[None, :], y[:, None]), dtype=float)
    heights = np.maximum(heights, ground)
    if np.ptp(heights) < FLATTEST:
        return
    low, top = float(ground.min()), float(ground.max())
    norm = Normalize(low, max(top, low + 0.3 * float(np.ptp(heights)), low + FLATTEST))
    steep = 2.0 if np.ptp(ground) > FLATTEST else 1.0
    lit = LIGHT.shade(
        heights, EARTH, norm=norm, blend_mode="soft", vert_exag=steep, dx=wide / columns, dy=high / rows
    )
    if np.ptp(ground) < FLATTEST:
        lit[..., 3] = heights > ground + FLATTEST  # level ground is left plain
    ax.imshow(lit, extent=extent, origin="lower", interpolation="bilinear", zorder=1)


def draw_things(ax: Axes, scene: Scene, obstacles: Collection[Solid | Hole]) -> None:
    """Patches, holes, low things as plates, and hatched what is walked around."""
    for patch in scene.patches:
        ax.add_patch(Polygon(patch.corners(), facecolor=ICE, edgecolor=ICE, alpha=0.35, zorder=1.5))
        ax.annotate(f"μ {patch.friction:g}", patch.corners().mean(axis=0), ha="center", color=INK, zorder=3)
    around = set(obstacles)
    for hole in scene.holes:
        edge = INK if hole in around else PIT
        width = 1.6 if hole in around else 0.8
        ax.add_patch(Polygon(hole.corners(), facecolor=PIT, edgecolor=edge, linewidth=width, zorder=1.8))
    low = [solid for solid in scene.solids if solid not in around]
    tallest = max((scene.top(solid) for solid in low), default=1.0)
    for solid in low:
        shade = 0.25 + 0.55 * min(max(scene.top(solid), 0.0) / max(tallest, 1e-9), 1.0)
        face = (0.72, 0.60, 0.36, shade if is_level(solid) else 0.15)
        ax.add_patch(Polygon(solid.corners(), facecolor=face, edgecolor=LOW_EDGE, linewidth=0.8, zorder=2))
    for one in around:
        if not isinstance(one, Hole):
            ax.add_patch(Polygon(one.corners(), zorder=2.2, **HIGH))


def is_level(solid: Solid) -> bool:
    """Whether the top of a solid is of one height: of one that slants the relief is to be seen."""
    return type(solid).__name__ in ("Box", "Cylinder", "Prism")
