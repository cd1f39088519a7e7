"""Is there a way for a disc? By shapely's buffers alone, whatever the planner does."""

import shapely

from gaitwright.bench.unknown_worlds.world import BOUNDS, RADIUS, WIDER, Point, World

QUARTER = 64
"""Chords of a quarter circle: the room taken is too small by at most 0.012 mm."""


def has_way(world: World, radius: float, start: Point | None = None, goal: Point | None = None) -> bool:
    """Whether a disc of this radius [m] gets from start to goal (the world's, where not said)."""
    free = shapely.box(*BOUNDS).difference(grown(world, radius, QUARTER))
    ends = shapely.points([start or world.start, goal or world.goal])
    return any(bool(shapely.intersects(part, ends).all()) for part in shapely.get_parts(free))


def grown(world: World, radius: float, quarter: int) -> shapely.Geometry:
    """What a disc's centre cannot enter, less what chords cut off: corners lie on the true circles.

    Of convex obstacles one by one: of others GEOS smooths hollows before it buffers.
    """
    return shapely.union_all(shapely.buffer(list(world.obstacles), radius, quad_segs=quarter))


def truth(world: World) -> str:
    """`way`, `none`, or `either` where only the two radii differ: then both answers are right."""
    if not has_way(world, RADIUS):
        return "none"
    return "way" if has_way(world, WIDER) else "either"
