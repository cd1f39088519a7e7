"""A programme is gone as it is written, from stop to stop; whatever is in its way ends it (V6)."""

import math
from dataclasses import replace

import numpy as np

from gaitwright.missions import Mission, Programme, Stop
from gaitwright.model.robot import Robot
from gaitwright.model.stopping import stopping_distance
from gaitwright.navigation.known_field import is_within
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.paths import directions, length, part_way
from gaitwright.navigation.planning import Point
from gaitwright.navigation.reached import ARRIVED, PASSED, STOP_AT, has_arrived
from gaitwright.navigation.travel import Moment, Travel
from gaitwright.signals import Route

AHEAD = 1.5
"""The robot stops so many body lengths before what is in its way, and what it takes to slow down."""
USUAL = 1.5
"""A robot that was told no speed goes at most so many body heights a second."""


def stops_of(mission: Mission) -> tuple[Stop, ...]:
    """The stops of a mission's programme; none where it has none."""
    return mission.guidance.stops if isinstance(mission.guidance, Programme) else ()


def set_out_on(travel: Travel, known: LearnedMap, now: Moment) -> Route:
    """The route over the stops that are left; `no_way` says where it leads outside, or through what was
    `known` before the first look: what is seen then, or later, is walked up to."""
    points, speed = tuple((stop.x, stop.y) for stop in travel.stops), travel.mission.speed
    no_way = first_fault(known, now, points)
    if no_way:
        return Route((), 0.0, speed, no_way=no_way)
    begins, ends = directions((now.place, *points))
    return as_left(Route((), 0.0, speed, begins=begins, ends=ends), travel, now)


def first_fault(known: LearnedMap, now: Moment, points: tuple[Point, ...]) -> str | None:
    """Why a way from point to point cannot be gone, as a sentence."""
    for before, point in zip((now.place, *points), points, strict=False):
        if not is_within(now.ground.bounds, point):
            return f"({point[0]:g}, {point[1]:g}) lies outside the scene"
        if known.is_cut((before, point)):
            whence = "here" if before is now.place else f"({before[0]:g}, {before[1]:g})"
            return f"straight from {whence} to ({point[0]:g}, {point[1]:g}) stands an obstacle"
    return None


def gone_on_with(route: Route, travel: Travel, now: Moment, robot: Robot) -> tuple[Route, Travel]:
    """What is left of a programme: stops are left behind, waited at, and not reached where something stands
    in the way."""
    stops, unit = travel.stops, robot.body_length
    if travel.waits_until is not None:
        if now.time < travel.waits_until - 1e-9:
            return route, travel
        stops = (stops[0]._replace(wait=0.0), *stops[1:])
        travel = travel._replace(waits_until=None)
    while stops[1:] and stops[0].wait == 0.0 and is_passed(now, stops[0][:2], unit):
        stops = stops[1:]
    travel = travel._replace(stops=stops)
    route = replace(as_left(route, travel, now), pause=None)
    stop = stops[0]
    if stop.wait > 0.0 and route.remaining < STOP_AT * unit:
        travel = travel._replace(waits_until=now.time + stop.wait)
        return replace(route, pause=f"it waits {stop.wait:g} s at ({stop.x:g}, {stop.y:g})"), travel
    arrived = len(stops) == 1 and has_arrived(route, robot)
    return replace(route, arrived=arrived, halt=in_the_way(travel.known, route, now, robot)), travel


def as_left(route: Route, travel: Travel, now: Moment) -> Route:
    """The route from here over the stops that are left, up to the first where the robot is to stand."""
    stops, speed = travel.stops, travel.mission.speed
    resting = next((k for k, stop in enumerate(stops) if stop.wait > 0.0), len(stops) - 1)
    path = tuple((stop.x, stop.y) for stop in stops[: resting + 1])
    own = stops[0].speed if stops else None
    return replace(route, path=path, remaining=length(now.place, path), speed=speed if own is None else own)


def is_passed(now: Moment, point: Point, unit: float) -> bool:
    """Whether a robot may leave a point behind: it has come to it, or it lies behind it nearby."""
    return math.dist(now.place, point) < ARRIVED * unit or now.has_gone_by(point, PASSED * unit)


def in_the_way(known: LearnedMap, route: Route, now: Moment, robot: Robot) -> str | None:
    """What stands in the way to the next stop, near enough to stop before it, as a sentence."""
    (x, y), here = route.path[0], now.place
    far = math.dist(here, (x, y))
    speed = route.speed if route.speed is not None else USUAL * robot.height
    look = AHEAD * robot.body_length + stopping_distance(speed)
    share = min(1.0, look / far) if far > 0.0 else 0.0
    if not known.is_cut((here, part_way(here, (x, y), share))):
        return None
    parts = np.linspace(0.0, share, 41).tolist()
    clear = next(part for part in parts if known.is_cut((here, part_way(here, (x, y), part))))
    return f"something stands in the way to ({x:g}, {y:g}), {clear * far:.1f} m ahead"
