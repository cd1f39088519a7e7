"""How well a terrain curve agrees with the ground, and with the feet that stood on it (figures 6.9, 6.10)."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.record.metrics import stretches
from gaitwright.reproduce.seen_walk import FootPaths, TerrainCurve
from gaitwright.reproduce.strides import BREAK

BESIDE = 0.05
"""Beside an edge, up to here, a curve is told by the place of the edge instead of its height [m]."""
SETTLED = 0.5
"""Share of a stance after which a foot is taken to rest."""


class Agreement(NamedTuple):
    """How far curves are from the ground."""

    known: float
    """Share of the way of which the curve tells a height."""
    off: Float[np.ndarray, " places"]
    """Distances in height away from edges [m]."""
    edges: Float[np.ndarray, " edges"]
    """Distances of the edges along the way [m]; NaN where the curve has none."""


def agreement(curve: TerrainCurve, way: tuple[float, float]) -> Agreement:
    """Compares what was seen with what is there, from one x to another [m]."""
    on_way = (curve.x >= way[0]) & (curve.x <= way[1])
    x, seen, true = curve.x[on_way], curve.seen[on_way], curve.true[on_way]
    known = ~np.isnan(seen)
    at = np.flatnonzero(np.abs(np.diff(true)) > BREAK)
    places = 0.5 * (x[at] + x[at + 1])
    is_beside = (np.abs(x[:, None] - places) <= BESIDE).any(axis=1)
    off = np.abs(seen - true)[known & ~is_beside]
    edges = [
        edge_off(x[known], seen[known], place, true[k], true[k + 1])
        for place, k in zip(places, at, strict=True)
    ]
    return Agreement(float(known.mean()), off, np.array(edges))


def edge_off(
    x: Float[np.ndarray, " n"], seen: Float[np.ndarray, " n"], place: float, before: float, after: float
) -> float:
    """How far from an edge at `place`, between two heights, a curve goes through the middle of them [m].

    Where it tells nothing in between, the edge may be anywhere there.
    """
    above = seen > 0.5 * (before + after)
    crossings = np.flatnonzero((above[1:] != above[:-1]) & (above[1:] == (after > before)))
    away = np.maximum(np.maximum(x[crossings] - place, place - x[crossings + 1]), 0.0)
    return float(away.min()) if len(away) and away.min() <= 2.0 * BESIDE else float("nan")


def rests(feet: FootPaths, leg: int) -> Float[np.ndarray, "stances 2"]:
    """Where a foot rested, stance by stance: x and the height of its lowest point [m]."""
    stands: Bool[np.ndarray, " n"] = feet.swings[:, leg] < 0.5
    found = []
    for start, end in stretches(stands):
        if stands[start]:
            middle = start + int(SETTLED * (end - start))
            found.append(np.median(feet.place_w[middle:end, leg][:, [0, 2]], axis=0))
    return np.array(found).reshape(-1, 2)


def seen_at(curve: TerrainCurve, x: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """The curve at places along the way [m]; NaN where it tells nothing."""
    k = np.clip(np.searchsorted(curve.x, x), 1, len(curve.x) - 1)
    nearer = np.where(x - curve.x[k - 1] < curve.x[k] - x, k - 1, k)
    return curve.seen[nearer]
