"""The kernels of the elevation map: its window rolls, cells seen through are weakened, cells hit updated.

A cell's height is a Kalman filter's (Fankhauser et al. 2014): what lies higher than it can be replaces it,
what lies lower is kept as the lowest seen, so a cell with an edge in it holds both. Its variance is its trust
as well: rays that go through it make it worse, until what is remembered there is given up.
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import times, vec

HEIGHT, VARIANCE, LOW, HIGH, SEEN, PROOF = 0, 1, 2, 3, 4, 5
"""Places in a cell. Unknown: NaN, inf, inf, -inf, -inf; PROOF: how many more hits than looks through it."""
LEAST, MOST = -3.0, 6.0
"""Proof is not counted beyond these, so that a cell can still be changed [-]."""
FLOOR = 0.1
"""Standard deviation of a height from how rays fall into a cell, in cells: no camera is better than that."""
GATE = 3.0
"""Heights farther apart than this many standard deviations are two surfaces [-]."""
SLOPE = 1.0
"""Ground of one surface rises by no more than this within a cell [-]."""
SURE = 1.0 / 16.0
"""Of the variance of one look; a cell is never surer, so that it can still be changed."""
WORSE = 2.0
"""Factor on the variance of a cell for a ray that goes through it."""
LOST = 2.0
"""A cell of more variance than this, in those of one look, is given up."""
BENEATH = 0.75
"""A cell is looked through where the camera sees past it this far under its height, in cells; the pixel is
chosen twice as far under it and half a pixel, so that its ray lies there for sure."""


@kernel
def slot(index, cells):
    """Where a row or column of the world's lattice is kept: the window rolls over the same memory."""
    return index % cells


@kernel
def nearest_line(at, spacing):
    """Row or column of the world's lattice nearest to a coordinate."""
    return math.floor(at / spacing + 0.5)


@kernel
def forget(cell):
    """Makes a cell unknown."""
    cell[HEIGHT], cell[VARIANCE], cell[SEEN] = math.nan, math.inf, -math.inf
    cell[LOW], cell[HIGH] = math.inf, -math.inf


@kernel
def empty(cell):
    """Makes a cell one that nobody has ever looked at."""
    forget(cell)
    cell[PROOF] = 0.0


@kernel
def roll(cells, old, new):
    """Forgets rows and columns of a window at `new` (row, column) that were not in it at `old`."""
    n = cells.shape[0]
    for row in range(new[0], new[0] + n):
        kept = old[0] <= row < old[0] + n
        for column in range(new[1], new[1] + n):
            if not (kept and old[1] <= column < old[1] + n):
                empty(cells[slot(row, n), slot(column, n)])


@kernel
def look_variance(spread, fall, spacing):
    """Variance of a height from one look [m²]: noise along the ray, which falls by `fall` a metre."""
    return (spread * fall) ** 2 + (FLOOR * spacing) ** 2


@kernel
def update(cell, z, variance, spacing, time):
    """A hit at height z on a cell."""
    cell[SEEN] = time
    cell[PROOF] = min(cell[PROOF] + 1.0, MOST)
    if not cell[VARIANCE] < math.inf:
        cell[HEIGHT] = cell[LOW] = cell[HIGH] = z
        cell[VARIANCE] = variance
        return
    doubt = 2.0 * math.sqrt(variance)
    cell[LOW], cell[HIGH] = min(cell[LOW], z + doubt), max(cell[HIGH], z - doubt)
    apart = GATE * math.sqrt(cell[VARIANCE] + variance) + SLOPE * spacing
    if z > cell[HEIGHT] + apart:  # another surface, above
        cell[HEIGHT], cell[VARIANCE] = z, variance
    elif z > cell[HEIGHT] - apart:
        gain = cell[VARIANCE] / (cell[VARIANCE] + variance)
        cell[HEIGHT] += gain * (z - cell[HEIGHT])
        cell[VARIANCE] = max((1.0 - gain) * cell[VARIANCE], SURE * variance)
    cell[LOW], cell[HIGH] = min(cell[LOW], cell[HEIGHT]), max(cell[HIGH], cell[HEIGHT])


@kernel
def weaken(cell, variance, spacing):
    """A ray went through a cell: it is less sure, and at last only its lower surface is kept, or nothing."""
    cell[PROOF] = max(cell[PROOF] - 1.0, LEAST)
    cell[VARIANCE] *= WORSE
    if cell[VARIANCE] <= LOST * variance:
        return
    if cell[LOW] < cell[HEIGHT] - 2.0 * SLOPE * spacing:
        cell[HEIGHT] = cell[HIGH] = cell[LOW]
        cell[VARIANCE] = LOST * variance
    else:
        forget(cell)


@kernel
def look_through(cells, first, spacing, eye, R_wc, rays, ranges, lens, noise, now, keep):
    """Weakens every cell behind which the camera sees something, and forgets those older than `keep` [s].

    For each cell the pixel is asked in which it would show: no ray is followed through the map. `lens`: half
    the width and height of the picture at one metre, and the range [m]; `rays`: unit, camera axes.
    """
    n, (rows, columns) = cells.shape[0], ranges.shape
    wide, high, reach = lens
    for u in range(n):
        i, dy = slot(first[0] + u, n), (first[0] + u) * spacing - eye[1]
        before = slot(first[1], n)
        for v in range(n):
            j = before + v if before + v < n else before + v - n
            if not cells[i, j, VARIANCE] < math.inf:
                continue
            if now - cells[i, j, SEEN] > keep:
                empty(cells[i, j])
                continue
            dx = (first[1] + v) * spacing - eye[0]
            lower = 2.0 * BENEATH * spacing + high / rows * max(abs(dx), abs(dy))
            dz = cells[i, j, HEIGHT] - lower - eye[2]
            ahead = R_wc[0, 0] * dx + R_wc[1, 0] * dy + R_wc[2, 0] * dz
            if ahead <= 0.0 or ahead > reach:
                continue
            left = (R_wc[0, 1] * dx + R_wc[1, 1] * dy + R_wc[2, 1] * dz) / (ahead * wide)
            up = (R_wc[0, 2] * dx + R_wc[1, 2] * dy + R_wc[2, 2] * dz) / (ahead * high)
            if abs(left) >= 1.0 or abs(up) >= 1.0:
                continue
            row, column = int(0.5 * (1.0 - up) * rows), int(0.5 * (1.0 - left) * columns)
            far, k = ranges[row, column], row * columns + column
            spread = noise[0] + noise[1] * far * far
            if not far * rays[k, 0] > ahead + spacing + spread:  # nothing came back, or not from behind
                continue
            ray = times(R_wc, vec(rays[k]))
            variance = look_variance(spread, ray[2], spacing)
            beneath = BENEATH * spacing + GATE * math.sqrt(variance) - GATE * FLOOR * spacing
            at = math.hypot(dx, dy) / math.hypot(ray[0], ray[1])
            if eye[2] + at * ray[2] < cells[i, j, HEIGHT] - beneath:
                weaken(cells[i, j], variance, spacing)


@kernel
def hit(cells, first, spacing, eye, R_wc, rays, ranges, noise, now):
    """Updates the cells that rays end in; ends outside the window are left out."""
    n, (rows, columns) = cells.shape[0], ranges.shape
    for k in range(rows * columns):
        far = ranges[k // columns, k % columns]
        if not far < math.inf:
            continue
        ray = times(R_wc, vec(rays[k]))
        row = nearest_line(eye[1] + far * ray[1], spacing)
        column = nearest_line(eye[0] + far * ray[0], spacing)
        if first[0] <= row < first[0] + n and first[1] <= column < first[1] + n:
            variance = look_variance(noise[0] + noise[1] * far * far, ray[2], spacing)
            update(cells[slot(row, n), slot(column, n)], eye[2] + far * ray[2], variance, spacing, now)


@kernel
def fuse(cells, old, new, spacing, eye, R_wc, rays, ranges, lens, noise, now, keep):
    """One frame into the cells of a window that was at `old` and is at `new` (row, column)."""
    if old[0] != new[0] or old[1] != new[1]:
        roll(cells, old, new)
    look_through(cells, new, spacing, eye, R_wc, rays, ranges, lens, noise, now, keep)
    hit(cells, new, spacing, eye, R_wc, rays, ranges, noise, now)


@kernel
def feel(cells, first, spacing, places, radius, variance, now):
    """What feet rest on, `(feet, 3)` world [m]: the highest thing within `radius` of each is as high as it.

    What was seen higher is brought down to it; where all was seen lower, or nothing, all is brought up.
    """
    n = cells.shape[0]
    for k in range(places.shape[0]):
        x, y, z = places[k, 0], places[k, 1], places[k, 2]
        apart = GATE * math.sqrt(variance) + SLOPE * spacing
        lowest, highest = nearest_line(y - radius, spacing), nearest_line(y + radius, spacing)
        left, right = nearest_line(x - radius, spacing), nearest_line(x + radius, spacing)
        middle = nearest_line(y, spacing), nearest_line(x, spacing)
        agrees = False
        for phase in range(2):  # first whether anything agrees with the foot, then what does not
            for row in range(max(lowest, first[0]), min(highest, first[0] + n - 1) + 1):
                for column in range(max(left, first[1]), min(right, first[1] + n - 1) + 1):
                    far = math.hypot(row * spacing - y, column * spacing - x)
                    if far > radius and not (row == middle[0] and column == middle[1]):
                        continue
                    cell = cells[slot(row, n), slot(column, n)]
                    known = cell[VARIANCE] < math.inf
                    if phase == 0:
                        agrees = agrees or (known and abs(cell[HEIGHT] - z) <= apart)
                    elif (known and cell[HEIGHT] > z + apart) or (
                        not agrees and not (known and abs(cell[HEIGHT] - z) <= apart)
                    ):
                        cell[HEIGHT] = cell[LOW] = cell[HIGH] = z
                        cell[VARIANCE], cell[SEEN], cell[PROOF] = variance, now, MOST
