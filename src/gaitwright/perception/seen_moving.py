"""Sights one after the other → what stands, and what moves: who sees tells them apart by itself.

A wall that lies well within ground which a look of the last second saw to be free was not there before. Its
velocity is that of the walls which it follows from look to look. What has just appeared is held back until it
is known whether it moves; what moves and is lost from view is taken to go on for a while.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.numerics.geometry import GRAVITY
from gaitwright.perception.edge_runs import SECTORS
from gaitwright.signals import Moving, Sight

REMEMBERED, FOLLOWED, HELD = 1.0, 0.6, 1.5
"""Looks are remembered for so long; a velocity is taken from those of so long; what is lost from view goes on
for so long [s]."""
APART = 0.17
"""From point to point along a wall, in body heights."""
WITHIN = 0.17
"""A wall was not there where it lies so far within free ground, in body heights, and 3 times the noise."""
FEW, TWICE = 3, 2
"""So many points of a wall must, in so many looks."""
GONE, NEAR = 0.5, 1.0
"""What moved is not there if so much of its edge would be on free ground, or so near to what is seen, in body
heights."""
LOOKS = 4
"""After so many it is known whether what appeared moves; one fewer tell that it does."""
CALM = 0.5
"""So much of a velocity is what it was a look before: from single looks it is too uneasy to go by."""
SLOWEST, FASTEST = 0.06, 1.5
"""What moves goes so fast, in √(g h); what goes faster is not followed."""

Point = Float[np.ndarray, "2"]
Points = Float[np.ndarray, "_ 2"]


class Look(NamedTuple):
    """What is remembered of a sight."""

    time: float
    eye: Point
    free: Float[np.ndarray, "sectors"]
    """How far it is free in each sector around the eye [m]."""
    walls: tuple[Points, ...]
    """Points along each wall that hangs together."""
    middles: Float[np.ndarray, "_ 2"]
    """Of each of them, what it is followed by."""


class Track(NamedTuple):
    """A thing that moves."""

    moving: Moving
    fresh: float
    """When it was last where there was free ground before [s]."""


class Watched(NamedTuple):
    """What is remembered from look to look."""

    looks: tuple[Look, ...] = ()
    tracks: tuple[Track, ...] = ()

    @property
    def moving(self) -> tuple[Moving, ...]:
        """What moves."""
        return tuple(track.moving for track in self.tracks)


def told_apart(
    sight: Sight, time: float, before: Watched, height: float, noise: float
) -> tuple[Sight, Watched]:
    """The sight of what stands, and what moves with what is remembered. `height`: of the body [m]; `noise`:
    standard deviation of where walls are seen [m]."""
    wall, pace = wall_of_each(sight), math.sqrt(GRAVITY * height)
    look = look_of(sight, wall, time, height)
    looks = tuple(one for one in before.looks if time - one.time <= REMEMBERED + 1e-9)
    fresh = were_free(look, looks, WITHIN * height + 3.0 * noise)
    comes = np.array([come(track, look) for track in before.tracks]).reshape(-1, 2)
    tracks, found, apart = [], set(), np.zeros(len(look.walls), dtype=bool)
    for k, points in enumerate(look.walls):
        j = track_to(look, k, before.tracks, comes, FASTEST * pace)
        if not (fresh[k] or j >= 0):
            continue
        velocity, count = followed(look, k, looks, FASTEST * pace)
        moves = count >= LOOKS - 1 and math.hypot(*velocity) >= SLOWEST * pace
        apart[k] = moves or (fresh[k] and count < LOOKS)
        if moves:
            since = time if fresh[k] else before.tracks[j].fresh
            if j >= 0:
                x, y = CALM * np.array(before.tracks[j].moving.velocity) + (1.0 - CALM) * np.array(velocity)
                velocity = float(x), float(y)
            tracks.append(Track(Moving(points, velocity, time), since))
            found.add(j)
    if apart.any():
        stands = ~apart[wall]
        sight = sight._replace(pieces=sight.pieces[stands], corners=sight.corners[stands])
    hidden = (
        one for j, one in enumerate(before.tracks) if j not in found and is_hidden(one, look, NEAR * height)
    )
    return sight, Watched((*looks, look), (*tracks, *hidden))


def wall_of_each(sight: Sight) -> np.ndarray:
    """Number of the wall that each piece is of: those hang together that begin where the one before ends."""
    pieces = sight.pieces
    begins = (pieces[1:, :2] != pieces[:-1, 2:]).any(axis=1)
    return np.concatenate([np.zeros(min(len(pieces), 1), dtype=int), np.cumsum(begins)])


def look_of(sight: Sight, wall: np.ndarray, time: float, height: float) -> Look:
    """What to remember of a sight. `wall`: number of the wall that each piece is of."""
    eye = np.array(sight.eye)
    walls = tuple(
        np.concatenate([points_along(piece, APART * height) for piece in sight.pieces[wall == k]])
        for k in range(wall[-1] + 1 if len(wall) else 0)
    )
    middles = np.array([middle(points, eye) for points in walls]).reshape(-1, 2)
    rim = sight.free - eye
    far = np.hypot(rim[:, 0], rim[:, 1])
    free = np.zeros(SECTORS)
    free[sectors_of(rim)[far > 0.0]] = far[far > 0.0]
    return Look(time, eye, free, walls, middles)


def points_along(piece: Float[np.ndarray, "4"], apart: float) -> Points:
    """Points of a piece from end to end, no farther apart than that [m]."""
    count = max(1, math.ceil(math.dist(piece[:2], piece[2:]) / apart))
    share = np.linspace(0.0, 1.0, count + 1)[:, None]
    return (1.0 - share) * piece[:2] + share * piece[2:]


def middle(points: Points, eye: Point) -> Point:
    """What a wall is followed by: between the middle of what is seen of it and its nearest point. The former
    alone wanders as more of it is seen, the latter as it turns."""
    nearest = points[np.argmin(((points - eye) ** 2).sum(axis=1))]
    return (points.mean(axis=0) + nearest) / 2.0


def sectors_of(away: Points) -> np.ndarray:
    """The sectors that places lie in, from the eye."""
    return np.floor(np.arctan2(away[:, 1], away[:, 0]) / (2.0 * math.pi) * SECTORS).astype(int) % SECTORS


def is_free(places: Points, look: Look, within: float) -> Bool[np.ndarray, "_"]:
    """Which places a look saw to lie so far within free ground [m], to both sides by a sector too."""
    away = places - look.eye
    sector = sectors_of(away)
    free = np.minimum(look.free[sector], np.minimum(look.free[sector - 1], look.free[(sector + 1) % SECTORS]))
    return np.hypot(away[:, 0], away[:, 1]) < free - within


def were_free(look: Look, looks: tuple[Look, ...], within: float) -> Bool[np.ndarray, "walls"]:
    """Which walls of a look lie where one of the last looks saw free ground."""
    if not look.walls or not looks:
        return np.zeros(len(look.walls), dtype=bool)
    places = np.concatenate(look.walls)
    free = np.sum([is_free(places, one, within) for one in looks], axis=0) >= TWICE
    wall = np.repeat(np.arange(len(look.walls)), [len(points) for points in look.walls])
    return np.bincount(wall, free, len(look.walls)) >= FEW


def followed(look: Look, k: int, looks: tuple[Look, ...], fastest: float) -> tuple[tuple[float, float], int]:
    """Velocity of wall `k` of a look [m/s], and in how many looks it was seen: each time the nearest one."""
    times, places = [look.time], [look.middles[k]]
    for one in reversed(looks):
        away = np.hypot(*(one.middles - places[-1]).T)
        if look.time - one.time > FOLLOWED + 1e-9 or not (away < fastest * (times[-1] - one.time)).any():
            break
        times.append(one.time)
        places.append(one.middles[np.argmin(away)])
    if len(times) < 2:
        return (0.0, 0.0), 1
    time, place = np.array(times) - np.mean(times), np.array(places)
    x, y = time @ place / (time @ time)
    return (float(x), float(y)), len(times)


def track_to(look: Look, k: int, tracks: tuple[Track, ...], comes: Points, fastest: float) -> int:
    """The track that leads to wall `k` of a look; -1: none does. `comes`: where they have come to by now."""
    if not tracks:
        return -1
    away = np.hypot(*(comes - look.middles[k]).T)
    j = int(np.argmin(away))
    passed = look.time - tracks[j].moving.time
    return j if away[j] < fastest * passed and look.time - tracks[j].fresh <= HELD else -1


def come(track: Track, look: Look) -> Point:
    """Where what moved has come to by the time of a look, as it is followed."""
    return middle(now_at(track, look), look.eye)


def now_at(track: Track, look: Look) -> Points:
    """The edge of what moved by the time of a look, if it went on [m]."""
    one = track.moving
    return one.edge + (look.time - one.time) * np.array(one.velocity)


def is_hidden(track: Track, look: Look, near: float) -> bool:
    """Whether what moved may still be there, out of view: it was seen not long ago, is not seen to be gone,
    and nothing else is seen so near to there [m]."""
    if look.time - track.moving.time > HELD:
        return False
    edge = now_at(track, look)
    seen = any((np.hypot(*(points - edge.mean(axis=0)).T) < near).any() for points in look.walls)
    return not seen and bool(is_free(edge, look, 0.0).mean() < GONE)
