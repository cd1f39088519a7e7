"""ElevationMap → what feet and eyes read: an `ElevationGrid`, and an `Elevation`.

What is unknown must do no harm. No foot stands there: to feet it is an edge, and where more of it lies
together than rays leave out, so is the rim around it: it may be that of a hole. Its height is that of the
nearest known place, so that a swing over it lifts the foot no more than its surroundings ask, a shank finds
room, and nothing looks like a step or a hole that nobody saw. Eyes are told NaN.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32

from gaitwright.ground.elevation import MARGIN
from gaitwright.ground.footholds import RIM
from gaitwright.ground.terrain import STEEPEST, Number
from gaitwright.numerics.compiled import kernel
from gaitwright.perception.elevation_map import ElevationMap
from gaitwright.perception.fusing import HEIGHT, HIGH, LOW, PROOF, VARIANCE, slot
from gaitwright.signals import ElevationGrid

BRIDGED = 2
"""So many unknown cells between two that lie level with each other, along both rows and columns, are ground
like them, and a single one along either: rays leave such gaps, and they are narrower than a foot. In the
corner of a hole there are some along one of them alone."""

VAGUE = 2.0
"""A break must be more than an edge by so many standard deviations of what was seen, or be twice one [-]."""
FAR = 30_000
"""Cells away: there is none."""


def footholds_of(seen: ElevationMap) -> ElevationGrid:
    """The ground for feet: nodes are the middles of the map's cells."""
    heights, edges, known = (np.empty((seen.n, seen.n)) for _ in range(3))
    steep = STEEPEST * MARGIN * seen.spacing
    write_grid(seen.cells, seen.first, (seen.edge, steep), seen.proof, heights, edges, known)
    row, column = seen.first
    return ElevationGrid(np.array([column * seen.spacing, row * seen.spacing, seen.spacing]), heights, edges)


@dataclass(frozen=True, eq=False)
class SeenElevation:
    """Heights at places as they were seen (an `Elevation`); NaN where nothing was."""

    seen: ElevationMap

    def height(self, x: Number, y: Number) -> Float[np.ndarray, "..."]:
        """Height of the ground in the cells that hold places x, y [m]."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        (first_row, first_column), n = self.seen.first, self.seen.n
        row = np.floor(y / self.seen.spacing + 0.5).astype(int)
        column = np.floor(x / self.seen.spacing + 0.5).astype(int)
        inside = (
            (row >= first_row)
            & (row < first_row + n)
            & (column >= first_column)
            & (column < first_column + n)
        )
        return np.where(inside, self._heights[row % n, column % n], np.nan)

    @cached_property
    def _heights(self) -> Float32[np.ndarray, "n n"]:
        return self.seen.cells[:, :, HEIGHT]


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def write_grid(cells, first, limits, proof, heights, edges, known):
    """Writes heights [m], edges and what is known (0, 1) of a map's window, in the order of the world.

    `limits`: a break by more than the first, or a rise by more than the second [m], is an edge.
    Ground is what has so many more hits than looks through as `proof` says.
    """
    n, (edge, steep) = cells.shape[0], limits
    for u in range(n):
        i, before = slot(first[0] + u, n), slot(first[1], n)
        for v in range(n):
            j = before + v if before + v < n else before + v - n
            known[u, v] = 1.0 if cells[i, j, VARIANCE] < math.inf and cells[i, j, PROOF] >= proof else 0.0
            split = cells[i, j, HIGH] - cells[i, j, LOW] > edge
            heights[u, v] = cells[i, j, HIGH] if split else cells[i, j, HEIGHT]
            edges[u, v] = 1.0 if split else 0.0
    hidden = np.zeros((n, n), np.uint8)
    somewhere = fill(heights, known, edge, proof > -math.inf, hidden)
    mark_breaks(heights, known, edge, steep, edges, cells, first)
    mark_rims(hidden, edges)
    for u in range(n):
        for v in range(n):
            edges[u, v] = max(edges[u, v], 1.0 - known[u, v])
            heights[u, v] = somewhere if math.isnan(heights[u, v]) else heights[u, v]


@kernel
def fill(heights, known, edge, doubts, hidden):
    """Gives unknown cells the height of the nearest known one in their row or column; bridges small gaps.

    Those with nothing known in either stay NaN; a height that is known is given for them. Bridged ones become
    known; `hidden` are those in gaps wider than that along both, or, to one who `doubts`, all others.
    """
    n, last = heights.shape[0], 0.0
    west, south = np.empty((n, n), np.int16), np.empty((n, n), np.int16)
    for u in range(n):  # how many cells away the last known one is
        for v in range(n):
            west[u, v] = 0 if known[u, v] > 0.0 else west[u, v - 1] + 1 if v > 0 else FAR
            south[u, v] = 0 if known[u, v] > 0.0 else south[u - 1, v] + 1 if u > 0 else FAR
            last = heights[u, v] if known[u, v] > 0.0 else last
    north = np.full(n, FAR, np.int64)
    for u in range(n - 1, -1, -1):
        east = FAR
        for v in range(n - 1, -1, -1):
            if known[u, v] > 0.0:
                north[v], east = 0, 0
                continue
            north[v] += 1
            east += 1
            w, s = west[u, v], south[u, v]
            hidden[u, v] = doubts or min(w + east, s + north[v]) > BRIDGED + 1
            near = min(w, east, s, north[v])
            if near >= FAR:
                heights[u, v] = math.nan
                continue
            a, b, z_a, z_b = w, east, math.nan, math.nan
            if min(s, north[v]) < min(w, east):
                a, b = s, north[v]
                z_a = heights[u - a, v] if a < FAR else z_a
                z_b = heights[u + b, v] if b < FAR else z_b
            else:
                z_a = heights[u, v - a] if a < FAR else z_a
                z_b = heights[u, v + b] if b < FAR else z_b
            heights[u, v] = z_a if a < b else z_b
            narrow = a + b <= 2 or max(w + east, s + north[v]) <= BRIDGED + 1
            if narrow and abs(z_a - z_b) <= edge:
                heights[u, v], known[u, v], hidden[u, v] = (b * z_a + a * z_b) / (a + b), 1.0, 0
    return last


@kernel
def mark_rims(hidden, edges):
    """Marks the cells up to `MARGIN` away from those that are `hidden`."""
    n = hidden.shape[0]
    for u in range(MARGIN, n - MARGIN):
        for v in range(MARGIN, n - MARGIN):
            if not hidden[u, v] or (
                hidden[u, v - 1] and hidden[u, v + 1] and hidden[u - 1, v] and hidden[u + 1, v]
            ):
                continue
            for du in range(-MARGIN, MARGIN + 1):
                for dv in range(abs(du) - MARGIN, MARGIN - abs(du) + 1):
                    edges[u + du, v + dv] = max(edges[u + du, v + dv], RIM)


@kernel
def doubt(cells, first, u, v, du, dv, middle):
    """Standard deviation of a break in a node of the window between two beside it [m], or, where the `middle`
    does not count, of the rise from the one to the other."""
    n, variance = cells.shape[0], 0.0
    for k in range(-1, 2):
        of = cells[slot(first[0] + u + k * du, n), slot(first[1] + v + k * dv, n), VARIANCE]
        variance += (middle if k == 0 else 1.0) * of if of < math.inf else 0.0
    return math.sqrt(variance)


@kernel
def mark_breaks(heights, known, step, steep, edges, cells, first):
    """The law of `ground.elevation.edges`: 1 where the ground breaks by more than `step` [m] near by, or
    rises by more than `steep` [m] from the node before to the one behind.

    It is seen by two places at least: what the unknown was filled with makes none. Nor does noise.
    """
    n, half = heights.shape[0], MARGIN // 2
    broken = np.zeros((n, n), np.uint8)
    for u in range(half, n - half):  # first where there may be one at all: this is quick
        for v in range(half, n - half):
            most, rise, twice = 0.0, 0.0, 2.0 * heights[u, v]
            for du, dv in ((0, half), (half, 0), (half, half), (half, -half)):
                before, after = heights[u - du, v - dv], heights[u + du, v + dv]
                most = max(most, abs(before - twice + after))
                rise = max(rise, abs(after - before))
            broken[u, v] = most > step or rise > steep
    for u in range(half, n - half):
        for v in range(half, n - half):
            if broken[u, v] == 0:
                continue
            for du, dv in ((0, half), (half, 0), (half, half), (half, -half)):
                ends = known[u - du, v - dv] + known[u + du, v + dv]
                off = abs(heights[u - du, v - dv] - 2.0 * heights[u, v] + heights[u + du, v + dv])
                rise = abs(heights[u + du, v + dv] - heights[u - du, v - dv]) / math.hypot(
                    du / half, dv / half
                )
                breaks = ends + known[u, v] > 1.5 and off > step
                if breaks and off <= 2.0 * step:
                    breaks = off > step + VAGUE * doubt(cells, first, u, v, du, dv, 4.0)
                leans = ends > 1.5 and rise > steep
                if leans and rise <= 2.0 * steep:
                    leans = rise > steep + VAGUE * doubt(cells, first, u, v, du, dv, 0.0)
                if breaks or leans:
                    edges[u - du, v - dv] = edges[u + du, v + dv] = 1.0
