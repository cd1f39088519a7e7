"""The grounds of the built-in scenes: (number, scale, random numbers) → Layout.

`scale` multiplies every length: 1 suits robots of a dog's size, a robot of 5 m asks for more. Robots
start at (0, 0) and look along x.
"""

import math
from collections.abc import Callable, Iterable

import numpy as np

from gaitwright.ground import courses, landscapes, towns, traffic
from gaitwright.ground.layout import Bounds, Layout
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, smooth_step


def _bounds(scale: float) -> Bounds:
    """14 m × 8 m, most of it ahead of the start."""
    return (-4.0 * scale, -4.0 * scale, 10.0 * scale, 4.0 * scale)


def _wide(scale: float) -> Bounds:
    """200 m × 200 m: ground that costs nothing to extend."""
    return (-100.0 * scale, -100.0 * scale, 100.0 * scale, 100.0 * scale)


def _long(scale: float) -> Bounds:
    """34 m × 8 m: a minute's walk ahead of the start."""
    return (-4.0 * scale, -4.0 * scale, 30.0 * scale, 4.0 * scale)


def flat(_: float, scale: float, __: np.random.Generator) -> Layout:
    return Layout(Flat(), (), _wide(scale))


def slippery(friction: float, scale: float, _: np.random.Generator) -> Layout:
    return Layout(Flat(), (), _wide(scale), friction)


def slope(degrees: float, scale: float, _: np.random.Generator) -> Layout:
    return Layout(Slope(math.radians(degrees)), (), _wide(scale))


def cross_slope(degrees: float, scale: float, _: np.random.Generator) -> Layout:
    return Layout(Slope(0.0, math.radians(degrees)), (), _wide(scale))


# --- rough ---------------------------------------------------------------------------------------
NODE = 0.2
"""Distance between the random heights [m]."""
FINE = 4
"""Grid cells from one random height to the next."""
LEVEL, BLEND = 0.6, 0.4
"""Radius of the level start, and the width over which the hills grow from it [m]."""
RIM = 1.0
"""How far the rough ground goes on beyond the bounds [m]."""


def rough(amplitude: float, scale: float, rng: np.random.Generator) -> Layout:
    """Heights drawn from ±amplitude at every node, joined by smooth steps: never beyond ±amplitude."""
    bounds = _long(scale)
    x_min, y_min = bounds[0] - RIM * scale, bounds[1] - RIM * scale
    columns = round((bounds[2] + RIM * scale - x_min) / (NODE * scale))
    rows = round((bounds[3] + RIM * scale - y_min) / (NODE * scale))
    nodes = rng.uniform(-amplitude, amplitude, (rows + 1, columns + 1)) * scale
    heights = _between(_between(nodes).T).T
    x = x_min + NODE / FINE * scale * np.arange(heights.shape[1])
    y = y_min + NODE / FINE * scale * np.arange(heights.shape[0])
    distance = np.hypot(x[None, :], y[:, None]) / scale
    heights = heights * smooth_step((distance - LEVEL) / BLEND)
    return Layout(HeightField(x_min, y_min, NODE / FINE * scale, heights), (), bounds)


def _between(nodes: np.ndarray) -> np.ndarray:
    """`FINE` rows for every row but the last: smooth steps from row to row."""
    share = smooth_step(np.arange(FINE) / FINE)[None, :, None]
    steps = nodes[:-1, None] * (1.0 - share) + nodes[1:, None] * share
    return np.concatenate([steps.reshape(-1, nodes.shape[1]), nodes[-1:]])


# --- blocks --------------------------------------------------------------------------------------
GOAL = (6.0, 0.0)
PASSAGE = 1.2
"""Least free width around every large block [m]."""
CLEAR = 0.8
"""Radius of the free place around start and goal [m]."""
LARGE, SMALL = 7, 45
"""Blocks tried for; a crowded draw may hold fewer small ones."""
TRIES = 400


def blocks(_: float, scale: float, rng: np.random.Generator) -> Layout:
    """The thesis's ground: many small blocks, a few large ones, one of these in the straight way."""
    x_min, y_min, x_max, y_max = _bounds(1.0)
    barrier = _block(rng, (2.4, -0.1, 3.6, 0.1), (0.4, 1.0), (0.3, 0.5))
    large, small = [barrier], []

    inner = (x_min + PASSAGE, y_min + PASSAGE, x_max - PASSAGE, y_max - PASSAGE)
    for _try in range(TRIES):
        block = _block(rng, inner, (0.4, 1.0), (0.3, 0.5))
        if (
            len(large) < LARGE
            and _within(block, inner)
            and _apart(block, large, PASSAGE)
            and _off_ends(block)
        ):
            large.append(block)
    for _try in range(TRIES):
        block = _block(rng, (x_min, y_min, x_max, y_max), (0.2, 0.5), (0.02, 0.04))
        if len(small) < SMALL and _apart(block, [*large, *small], 0.05) and _off_ends(block):
            small.append(block)
    return Layout(
        Flat(),
        tuple(_scaled(block, scale) for block in [*large, *small]),
        _bounds(scale),
        goal=(GOAL[0] * scale, GOAL[1] * scale),
    )


def _block(
    rng: np.random.Generator, where: Bounds, sides: tuple[float, float], heights: tuple[float, float]
) -> Box:
    x, y = rng.uniform(where[0], where[2]), rng.uniform(where[1], where[3])
    lx, ly = rng.uniform(*sides, size=2)
    numbers = (x, y, rng.uniform(-math.pi, math.pi), lx, ly, rng.uniform(*heights))
    return Box(*(round(float(number), 3) for number in numbers))


def _apart(block: Box, others: Iterable[Box], gap: float) -> bool:
    """Whether the circle around a block keeps `gap` from those around the others."""
    return all(math.hypot(block.x - o.x, block.y - o.y) >= block.radius + o.radius + gap for o in others)


def _off_ends(block: Box) -> bool:
    """Whether a block leaves start and goal free."""
    return all(math.hypot(block.x - x, block.y - y) >= block.radius + CLEAR for x, y in [(0.0, 0.0), GOAL])


def _within(block: Box, b: Bounds) -> bool:
    r = block.radius
    return b[0] + r <= block.x <= b[2] - r and b[1] + r <= block.y <= b[3] - r


def _scaled(b: Box, k: float) -> Box:
    return Box(k * b.x, k * b.y, b.yaw, k * b.lx, k * b.ly, k * b.height, k * b.base)


# --- stairs --------------------------------------------------------------------------------------
STEPS, TREAD, TOP, FOOT_OF_STAIRS = 5, 0.3, 1.2, 1.5
"""Steps each way, depth of a step, length of the platform, x of the first step [m]."""


FLIGHT = 6
"""Steps each way of a stairway."""


def stairway(rise: float, scale: float, _: np.random.Generator) -> Layout:
    """The thesis's stairway (6.3, stage 2): steps as deep as they are high, which makes 45°."""
    return flight(rise * scale, rise * scale, scale)


def flight(rise: float, tread: float, scale: float = 1.0, steps: int = FLIGHT) -> Layout:
    """A stairway of any steepness: `rise` and `tread` of a step [m] as they are, the rest times `scale`."""
    x_min, y_min, _, y_max = _bounds(scale)
    half = TOP / 2 * scale + tread * (steps - 1)
    centre, width = FOOT_OF_STAIRS * scale + half, y_max - y_min
    boxes = (Box(centre, 0.0, 0.0, 2 * (half - tread * k), width, rise, rise * k) for k in range(steps))
    return Layout(Flat(), tuple(boxes), (x_min, y_min, 2 * centre + 4.0 * scale, y_max))


def stairs(rise: float, scale: float, _: np.random.Generator) -> Layout:
    """Boxes that lie on each other, each shorter than the one below by a step at either end."""
    return flight(rise * scale, TREAD * scale, scale, STEPS)


# --- ramp ----------------------------------------------------------------------------------------
RAMP_AT, RAMP_LONG, RAMP_GRID = 1.2, 1.5, 0.05
"""x where it rises, its length along x each way, spacing of the grid that holds it [m]."""


def ramp(degrees: float, scale: float, _: np.random.Generator) -> Layout:
    """A ramp up, a platform, and a ramp down again, as wide as the field."""
    bounds, grid = _bounds(scale), RAMP_GRID * scale
    x = bounds[0] + grid * np.arange(round((bounds[2] - bounds[0]) / grid) + 1)
    up = np.clip(x - RAMP_AT * scale, 0.0, RAMP_LONG * scale)
    down = np.clip(x - (RAMP_AT + RAMP_LONG + TOP) * scale, 0.0, RAMP_LONG * scale)
    rows = round((bounds[3] - bounds[1]) / grid) + 1
    heights = np.tile(math.tan(math.radians(degrees)) * (up - down), (rows, 1))
    return Layout(HeightField(bounds[0], bounds[1], grid, heights), (), bounds)


# --- boxes -----------------------------------------------------------------------------------------
BOXES, BOX_AT, BOX_LONG, BETWEEN = 2, 1.2, 0.35, 0.65
"""How many, x where the first begins, their length along x, ground between them [m]."""


def boxes(height: float, scale: float, _: np.random.Generator) -> Layout:
    """Boxes across the way, as wide as the field: a foot can stand on them, or be lifted over them."""
    x_min, y_min, x_max, y_max = _bounds(scale)
    centres = (BOX_AT + BOX_LONG / 2 + k * (BOX_LONG + BETWEEN) for k in range(BOXES))
    return Layout(
        Flat(),
        tuple(Box(x * scale, 0.0, 0.0, BOX_LONG * scale, y_max - y_min, height * scale) for x in centres),
        (x_min, y_min, x_max, y_max),
    )


# --- gaps ----------------------------------------------------------------------------------------
GAPS, GAP_AT, ISLAND, DEEP = 3, 1.2, 0.8, 0.5
"""How many, x where the first begins, ground between them, depth [m]."""


def gap(width: float, scale: float, _: np.random.Generator) -> Layout:
    """Blocks in a row with gaps between them, as wide as the field: a robot starts on the first one."""
    x_min, y_min, x_max, y_max = _bounds(scale)
    ends = [(GAP_AT + k * (ISLAND + width)) * scale for k in range(GAPS)]
    starts = [x_min, *(end + width * scale for end in ends)]
    boxes = (
        Box((a + b) / 2, 0.0, 0.0, b - a, y_max - y_min, DEEP * scale)
        for a, b in zip(starts, [*ends, x_max], strict=True)
    )
    return Layout(Flat(), tuple(boxes), (x_min, y_min, x_max, y_max))


BUILDERS: dict[str, Callable[[float, float, np.random.Generator], Layout]] = {
    "flat": flat,
    "slippery": slippery,
    "slope": slope,
    "cross-slope": cross_slope,
    "rough": rough,
    "blocks": blocks,
    "stairs": stairs,
    "stairway": stairway,
    "ramp": ramp,
    "gap": gap,
    "boxes": boxes,
    "holes": landscapes.holes,
    "trench": landscapes.trench,
    "waves": landscapes.waves,
    "hills": landscapes.hills,
    "forest": towns.forest,
    "streets": towns.streets,
    "rooms": towns.rooms,
    "maze": towns.maze,
    "bugtrap": towns.bugtrap,
    "crossing": traffic.crossing,
    "plaza": traffic.plaza,
    "mixed": courses.mixed,
}
"""One builder per name of `scenes_list.OFFERS`."""
