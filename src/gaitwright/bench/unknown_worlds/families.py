"""Five families of obstacles, drawn by lot: forest, rooms with doors, bug traps, mazes, streets.

What is built of walls is turned by any angle in every second world, and cut off at the square's edge. Its
walls are boxes one after another: they touch, overlap by 1 nm or by a hand, or stand 1 nm apart.
"""

import math
from collections.abc import Callable, Iterator

import numpy as np
import shapely
from shapely import Polygon
from shapely.affinity import rotate, translate

from gaitwright.bench.unknown_worlds.world import BOUNDS, SIZE

JOINTS = (0.0, 1e-9, -1e-9, 0.03)
"""Neighbouring boxes of a wall overlap by one of these [m]; negative ones stand apart."""
REACH = 0.75 * SIZE
"""What is to be turned is drawn so far from the middle [m]."""
MIDDLE = (SIZE / 2.0, SIZE / 2.0)

Family = Callable[[np.random.Generator], list[Polygon]]


def forest(rng: np.random.Generator) -> list[Polygon]:
    """Trunks and rocks, convex, some of which grow into each other."""
    trees = []
    for _ in range(int(rng.integers(40, 80))):
        corners, size = int(rng.integers(3, 9)), rng.uniform(0.2, 1.1)
        angles = np.sort(rng.uniform(0.0, 2.0 * math.pi, corners))
        radii = size * rng.uniform(0.7, 1.0, corners)
        rim = rng.uniform(0.0, SIZE, 2) + radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        trees.append(shapely.convex_hull(shapely.multipoints(rim)))
    return [tree for tree in trees if tree.area > 0.01]


def rooms(rng: np.random.Generator) -> list[Polygon]:
    """Rooms whose walls have a door each, or none."""
    pitch, thick, joint = rng.uniform(3.0, 4.5), rng.uniform(0.1, 0.3), rng.choice(JOINTS)
    walls = []
    for horizontal, line, start in grid_lines(pitch):
        doors = [] if rng.random() < 0.25 else [start + rng.uniform(0.3, 0.7) * pitch]
        wide = rng.uniform(0.5, 1.1)
        walls += wall(horizontal, line, (start, start + pitch), thick, cut_out(doors, wide), joint)
    return turned(rng, walls) + furniture(rng, 12)


def bug_traps(rng: np.random.Generator) -> list[Polygon]:
    """Rooms open on one side only, in which whoever goes straight is caught, some with lips."""
    traps: list[Polygon] = []
    for _ in range(int(rng.integers(7, 12))):
        deep, wide = rng.uniform(1.5, 4.5), rng.uniform(1.5, 5.0)
        thick, joint = rng.uniform(0.1, 0.3), rng.choice(JOINTS)
        parts = [
            *wall(True, wide / 2.0, (-deep / 2.0, deep / 2.0), thick, [], joint),
            *wall(True, -wide / 2.0, (-deep / 2.0, deep / 2.0), thick, [], joint),
            *wall(False, deep / 2.0, (-wide / 2.0, wide / 2.0), thick, [], joint),
        ]
        if rng.random() < 0.4:
            mouth = rng.uniform(0.6, 1.2)
            parts += wall(False, -deep / 2.0, (-wide / 2.0, wide / 2.0), thick, cut_out([0.0], mouth), joint)
        angle, (x, y) = rng.uniform(0.0, 360.0), rng.uniform(2.0, SIZE - 2.0, 2)
        traps += [translate(rotate(part, angle, (0.0, 0.0)), x, y) for part in parts]
    return traps + furniture(rng, 10)


def maze(rng: np.random.Generator) -> list[Polygon]:
    """A random spanning tree of square cells, and a few walls less, so that there are ways round."""
    pitch, thick, joint = rng.uniform(1.8, 2.6), rng.uniform(0.08, 0.25), rng.choice(JOINTS)
    cells = 2 * math.ceil(REACH / pitch)
    open_walls = spanning_tree(rng, cells)
    walls = []
    for horizontal, line, start in grid_lines(pitch, cells):
        i, j = round(start / pitch) + cells // 2, round(line / pitch) + cells // 2
        pair = ((i, j - 1), (i, j)) if horizontal else ((j - 1, i), (j, i))
        if pair not in open_walls and rng.random() > 0.08:
            walls += wall(horizontal, line, (start, start + pitch), thick, [], joint)
    return turned(rng, walls)


def streets(rng: np.random.Generator) -> list[Polygon]:
    """Blocks of houses with streets between, some of them barred."""
    pitch, width, joint = rng.uniform(3.0, 4.5), rng.uniform(0.7, 1.3), rng.choice(JOINTS)
    count = math.ceil(REACH / pitch)
    half = (pitch - width) / 2.0
    blocks: list[Polygon] = []
    for i in range(-count, count + 1):
        for j in range(-count, count + 1):
            x, y = (i + 0.5) * pitch, (j + 0.5) * pitch
            cut = rng.uniform(-0.5, 0.5) * half
            blocks.append(shapely.box(x - half, y - half, x + cut + joint, y + half))
            blocks.append(shapely.box(x + cut, y - half, x + half, y + half * rng.choice((1.0, 1.0, 0.4))))
    for horizontal, line, start in grid_lines(pitch):
        if rng.random() < 0.25:
            at = start + rng.uniform(0.35, 0.65) * pitch
            across = (at - 0.1, line - width / 2.0 - 0.02, at + 0.1, line + width / 2.0 + 0.02)
            blocks.append(
                shapely.box(*(across if horizontal else (across[1], across[0], across[3], across[2])))
            )
    return turned(rng, blocks)


FAMILIES: dict[str, Family] = {
    "forest": forest,
    "rooms": rooms,
    "bug traps": bug_traps,
    "mazes": maze,
    "streets": streets,
}


# --- parts -----------------------------------------------------------------------------------------
def grid_lines(pitch: float, cells: int | None = None) -> Iterator[tuple[bool, float, float]]:
    """Of every wall between two cells of a grid: whether it is horizontal, its line, where it begins."""
    half = (cells or 2 * math.ceil(REACH / pitch)) // 2
    for line in range(-half, half + 1):
        for start in range(-half, half):
            yield True, line * pitch, start * pitch
            yield False, line * pitch, start * pitch


def cut_out(middles: list[float], wide: float) -> list[tuple[float, float]]:
    """Openings of a width around their middles."""
    return [(middle - wide / 2.0, middle + wide / 2.0) for middle in middles]


def wall(
    horizontal: bool,
    line: float,
    ends: tuple[float, float],
    thick: float,
    openings: list[tuple[float, float]],
    joint: float,
) -> list[Polygon]:
    """Boxes of about a metre along a line; at its ends they go on by half the thickness."""
    edges = [ends[0] - thick / 2.0, *(x for opening in openings for x in opening), ends[1] + thick / 2.0]
    boxes = []
    for low, high in zip(edges[::2], edges[1::2], strict=True):
        parts = max(round(high - low), 1)
        cuts = np.linspace(low, high, parts + 1)
        for k in range(parts):
            a, b = cuts[k], cuts[k + 1] + (joint if k < parts - 1 else 0.0)
            flat = (a, line - thick / 2.0, b, line + thick / 2.0)
            boxes.append(shapely.box(*(flat if horizontal else (flat[1], flat[0], flat[3], flat[2]))))
    return boxes


def furniture(rng: np.random.Generator, most: int) -> list[Polygon]:
    """Boxes that stand about, turned by any angle."""
    boxes = []
    for _ in range(int(rng.integers(0, most + 1))):
        long, wide = rng.uniform(0.2, 0.8, 2)
        box = rotate(shapely.box(-long / 2.0, -wide / 2.0, long / 2.0, wide / 2.0), rng.uniform(0.0, 360.0))
        boxes.append(translate(box, *rng.uniform(0.0, SIZE, 2)))
    return boxes


def turned(rng: np.random.Generator, walls: list[Polygon]) -> list[Polygon]:
    """Walls around the origin, put around the middle, every second time turned; cut off at the edge."""
    angle = rng.uniform(0.0, 90.0) if rng.random() < 0.5 else 0.0
    shift = rng.uniform(-1.0, 1.0, 2)
    square = shapely.box(*BOUNDS)
    out = []
    for one in walls:
        placed = translate(rotate(one, angle, (0.0, 0.0)), *(np.array(MIDDLE) + shift))
        cut = placed if square.contains(placed) else placed.intersection(square)
        out += [part for part in shapely.get_parts(cut) if isinstance(part, Polygon) and part.area > 1e-6]
    return out


def spanning_tree(rng: np.random.Generator, cells: int) -> set[tuple[tuple[int, int], tuple[int, int]]]:
    """Pairs of neighbouring cells (lower one first) that a random tree joins."""
    seen, stack, pairs = {(0, 0)}, [(0, 0)], set()
    while stack:
        x, y = stack[-1]
        around = [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]
        new = [c for c in around if c not in seen and 0 <= c[0] < cells and 0 <= c[1] < cells]
        if not new:
            stack.pop()
            continue
        there = new[int(rng.integers(len(new)))]
        seen.add(there)
        stack.append(there)
        pairs.add((min((x, y), there), max((x, y), there)))
    return pairs
