"""ElevationMap + DepthFrame + where the camera was → ElevationMap: the ground around a robot, as it was seen.

A square grid rolls with the robot. Each cell holds a height with its variance, the lowest and the highest
that was seen in it, and when; what nobody saw or felt is unknown. Maps are values: who learns more makes a
new one.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Float32

from gaitwright.ground.elevation import EDGE, SPACING
from gaitwright.model import kinematics
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.perception.fusing import HEIGHT, HIGH, LOW, MOST, PROOF, SEEN, VARIANCE, feel, fuse
from gaitwright.signals import DepthFrame, Sensed

CELLS = 288
"""Cells along a side: 10 body heights to each side of the robot at the spacing of feet."""
STRIDE = 8
"""The window moves by so many cells at once, so that most frames need no new rows."""
FELT = 0.003
"""Standard deviation of a height that a foot felt [m]."""
SUPPOSED = 0.1
"""Standard deviation, in body heights, of ground that is only supposed: any look replaces it."""
LOADED = 0.1
"""A foot that carries this share of the weight rests on the ground; less is a touch."""
ASIDE = 1.2
"""What moves reaches so far beyond the edge that is seen of it, in body heights."""
UNKNOWN = (np.nan, np.inf, np.inf, -np.inf, -np.inf, 0.0)
"""A cell of which nothing is known."""
PROVEN = 3.0
"""Feet count on ground that a camera with noise has hit so many times more than it looked through it."""
AROUND = 1.0
"""The ground that feet stand on at the start is supposed to go on so far beyond them, in body heights: up to
what the camera sees first."""


@dataclass(frozen=True, eq=False)
class ElevationMap:
    """What was seen and felt of the ground around a robot."""

    height: float
    """Of the robot's body [m]: in it is said what is sudden, narrow or near."""
    first: tuple[int, int]
    """Row and column of the window's lowest cell in the world's lattice, whose cell 0, 0 is around 0, 0."""
    cells: Float32[np.ndarray, "n n 6"]
    """Height [m], variance [m²], lowest and highest seen [m], time [s], proof; row r at r mod n."""
    keep: float = math.inf
    """What was not seen or felt for longer is forgotten [s]."""
    proof: float = -math.inf
    """Feet count on a cell that was hit by so many rays more than went through it: with noise some hit cells
    that have no ground."""

    @classmethod
    def for_robot(cls, robot: Robot, keep: float = math.inf, noise: float = 0.0) -> "ElevationMap":
        """Nothing is known yet; window and cells as the robot's size asks. `noise`: of a camera's ranges
        [m]."""
        cells = np.empty((CELLS, CELLS, 6), np.float32)
        cells[:] = UNKNOWN
        first = (-CELLS // 2, -CELLS // 2)
        return cls(robot.height, first, cells, keep, PROVEN if noise else -math.inf)

    @property
    def spacing(self) -> float:
        """Side of a cell [m], as feet want it."""
        return SPACING * self.height

    @property
    def edge(self) -> float:
        """A break of the ground by more than this is an edge [m]."""
        return EDGE * self.height

    @property
    def n(self) -> int:
        """Cells along a side."""
        return self.cells.shape[0]

    @property
    def heights(self) -> Float32[np.ndarray, "rows columns"]:
        """Heights in the order of the world [m]; NaN where unknown."""
        return self.layer(HEIGHT)

    @property
    def known(self) -> Bool[np.ndarray, "rows columns"]:
        """What was seen or felt, in the order of the world."""
        return np.isfinite(self.layer(VARIANCE))

    @property
    def split(self) -> Bool[np.ndarray, "rows columns"]:
        """Cells in which an edge was seen: what lies lowest and what lies highest are two things."""
        return self.layer(HIGH) - self.layer(LOW) > self.edge

    @property
    def seen(self) -> Float32[np.ndarray, "rows columns"]:
        """When each cell was last seen [s]; -inf where never."""
        return self.layer(SEEN)

    def layer(self, of: int) -> Float32[np.ndarray, "rows columns"]:
        """One number of each cell (`fusing.HEIGHT` …), in the order of the world."""
        row, column = (-(k % self.n) for k in self.first)
        return np.roll(self.cells[:, :, of], (row, column), axis=(0, 1))

    def places(self) -> tuple[Float[np.ndarray, "columns"], Float[np.ndarray, "rows"]]:
        """x of the columns and y of the rows, world [m]."""
        row, column = self.first
        return self.spacing * np.arange(column, column + self.n), self.spacing * np.arange(row, row + self.n)

    def around(self, position_w: Float[np.ndarray, "3"]) -> tuple[int, int]:
        """Where the window of a robot at `position_w` begins: row and column of the lattice."""
        row, column = (
            STRIDE * round(position_w[axis] / (STRIDE * self.spacing)) - self.n // 2 for axis in (1, 0)
        )
        return row, column


def fused(before: ElevationMap, frame: DepthFrame, camera: Camera, sensed: Sensed) -> ElevationMap:
    """The map after one more frame of a camera, whose robot was where `sensed` says."""
    R_wb = rotation(sensed.orientation_wb)
    eye, R_wc = camera.eye(sensed.position_w, R_wb), R_wb @ camera.axes
    cells, first = before.cells.copy(), before.around(sensed.position_w)
    noise = (camera.noise, camera.noise_growth)
    fuse(
        cells,
        before.first,
        first,
        before.spacing,
        eye,
        R_wc,
        camera.rays_c,
        frame.ranges,
        camera.lens,
        noise,
        frame.time,
        before.keep,
    )
    return replace(before, first=first, cells=cells)


def lowest_points(robot: Robot, sensed: Sensed) -> Float[np.ndarray, "legs 3"]:
    """Where the feet of a robot touch the ground, if they do, world [m]."""
    centres = sensed.position_w + kinematics.feet(robot, sensed.q) @ rotation(sensed.orientation_wb).T
    return centres - np.outer(robot.foot_radius, [0.0, 0.0, 1.0])


def carrying(robot: Robot, sensed: Sensed) -> Bool[np.ndarray, "legs"]:
    """Which feet carry enough to tell where the ground is."""
    return sensed.load > LOADED * robot.total_mass * GRAVITY


def felt(
    before: ElevationMap, places: Float[np.ndarray, "feet 3"], radius: float, time: float
) -> ElevationMap:
    """The map after feet of a radius [m] were felt to rest on the ground at `places`, world [m].

    It believes the foot: under it nothing is higher, and something is as high.
    """
    cells = before.cells.copy()
    feel(cells, before.first, before.spacing, places, radius, FELT**2, time)
    return replace(before, cells=cells)


def without(before: ElevationMap, edge: Float[np.ndarray, "n 2"], step: float, time: float) -> ElevationMap:
    """The map without what was seen at a time [s] to rise by more than a step [m] about an edge, world [m].

    It is something that moves: there the ground is supposed to be as it was seen before, or is unknown.
    """
    around, n = ASIDE * before.height, before.n
    lines = []
    for axis, first in zip((1, 0), before.first, strict=True):
        low, high = edge[:, axis].min() - around, edge[:, axis].max() + around
        begin, end = math.floor(low / before.spacing), math.ceil(high / before.spacing)
        lines.append(np.arange(max(begin, first), min(end, first + n - 1) + 1))
    rows, columns = lines
    if not (len(rows) and len(columns)):
        return before
    where = np.ix_(rows % n, columns % n)
    found = before.cells[where]
    places = np.stack(np.meshgrid(columns, rows), axis=-1)[..., None, :] * before.spacing
    near = (np.hypot(*np.moveaxis(places - edge, -1, 0)) < around).any(axis=-1)
    high = found[..., HEIGHT] > found[..., LOW][near].min(initial=np.inf) + step
    moves = near & high & (found[..., SEEN] >= np.float32(time))
    ground = moves & (found[..., LOW] < found[..., HEIGHT] - step)
    found[moves & ~ground] = UNKNOWN
    found[ground, HEIGHT] = found[ground, HIGH] = found[ground, LOW]
    found[ground, VARIANCE] = (SUPPOSED * before.height) ** 2
    cells = before.cells.copy()
    cells[where] = found
    return replace(before, cells=cells)


def standing(
    robot: Robot,
    sensed: Sensed,
    feet: Float[np.ndarray, "legs 3"],
    keep: float = math.inf,
    noise: float = 0.0,
) -> ElevationMap:
    """The map at the start: the plane through the feet's lowest points, world [m], under and around them.

    Nobody saw it, so it is only supposed; what feet rest on was felt.
    """
    empty = ElevationMap.for_robot(robot, keep, noise)
    first, cells = empty.around(sensed.position_w), empty.cells.copy()
    x, y = replace(empty, first=first).places()
    slopes = np.linalg.lstsq(np.column_stack([feet[:, :2], np.ones(len(feet))]), feet[:, 2], rcond=None)[0]
    plane = slopes[0] * x[None, :] + slopes[1] * y[:, None] + slopes[2]
    beyond = AROUND * robot.height
    (x_min, y_min), (x_max, y_max) = feet[:, :2].min(axis=0) - beyond, feet[:, :2].max(axis=0) + beyond
    rows, columns = np.flatnonzero((y >= y_min) & (y <= y_max)), np.flatnonzero((x >= x_min) & (x <= x_max))
    under = np.ix_((rows + first[0]) % empty.n, (columns + first[1]) % empty.n)
    for of in (HEIGHT, LOW, HIGH):
        cells[(*under, of)] = plane[np.ix_(rows, columns)]
    cells[(*under, VARIANCE)] = (SUPPOSED * robot.height) ** 2
    cells[(*under, SEEN)], cells[(*under, PROOF)] = sensed.time, MOST
    return felt(replace(empty, first=first, cells=cells), feet, float(robot.foot_radius.max()), sensed.time)
