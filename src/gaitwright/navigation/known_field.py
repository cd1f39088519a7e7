"""A ground that is known from the start → the map that ways are planned on."""

from functools import lru_cache

from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.planning import Point
from gaitwright.navigation.unlearning import is_inside
from gaitwright.signals import GroundMap


@lru_cache(maxsize=4)
def known_field(ground: GroundMap, radius: float) -> LearnedMap:
    """The map for a disc of a radius [m], the middle of which stays within the bounds."""
    x_min, y_min, x_max, y_max = ground.bounds
    around = (x_min - radius, y_min - radius, x_max + radius, y_max + radius)
    return LearnedMap.of_polygons(around, radius, ground.obstacles)


def is_blocked(ground: GroundMap, radius: float, point: Point) -> bool:
    """Whether a disc that stands at a place of a known ground is on an obstacle, or too near to one."""
    return known_field(ground, radius).is_touched(point) or is_on_obstacle(ground, point)


def is_on_obstacle(ground: GroundMap, point: Point) -> bool:
    """Whether a place lies within an outline that is known."""
    return any(is_inside(*point, outline) for outline in ground.obstacles)


def is_within(bounds: tuple[float, float, float, float], point: Point, room: float = 0.0) -> bool:
    """Whether a place lies in a field and more than some room [m] from its edge."""
    x_min, y_min, x_max, y_max = bounds
    return x_min + room < point[0] < x_max - room and y_min + room < point[1] < y_max - room
