"""The support polygon: whether a point seen from above lies over the feet that stand (row V3)."""

import numpy as np
from jaxtyping import Float

Points = Float[np.ndarray, "n 2"]


def hull(points: Points) -> Float[np.ndarray, "corners 2"]:
    """Corners of the convex hull, anticlockwise (Andrew's monotone chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)
    return np.array(half_hull(ordered)[:-1] + half_hull(ordered[::-1])[:-1])


def half_hull(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """One side of the hull of points sorted by x."""
    kept: list[tuple[float, float]] = []
    for x, y in ordered:
        while len(kept) > 1:
            (ax, ay), (bx, by) = kept[-2:]
            if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0:
                break
            kept.pop()
        kept.append((x, y))
    return kept


def margins(corners: Float[np.ndarray, "corners 2"], points: Points) -> Float[np.ndarray, " n"]:
    """How far inside a convex polygon points lie [m]; negative outside, where it is a bound from below.

    A polygon of fewer than three corners holds nothing: minus the distance from its line.
    """
    if len(corners) < 3:
        return -distances(corners, points)
    inward = normals(corners)
    return (points @ inward.T - (corners * inward).sum(axis=1)).min(axis=1)


def normals(corners: Float[np.ndarray, "corners 2"]) -> Float[np.ndarray, "corners 2"]:
    """Unit normals of the edges, inwards; the edge from each corner to the next."""
    edge = np.roll(corners, -1, axis=0) - corners
    return np.stack([-edge[:, 1], edge[:, 0]], axis=1) / np.hypot(edge[:, 0], edge[:, 1])[:, None]


def distances(corners: Float[np.ndarray, "corners 2"], points: Points) -> Float[np.ndarray, " n"]:
    """Distance of points from a segment or a point [m]; infinite from nothing."""
    if not len(corners):
        return np.full(len(points), np.inf)
    start, way = corners[0], corners[-1] - corners[0]
    along = np.clip((points - start) @ way / max(float(way @ way), 1e-300), 0.0, 1.0)
    return np.linalg.norm(points - start - along[:, None] * way, axis=1)


def leaned(
    corners: Float[np.ndarray, "corners 2"], point: Float[np.ndarray, "2"], margin: float
) -> Float[np.ndarray, "2"]:
    """`point`, moved towards the polygon's middle until it lies `margin` inside [m], or to the middle."""
    middle = corners.mean(axis=0)
    if len(corners) < 3:
        return middle
    inward = normals(corners)
    at_point, at_middle = (((place - corners) * inward).sum(axis=1) for place in (point, middle))
    # Along the way the distance from each edge changes evenly; the last edge to be cleared decides.
    short, gain = np.maximum(margin - at_point, 0.0), at_middle - at_point
    needed = np.where(short > 0.0, short / np.where(gain > 1e-12, gain, 1e-12), 0.0)
    return point + min(1.0, float(needed.max())) * (middle - point)
