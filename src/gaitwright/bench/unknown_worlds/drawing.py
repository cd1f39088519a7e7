"""First trips of everyone, one world of each family, as a picture."""

from pathlib import Path

from gaitwright.bench.unknown_worlds.baselines import length_of
from gaitwright.bench.unknown_worlds.contestants import planner
from gaitwright.bench.unknown_worlds.drawn import world
from gaitwright.bench.unknown_worlds.eyes import Camera
from gaitwright.bench.unknown_worlds.families import FAMILIES
from gaitwright.bench.unknown_worlds.optimum import shortest_way
from gaitwright.bench.unknown_worlds.walker import Walker
from gaitwright.pictures.walks_above import Walks, walks_picture

NUMBERS = (*range(2 * len(FAMILIES), 3 * len(FAMILIES)), 2)
"""An open world of each family, and one with a gap that decides."""


def draw(seed: int, names: tuple[str, ...], path: Path) -> int:
    """Draws how each of the named planners went at first; how many worlds."""
    panels = []
    for number in NUMBERS:
        here = world(seed, number)
        trips = {name: Walker(here, planner(name), Camera()).trip(here.goal) for name in names}
        ways = {f"{name}: {trip.end}, {trip.metres:.1f} m": trip.way for name, trip in trips.items()}
        known = shortest_way(here)
        if len(known):
            ways[f"with everything known: {length_of(known):.1f} m"] = known
        outlines = tuple(list(one.exterior.coords) for one in here.obstacles)
        title = here.name if here.gap is None else f"{here.name}: gap {1e3 * here.gap:+.1f} mm"
        panels.append(Walks(title, outlines, here.start, here.goal, ways))
    walks_picture(panels, path)
    return len(panels)
