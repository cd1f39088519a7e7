"""Scene + pose → DepthFrame: a simulated depth camera that casts all rays of a frame over a height field.

The scene is drawn once as *facets*, small cells, so a frame among 2,000 boxes is as quick as among 20; what
moves is drawn into them where it is (`moving_facets`).
"""

import math
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.model.camera import Camera
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import rotation, times, vec
from gaitwright.plant.facets import TILE, Facets, facets_of
from gaitwright.plant.moving_facets import MovingFacets
from gaitwright.signals import DepthFrame, Sensed

CELL = 0.0033
"""Side of a cell, as a share of the camera's range [-]: 1.6 cm for a Go2's."""


def imperfect(
    ranges: Float[np.ndarray, "pixels"], camera: Camera, seed: int, tick: int
) -> Float[np.ndarray, "rows columns"]:
    """True ranges [m] as a camera gives them: noise and drop-outs are drawn by a run's seed and tick."""
    if camera.noise > 0.0 or camera.noise_growth > 0.0 or camera.dropouts > 0.0:
        rng = np.random.default_rng((seed, tick))
        ranges = ranges + camera.spread(ranges) * rng.standard_normal(ranges.size)
        ranges[rng.random(ranges.size) < camera.dropouts] = np.nan
        ranges[ranges <= 0.0] = np.nan
    return ranges.reshape(camera.pixels)


@dataclass
class Eyes:
    """A simulated camera in a scene; it keeps the facets that it looks at."""

    camera: Camera
    scene: Scene
    seed: int = 0
    """Of the run: what noise and drop-outs are drawn from, with the tick."""
    facets: Facets = field(init=False, repr=False)
    moving: MovingFacets | None = field(init=False, repr=False)
    """The same with what moves drawn into it; `None` where nothing does."""

    def __post_init__(self) -> None:
        self.rearrange(self.scene)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of what stands around from now on."""
        self.scene = scene
        self._look_around(scene.start[:2])

    def see(self, sensed: Sensed, tick: int = 0) -> DepthFrame:
        """What the camera of a robot sees whose base is where `sensed` says."""
        R_wb = rotation(sensed.orientation_wb)
        eye = self.camera.eye(sensed.position_w, R_wb)
        if not self._holds(eye):
            self._look_around((float(eye[0]), float(eye[1])))
        if self.moving is not None:
            self.facets = self.moving.at(self.scene.at(sensed.time))
        ranges = np.empty(len(self.camera.rays))
        cast(*self.facets, eye, R_wb, self.camera.rays, self.camera.range, ranges)
        return DepthFrame(imperfect(ranges, self.camera, self.seed, tick), sensed.time)

    def _look_around(self, place: tuple[float, float]) -> None:
        """Draws what can be seen from about a place x, y."""
        self.facets = facets_of(self.scene, place, self.camera.range, CELL * self.camera.range)
        self.moving = MovingFacets(self.facets) if self.scene.movers else None

    def _holds(self, eye: Float[np.ndarray, "3"]) -> bool:
        """Whether the facets have all that can be seen from here, or the scene has no more."""
        (x, y, cell), reach = self.facets.place, self.camera.range
        rows, columns, _ = self.facets.planes.shape
        x_min, y_min, x_max, y_max = self.scene.bounds
        lower = max(eye[0] - reach, x_min) >= x and max(eye[1] - reach, y_min) >= y
        far_x, far_y = min(eye[0] + reach, x_max), min(eye[1] + reach, y_max)
        return bool(lower and far_x <= x + cell * columns and far_y <= y + cell * rows)


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def crossings(low, cell, origin, way):
    """Step of a ray's cells along one axis, and a, b of a + k b: how far along it meets their k-th line."""
    if way == 0.0:
        return 0, math.inf, 0.0
    return 1 if way > 0.0 else -1, (low - origin) / way, cell / way


@kernel
def start_of(eye, ray, highest):
    """How far along a ray it comes down to the highest of all facets [m]; infinite where never."""
    if eye[2] <= highest:
        return 0.0
    return (eye[2] - highest) / -ray[2] if ray[2] < 0.0 else math.inf


@kernel
def within(at, low, cell, tile):
    """The cell along one axis at a coordinate, kept in a tile: what lies on its rim may round out of it."""
    return min(max(math.floor((at - low) / cell), tile * TILE), tile * TILE + TILE - 1)


@kernel
def met(place, planes, i, j, eye, ray, s, end):
    """Whether a ray meets cell i, j between `s` and `end`, and how far along it; a wall before it at `s`."""
    x, y = place[0] + (j + 0.5) * place[2], place[1] + (i + 0.5) * place[2]
    a, b = planes[i, j, 1], planes[i, j, 2]
    over = eye[2] - planes[i, j, 0] - a * (eye[0] - x) - b * (eye[1] - y)
    gain = ray[2] - a * ray[0] - b * ray[1]
    if over + s * gain <= 0.0:
        return True, s
    return over + end * gain <= 0.0, -over / gain


@kernel
def cast_one(place, planes, tops, eye, ray, s, reach):
    """Distance along one ray to the facets [m], looked for from `s` on; NaN if none is in `reach`."""
    cell, (rows, columns, _) = place[2], planes.shape
    step_x, first_x, gain_x = crossings(place[0], cell, eye[0], ray[0])
    step_y, first_y, gain_y = crossings(place[1], cell, eye[1], ray[1])
    j = math.floor((eye[0] + s * ray[0] - place[0]) / cell)
    i = math.floor((eye[1] + s * ray[1] - place[1]) / cell)
    on_x, on_y = 1 if step_x > 0 else 0, 1 if step_y > 0 else 0
    while 0 <= i < rows and 0 <= j < columns and s <= reach:
        tile_i, tile_j = i // TILE, j // TILE
        top = tops[tile_i, tile_j]
        if eye[2] + s * ray[2] > top:
            at_x = first_x + (tile_j + on_x) * TILE * gain_x
            at_y = first_y + (tile_i + on_y) * TILE * gain_y
            end = min(at_x, at_y)
            passes = eye[2] + end * ray[2] > top  # above all that is in the tile
            s = end if passes else max(s, (top - eye[2]) / ray[2])
            i = within(eye[1] + s * ray[1], place[1], cell, tile_i)
            j = within(eye[0] + s * ray[0], place[0], cell, tile_j)
            if passes:
                if at_x < at_y:
                    j = (tile_j + on_x) * TILE - 1 + on_x
                else:
                    i = (tile_i + on_y) * TILE - 1 + on_y
                continue
        at_x, at_y = first_x + (j + on_x) * gain_x, first_y + (i + on_y) * gain_y
        end = min(at_x, at_y, reach + cell)
        hits, at = met(place, planes, i, j, eye, ray, s, end)
        if hits:
            return at if at <= reach else math.nan
        s = end
        if at_x < at_y:
            j += step_x
        else:
            i += step_y
    return math.nan


@kernel
def cast(place, planes, tops, eye, R_wb, rays, reach, out):
    """Writes the distance along each ray `(pixels, 3)`, base axes, to facets [m]; NaN beyond `reach`."""
    highest = tops.max()
    for k in range(rays.shape[0]):
        ray = times(R_wb, vec(rays[k]))
        start = start_of(eye, ray, highest)
        out[k] = cast_one(place, planes, tops, eye, ray, start, reach) if start <= reach else math.nan
