"""ElevationMap → the separate things that stand on the ground, each as a primitive with its doubt (row V2).

The thesis reduces what it meets to geometric primitives (5.4). Cells that rise above the ground and touch
each other are one thing; every kind of primitive is fitted to their heights, and the one is taken that
explains them best for its number of parameters. What none explains is an unknown shape. It is done on
request, not in every frame: a thing takes some 100 ms.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.least_squares import Fit, fit
from gaitwright.perception.elevation_map import ElevationMap
from gaitwright.perception.fusing import HIGH

UNKNOWN = "unknown shape"
FEWEST = 20
"""Cells that a thing has at least: fewer say nothing of its shape."""
NEAR = 2
"""Cells that lie no farther apart than this are of one thing: rays leave gaps."""
SKIRT = 3
"""Ground this many cells around a thing is fitted with it: it says where the thing ends."""
MISFIT = 0.18
"""A thing is of an unknown shape if the best fit is off by more than this share of its height. Boxes and
cylinders seen with 2 cm of noise are off by up to 0.17, crosses and angles by 0.18 to 0.3 without any."""
BARELY = 0.004
"""Residual below which no difference counts [m]: how the cells fall."""


@dataclass(frozen=True)
class Primitive:
    """One thing on the ground."""

    kind: str
    """box, cylinder, pyramid, wedge, sphere or unknown shape."""
    numbers: dict[str, float]
    """x, y of its middle, world [m]; yaw [rad], sides lx, ly or radius, height over the ground [m] …"""
    spread: dict[str, float]
    """Standard deviation of each; inf where what was seen does not fix it."""
    rms: float
    """How far the heights that were seen are from it [m]."""
    cells: int
    """Of how many cells it was made."""


class Patch(NamedTuple):
    """The cells of a thing and of the ground around it."""

    x: Float[np.ndarray, " n"]
    y: Float[np.ndarray, " n"]
    """World [m]."""
    z: Float[np.ndarray, " n"]
    """Over the ground [m]."""
    raised: Bool[np.ndarray, " n"]
    cell: float
    """Side [m]."""


def recognised(seen: ElevationMap) -> tuple[Primitive, ...]:
    """What stands on the ground that was seen, the largest first."""
    ground = ground_plane(seen)
    over = np.where(seen.split, seen.layer(HIGH), seen.heights) - ground
    raised = seen.known & (over > seen.edge)
    labels = np.zeros(raised.shape, np.int64)
    count = label(raised, NEAR, labels)
    found = []
    for k in range(1, count + 1):
        patch = patch_of(labels, k, over, ground, seen)
        if patch is not None:
            found.append(best(patch))
    return tuple(sorted(found, key=lambda one: -one.cells))


def ground_plane(seen: ElevationMap) -> Float[np.ndarray, "rows columns"]:
    """The plane of most of the known ground, fitted and trimmed three times [m]; zero where none is."""
    x, y = seen.places()
    rows, columns = np.nonzero(seen.known)
    if len(rows) < FEWEST:
        return np.zeros((seen.n, seen.n))
    z = seen.heights[rows, columns].astype(float)
    design = np.column_stack([x[columns], y[rows], np.ones(len(rows))])
    kept, plane = np.abs(z - np.median(z)) <= np.quantile(np.abs(z - np.median(z)), 0.8) + 1e-9, np.zeros(3)
    for _ in range(3):
        plane = np.linalg.lstsq(design[kept], z[kept], rcond=None)[0]
        off = np.abs(z - design @ plane)
        kept = off <= max(2.5 * float(np.median(off)), 0.5 * seen.edge)
    return plane[0] * x[None, :] + plane[1] * y[:, None] + plane[2]


def patch_of(
    labels: Int[np.ndarray, "rows columns"],
    k: int,
    over: Float[np.ndarray, "rows columns"],
    ground: Float[np.ndarray, "rows columns"],
    seen: ElevationMap,
) -> Patch | None:
    """The cells of thing `k` with a skirt of ground; `None` where they are too few.

    Things stand upright: on a slope, what is level stays so, over the ground in their middle.
    """
    (x, y), (rows, columns) = seen.places(), np.nonzero(labels == k)
    if len(rows) < FEWEST:
        return None
    row, column = max(rows.min() - SKIRT, 0), max(columns.min() - SKIRT, 0)
    part = np.s_[row : rows.max() + SKIRT + 1, column : columns.max() + SKIRT + 1]
    raised = labels[part] == k
    of_it = seen.known[part] & (raised | (labels[part] == 0))
    in_rows, in_columns = np.nonzero(of_it)
    upright = over + ground - float(ground[rows, columns].mean())
    z = np.where(raised, upright[part], over[part])[of_it].astype(float)
    z = np.where(raised[of_it], z, np.where(np.abs(z) <= seen.edge, z, 0.0))
    return Patch(x[column + in_columns], y[row + in_rows], z, raised[of_it], seen.spacing)


def best(patch: Patch) -> Primitive:
    """The primitive that explains a patch best for its number of parameters (Schwarz 1978)."""
    tried = {name: fitted(name, patch) for name in SHAPES}
    n = len(patch.z)

    def cost(name: str) -> float:
        return n * math.log(tried[name].rms ** 2 + BARELY**2) + len(tried[name].numbers) * math.log(n)

    kind = min(tried, key=cost)
    one, cells, top = tried[kind], int(patch.raised.sum()), float(np.quantile(patch.z[patch.raised], 0.95))
    if one.rms > max(MISFIT * top, BARELY):
        middle = {
            "x": float(patch.x[patch.raised].mean()),
            "y": float(patch.y[patch.raised].mean()),
            "height": top,
        }
        return Primitive(UNKNOWN, middle, dict.fromkeys(middle, patch.cell), one.rms, cells)
    names = SHAPES[kind].names
    numbers = dict(zip(names, map(float, one.numbers), strict=True))
    return Primitive(kind, numbers, dict(zip(names, map(float, one.spread), strict=True)), one.rms, cells)


# --- shapes ----------------------------------------------------------------------------------------
class Shape(NamedTuple):
    """A kind of primitive: its numbers, and its height at places beside its middle [m]."""

    names: tuple[str, ...]
    height: Callable[..., Float[np.ndarray, " n"]]
    """(dx, dy, cell, *numbers after x and y) → height; edges are as wide as a cell, so that it has slopes."""


def inside(away: Float[np.ndarray, " n"], cell: float) -> Float[np.ndarray, " n"]:
    """How much of a cell lies within an outline that is `away` from its middle, positive inside [m]."""
    return np.clip(0.5 + away / cell, 0.0, 1.0)


def along(dx: np.ndarray, dy: np.ndarray, yaw: float) -> tuple[np.ndarray, np.ndarray]:
    c, s = math.cos(yaw), math.sin(yaw)
    return c * dx + s * dy, c * dy - s * dx


def of_box(dx, dy, cell, yaw, lx, ly, height):
    u, v = along(dx, dy, yaw)
    return height * inside(0.5 * abs(lx) - np.abs(u), cell) * inside(0.5 * abs(ly) - np.abs(v), cell)


def of_cylinder(dx, dy, cell, radius, height):
    return height * inside(abs(radius) - np.hypot(dx, dy), cell)


def of_pyramid(dx, dy, cell, yaw, lx, ly, height):
    u, v = along(dx, dy, yaw)
    out = np.maximum(np.abs(u) / max(0.5 * abs(lx), cell), np.abs(v) / max(0.5 * abs(ly), cell))
    return height * np.maximum(1.0 - out, 0.0)


def of_wedge(dx, dy, cell, yaw, lx, ly, height):
    u, v = along(dx, dy, yaw)
    rise = np.clip(u / max(abs(lx), cell) + 0.5, 0.0, 1.0)
    return height * rise * inside(0.5 * abs(lx) - np.abs(u), cell) * inside(0.5 * abs(ly) - np.abs(v), cell)


def of_sphere(dx, dy, cell, radius, height):
    """A ball whose top is at `height`; what is under it is not seen."""
    outside = np.hypot(dx, dy)
    cap = height - abs(radius) + np.sqrt(np.maximum(radius * radius - outside * outside, 0.0))
    return np.maximum(cap, 0.0) * inside(abs(radius) - outside, cell)


RECT = ("x", "y", "yaw", "lx", "ly", "height")
ROUND = ("x", "y", "radius", "height")
SHAPES = {
    "box": Shape(RECT, of_box),
    "cylinder": Shape(ROUND, of_cylinder),
    "pyramid": Shape(RECT, of_pyramid),
    "wedge": Shape(RECT, of_wedge),
    "sphere": Shape(ROUND, of_sphere),
}


def fitted(kind: str, patch: Patch) -> Fit:
    """The best of a kind, begun from the outline of the thing, a wedge from each of its four sides."""
    shape = SHAPES[kind]

    def residuals(numbers: Float[np.ndarray, "numbers"]) -> Float[np.ndarray, " n"]:
        x, y, *others = numbers
        return shape.height(patch.x - x, patch.y - y, patch.cell, *others) - patch.z

    top = float(np.quantile(patch.z[patch.raised], 0.95))
    outline = shapely.MultiPoint(np.column_stack([patch.x, patch.y])[patch.raised]).buffer(0.5 * patch.cell)
    (ax, ay), (bx, by), (cx, cy) = shapely.get_coordinates(shapely.oriented_envelope(outline))[:3]
    x, y, yaw = 0.5 * (ax + cx), 0.5 * (ay + cy), math.atan2(by - ay, bx - ax)
    lx, ly = math.hypot(bx - ax, by - ay), math.hypot(cx - bx, cy - by)
    if shape.names == ROUND:
        starts = [np.array([x, y, 0.25 * (lx + ly), top])]
    else:
        turned = [(yaw, lx, ly), (yaw + 0.5 * math.pi, ly, lx)]
        turned += [(a + math.pi, p, q) for a, p, q in turned] if kind == "wedge" else []
        turned += [] if kind == "wedge" else [(yaw + 0.25 * math.pi, 0.7 * lx, 0.7 * ly)]
        starts = [np.array([x, y, a, p, q, top]) for a, p, q in turned]
    scale = np.array([patch.cell if name != "yaw" else 0.1 for name in shape.names])
    return min((fit(residuals, start, scale) for start in starts), key=lambda one: one.rms)


@kernel
def label(mask, near, labels):
    """Numbers the things of a mask from 1 on: cells no farther apart than `near` are of one; how many."""
    rows, columns = mask.shape
    stack, count = np.empty((mask.size, 2), np.int64), 0
    for i in range(rows):
        for j in range(columns):
            if not mask[i, j] or labels[i, j] > 0:
                continue
            count += 1
            labels[i, j], stack[0, 0], stack[0, 1], top = count, i, j, 1
            while top > 0:
                top -= 1
                a, b = stack[top, 0], stack[top, 1]
                for u in range(max(a - near, 0), min(a + near + 1, rows)):
                    for v in range(max(b - near, 0), min(b + near + 1, columns)):
                        if mask[u, v] and labels[u, v] == 0:
                            labels[u, v], stack[top, 0], stack[top, 1] = count, u, v
                            top += 1
    return count
