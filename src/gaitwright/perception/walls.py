"""ElevationMap + DepthFrame → Sight: what a look shows of what is too high to step on, seen from above.

The eye's surroundings are divided into sectors. In each stands the nearest wall that this frame hit, and as
far as the ground before it was seen, it is free. `wall_kinds` says what is a wall, `edge_runs` makes pieces.
"""

import math

import numpy as np

from gaitwright.model.camera import Camera
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import rotation, times, vec
from gaitwright.perception.edge_runs import (
    FREE,
    LEFT,
    LEVEL,
    NEAREST,
    RIGHT,
    SECTORS,
    STOPPED,
    WALL,
    join,
)
from gaitwright.perception.elevation_map import ElevationMap
from gaitwright.perception.wall_kinds import FACE, GROUND, RIM, is_brink, kind_of
from gaitwright.signals import DepthFrame, Sensed, Sight

SUDDEN, GAP = 0.3, 1.1
"""A wall rises over all ground from this far to this far before it, in body heights: what takes longer is a
slope of less than 50°, and ground beyond a gap that is no wider is reached from the ground before it."""
NARROW = 0.8
"""Walls no farther apart than this, in body heights, leave no room for a robot between them."""
CLUSTER = 4.0
"""Hits this many standard deviations of a range behind the nearest are of the same wall [-]."""
OBLIQUE = 2.0 * 2.0 * math.pi / SECTORS
"""A face seen from the side recedes in a sector by up to this share of its distance: 63° off the square."""
BLIND = 3.0
"""Ground that was seen nearer than this, in body heights, is free all the way: pixels are far apart there."""
FEW = 4
"""Fewer hits than this in a sector are no wall to a camera with noise."""
BENT, VAGUE = 0.75, 2.0
"""A run is broken where it leaves its chord by more than so many cells (half a cell, and rounding) and
standard deviations of a range."""


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
    vague = camera.noise + camera.noise_growth * (0.5 * camera.range) ** 2
    bent = BENT * seen.spacing + VAGUE * vague
    count = join(sectors, points, (eye[0], eye[1]), narrow, bent, pieces, corners)
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
@kernel
def sector_of(x, y):
    """The sector of a direction."""
    return math.floor(math.atan2(y, x) / (2.0 * math.pi) * SECTORS) % SECTORS


@kernel
def look(cells, first, spacing, eye, R_wc, rays, ranges, noise, limits, sectors, points):
    """Writes sectors `(SECTORS, 4)` and their points `(SECTORS, 3, 2)` from the hits of a frame."""
    rows, columns = ranges.shape
    sectors[:, WALL], sectors[:, FREE], sectors[:, LEVEL], sectors[:, STOPPED] = math.inf, 0.0, math.nan, 0.0
    kinds, brink = np.zeros(rows * columns, np.int8), np.full(SECTORS, -1)
    for k in range(rows * columns - 1, -1, -1):  # from below: so each sector goes outwards
        far = ranges[k // columns, k % columns]
        if not far < math.inf:
            continue
        ray = times(R_wc, vec(rays[k]))
        level = math.hypot(ray[0], ray[1])
        if level < 1e-6:
            continue
        away, s = far * level, sector_of(ray[0], ray[1])
        spread = CLUSTER * (noise[0] + noise[1] * far * far)
        if away > sectors[s, WALL] + OBLIQUE * away + spread + spacing:  # behind a wall: it changes nothing
            continue
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
        elif sectors[s, STOPPED] == 0.0 and z < sectors[s, LEVEL] - limits[0]:
            # Down there; what is beyond a narrow hole goes on as if that were not there.
            if away - sectors[s, FREE] <= limits[2]:
                continue
            sectors[s, STOPPED] = 1.0
            if brink[s] >= 0 and meets_brink(cells, first, spacing, eye, sectors[s], way_x, way_y, limits):
                sectors[s, WALL], kinds[brink[s]] = sectors[s, FREE], RIM
        elif sectors[s, STOPPED] == 0.0:
            # Nothing of a step's height stands between what was seen before and this.
            over = z - (away - sectors[s, FREE]) * ray[2] / level - max(sectors[s, LEVEL], z)
            passed = kinds[k] == GROUND and (away <= limits[3] or over <= limits[0])
            if passed and away > sectors[s, FREE]:
                sectors[s, FREE], sectors[s, LEVEL], brink[s] = away, z, k
            sectors[s, STOPPED] = 0.0 if passed else 1.0
    gather(eye, R_wc, rays, ranges, noise, spacing, kinds, sectors, points)


@kernel
def meets_brink(cells, first, spacing, eye, sector, way_x, way_y, limits):
    """Whether the ground of a sector ends near by, in a drop."""
    away, least = sector[FREE], sector[LEVEL] - limits[0]
    x, y = eye[0] + away * way_x, eye[1] + away * way_y
    return away <= limits[3] and is_brink(cells, first, spacing, x, y, way_x, way_y, least, limits[2])


@kernel
def gather(eye, R_wc, rays, ranges, noise, spacing, kinds, sectors, points):
    """Writes the points of each sector's wall: the mean of its hits, and those farthest right and left."""
    columns = ranges.shape[1]
    count, ends, kind = np.zeros(SECTORS), np.empty((SECTORS, 2)), np.zeros(SECTORS, np.int8)
    points[:], ends[:, 0], ends[:, 1] = 0.0, math.inf, -math.inf
    for k in range(kinds.size):
        if kinds[k] < RIM:
            continue
        far, ray = ranges[k // columns, k % columns], times(R_wc, vec(rays[k]))
        away, s = far * math.hypot(ray[0], ray[1]), sector_of(ray[0], ray[1])
        behind = away - sectors[s, WALL] - CLUSTER * (noise[0] + noise[1] * far * far)
        if behind > (OBLIQUE * away if kinds[k] == FACE else 0.25 * spacing):
            continue
        x, y = eye[0] + far * ray[0], eye[1] + far * ray[1]
        middle = 2.0 * math.pi * (s + 0.5) / SECTORS
        beside = math.cos(middle) * ray[1] - math.sin(middle) * ray[0]
        if behind <= 0.0 and kinds[k] >= kind[s]:  # hits on the face count alone, where there are any
            count[s] = count[s] + 1.0 if kinds[k] == kind[s] else 1.0
            kind[s] = kinds[k]
            points[s, NEAREST, 0] += (x - points[s, NEAREST, 0]) / count[s]
            points[s, NEAREST, 1] += (y - points[s, NEAREST, 1]) / count[s]
        if beside < ends[s, 0]:
            ends[s, 0], points[s, RIGHT, 0], points[s, RIGHT, 1] = beside, x, y
        if beside > ends[s, 1]:
            ends[s, 1], points[s, LEFT, 0], points[s, LEFT, 1] = beside, x, y
    if noise[0] + noise[1] > 0.0:  # a single hit is no place: the ends are as far away as the mean
        for s in range(SECTORS):
            if count[s] < FEW:
                sectors[s, WALL] = math.inf
            else:
                mean = math.hypot(points[s, NEAREST, 0] - eye[0], points[s, NEAREST, 1] - eye[1])
                for end in (RIGHT, LEFT):
                    dx, dy = points[s, end, 0] - eye[0], points[s, end, 1] - eye[1]
                    far = mean / math.hypot(dx, dy)
                    points[s, end, 0], points[s, end, 1] = eye[0] + far * dx, eye[1] + far * dy
