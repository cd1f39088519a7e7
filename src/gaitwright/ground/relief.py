"""Solids sorted into cells → the highest of them at any place, however many there are.

Every cell of a grid lists the solids that reach into it, so that a place is held against those of its cell
alone: heights among 2,000 solids take as long as among 20.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.ground.terrain import BOX, CYLINDER, PRISM, SPHERE, WEDGE, Number, Solid
from gaitwright.numerics.compiled import kernel

PER_SOLID = 16
"""Cells for each solid, at most, along both axes together."""

HAIR = 1e-9
"""What lies so near to a solid [m] is looked for among its places."""


class Sorted(NamedTuple):
    """Solids and the cells that they reach into, as kernels read them."""

    rows: np.ndarray
    """`(n, 11)` kind; centre x, y; cosine and sine of the yaw; half sides or radius; level or top [m]; height
    of what slants [m], or where a prism's corners begin; share of a frustum's top, or how many corners; its
    highest point [m]."""
    corners: np.ndarray
    """`(m, 2)` of all prisms [m]."""
    place: np.ndarray
    """`(3,)` corner of the first cell x, y, and size of a cell [m]."""
    first: np.ndarray
    """`(rows, columns + 1)` where the list of each cell begins and the row's last one ends."""
    items: np.ndarray
    """The lists, one behind the other."""


@dataclass(frozen=True, eq=False)
class Relief:
    """What stands on a ground, sorted."""

    sorted: Sorted

    @classmethod
    def of(cls, solids: Sequence[Solid], levels: Sequence[float]) -> "Relief":
        """Solids that stand on levels [m]."""
        standing = list(zip(solids, levels, strict=True))
        rows = np.array([(*solid.row(level), level + solid.height) for solid, level in standing], dtype=float)
        prisms = [k for k, row in enumerate(rows) if row[0] == PRISM]
        rings = [solids[k].corners() for k in prisms]
        rows[prisms, 8] = np.cumsum([0, *(len(ring) for ring in rings)])[: len(prisms)]
        corners = np.concatenate([np.empty((0, 2)), *rings])
        extents = np.array([solid.extent() for solid in solids]) + HAIR * np.array([-1.0, -1.0, 1.0, 1.0])
        low, high = extents[:, :2].min(axis=0), extents[:, 2:].max(axis=0)
        size = _cell_size(extents, high - low)
        columns, lines = (int(n) + 1 for n in (high - low) / size)
        first, items = fill_cells(extents, low, size, lines, columns)
        return cls(Sorted(rows, corners, np.array([*low, size]), first, items))

    def tops(self, x: Number, y: Number) -> Float[np.ndarray, "..."]:
        """Height of the highest solid at places [m], -inf where there is none."""
        return self.look(x, y)[..., 0]

    def look(self, x: Number, y: Number) -> Float[np.ndarray, "... 3"]:
        """The same, and how it rises there along x and y [m/m]."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        out = np.empty((x.size, 3))
        look(self.sorted, np.ascontiguousarray(x).ravel(), np.ascontiguousarray(y).ravel(), out)
        return out.reshape(*x.shape, 3)


def _cell_size(extents: Float[np.ndarray, "n 4"], span: Float[np.ndarray, "2"]) -> float:
    """A third of a solid in the mean, and no more cells than `PER_SOLID` each [m]."""
    cells = PER_SOLID * len(extents)
    mean = float((extents[:, 2:] - extents[:, :2]).mean())
    return max(mean / 3.0, math.sqrt(span[0] * span[1] / cells), *(2.0 * span / cells), 1e-9)


# --- kernels -----------------------------------------------------------------------------------------
@kernel
def fill_cells(extents, low, size, lines, columns):
    """The lists of all cells: where each begins, and the solids in them."""
    spans = np.empty((len(extents), 4), dtype=np.int64)
    count = np.zeros((lines, columns + 1), dtype=np.int64)
    for k in range(len(extents)):
        for i in range(4):
            most = columns if i % 2 == 0 else lines
            spans[k, i] = min(max(int((extents[k, i] - low[i % 2]) / size), 0), most - 1)
        for row in range(spans[k, 1], spans[k, 3] + 1):
            for column in range(spans[k, 0], spans[k, 2] + 1):
                count[row, column] += 1
    first, total = np.empty_like(count), 0
    for row in range(lines):
        for column in range(columns + 1):
            first[row, column] = total
            total += count[row, column]
    items, at = np.empty(total, dtype=np.int64), first.copy()
    for k in range(len(extents)):
        for row in range(spans[k, 1], spans[k, 3] + 1):
            for column in range(spans[k, 0], spans[k, 2] + 1):
                items[at[row, column]] = k
                at[row, column] += 1
    return first, items


@kernel
def look(relief, x, y, out):
    """Writes height and slopes of the highest solid at places, `(n, 3)`; -inf where there is none."""
    lines, columns = relief.first.shape
    for n in range(len(x)):
        best, rise_x, rise_y = -math.inf, 0.0, 0.0
        u, v = (x[n] - relief.place[0]) / relief.place[2], (y[n] - relief.place[1]) / relief.place[2]
        if -1.0 < u <= columns - 1 and -1.0 < v <= lines:  # never of a place that is no number
            row, column = min(max(int(v), 0), lines - 1), min(max(int(u), 0), columns - 2)
            for i in range(relief.first[row, column], relief.first[row, column + 1]):
                solid = relief.rows[relief.items[i]]
                if solid[10] > best:
                    top, along, across = top_of(solid, relief.corners, x[n], y[n])
                    if top > best:
                        best, rise_x, rise_y = top, along, across
        out[n, 0], out[n, 1], out[n, 2] = best, rise_x, rise_y


@kernel
def top_of(row, corners, x, y):
    """Height of a solid at a place and its rise along x and y; -inf outside."""
    kind, c, s, a, b, z = row[0], row[3], row[4], row[5], row[6], row[7]
    dx, dy = x - row[1], y - row[2]
    if kind == PRISM:
        return z if inside(corners, int(row[8]), int(row[9]), x, y) else -math.inf, 0.0, 0.0
    if kind in (CYLINDER, SPHERE):
        room = a * a - dx * dx - dy * dy
        if room < 0.0:
            return -math.inf, 0.0, 0.0
        if kind == CYLINDER:
            return z, 0.0, 0.0
        up = math.sqrt(room)
        steep = max(up, 1e-9 * a)
        return z + up, -dx / steep, -dy / steep
    u, v = c * dx + s * dy, c * dy - s * dx
    if abs(u) > a or abs(v) > b:
        return -math.inf, 0.0, 0.0
    if kind == BOX:
        return z, 0.0, 0.0
    if kind == WEDGE:
        rise = row[8] / (2.0 * a)
        return z + rise * (u + a), rise * c, rise * s
    return slanting(row, u, v)


@kernel
def slanting(row, u, v):
    """The same of a pyramid, from the place (u, v) in its own axes."""
    c, s, a, b, z, height = row[3], row[4], row[5], row[6], row[7], row[8]
    slant = 1.0 - row[9]  # where its level top begins, as a share of the way from the side to the middle
    from_u, from_v = 1.0 - abs(u) / a, 1.0 - abs(v) / b
    if min(from_u, from_v) >= slant:
        return z + height, 0.0, 0.0
    if from_u <= from_v:
        rise = -math.copysign(height / (a * slant), u)
        return z + height * from_u / slant, rise * c, rise * s
    rise = -math.copysign(height / (b * slant), v)
    return z + height * from_v / slant, -rise * s, rise * c


@kernel
def inside(corners, first, count, x, y):
    """Whether a place lies in a polygon: a ray to its right meets the outline an odd number of times."""
    odd, last = False, first + count - 1
    for k in range(first, first + count):
        x0, y0, x1, y1 = corners[last, 0], corners[last, 1], corners[k, 0], corners[k, 1]
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            odd = not odd
        last = k
    return odd
