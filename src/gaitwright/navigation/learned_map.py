"""Sights, contacts and trips → a map that knows the shortest way, if there is one (thesis 6.2).

Kept are pieces of edges that were seen, and which ground was seen to be free; what is unknown is taken for
free. So nothing imagined ever blocks, "no way" is true as soon as it is said, and a way that nothing new
comes near stays the shortest.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.errors import WrongUse, unknown
from gaitwright.navigation.path_check import crossed, is_path_cut
from gaitwright.navigation.piece_rows import CORNERS, FELT, KIND, SUPPOSED, Rows, joined_rows, rows_of
from gaitwright.navigation.planning import Point, Way, best_way
from gaitwright.navigation.raster import Raster, blank, with_sight, with_way
from gaitwright.navigation.roads import Bounds, RoadMap, fence
from gaitwright.navigation.thesis_rule import thesis_way
from gaitwright.navigation.tolerances import CHECK, DEEP, LINK, TOUCH
from gaitwright.navigation.unlearning import unlearned
from gaitwright.signals import Sight

Path = Sequence[Point] | Float[np.ndarray, "_ 2"]
"""Points of a path [m]."""
Ring = Sequence[Point] | Float[np.ndarray, "_ 2"]
"""Points of an outline [m]."""
STRATEGIES = ("optimistic", "thesis")
"""How a way is chosen where the map is blank."""
LARGEST = 100_000.0
"""A field is no longer or wider [m]."""
FARTHEST = 1e7
"""Nothing is farther from the origin [m]: there a distance is still right to a micrometre."""
TOUCHED, BESIDE = 1e-3, 0.15
"""What was touched is there to this length to either side, and twice the noise; it is supposed to go on to
that [m]."""


@dataclass(frozen=True, eq=False)
class LearnedMap:
    """What was learned of a field, for a disc; who learns more makes a new one."""

    bounds: Bounds
    """x_min, y_min, x_max, y_max of the field [m]: a fence."""
    radius: float
    """Of the disc [m]."""
    strategy: str
    noise: float
    """Standard deviation of where pieces were seen [m]."""
    rows: Rows
    raster: Raster
    trips: tuple[tuple[Point, ...], ...] = ()
    """Ways that were walked."""
    trail: tuple[Point, ...] = ()
    """Where the thesis's rule has looked from in this trip."""

    # --- made -----------------------------------------------------------------------------------
    @classmethod
    def of(
        cls, bounds: Bounds, radius: float, strategy: str = "optimistic", noise: float = 0.0
    ) -> "LearnedMap":
        """An empty map. Raises `WrongUse` for a field, a disc or a strategy that makes no sense."""
        if strategy not in STRATEGIES:
            raise unknown("strategy", strategy, STRATEGIES)
        x_min, y_min, x_max, y_max = bounds
        if not (x_min < x_max and y_min < y_max):
            raise WrongUse(f"a field from ({x_min:g}, {y_min:g}) to ({x_max:g}, {y_max:g}) has no room")
        require_places(np.array(bounds))
        if max(x_max - x_min, y_max - y_min) > LARGEST:
            raise WrongUse(
                f"a field has at most {LARGEST / 1000.0:g} km, not {x_max - x_min:g} m by {y_max - y_min:g} m"
            )
        if not (math.isfinite(radius) and radius > 0.0 and math.isfinite(noise) and noise >= 0.0):
            raise WrongUse(f"a disc of radius {radius:g} m seen with a noise of {noise:g} m makes no sense")
        return cls(bounds, radius, strategy, noise, rows_of(np.empty((0, 4)), True), blank(bounds))

    @classmethod
    def of_polygons(cls, bounds: Bounds, radius: float, polygons: Sequence[Ring]) -> "LearnedMap":
        """A field that is known from the start; outlines (closed by themselves) may touch, overlap, cross
        themselves, lie in each other or have no area."""
        empty = cls.of(bounds, radius)
        rings = [np.array(ring, dtype=float).reshape(-1, 2) for ring in polygons if len(ring)]
        edges = [np.hstack([ring, np.roll(ring, -1, axis=0)]) for ring in rings]
        pieces = np.concatenate([np.empty((0, 4)), *edges])
        require_places(pieces)
        known = Raster(empty.raster.place, np.ones_like(empty.raster.cells))
        return replace(empty, rows=rows_of(pieces, True), raster=known)

    # --- learned --------------------------------------------------------------------------------
    def seen(self, sight: Sight) -> "LearnedMap":
        """With what a look showed: pieces that it went through are unlearned, those of one line join."""
        require_places(sight.pieces, sight.free)
        rows = unlearned(self.rows, sight.free, self.noise)
        rows = joined_rows(rows, rows_of(sight.pieces, sight.corners), self.noise)
        trail = (*self.trail, sight.eye) if self.strategy == "thesis" else ()
        return replace(self, rows=rows, raster=with_sight(self.raster, sight.free), trail=trail)

    def felt(self, place: Point, direction: float, is_sure: bool = True) -> "LearnedMap":
        """With a contact of a disc that stands at `place` [m], on its rim in a world direction [rad]: there
        is something across it. No look of this trip unlearns it; but that it goes on to both sides is
        only supposed, and so is all of it where the robot is not sure."""
        require_places(np.array([*place, direction]))
        ahead = np.array([math.cos(direction), math.sin(direction)])
        across, at = np.array([-ahead[1], ahead[0]]), np.array(place) + (self.narrowest - TOUCH) * ahead
        rows = self.rows
        sure = ((TOUCHED + 2.0 * self.noise, FELT),) if is_sure else ()
        for half, kind in (*sure, (BESIDE, SUPPOSED)):
            piece = np.concatenate([at - half * across, at + half * across])[None]
            rows = joined_rows(rows, rows_of(piece, False, kind), self.noise)
        return replace(self, rows=rows)

    def barred(self, line: Path) -> "LearnedMap":
        """With a line of which it was found that no robot gets over it [m]; no look of this trip unlearns
        it."""
        points = np.array([(float(x), float(y)) for x, y in line])
        require_places(points)
        pieces = np.column_stack([points[:-1], points[1:]])
        return replace(self, rows=joined_rows(self.rows, rows_of(pieces, False, FELT), self.noise))

    def walked(self, way: Path) -> "LearnedMap":
        """With a trip that was made: its ground is free, so nothing lies deep within it. What was felt is
        only supposed from now on: it may be gone by the next trip."""
        points = [(float(x), float(y)) for x, y in way]
        require_places(np.array(points))
        if len(points) < 2:
            return self
        rows = self.rows[~crossed(self.rows, np.array(points), DEEP * self.radius)]
        rows[rows[:, KIND] == FELT, KIND] = SUPPOSED
        raster = with_way(self.raster, points, self.radius)
        return replace(self, rows=rows, raster=raster, trips=(*self.trips, tuple(points)), trail=())

    def joined(self, other: "LearnedMap") -> "LearnedMap":
        """With what another map of the same field knows: what either holds is held, and what is gone will be
        unlearned by a look. Raises `WrongUse` for a map of another field."""
        if self.bounds != other.bounds:
            raise WrongUse(f"a map of the field {self.bounds} has no place for one of {other.bounds}")
        noise = max(self.noise, other.noise)
        raster = Raster(self.raster.place, self.raster.cells | other.raster.cells)
        trips = (*self.trips, *(trip for trip in other.trips if trip not in self.trips))
        rows = joined_rows(self.rows, other.rows, noise)
        return replace(self, rows=rows, raster=raster, noise=noise, trips=trips)

    # --- asked ----------------------------------------------------------------------------------
    def way(self, start: Point, goal: Point, facing: float | None = None) -> Way | None:
        """The way to take by a robot that faces `facing` [rad], or does not say where; `None`: there is none
        for a disc of radius r / cos 15° (said only if so).

        A start that is too near to something is left. A goal outside the field or nearer than r to something
        cannot be reached, unless the robot stands there. `None` is said only if there is none either without
        what is only supposed, and where pieces are noisy for a disc narrower by twice the noise.
        """
        require_places(np.array([*start, *goal]))
        start, goal = (float(start[0]), float(start[1])), (float(goal[0]), float(goal[1]))
        way = self.way_over(self.road_map, start, goal, facing)
        if way is None and (self.noise > 0.0 or len(self.sure) < len(self.rows)):
            return self.way_over(self.sure_road_map, start, goal, facing)
        return way

    def way_over(self, road_map: RoadMap, start: Point, goal: Point, facing: float | None) -> Way | None:
        """The way to take over some roads, by the map's strategy."""
        if self.strategy == "thesis":
            return thesis_way(road_map, self.raster, self.trail, start, goal)
        return best_way(road_map, self.raster, start, goal, facing)

    def is_cut(self, path: Path) -> bool:
        """Whether what is known for sure comes within r of a path [m], and nearer than to its beginning,
        where the robot stands (`way` may go through what is only supposed, and out of what is deep in it)."""
        room, deep = self.narrowest - CHECK, DEEP * self.radius
        return is_path_cut(self.sure, path, room, deep) or is_path_cut(fence(self.bounds), path, room, deep)

    def is_touched(self, place: Point) -> bool:
        """Whether something that is known for sure comes within r of a place [m]: no disc stands there."""
        return bool(crossed(self.sure, np.array([place, place]), self.narrowest - LINK).any())

    @property
    def pieces(self) -> Float[np.ndarray, "n 4"]:
        """x0, y0, x1, y1 of what is known of obstacles' edges [m]."""
        return self.rows[:, :4]

    @cached_property
    def sure(self) -> Float[np.ndarray, "n 4"]:
        """The pieces that are not only supposed [m]."""
        return self.pieces[self.rows[:, KIND] != SUPPOSED]

    @property
    def corners(self) -> Bool[np.ndarray, "n 2"]:
        """Which of their ends are corners."""
        return self.rows[:, CORNERS] > 0.0

    @property
    def narrowest(self) -> float:
        """Radius of the disc for which "no way" is said [m]: noise may have made gaps narrower."""
        return max(self.radius - 2.0 * self.noise, 0.5 * self.radius)

    @cached_property
    def road_map(self) -> RoadMap:
        """The roads among what is known."""
        return RoadMap(self.bounds, self.radius, self.pieces)

    @cached_property
    def sure_road_map(self) -> RoadMap:
        """The roads of a disc narrower by what the noise may have added, without what is only supposed."""
        return RoadMap(self.bounds, self.narrowest, self.sure)


def require_places(*arrays: np.ndarray) -> None:
    """Raises `WrongUse` where a number is no place."""
    if not all((np.abs(array) <= FARTHEST).all() for array in arrays):
        raise WrongUse(f"a place of a map must be finite numbers of at most {FARTHEST:g} m")
