"""GroundMap + place + direction → Scan: what the ground ahead is like (row V3)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.model.robot import Robot
from gaitwright.signals import Elevation, GroundMap, Scan

BEHIND, FAR, SEES = -1.0, 3.5, 8.0
"""The road begins this many body heights ahead of the base, under the hind feet; it ends here; obstacles are
seen this far."""
SPACING = 0.14
"""From sample to sample of the road, in body heights: over this a rise or a drop is sudden."""
WIDE = 8
"""Ground beyond a gap of so many samples at most is reached from the ground before it."""
LANES = (-1.0, 0.0, 1.0)
"""Lanes beside each other, in half track widths."""
DEEP = 0.35
"""Ground this much lower than both sides is a gap, in body heights."""


@dataclass(frozen=True)
class Scanner:
    """Looks at what is known of the ground from a robot's place. Less than 0.3 ms a look."""

    height: float
    """Of the body [m]."""
    half_track: float
    """Half the width between left and right feet [m]."""

    @classmethod
    def of(cls, robot: Robot) -> "Scanner":
        """The eyes of a robot."""
        return cls(robot.height, float(abs(robot.nominal_feet[:, 1]).max()))

    def look(self, ground: GroundMap, place: Sequence[float] | np.ndarray, yaw: float) -> Scan | None:
        """The ground ahead of a place x, y [m] in direction `yaw` [rad]; `None` where it is not known."""
        if ground.elevation is None:
            return None
        h = self.height
        along = np.concatenate([np.arange(BEHIND, FAR, SPACING), np.arange(FAR, SEES, 2 * SPACING)]) * h
        known = self.heights(ground.elevation, place, yaw, along)
        if np.isnan(known).all():
            return None
        seen, obstacle = in_sight(along, carried_on(known), ground.step)
        road = along < FAR * h - 1e-9
        along, seen = along[road], seen[:, road]
        gap = widest_gap(along, seen.min(axis=0), DEEP * h)
        solid = seen if gap == 0.0 else bridged(seen, DEEP * h)
        slope = mean_slope(along, solid.mean(axis=0))
        left_over = solid - slope * along
        sudden = np.diff(left_over, axis=1)
        return Scan(
            slope=math.atan(slope),
            cross=math.atan((solid[-1] - solid[0]).mean() / (2.0 * self.half_track)),
            roughness=float(left_over.std(axis=1).max()),
            step_up=max(0.0, float(sudden.max())),
            step_down=max(0.0, -float(sudden.min())),
            gap=gap,
            obstacle=obstacle,
            course=yaw,
            friction=ground.friction,
        )

    def heights(
        self, elevation: Elevation, place: Sequence[float] | np.ndarray, yaw: float, along: np.ndarray
    ) -> np.ndarray:
        """Heights of the ground at distances ahead `(n,)` in each lane `(lanes, n)` [m]."""
        beside = self.half_track * np.array(LANES)[:, None]
        x = place[0] + math.cos(yaw) * along - math.sin(yaw) * beside
        y = place[1] + math.sin(yaw) * along + math.cos(yaw) * beside
        return np.array(elevation.height(x, y), dtype=float)


def carried_on(heights: Float[np.ndarray, "lanes n"]) -> Float[np.ndarray, "lanes n"]:
    """Ground that is not known (NaN) goes on as the known ground before it, or comes as the first behind it.

    A lane of which nothing is known is as the mean of the others.
    """
    unknown = np.isnan(heights)
    if not unknown.any():
        return heights
    known = ~unknown.all(axis=1)
    last = np.maximum.accumulate(np.where(unknown, -1, np.arange(heights.shape[1])), axis=1)
    first = unknown.argmin(axis=1)[:, None]
    out = np.take_along_axis(heights, np.where(last < 0, first, last), axis=1)
    out[~known] = out[known].mean(axis=0)
    return out


def in_sight(
    along: Float[np.ndarray, "n"], heights: Float[np.ndarray, "lanes n"], step: float
) -> tuple[Float[np.ndarray, "lanes n"], float]:
    """The ground before what is too high to step on, and how far ahead that is [m]; inf where nothing is.

    An obstacle hides what is behind it: there the ground is taken to go on as it was.
    """
    rises = [heights[:, WIDE:] - heights[:, WIDE - k : heights.shape[1] - k] for k in range(1, WIDE + 1)]
    wall = np.zeros((len(heights), len(along) - 1), dtype=bool)
    wall[:, WIDE - 1 :] = (np.min(rises, axis=0) > step) & (along[WIDE:] > 0.0)
    seen, nearest = heights.copy(), math.inf
    for lane, blocked in enumerate(wall):
        if blocked.any():
            first = int(blocked.argmax())
            seen[lane, first + 1 :] = heights[lane, first]
            nearest = min(nearest, float(along[first + 1]))
    return seen, nearest


def mean_slope(along: Float[np.ndarray, "n"], heights: Float[np.ndarray, "n"]) -> float:
    """Metres of rise per metre of way, by least squares."""
    away = along - along.mean()
    return float(away @ heights / (away @ away))


def holes(heights: np.ndarray, deep: float) -> np.ndarray:
    """Where the ground lies deeper than `deep` [m] under what came before and what follows."""
    before = np.maximum.accumulate(heights, axis=-1)
    after = np.maximum.accumulate(heights[..., ::-1], axis=-1)[..., ::-1]
    return np.minimum(before, after) - heights > deep


def widest_gap(along: Float[np.ndarray, "n"], heights: Float[np.ndarray, "n"], deep: float) -> float:
    """Width of the widest hole [m], zero where there is none."""
    inside = np.concatenate([[False], holes(heights, deep), [False]])
    edges = np.flatnonzero(np.diff(inside.astype(int)))
    runs = edges[1::2] - edges[::2]
    return float(runs.max() * (along[1] - along[0])) if len(runs) else 0.0


def bridged(heights: Float[np.ndarray, "lanes n"], deep: float) -> Float[np.ndarray, "lanes n"]:
    """The ground with its holes filled."""
    before = np.maximum.accumulate(heights, axis=-1)
    after = np.maximum.accumulate(heights[..., ::-1], axis=-1)[..., ::-1]
    return np.where(holes(heights, deep), np.minimum(before, after), heights)
