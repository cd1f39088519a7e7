"""ElevationMap + DepthFrame → Sight: what a look shows of what is too high to step on, seen from above.

The eye's surroundings are divided into sectors. In each stands the nearest wall that this frame hit, and as
far as the ground before it was seen, it is free. Walls of neighbouring sectors that leave no room for a robot
between them are one run, which is broken where it bends: what was hit becomes a piece, nothing is imagined.

A wall is what the scanner has for one (`scanner.in_sight`): higher by more than a step than all that is
known up to a gap's width before it.
"""

import math

import numpy as np

from gaitwright.model.camera import Camera
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import rotation, times, vec
from gaitwright.perception.elevation_map import ElevationMap
from gaitwright.perception.fusing import HEIGHT, HIGH, LOW, VARIANCE, nearest_line, slot
from gaitwright.signals import DepthFrame, Sensed, Sight

SECTORS = 120
"""Around the eye; none is narrower than two pixels of a usual camera."""
SUDDEN, GAP = 0.3, 1.1
"""A wall rises over all ground from this far to this far before it, in body heights: what takes longer is a
slope of less than 50°, and ground beyond a gap that is no wider is reached from the ground before it."""
FOOT = 0.25
"""Hits lower than this share of a step are on the ground before a wall, not on it [-]."""
NARROW = 0.8
"""Walls no farther apart than this, in body heights, leave no room for a robot between them."""
CLUSTER = 4.0
"""Hits this many standard deviations of a range behind the nearest are of the same wall [-]."""
SEEN_OVER = 0.75
"""What is no higher than where the robot stands is a wall only if the ground before it is known to be lower
over this share of the widest gap: else it may be the far side of one [-]."""
AROUND = 3
"""So many cells around a wall tell which way it looks."""
OBLIQUE = 2.0 * 2.0 * math.pi / SECTORS
"""A face seen from the side recedes in a sector by up to this share of its distance: 63° off the square."""
BLIND = 3.0
"""Ground that was seen nearer than this, in body heights, is free all the way: pixels are far apart there."""
BENT = 0.75
"""A run is broken where it leaves its chord by more than this, in cells: half a cell, and rounding."""


def sight_of(seen: ElevationMap, frame: DepthFrame, camera: Camera, sensed: Sensed, step: float) -> Sight:
    """The sight of a frame that is already in the map; a sudden rise of more than `step` [m] is a wall."""
    R_wb = rotation(sensed.orientation_wb)
    eye, height = camera.eye(sensed.position_w, R_wb), seen.height
    sectors, points = np.empty((SECTORS, 4)), np.empty((SECTORS, 3, 2))
    stands = float(sensed.position_w[2]) - height
    limits, narrow = (step, SUDDEN * height, GAP * height, BLIND * height, stands), NARROW * height
    noise = (camera.noise, camera.noise_growth)
    look(
        seen.cells,
        seen.first,
        seen.spacing,
        eye,
        R_wb @ camera.axes,
        camera.rays_c,
        frame.ranges,
        noise,
        limits,
        sectors,
        points,
    )
    pieces, corners = np.empty((3 * SECTORS, 4)), np.empty((3 * SECTORS, 2), np.bool_)
    count = join(sectors, points, (eye[0], eye[1]), narrow, BENT * seen.spacing, pieces, corners)
    place = float(eye[0]), float(eye[1])
    return Sight(place, pieces[:count].copy(), corners[:count].copy(), rim(sectors, place))


def rim(sectors: np.ndarray, eye: tuple[float, float]) -> np.ndarray:
    """Rim of what was seen free `(m, 2)`: the ends of all sectors, and the eye where some were not seen."""
    far = np.minimum(sectors[:, FREE], sectors[:, WALL])
    angle = 2.0 * math.pi * (np.arange(SECTORS) + 0.5) / SECTORS
    seen = np.flatnonzero(far > 0.0)
    if not len(seen):
        return np.empty((0, 2))
    gap = int(np.argmax(np.diff(seen, append=seen[0] + SECTORS)))
    order = np.roll(seen, -(gap + 1))
    ends = np.column_stack([np.cos(angle[order]), np.sin(angle[order])]) * far[order, None] + eye
    return ends if len(seen) == SECTORS else np.vstack([ends, eye])


# --- kernels ---------------------------------------------------------------------------------------
WALL, FREE, LEVEL, STOPPED = 0, 1, 2, 3
"""Of a sector: distance of its nearest wall, how far it is free, the height there [m]; whether it ended."""
NEAREST, RIGHT, LEFT = 0, 1, 2
"""Its points on the wall: in the middle, and at either end."""


GROUND, UNSURE, RIM, FACE = 0, 1, 2, 3
"""What a hit is on: ground; nothing that can be told yet; a wall, on its upper rim or on its face."""


@kernel
def cell_at(first, n, row, column):
    """Where a cell of the world's lattice is kept; -1, -1 outside the window."""
    if first[0] <= row < first[0] + n and first[1] <= column < first[1] + n:
        return slot(row, n), slot(column, n)
    return -1, -1


@kernel
def highest_before(cells, first, spacing, x, y, way_x, way_y, limits):
    """Highest known ground before a place, to one who comes along (way_x, way_y); how far it is known [m].

    -inf where none is known.
    """
    before, known = -math.inf, 0.0
    for k in range(math.ceil(limits[1] / spacing), math.ceil(limits[2] / spacing) + 1):
        row, column = (
            nearest_line(y - k * spacing * way_y, spacing),
            nearest_line(x - k * spacing * way_x, spacing),
        )
        i, j = cell_at(first, cells.shape[0], row, column)
        if i >= 0 and cells[i, j, VARIANCE] < math.inf:
            before, known = max(before, cells[i, j, HEIGHT]), k * spacing
    return before, known


@kernel
def uphill(cells, first, spacing, row, column, level, way_x, way_y):
    """Unit direction to a cell from the ground below `level` around it; where none is known, the way."""
    x = y = 0.0
    for u in range(-AROUND, AROUND + 1):
        for v in range(-AROUND, AROUND + 1):
            i, j = cell_at(first, cells.shape[0], row + u, column + v)
            if i >= 0 and cells[i, j, VARIANCE] < math.inf and cells[i, j, HEIGHT] < level:
                x, y = x - v, y - u
    length = math.hypot(x, y)
    return (x / length, y / length) if length > 0.5 else (way_x, way_y)


@kernel
def kind_of(cells, first, spacing, x, y, z, way_x, way_y, level, limits):
    """What a hit at z in the cell at x, y is on to one who comes along (way_x, way_y).

    `level`: of the ground in view before it [m], for where the map knows none; NaN: there is none.
    """
    row, column, step = nearest_line(y, spacing), nearest_line(x, spacing), limits[0]
    i, j = cell_at(first, cells.shape[0], row, column)
    if i < 0:
        return UNSURE
    top = z
    if cells[i, j, VARIANCE] < math.inf:
        top = max(z, cells[i, j, HEIGHT] - 2.0 * math.sqrt(cells[i, j, VARIANCE]))
    before, _ = highest_before(cells, first, spacing, x, y, way_x, way_y, limits)
    if before == -math.inf:
        before = cells[i, j, LOW] if math.isnan(level) else level
        if not top - before > step:
            return GROUND if abs(z - level) < FOOT * step else UNSURE
    if not (top - before > step and z - before > FOOT * step):
        return GROUND
    # Straight over it a gap is narrower than along the look.
    up_x, up_y = uphill(cells, first, spacing, row, column, top - step, way_x, way_y)
    straight, known = highest_before(cells, first, spacing, x, y, up_x, up_y, limits)
    if straight >= top - step:
        return GROUND
    if known < SEEN_OVER * limits[2] and top - limits[4] <= step:  # perhaps the far side of a gap
        return UNSURE
    return FACE if cells[i, j, HIGH] - cells[i, j, LOW] > FOOT * step else RIM


@kernel
def sector_of(x, y):
    """The sector of a direction."""
    return math.floor(math.atan2(y, x) / (2.0 * math.pi) * SECTORS) % SECTORS


@kernel
def look(cells, first, spacing, eye, R_wc, rays, ranges, noise, limits, sectors, points):
    """Writes sectors `(SECTORS, 4)` and their points `(SECTORS, 3, 2)` from the hits of a frame."""
    rows, columns = ranges.shape
    sectors[:, WALL], sectors[:, FREE], sectors[:, LEVEL], sectors[:, STOPPED] = math.inf, 0.0, math.nan, 0.0
    kinds = np.zeros(rows * columns, np.int8)
    for k in range(rows * columns - 1, -1, -1):  # from below: so each sector goes outwards
        far = ranges[k // columns, k % columns]
        if not far < math.inf:
            continue
        ray = times(R_wc, vec(rays[k]))
        level = math.hypot(ray[0], ray[1])
        if level < 1e-6:
            continue
        away, s = far * level, sector_of(ray[0], ray[1])
        x, y, z = eye[0] + far * ray[0], eye[1] + far * ray[1], eye[2] + far * ray[2]
        way_x, way_y = ray[0] / level, ray[1] / level
        inside = 0.5 * spacing  # a face stands on the line between two cells as often as not
        near = away - sectors[s, FREE] <= limits[2]
        level_before = sectors[s, LEVEL] if near else math.nan
        kinds[k] = kind_of(
            cells,
            first,
            spacing,
            x + inside * way_x,
            y + inside * way_y,
            z,
            way_x,
            way_y,
            level_before,
            limits,
        )
        if kinds[k] >= RIM:
            sectors[s, WALL] = min(sectors[s, WALL], away)
            sectors[s, STOPPED] = 1.0
        elif sectors[s, STOPPED] == 0.0:
            # Nothing of a step's height stands between what was seen before and this.
            over = z - (away - sectors[s, FREE]) * ray[2] / level - max(sectors[s, LEVEL], z)
            passed = kinds[k] == GROUND and (away <= limits[3] or over <= limits[0])
            if passed and away > sectors[s, FREE]:
                sectors[s, FREE], sectors[s, LEVEL] = away, z
            sectors[s, STOPPED] = 0.0 if passed else 1.0
    gather(eye, R_wc, rays, ranges, noise, spacing, kinds, sectors, points)


@kernel
def gather(eye, R_wc, rays, ranges, noise, spacing, kinds, sectors, points):
    """Writes the points of each sector's wall: the mean of its hits, and those farthest right and left."""
    columns = ranges.shape[1]
    count, ends = np.zeros(SECTORS), np.empty((SECTORS, 2))
    points[:], ends[:, 0], ends[:, 1] = 0.0, math.inf, -math.inf
    for k in range(kinds.size):
        if kinds[k] < RIM:
            continue
        far, ray = ranges[k // columns, k % columns], times(R_wc, vec(rays[k]))
        away, s = far * math.hypot(ray[0], ray[1]), sector_of(ray[0], ray[1])
        behind = away - sectors[s, WALL] - CLUSTER * (noise[0] + noise[1] * far * far) - 0.25 * spacing
        if behind > (OBLIQUE * away if kinds[k] == FACE else 0.0):
            continue
        x, y = eye[0] + far * ray[0], eye[1] + far * ray[1]
        middle = 2.0 * math.pi * (s + 0.5) / SECTORS
        beside = math.cos(middle) * ray[1] - math.sin(middle) * ray[0]
        if behind <= 0.0:
            count[s] += 1.0
            points[s, NEAREST, 0] += (x - points[s, NEAREST, 0]) / count[s]
            points[s, NEAREST, 1] += (y - points[s, NEAREST, 1]) / count[s]
        if beside < ends[s, 0]:
            ends[s, 0], points[s, RIGHT, 0], points[s, RIGHT, 1] = beside, x, y
        if beside > ends[s, 1]:
            ends[s, 1], points[s, LEFT, 0], points[s, LEFT, 1] = beside, x, y
    if noise[0] + noise[1] > 0.0:  # a single hit is no place: the ends are as far away as the mean
        for s in range(SECTORS):
            if count[s] > 0.0:
                mean = math.hypot(points[s, NEAREST, 0] - eye[0], points[s, NEAREST, 1] - eye[1])
                for end in (RIGHT, LEFT):
                    dx, dy = points[s, end, 0] - eye[0], points[s, end, 1] - eye[1]
                    far = mean / math.hypot(dx, dy)
                    points[s, end, 0], points[s, end, 1] = eye[0] + far * dx, eye[1] + far * dy


@kernel
def follows(sectors, points, s, narrow):
    """Whether the walls of a sector and of the next one leave no room between them."""
    t = (s + 1) % SECTORS
    if not (sectors[s, WALL] < math.inf and sectors[t, WALL] < math.inf):
        return False
    dx = points[t, RIGHT, 0] - points[s, LEFT, 0]
    dy = points[t, RIGHT, 1] - points[s, LEFT, 1]
    return math.hypot(dx, dy) <= narrow


@kernel
def off_chord(line, a, b, k):
    """Distance of point k of a line from its chord from point a to b."""
    dx, dy = line[b, 0] - line[a, 0], line[b, 1] - line[a, 1]
    px, py = line[k, 0] - line[a, 0], line[k, 1] - line[a, 1]
    along = min(max((px * dx + py * dy) / max(dx * dx + dy * dy, 1e-300), 0.0), 1.0)
    return math.hypot(px - along * dx, py - along * dy)


@kernel
def kept_points(line, count, bent, kept):
    """Marks the points of a line that its chords need to keep within `bent` (Douglas and Peucker 1973)."""
    kept[:count] = False
    kept[0] = kept[count - 1] = True
    stack, top = np.empty((count + 1, 2), np.int64), 1
    stack[0, 0], stack[0, 1] = 0, count - 1
    while top > 0:
        top -= 1
        a, b = stack[top, 0], stack[top, 1]
        worst, most = a, bent
        for k in range(a + 1, b):
            off = off_chord(line, a, b, k)
            if off > most:
                worst, most = k, off
        if worst > a:
            kept[worst] = True
            stack[top, 0], stack[top, 1] = a, worst
            stack[top + 1, 0], stack[top + 1, 1] = worst, b
            top += 2


@kernel
def seen_past(sectors, points, eye, s, end, t):
    """Whether free ground was seen in sector t beyond the end of the wall in sector s beside it."""
    away = math.hypot(points[s, end, 0] - eye[0], points[s, end, 1] - eye[1])
    return min(sectors[t, FREE], sectors[t, WALL]) > away


@kernel
def turns_away(line, a, b, c):
    """Whether a line around the eye bends away from it in b: a corner that stands out."""
    return (line[b, 0] - line[a, 0]) * (line[c, 1] - line[b, 1]) < (line[b, 1] - line[a, 1]) * (
        line[c, 0] - line[b, 0]
    )


@kernel
def join(sectors, points, eye, narrow, bent, pieces, corners):
    """Writes pieces and corners of all walls, anticlockwise around the eye; how many there are."""
    begin = 0  # a sector whose wall does not go on from the one before it
    while begin < SECTORS and follows(sectors, points, (begin - 1) % SECTORS, narrow):
        begin += 1
    found, k = 0, 0
    line, kept = np.empty((SECTORS + 2, 2)), np.empty(SECTORS + 2, np.bool_)
    while k < SECTORS:
        s = first = (begin + k) % SECTORS
        k += 1
        if not sectors[s, WALL] < math.inf:
            continue
        line[0], line[1], count = points[s, RIGHT], points[s, NEAREST], 2
        while k < SECTORS and follows(sectors, points, s, narrow):
            s = (s + 1) % SECTORS
            line[count] = points[s, NEAREST]
            count += 1
            k += 1
        line[count] = points[s, LEFT]
        kept_points(line, count + 1, bent, kept)
        open_right = seen_past(sectors, points, eye, first, RIGHT, (first - 1) % SECTORS)
        open_left = seen_past(sectors, points, eye, s, LEFT, (s + 1) % SECTORS)
        found = write_run(line, count + 1, kept, (open_right, open_left), pieces, corners, found)
    return found


@kernel
def write_run(line, count, kept, ends, pieces, corners, found):
    """Writes the pieces of one run from place `found` on; the next place."""
    b, corner = 0, ends[0]
    for c in range(1, count):
        if not kept[c]:
            continue
        pieces[found, 0], pieces[found, 1] = line[b, 0], line[b, 1]
        pieces[found, 2], pieces[found, 3] = line[c, 0], line[c, 1]
        following = c + 1
        while following < count and not kept[following]:
            following += 1
        after = ends[1] if following >= count else turns_away(line, b, c, following)
        corners[found, 0], corners[found, 1] = corner, after
        corner, b = after, c
        if pieces[found, 0] != pieces[found, 2] or pieces[found, 1] != pieces[found, 3]:
            found += 1
    return found
