"""A course with everything on it: (difficulty 0 … 1, scale, random numbers) → Layout."""

import math

import numpy as np

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.layout import Bounds, Layout, scaled
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.scattering import between, clear_of, scattered
from gaitwright.ground.solids import Cylinder, Prism, Wedge
from gaitwright.ground.terrain import Box, HeightField, Solid, smooth_step

GOAL = (15.0, 0.0)
BOUNDS: Bounds = (-2.0, -3.0, 17.0, 3.0)
FIRST, LONG = 1.0, 2.6
"""x of the first stretch, and the length of each [m]."""
GRID = 0.025
"""Of the ground [m]: the walls of holes are as wide."""
HALF = 1.3
"""Half the width of ramp and steps [m]; beside them the ground is level."""


def mixed(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Stretches of blocks, holes, a ramp, steps and rough ground, 2.6 m each, in any order."""
    x = BOUNDS[0] - 1.0 + GRID * np.arange(round((BOUNDS[2] - BOUNDS[0] + 2.0) / GRID) + 1)
    y = BOUNDS[1] - 1.0 + GRID * np.arange(round((BOUNDS[3] - BOUNDS[1] + 2.0) / GRID) + 1)
    heights = np.zeros((len(y), len(x)))
    solids: list[Solid] = []
    found: list[Hole] = []
    for k, kind in enumerate(rng.permutation(["blocks", "holes", "ramp", "steps", "rough"])):
        at = FIRST + k * LONG
        if kind == "blocks":
            solids += _blocks(at, difficulty, rng)
        elif kind == "holes":
            found += _holes(at, difficulty, rng)
        elif kind == "ramp":
            solids += _ramp(at, difficulty)
        elif kind == "steps":
            solids += _steps(at, difficulty)
        else:
            heights += _rough(x, y, at, between(0.01, 0.05, difficulty), rng)
    ground = dug(HeightField(float(x[0]), float(y[0]), GRID, heights), found)
    boxes = tuple(solid for solid in solids if isinstance(solid, Box))
    shapes = tuple(solid for solid in solids if not isinstance(solid, Box))
    return scaled(Layout(ground, boxes, BOUNDS, shapes=shapes, holes=tuple(found), goal=GOAL), scale)


def _stretch(at: float) -> Bounds:
    """Where a stretch puts its things."""
    return (at + 0.2, BOUNDS[1] + 0.2, at + LONG - 0.2, BOUNDS[3] - 0.2)


def _blocks(at: float, difficulty: float, rng: np.random.Generator) -> list[Solid]:
    """Two to five high ones to walk around, low ones to step on, of three shapes."""
    high = scattered(rng, round(between(2.0, 5.0, difficulty)), _stretch(at), (0.15, 0.35), 0.9)
    low = scattered(rng, 14, _stretch(at), (0.1, 0.2), 0.05, clear_of(high, 0.05))
    out: list[Solid] = []
    for places, heights in ((high, (0.3, 0.5)), (low, (0.02, 0.04))):
        for x, y, radius in places:
            height = round(rng.uniform(*heights), 3)
            kind = rng.integers(3)
            if kind == 0:
                out.append(Cylinder(x, y, radius, height))
            elif kind == 1:
                out.append(Prism(outline_of(regular(x, y, radius, 5).round(4)), height))
            else:
                yaw = round(rng.uniform(-math.pi, math.pi), 3)
                out.append(Box(x, y, yaw, 1.5 * radius, 1.2 * radius, height))
    return out


def _holes(at: float, difficulty: float, rng: np.random.Generator) -> list[Hole]:
    """Holes for a leg to fall into, and some to walk around."""
    largest = between(0.08, 0.14, difficulty)
    many = round(between(6.0, 22.0, difficulty))
    places = scattered(rng, many, _stretch(at), (0.05, largest), 0.25)
    return [Hole(outline_of(regular(x, y, radius, 12)), 0.25) for x, y, radius in places]


def _ramp(at: float, difficulty: float) -> list[Solid]:
    """Up, a level piece, and down again: 8° when easy, 20° when hard."""
    length = 0.9
    high = length * math.tan(math.radians(between(8.0, 20.0, difficulty)))
    level = LONG - 0.2 - 2.0 * length
    middle = at + 0.1 + length + level / 2
    up, down = at + 0.1 + length / 2, at + LONG - 0.1 - length / 2
    return [
        Wedge(up, 0.0, 0.0, length, 2 * HALF, high),
        Box(middle, 0.0, 0.0, level, 2 * HALF, high),
        Wedge(down, 0.0, math.pi, length, 2 * HALF, high),
    ]


def _steps(at: float, difficulty: float) -> list[Solid]:
    """Three steps up and three down, 4 cm high when easy and 10 cm when hard, on top of each other."""
    rise, tread = between(0.04, 0.1, difficulty), (LONG - 0.2) / 6
    middle = at + LONG / 2
    return [Box(middle, 0.0, 0.0, (6 - 2 * k) * tread, 2 * HALF, rise, base=k * rise) for k in range(3)]


def _rough(x: np.ndarray, y: np.ndarray, at: float, amplitude: float, rng: np.random.Generator) -> np.ndarray:
    """Random heights 0.2 m apart, smooth between them, that fade out at both ends of the stretch."""
    node = round(0.2 / GRID)
    columns, rows = len(x) // node + 2, len(y) // node + 2
    nodes = rng.uniform(-amplitude, amplitude, (rows, columns))
    u, v = np.arange(len(x)) / node, np.arange(len(y)) / node
    i, j = u.astype(int), v.astype(int)
    share_x, share_y = smooth_step(u - i)[None, :], smooth_step(v - j)[:, None]
    low = nodes[j][:, i] * (1 - share_x) + nodes[j][:, i + 1] * share_x
    high = nodes[j + 1][:, i] * (1 - share_x) + nodes[j + 1][:, i + 1] * share_x
    fade = smooth_step((x - at) / 0.3) * smooth_step((at + LONG - x) / 0.3)
    return (low * (1 - share_y) + high * share_y) * fade[None, :]
