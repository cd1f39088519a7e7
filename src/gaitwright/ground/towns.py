"""Places to find a way through: (difficulty 0 … 1, scale, random numbers) → Layout.

A forest, streets, rooms, a maze, a bug trap. Robots start at (0, 0) and look along x; the goal is (12, 0).
"""

import math

import numpy as np

from gaitwright.ground.layout import Bounds, Layout, scaled
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.scattering import between, clear_of, free_of_ends, scattered
from gaitwright.ground.solids import Cylinder, Prism, Sphere
from gaitwright.ground.terrain import Box, Flat, Solid

GOAL = (12.0, 0.0)
BOUNDS: Bounds = (-2.0, -6.0, 14.0, 6.0)
WALL, HIGH = 0.1, 0.6
"""Thickness and height of a wall [m]."""


# --- forest ------------------------------------------------------------------------------------------
def forest(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """Trunks and boulders, 1.2 m apart when easy and 0.5 m when hard, and stumps to step on."""
    gap = between(1.2, 0.5, difficulty)
    may = free_of_ends((0.0, 0.0), GOAL)
    boulders = scattered(rng, 10, BOUNDS, (0.25, 0.5), gap, may)
    trunks = scattered(
        rng, round(between(25.0, 130.0, difficulty)), BOUNDS, (0.06, 0.2), gap, may, clear_of(boulders, gap)
    )
    stumps = scattered(rng, 30, BOUNDS, (0.08, 0.2), 0.1, may, clear_of([*trunks, *boulders], 0.1))
    shapes: list[Solid] = [Cylinder(x, y, r, round(rng.uniform(0.6, 1.4), 3)) for x, y, r in trunks]
    for x, y, r in boulders:
        if rng.uniform() < 0.5:
            shapes.append(Sphere(x, y, r, round(r * rng.uniform(0.7, 1.0), 3)))
        else:
            shapes.append(Prism(_rock(rng, x, y, r), round(rng.uniform(0.2, 0.5), 3)))
    shapes += [Cylinder(x, y, r, round(rng.uniform(0.02, 0.05), 3)) for x, y, r in stumps]
    return scaled(Layout(Flat(), (), BOUNDS, shapes=tuple(shapes), goal=GOAL), scale)


def _rock(rng: np.random.Generator, x: float, y: float, radius: float) -> tuple:
    """An irregular outline in a circle, mostly not convex."""
    corners = regular(0.0, 0.0, radius, 9) * rng.uniform(0.6, 1.0, 9)[:, None] + (x, y)
    return outline_of(corners.round(4))


# --- streets -----------------------------------------------------------------------------------------
BLOCK = 3.0
"""From junction to junction [m]."""
COLUMNS, ROWS = 5, 5
"""Junctions along x and y."""


def streets(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """5 × 5 junctions, 3 m apart, of streets 1.6 m wide when easy and 1 m when hard; of the stretches between
    junctions up to a third are shut by a barrier. Houses are square, L- and U-shaped."""
    width = between(1.6, 1.0, difficulty)
    low = -BLOCK * (ROWS - 1) / 2
    shapes: list[Solid] = []
    for i in range(COLUMNS - 1):
        for j in range(ROWS - 1):
            corner = np.array([BLOCK * i + width / 2, low + BLOCK * j + width / 2])
            outline = outline_of((corner + (BLOCK - width) * _house(rng)).round(4))
            shapes.append(Prism(outline, round(rng.uniform(0.5, 1.2), 3)))
    barriers = []
    for i in range(COLUMNS):
        for j in range(ROWS):
            x, y = BLOCK * i, low + BLOCK * j
            shut = rng.uniform(size=2) < difficulty / 3.0
            if i + 1 < COLUMNS and shut[0]:
                barriers.append(Box(x + BLOCK / 2, y, 0.0, 0.2, width + 0.2, 0.4))
            if j + 1 < ROWS and shut[1]:
                barriers.append(Box(x, y + BLOCK / 2, 0.0, width + 0.2, 0.2, 0.4))
    half = width / 2
    bounds = (-half, low - half, BLOCK * (COLUMNS - 1) + half, -low + half)
    return scaled(Layout(Flat(), tuple(barriers), bounds, shapes=tuple(shapes), goal=GOAL), scale)


def _house(rng: np.random.Generator) -> np.ndarray:
    """The outline of a house on the unit square, turned by quarters."""
    a, b = rng.uniform(0.35, 0.65, 2)
    kinds = (
        [[0, 0], [1, 0], [1, 1], [0, 1]],
        [[0, 0], [1, 0], [1, b], [a, b], [a, 1], [0, 1]],
        [[0, 0], [1, 0], [1, 1], [0.75, 1], [0.75, b], [0.25, b], [0.25, 1], [0, 1]],
    )
    outline = np.array(kinds[rng.integers(3)], dtype=float)
    for _ in range(rng.integers(4)):
        outline = np.column_stack([1.0 - outline[:, 1], outline[:, 0]])
    return outline


# --- rooms and mazes ---------------------------------------------------------------------------------
def rooms(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """3 × 3 rooms when easy, 6 × 5 when hard, with doors from 1.2 down to 0.7 m; there is a way to each."""
    columns, rows = round(between(3.0, 6.0, difficulty)), 2 * round(between(1.0, 2.0, difficulty)) + 1
    door = between(1.2, 0.7, difficulty)
    opened = _passages(rng, columns, rows, 0.35 * (1.0 - difficulty))
    walls: list[Box] = []
    span = 12.0 / (columns - 1)
    across = 11.0 / rows
    for wall in _walls(columns, rows):
        piece = Stretch(wall, span, across, rows)
        if wall in opened:
            middle = rng.uniform(0.25, 0.75)
            at = middle * (piece.length - door - 2 * WALL) + door / 2 + WALL
            walls += [piece.box(0.0, at - door / 2), piece.box(at + door / 2, piece.length)]
        else:
            walls.append(piece.box(0.0, piece.length))
    return _walled(walls, span, across, columns, rows, scale)


def maze(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """5 × 5 cells 3 m wide when easy, 12 × 11 cells of 1.1 m when hard; easy ones lack some walls."""
    columns, rows = round(between(5.0, 12.0, difficulty)), 2 * round(between(2.0, 5.0, difficulty)) + 1
    span = 12.0 / (columns - 1)
    opened = _passages(rng, columns, rows, 0.15 * (1.0 - difficulty))
    pieces = [Stretch(wall, span, span, rows) for wall in _walls(columns, rows) if wall not in opened]
    return _walled([piece.box(0.0, piece.length) for piece in pieces], span, span, columns, rows, scale)


Wall = tuple[tuple[int, int], tuple[int, int]]
"""The cells (column, row) on both sides."""


def _walls(columns: int, rows: int) -> list[Wall]:
    """All walls between two cells."""
    beside = [((i, j), (i + 1, j)) for i in range(columns - 1) for j in range(rows)]
    return beside + [((i, j), (i, j + 1)) for i in range(columns) for j in range(rows - 1)]


def _passages(rng: np.random.Generator, columns: int, rows: int, more: float) -> set[Wall]:
    """Walls that are opened so that one way leads to every cell, and a share of the others."""
    group = {(i, j): (i, j) for i in range(columns) for j in range(rows)}

    def root(cell: tuple[int, int]) -> tuple[int, int]:
        while group[cell] != cell:
            cell = group[cell]
        return cell

    opened: set[Wall] = set()
    walls = _walls(columns, rows)
    for k in rng.permutation(len(walls)):
        one, other = map(root, walls[k])
        if one != other or rng.uniform() < more:
            group[one] = other
            opened.add(walls[k])
    return opened


class Stretch:
    """A wall between two cells as it stands: the first cell of the middle row is around the start."""

    def __init__(self, wall: Wall, span: float, across: float, rows: int) -> None:
        (i, j), (_, above) = wall
        self.along_x = above > j
        self.length = span if self.along_x else across
        x, y = span * (i - 0.5), across * (j - rows / 2)
        self.start = (x, y + across) if self.along_x else (x + span, y)

    def box(self, begin: float, end: float) -> Box:
        """The part from one length to another, and half a wall more at both ends."""
        (x, y), middle, length = self.start, (begin + end) / 2, end - begin + WALL
        if self.along_x:
            return Box(x + middle, y, 0.0, length, WALL, HIGH)
        return Box(x, y + middle, 0.0, WALL, length, HIGH)


def _walled(inner: list[Box], span: float, across: float, columns: int, rows: int, scale: float) -> Layout:
    """The walls within, and those around it all."""
    x_min, x_max, half = -span / 2, span * (columns - 0.5), across * rows / 2
    wide, high = x_max - x_min + WALL, 2 * half + WALL
    around = [Box((x_min + x_max) / 2, y, 0.0, wide, WALL, HIGH) for y in (-half, half)]
    around += [Box(x, 0.0, 0.0, WALL, high, HIGH) for x in (x_min, x_max)]
    room = 3.0 * WALL
    bounds = (x_min - room, -half - room, x_max + room, half + room)
    return scaled(Layout(Flat(), (*around, *inner), bounds, goal=GOAL), scale)


# --- bug traps ---------------------------------------------------------------------------------------
def bugtrap(difficulty: float, scale: float, rng: np.random.Generator) -> Layout:
    """A bay that opens towards the start: 1 m deep when easy; 4 m deep and with its arms turned in when hard.
    Some pillars stand around it."""
    deep, wide = between(1.0, 4.0, difficulty), rng.uniform(2.5, 4.0)
    lip = difficulty * (wide - 1.4) / 2
    t = 2.0 * WALL
    half = wide / 2
    upper = [(0, half - lip), (0, half), (deep, half), (deep, -half), (0, -half), (0, -half + lip)]
    back = [(t, -half + lip), (t, -half + t), (deep - t, -half + t), (deep - t, half - t), (t, half - t)]
    ring = np.array([*upper, *back, (t, half - lip)]) if lip > t else np.array(
        [(0, half), (deep, half), (deep, -half), (0, -half), (0, -half + t), *back[2:4], (0, half - t)]
    )  # fmt: skip
    turn = rng.uniform(-0.35, 0.35)
    c, s = math.cos(turn), math.sin(turn)
    place = (7.0 - deep / 2, rng.uniform(-0.4, 0.4) * half)
    ring = (ring - (deep / 2, 0.0)) @ np.array([[c, s], [-s, c]]) + place + (deep / 2, 0.0)
    trap = Prism(outline_of(ring.round(4)), HIGH)
    pillars = scattered(
        rng,
        round(between(4.0, 14.0, difficulty)),
        BOUNDS,
        (0.15, 0.4),
        1.0,
        free_of_ends((0.0, 0.0), GOAL),
        clear_of([(*trap.centre, trap.reach)], 0.8),
    )
    shapes = (trap, *(Cylinder(*pillar, HIGH) for pillar in pillars))
    return scaled(Layout(Flat(), (), BOUNDS, shapes=shapes, goal=GOAL), scale)
