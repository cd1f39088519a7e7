"""Outlines seen from above: simple polygons, mended where that can be, and cut into convex parts."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import shapely
from jaxtyping import Float
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

Outline = tuple[tuple[float, float], ...]
"""Corners of a simple polygon, anticlockwise, each once, x, y [m]."""

SAGITTA = 1e-3
"""The outline of a circle lies outside it, nowhere by more than this [m]."""
MOST_SIDES = 48
"""Of a circle's outline; of a large one the sagitta is larger."""
SNAP = 1e-3
"""Corners nearer to each other than this are one [m]: feet and maps know no less than a millimetre."""
FLATTEST = 1e-6
"""Corners may lie this much inside a convex part, over its size: less is rounding."""


def circle(x: float, y: float, radius: float) -> Float[np.ndarray, "corners 2"]:
    """Corners of a polygon around a circle, as near to it as maps need [m]."""
    sides = math.ceil(math.pi / math.acos(radius / (radius + SAGITTA)))
    sides = min(max(sides, 8), MOST_SIDES)
    return regular(x, y, radius / math.cos(math.pi / sides), sides)


def regular(x: float, y: float, radius: float, sides: int) -> Float[np.ndarray, "corners 2"]:
    """Corners of a polygon of equal sides in a circle [m]."""
    angle = 2.0 * math.pi * np.arange(sides) / sides
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + (x, y)


def outline_of(corners: Sequence[Sequence[float]] | np.ndarray) -> Outline:
    """Corners as an outline: plain numbers, anticlockwise."""
    ring = [(float(x), float(y)) for x, y in corners]
    area = sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in pairwise([*ring, ring[0]]))
    return tuple(ring if area >= 0.0 else ring[::-1])


def mended(corners: Sequence[tuple[float, float]]) -> tuple[Outline, str]:
    """The outline that a person's corners mean, and a sentence where something was mended.

    Raises `ValueError` with what is wrong where no outline comes of them.
    """
    ring: list[tuple[float, float]] = []
    for corner in corners:
        if not ring or math.dist(ring[-1], corner) > SNAP:
            ring.append(corner)
    while len(ring) > 1 and math.dist(ring[-1], ring[0]) <= SNAP:
        ring.pop()
    if len(ring) < 3:
        raise ValueError(f"has {len(ring)} different corners, and takes three or more")
    polygon = Polygon(ring)
    if polygon.convex_hull.area <= SNAP * SNAP:
        raise ValueError("has no area: its corners lie on a line")
    if not polygon.is_valid:
        why, _, where = shapely.is_valid_reason(polygon).rstrip("]").partition("[")
        x, y = (float(number) for number in where.split()[:2])
        raise ValueError(f"crosses itself at ({x:g}, {y:g})" if "Self" in why else why.lower())
    lost = len(corners) - len(ring)
    said = (
        f"{lost} corner{'s' if lost > 1 else ''} repeated or within 1 mm of the next left out" if lost else ""
    )
    return outline_of(ring), said


# --- convex parts ----------------------------------------------------------------------------------
def convex_parts(region: BaseGeometry) -> tuple[Float[np.ndarray, "_ 2"], ...]:
    """Convex polygons, anticlockwise, that fill a polygon or several: triangles, joined while the whole stays
    convex (Hertel and Mehlhorn, 1983). All corners of the region are corners of every part beside them."""
    parts = {k: outline_of(ring) for k, ring in enumerate(_triangles(region))}
    beside: dict[tuple, list[int]] = {}
    for k, part in parts.items():
        for edge in pairwise([*part, part[0]]):
            beside.setdefault(tuple(sorted(edge)), []).append(k)
    now = {k: k for k in parts}  # which part a triangle has become
    for edge, sides in sorted(beside.items(), key=lambda found: -math.dist(*found[0])):
        if len(sides) != 2:
            continue
        first, second = (_root(now, k) for k in sides)
        if first == second:
            continue
        whole = _joined(parts[first], parts[second], edge)
        if whole and _is_convex(whole):
            parts[first] = whole
            del parts[second]
            now[second] = first
    return tuple(np.array(part) for part in parts.values())


def _triangles(region: BaseGeometry) -> Iterator[list[tuple[float, float]]]:
    for polygon in getattr(region, "geoms", [region]):
        if isinstance(polygon, Polygon) and not polygon.is_empty:
            for triangle in shapely.constrained_delaunay_triangles(polygon).geoms:
                yield [(x, y) for x, y in shapely.get_coordinates(triangle)[:-1].tolist()]


def _root(now: dict[int, int], k: int) -> int:
    while now[k] != k:
        k = now[k]
    return k


def _joined(first: Outline, second: Outline, edge: tuple) -> Outline | None:
    """Two outlines that share an edge as one; none where they share more than it."""
    if len({*first} & {*second}) != 2:
        return None
    a, b = edge
    i, j = first.index(a), first.index(b)
    if (i + 1) % len(first) != j:
        a, b, i, j = b, a, j, i
    k = second.index(a)
    return (*first[j:], *first[:j], *(second[(k + n) % len(second)] for n in range(1, len(second) - 1)))


def _is_convex(ring: Outline) -> bool:
    around = np.array([*ring, *ring[:2]])
    side = np.diff(around, axis=0)
    turn = side[:-1, 0] * side[1:, 1] - side[:-1, 1] * side[1:, 0]
    length = np.hypot(*side.T)
    return bool((turn >= -FLATTEST * length[:-1] * length[1:]).all())
