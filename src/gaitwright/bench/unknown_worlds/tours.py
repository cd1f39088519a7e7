"""One world, and what became of everyone who was sent there, back, there, back, there, the map kept."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache

from gaitwright.bench.unknown_worlds.contestants import planner
from gaitwright.bench.unknown_worlds.drawn import rearranged, world
from gaitwright.bench.unknown_worlds.eyes import SIGMA, Camera
from gaitwright.bench.unknown_worlds.optimum import Optimum, optimum
from gaitwright.bench.unknown_worlds.oracle import has_way, truth
from gaitwright.bench.unknown_worlds.walker import ARRIVED, NONE, Trip, Walker
from gaitwright.bench.unknown_worlds.world import RADIUS, WIDER, World

TRIPS, FIRST = 5, 10
"""Trips in a world, and the world that is tried before those that count: an open one."""
SLIM = 0.13
"""With noise the disc is slimmer than its planner believes [m]."""


@dataclass(frozen=True)
class Asked:
    """A world by number, and who is sent there."""

    seed: int
    number: int
    planners: tuple[str, ...]
    camera: Camera = field(default_factory=Camera)
    trips: int = TRIPS
    has_noise: bool = False
    moves_after: int = 0
    """After so many trips some obstacles move; 0: they stay."""


@dataclass(frozen=True)
class Found:
    """What became of it."""

    name: str
    family: str
    kind: str
    gap: float | None
    truth: str
    """Whether there is a way: way, none, either."""
    optimum: Optimum
    tours: Mapping[str, tuple[Trip, ...]]
    """By planner, up to the first trip that did not arrive; where the trips went is left out."""
    later: str = ""
    """Truth and …"""
    later_optimum: Optimum | None = None
    """… optimum after obstacles moved."""

    def is_right(self, name: str) -> bool:
        """Whether a planner's answers are."""
        trips = self.tours[name]
        if self.truth == "none":
            return trips[-1].end == NONE and len(trips) == 1
        return all(trip.end == ARRIVED for trip in trips) or (
            self.truth == "either" and trips[-1].end == NONE and len(trips) == 1
        )

    def all_arrived(self, names: tuple[str, ...]) -> bool:
        """Whether all of these planners arrived on the first trip."""
        return all(self.tours[name][0].end == ARRIVED for name in names)


def toured(asked: Asked) -> Found:
    """Sends everyone who is asked for."""
    load(asked.planners)
    here = world(asked.seed, asked.number)
    bound = Optimum(float("inf"), float("inf"))
    said = noisy_truth(here) if asked.has_noise else truth(here)
    if said == "way":
        bound = optimum(here)
    tours = {name: tour(here, name, asked) for name in asked.planners}
    found = Found(here.name, here.family, here.kind, here.gap, said, bound, tours)
    if not asked.moves_after:
        return found
    there = rearranged(here, asked.number)
    later = truth(there)
    return replace(found, later=later, later_optimum=optimum(there) if later == "way" else None)


@cache
def load(planners: tuple[str, ...]) -> None:
    """Loads or compiles what is compiled, once in a process: else the first plans would be charged for it."""
    here = world(0, FIRST)
    optimum(here)
    for name in planners:
        tour(here, name, Asked(0, FIRST, (), trips=2))


def noisy_truth(here: World) -> str:
    """Where places are known by some centimetres only: what is to be said for sure."""
    if not has_way(here, SLIM):
        return "none"
    return "way" if has_way(here, WIDER + 2.0 * SIGMA) else "either"


def tour(here: World, name: str, asked: Asked) -> tuple[Trip, ...]:
    """A planner's trips, until one does not arrive."""
    blur, body = (asked.number, SLIM) if asked.has_noise else (None, RADIUS)
    walker = Walker(here, planner(name), asked.camera, blur, body)
    trips: list[Trip] = []
    for number in range(asked.trips):
        if number and number == asked.moves_after:
            walker.world = rearranged(here, asked.number)
        trip = walker.trip(here.start if number % 2 else here.goal)
        trips.append(replace(trip, way=trip.way[:0]))
        if trip.end != ARRIVED:
            break
    return tuple(trips)
