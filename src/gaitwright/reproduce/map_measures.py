"""How much of an obstacle terrain a learned map holds, and how a way goes through it (figure 6.11)."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float

Segments = Float[np.ndarray, "_ 4"]
"""x0, y0, x1, y1 [m]."""
FINE = 0.02
"""From place to place at which edges and ways are looked at [m]."""
BESIDE = 0.06
"""A piece that is nearer to an edge than this is of it [m]."""
MOST = 0.8
"""An edge is known where so much of it is."""


def edges_of(rims: Sequence[Float[np.ndarray, "_ 2"]]) -> Segments:
    """The edges of outlines."""
    return np.concatenate([np.empty((0, 4)), *(np.hstack([rim, np.roll(rim, -1, axis=0)]) for rim in rims)])


def are_known(edges: Segments, pieces: Segments) -> Bool[np.ndarray, " edges"]:
    """Which edges are known: pieces lie along the most of them."""
    shares = [float((distances(along(edge.reshape(2, 2)), pieces) <= BESIDE).mean()) for edge in edges]
    return np.array(shares) >= MOST


def near_share(
    way: Float[np.ndarray, "n 2"], lines: Sequence[Float[np.ndarray, "_ 2"]], within: float
) -> float:
    """The share of a way that is nearer than `within` [m] to one of some lines."""
    pieces = [np.hstack([line[:-1], line[1:]]) for line in lines]
    return float((distances(along(way), np.concatenate([np.empty((0, 4)), *pieces])) <= within).mean())


def along(line: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "places 2"]:
    """Places on a line, evenly."""
    gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.linspace(0.0, gone[-1], max(2, round(gone[-1] / FINE) + 1))
    return np.column_stack([np.interp(at, gone, line[:, 0]), np.interp(at, gone, line[:, 1])])


def distances(places: Float[np.ndarray, "n 2"], pieces: Segments) -> Float[np.ndarray, " n"]:
    """How far places are from the nearest piece [m]; inf where there is none."""
    if not len(pieces):
        return np.full(len(places), np.inf)
    start, way = pieces[:, :2], pieces[:, 2:] - pieces[:, :2]
    away = places[:, None] - start
    length = np.maximum((way * way).sum(axis=1), 1e-18)
    share = np.clip((away * way).sum(axis=2) / length, 0.0, 1.0)
    return np.linalg.norm(away - share[..., None] * way, axis=2).min(axis=1)
