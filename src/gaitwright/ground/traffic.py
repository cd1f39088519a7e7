"""Grounds on which things move: (difficulty 0 … 1, scale, random numbers) → Layout. A crossing, a plaza.

Robots start at (0, 0) and look along x; the goal is (12, 0). Nothing comes within `CLEAR` of either.
"""

import math

import numpy as np

from gaitwright.ground.layout import Bounds, Layout, scaled
from gaitwright.ground.moving import Mover, Point, moved
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.scattering import between
from gaitwright.ground.solids import Cylinder, Prism
from gaitwright.ground.terrain import Box, Flat, Solid

GOAL = (12.0, 0.0)
BOUNDS: Bounds = (-2.0, -4.0, 14.0, 4.0)
CLEAR = 1.0
"""Room that things leave around start and goal [m]."""
RADII, HEIGHTS = (0.15, 0.35), (0.4, 0.9)
"""How large things are: radius of the circle that holds one, and height [m]."""


# --- crossing ----------------------------------------------------------------------------------------
FIRST, LAST = 2.0, 10.4
"""x of the first lane and of the last one [m]."""
WIDE, ASKEW = (1.6, 3.2), 0.5
"""How far a lane reaches to either side, and how far its ends are off straight across, at most [m]."""


def crossing(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Two lanes with slow things when easy (0.2 to 0.3 m/s), seven with fast ones when hard (0.4 to 0.8)."""
    lanes = np.linspace(FIRST, LAST, round(between(2.0, 7.0, difficulty)))
    movers = []
    for x in lanes:
        skew = rng.uniform(-ASKEW, ASKEW)
        right, left = (-rng.uniform(*WIDE), x - skew), (rng.uniform(*WIDE), x + skew)
        start = rng.uniform(right[0], left[0])
        share = (start - right[0]) / (left[0] - right[0])
        at = (right[1] + share * (left[1] - right[1]), start)
        ends = [(right[1], right[0]), (left[1], left[0])]
        along = tuple(rounded(*end) for end in (ends if rng.uniform() < 0.5 else ends[::-1]))
        movers.append(Mover(thing(rng, *at), along, pace(difficulty, rng), loop=True))
    return scaled(Layout(Flat(), (), BOUNDS, goal=GOAL, movers=tuple(movers)), scale)


# --- plaza -------------------------------------------------------------------------------------------
ROUND = 4
"""Points of the way of a thing that wanders, its first one among them."""
FIELD: Bounds = (1.5, -3.2, 10.5, 3.2)
"""Where things wander."""
LASTS = (12.0, 30.0)
"""For how long a thing is there that comes and goes [s]."""


def plaza(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Three things that wander and one that comes and goes when easy, ten and five when hard, as fast as in a
    crossing."""
    movers = []
    for _ in range(round(between(3.0, 10.0, difficulty))):
        first, *along = (somewhere(rng) for _ in range(ROUND))
        movers.append(Mover(thing(rng, *first), tuple(along), pace(difficulty, rng), loop=True))
    for _ in range(round(between(1.0, 5.0, difficulty))):
        x, y = rng.uniform(3.0, FIELD[2]), rng.uniform(-1.0, 1.0)
        appears = round(rng.uniform(0.5, 3.0), 2)  # before a robot can be there
        vanishes = round(appears + rng.uniform(*LASTS), 2)
        movers.append(Mover(thing(rng, x, y), appears=appears, vanishes=vanishes))
    return scaled(Layout(Flat(), (), BOUNDS, goal=GOAL, movers=tuple(movers)), scale)


def somewhere(rng: np.random.Generator) -> Point:
    """A place of the field."""
    x_min, y_min, x_max, y_max = FIELD
    return rounded(rng.uniform(x_min, x_max), rng.uniform(y_min, y_max))


# --- things ------------------------------------------------------------------------------------------
def thing(rng: np.random.Generator, x: float, y: float) -> Solid:
    """A post, a box or a six-sided block, with its centre at a place [m]."""
    radius, height = rng.uniform(*RADII), round(rng.uniform(*HEIGHTS), 3)
    kind, yaw = rng.integers(3), round(rng.uniform(-math.pi, math.pi), 3)
    place = rounded(x, y)
    if kind == 0:
        return Cylinder(*place, round(radius, 3), height)
    if kind == 1:
        return Box(*place, yaw, round(1.6 * radius, 3), round(1.2 * radius, 3), height)
    return moved(Prism(outline_of(regular(0.0, 0.0, radius, 6).round(3)), height), place)


def pace(difficulty: float, rng: np.random.Generator) -> float:
    """How fast a thing goes [m/s]."""
    return round(rng.uniform(between(0.2, 0.4, difficulty), between(0.3, 0.8, difficulty)), 3)


def rounded(x: float, y: float) -> Point:
    """A place to the millimetre."""
    return round(float(x), 3), round(float(y), 3)
