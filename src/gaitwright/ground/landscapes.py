"""Grounds to walk over: (difficulty 0 … 1, scale, random numbers) → Layout. Holes, trenches, waves, hills."""

import math

import numpy as np
import shapely

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.layout import Bounds, Layout, scaled
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.scattering import between, free_of_ends, scattered
from gaitwright.ground.splines import spline_field
from gaitwright.ground.terrain import Flat, HeightField, rectangle, smooth_step

GOAL = (12.0, 0.0)
BOUNDS: Bounds = (-2.0, -4.0, 14.0, 4.0)

# --- holes -------------------------------------------------------------------------------------------
APART = 0.45
"""Least ground between two holes [m]: a dog walks between them."""
DEEP = 0.3
"""Depth of holes and trenches [m]."""


def holes(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Round, square and irregular holes, up to 0.6 m across: some for a leg, some to walk around."""
    many = round(between(10.0, 50.0, difficulty))
    largest = between(0.12, 0.3, difficulty)
    places = scattered(rng, many, BOUNDS, (0.06, largest), APART, free_of_ends((0.0, 0.0), GOAL))
    found = tuple(Hole(outline_of(_mouth(rng, x, y, radius)), DEEP) for x, y, radius in places)
    return scaled(Layout(dug(Flat(), found), (), BOUNDS, holes=found, goal=GOAL), scale)


def _mouth(rng: np.random.Generator, x: float, y: float, radius: float) -> np.ndarray:
    """The outline of a hole in a circle."""
    kind = rng.integers(3)
    if kind == 0:
        return regular(x, y, radius, 16)
    if kind == 1:
        angle = rng.uniform(0.5, 1.0)
        sides = 2.0 * radius * math.cos(angle), 2.0 * radius * math.sin(angle)
        return rectangle(x, y, rng.uniform(-math.pi, math.pi), *sides)
    angles = 2.0 * math.pi * (np.arange(9) + rng.uniform(-0.3, 0.3, 9)) / 9.0
    rays = radius * rng.uniform(0.55, 1.0, 9)
    return np.column_stack([np.cos(angles), np.sin(angles)]) * rays[:, None] + (x, y)


TRENCHES, TRENCH_AT, ISLAND = 3, 1.4, 0.9
"""How many, x of the first, ground between two [m]."""
ACROSS: Bounds = (-4.0, -4.0, 10.0, 4.0)


def trench(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Trenches across the whole field, each a little askew, 5 to 20 cm wide."""
    found, at, skewed = [], TRENCH_AT, rng.uniform(-0.2, 0.2) * difficulty
    for _ in range(TRENCHES):
        width = between(0.05, 0.2, difficulty) * rng.uniform(0.8, 1.0)
        skew = skewed + rng.uniform(-0.04, 0.04) * difficulty
        strip = rectangle(at + width / 2, 0.0, skew, width, 12.0)
        inside = shapely.intersection(shapely.Polygon(strip), shapely.box(*ACROSS))
        found.append(Hole(outline_of(shapely.get_coordinates(inside)[:-1]), DEEP))
        at += ISLAND + width
    return scaled(Layout(dug(Flat(), found), (), ACROSS, holes=tuple(found), goal=(6.0, 0.0)), scale)


# --- smooth ground -----------------------------------------------------------------------------------
RIM = 1.0
"""Smooth ground goes on beyond the bounds by so much [m]."""
LEVEL, BLEND = 0.8, 1.0
"""Radius of the level start, and the width over which the hills grow from it [m]."""


def waves(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Waves 2 m long and up to 0.15 m high, their crests askew, over a net of points 0.25 m apart."""
    spacing, length = 0.25, rng.uniform(1.7, 2.3)
    x, y = _net(spacing)
    course, phase = rng.uniform(-0.5, 0.5), rng.uniform(-math.pi, math.pi)
    along = np.cos(course) * x[None, :] + np.sin(course) * y[:, None]
    swell = 1.0 + 0.3 * np.sin(
        2.0 * math.pi * (y[:, None] - x[None, :]) / 7.0 + rng.uniform(-math.pi, math.pi)
    )
    heights = between(0.02, 0.11, difficulty) * swell * np.sin(2.0 * math.pi * along / length + phase)
    return _smooth(heights * _grown(x, y), spacing, 0.0, scale)


def hills(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Hills and hollows of Bézier patches 2.4 m wide that join without a crease."""
    spacing = 0.8
    x, y = _net(spacing, 3)
    net = _bumps(x, y, rng) * between(0.08, 0.5, difficulty) * _grown(x, y)
    net[3:-1:3] = (net[2:-2:3] + net[4::3]) / 2  # a joint lies between its neighbours
    net[:, 3:-1:3] = (net[:, 2:-2:3] + net[:, 4::3]) / 2
    return _smooth(net, spacing, None, scale)


BUMPS = 60
"""Hills and hollows that the control heights are taken from."""


def _bumps(x: np.ndarray, y: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Heights of round hills and hollows of all sizes, about one high [-]."""
    out = np.zeros((len(y), len(x)))
    for _ in range(BUMPS):
        at_x, at_y = rng.uniform(x[0], x[-1]), rng.uniform(y[0], y[-1])
        away = np.hypot(x[None, :] - at_x, y[:, None] - at_y) / rng.uniform(1.2, 3.0)
        out += rng.uniform(-1.0, 1.0) * (1.0 - smooth_step(away))
    return out


def _net(spacing: float, multiple: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Places of the control points along x and y: a multiple of so many spans [m]."""
    x_min, y_min, x_max, y_max = BOUNDS
    counts = (
        multiple * math.ceil((high - low + 2 * RIM) / (spacing * multiple)) + 1
        for low, high in ((x_min, x_max), (y_min, y_max))
    )
    columns, rows = counts
    return x_min - RIM + spacing * np.arange(columns), y_min - RIM + spacing * np.arange(rows)


def _grown(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """How much of a hill there is at places: none at the start."""
    return smooth_step((np.hypot(x[None, :], y[:, None]) - LEVEL) / BLEND)


def _smooth(net: np.ndarray, spacing: float, tension: float | None, scale: float) -> Layout:
    field = spline_field(BOUNDS[0] - RIM, BOUNDS[1] - RIM, spacing, net, tension)
    x = field.x_min + field.spacing * np.arange(field.heights.shape[1])
    y = field.y_min + field.spacing * np.arange(field.heights.shape[0])
    level = smooth_step((np.hypot(x[None, :], y[:, None]) - LEVEL / 2) / BLEND)
    field = HeightField(field.x_min, field.y_min, field.spacing, field.heights * level)
    return scaled(Layout(field, (), BOUNDS, goal=GOAL), scale)
