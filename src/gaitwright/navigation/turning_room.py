"""Room to turn: where there is none towards the way ahead, how to go on, or where to go first (V6).

A robot that is longer than wide sweeps more where it turns in place than where it walks. Where things are in
the way of that, it goes on along its path as it stands and turns as far as there is room; where that leads
nowhere, it first goes to the nearest place with room all round: straight to any side, back the way it came,
or backwards along its path.
"""

import math
from typing import NamedTuple

import numpy as np

from gaitwright.navigation.footprint import (
    ALIGNED,
    Footprint,
    Pieces,
    Pose,
    backs,
    follows,
    goes,
    near,
    place_apart,
    turns,
)
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.paths import begin_of, length
from gaitwright.navigation.planning import Point
from gaitwright.navigation.raster import is_known
from gaitwright.numerics.geometry import wrap
from gaitwright.signals import SHARP

DIRECTIONS = tuple(math.radians(angle) for angle in (180, 90, -90, 0, 135, -135, 45, -45))
"""Of straight moves, from ahead to the left [rad]; of equally short ones the first is taken."""
FARTHEST, STEP = 8.0, 0.02
"""A straight move is at most so many turning radii long; places are looked at in such steps [m]."""
ALONG = 3.0
"""A robot looks along its path after so many turning radii at most, if it goes on as it stands."""
SPARE = 0.05
"""A place to turn has this much more room than turning takes, in turning radii."""
BEHIND = math.radians(120)
"""What is farther from straight ahead is gone to backwards [rad]."""
EVERY, MOST = 0.25, 200
"""Places along which a robot came are remembered in such steps, in turning radii, and so many of them."""


class Turning(NamedTuple):
    """How a robot comes to look along its way."""

    facing: float | None = None
    """Where it looks meanwhile, a world direction [rad]; `None`: towards the next point."""
    aside: tuple[Point, ...] = ()
    """Where it goes first [m]."""


FREE = Turning()
"""There is room."""


def room_to_turn(
    known: LearnedMap, body: Footprint, pose: Pose, path: tuple[Point, ...], trail: tuple[Point, ...]
) -> Turning | None:
    """How a robot turns to a path. `None`: there is no room, and no place that has some is near, was passed
    or lies on the path."""
    x, y, yaw = pose
    by = off_of(pose, path[0])
    if abs(by) <= ALIGNED:
        return FREE
    pieces = near(known.pieces, (x, y), (ALONG + 1.0 + SPARE) * body.radius)
    if not len(pieces) or turns(pieces, pose, by, body) == by:
        return FREE
    if follows(pieces, pose, path, ALONG * body.radius, body):
        return Turning(yaw + turns(pieces, pose, by, body))
    if abs(by) <= SHARP:
        return FREE
    ways = (
        straight_aside(known, body, pose),
        back_along(known, body, (x, y), trail),
        backwards(known, body, pose, path),
    )
    found = [way for way in ways if way]
    return going(known, body, pose, min(found, key=lambda way: length((x, y), way))) if found else None


def going(known: LearnedMap, body: Footprint, pose: Pose, aside: tuple[Point, ...]) -> Turning:
    """How a robot goes aside: backwards where that leads back, else as it stands."""
    x, y, yaw = pose
    off = off_of(pose, aside[0])
    if abs(off) <= BEHIND:
        return Turning(yaw, aside)
    pieces = near(known.pieces, (x, y), (1.0 + SPARE) * body.radius)
    return Turning(yaw + turns(pieces, pose, float(wrap(off - math.pi)), body), aside)


def off_of(pose: Pose, point: Point) -> float:
    """How far to the left of the robot's nose a point lies [rad]."""
    return float(wrap(math.atan2(point[1] - pose[1], point[0] - pose[0]) - pose[2]))


# --- where there is room ----------------------------------------------------------------------------
def straight_aside(known: LearnedMap, body: Footprint, pose: Pose) -> tuple[Point, ...]:
    """The nearest place with room, straight on over known ground; none where there is none."""
    x, y, yaw = pose
    best, place = FARTHEST * body.radius, ()
    pieces = near(known.pieces, (x, y), best + (1.0 + SPARE) * body.radius)
    for angle in DIRECTIONS:
        free = goes(pieces, pose, yaw + angle, best, body)
        for far in np.arange(STEP, min(free, best - STEP / 2.0), STEP).tolist():
            there = onwards((x, y), yaw + angle, far)
            if has_room(pieces, body, there):
                if is_seen(known, body, (x, y), there):
                    best, place = far, (there,)
                break
    return place


def back_along(
    known: LearnedMap, body: Footprint, here: Point, trail: tuple[Point, ...]
) -> tuple[Point, ...]:
    """The way back to the last place with room that the robot came along; none where there was none."""
    for k in range(len(trail) - 1, -1, -1):
        if has_room(near(known.pieces, trail[k], (1.0 + SPARE) * body.radius), body, trail[k]):
            return tuple(place for place in trail[k:][::-1] if math.dist(place, here) > STEP)
    return ()


def backwards(known: LearnedMap, body: Footprint, pose: Pose, path: tuple[Point, ...]) -> tuple[Point, ...]:
    """The beginning of a path that leads back, to where there is room, or all of it; none where it does not
    lead back, or over ground that was never seen."""
    here = pose[:2]
    if abs(off_of(pose, path[0])) <= BEHIND:
        return ()
    far = backs(known.pieces, pose, path, (1.0 + SPARE) * body.radius, body)
    way = begin_of(here, path, far) if far > 0.0 else ()
    legs = zip((here, *way), way, strict=False)
    return way if all(is_seen(known, body, *leg) for leg in legs) else ()


def has_room(pieces: Pieces, body: Footprint, place: Point) -> bool:
    """Whether a robot can turn all round at a place."""
    wanted = (1.0 + SPARE) * body.radius
    return bool(place_apart(pieces, *place, wanted) >= wanted)


def is_seen(known: LearnedMap, body: Footprint, here: Point, there: Point) -> bool:
    """Whether ground is known to be free from beside the body on, as far as a move goes."""
    far = math.dist(here, there)
    if far <= body.side:
        return True
    begin = onwards(here, math.atan2(there[1] - here[1], there[0] - here[0]), body.side)
    return bool(is_known(known.raster.cells, known.raster.place, *begin, *there))


def onwards(here: Point, towards: float, far: float) -> Point:
    """The place so far away in a world direction."""
    return here[0] + far * math.cos(towards), here[1] + far * math.sin(towards)


# --- where it came along ----------------------------------------------------------------------------
def come_along(trail: tuple[Point, ...], here: Point, body: Footprint) -> tuple[Point, ...]:
    """The trail of a robot that is here now: loops are cut off, so it shortens where the robot goes back."""
    step = EVERY * body.radius
    if not trail:
        return (here,)
    apart = np.hypot(*(np.array(trail) - here).T)
    again = int(np.argmax(apart < step))
    if apart[again] < step:
        return trail[: again + 1]
    return (*trail, here)[-MOST:]
