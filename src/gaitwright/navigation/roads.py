"""Straight links between turning nodes: found when a node is first gone on from, and kept.

A node has two states, one for each way round: 2 k turns counterclockwise about the end of node k, 2 k + 1
clockwise. A shortest path only ever leaves a node the way round that it came.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from gaitwright.navigation.piece_grid import PieceGrid, is_free, piece_grid
from gaitwright.navigation.tolerances import LINK
from gaitwright.navigation.turning_nodes import TurningNodes, turning_nodes
from gaitwright.numerics.compiled import kernel

Bounds = tuple[float, float, float, float]


class Roads(NamedTuple):
    """What a search reads, and the links that it has found."""

    grid: PieceGrid
    nodes: TurningNodes
    radius: float
    found: Int[np.ndarray, "states 2"]
    """Where the links of a state begin in `targets`, and how many they are; -1: not looked for."""
    targets: Int[np.ndarray, " room"]
    """States that a link leads to."""
    used: Int[np.ndarray, "1"]
    """How much of `targets` is filled."""


@dataclass
class RoadMap:
    """The roads of one map. They fill as they are asked, always with the same; so a map stays a value."""

    bounds: Bounds
    radius: float
    pieces: Float[np.ndarray, "n 4"]
    roads: Roads = field(init=False)

    def __post_init__(self) -> None:
        fenced = np.concatenate([self.pieces, fence(self.bounds)])
        grid = piece_grid(fenced, self.bounds, 1.1 * self.radius)
        nodes = turning_nodes(grid, self.bounds, self.radius)
        states = 2 * len(nodes.lean)
        found = np.full((states, 2), -1, dtype=np.int64)
        targets = np.empty(16 * states + 64, dtype=np.int64)
        self.roads = Roads(grid, nodes, self.radius, found, targets, np.zeros(1, dtype=np.int64))

    def widen(self) -> None:
        """Makes room for more links."""
        self.roads = self.roads._replace(targets=np.concatenate([self.roads.targets] * 2))


def fence(bounds: Bounds) -> Float[np.ndarray, "4 4"]:
    """The edge of a field as pieces."""
    x0, y0, x1, y1 = bounds
    return np.array([[x0, y0, x1, y0], [x1, y0, x1, y1], [x1, y1, x0, y1], [x0, y1, x0, y0]])


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def way_round(node, dx, dy, lean):
    """The way round in which a line of direction (dx, dy) touches a node's circle: 0 counterclockwise, 1
    clockwise, -1 where it leans too much from the tangent."""
    off = dx * node[2] + dy * node[3]
    if off * off > lean * lean * (dx * dx + dy * dy):
        return -1
    return 0 if node[2] * dy - node[3] * dx > 0.0 else 1


@kernel
def find_links(roads, state):
    """Looks for the links of a state; false where there is no room for them."""
    at, lean = roads.nodes.at, roads.nodes.lean
    here, turn, begin = at[state // 2], state % 2, roads.used[0]
    count, own_lean, room = begin, lean[state // 2], roads.radius - LINK
    for k in range(len(at)):
        dx, dy = at[k, 0] - here[0], at[k, 1] - here[1]
        if way_round(here, dx, dy, own_lean) != turn or dx * dx + dy * dy < 1e-18:
            continue
        on = way_round(at[k], dx, dy, lean[k])
        if on >= 0 and is_free(roads.grid, here[0], here[1], at[k, 0], at[k, 1], room):
            if count == len(roads.targets):
                return False
            roads.targets[count] = 2 * k + on
            count += 1
    roads.found[state, 0], roads.found[state, 1] = begin, count - begin
    roads.used[0] = count
    return True
