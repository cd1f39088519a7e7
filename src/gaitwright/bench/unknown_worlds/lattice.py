"""What planners on a grid know: seen pieces, and the links of a grid of 0.1 m that keep clear of them.

A link between two of eight neighbours is closed where a straight walk along it would come nearer than the
disc's radius to a piece, exactly: no cell is closed for a corner in it, and no open link ever touches. What
was never seen is open. This is the best that a grid can do.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, UInt8

from gaitwright.bench.unknown_worlds.segments import (
    clearance,
    is_clear,
    is_way_clear,
    piece_to_piece,
    point_to_piece,
)
from gaitwright.numerics.compiled import kernel

CELL = 0.1
"""Distance between nodes [m]."""
GO_X = (1, 1, 0, -1, -1, -1, 0, 1)
GO_Y = (0, 1, 1, 1, 0, -1, -1, -1)
"""Steps to the eight neighbours; k + 4 leads back."""
ALL = np.uint8(255)
IN_LINE = 1e-6
"""Pieces are of one line, or one lies within another, within this [m]."""
HAIR = 1e-7
"""A robot that touches may leave with the room that it has, less this [m]."""
SOFT = 6e-4
"""A way is cut where something is nearer than the radius less this [m]: a disc that touches gives less."""
LINKED = 0.15
"""A place is linked to nodes within this [m], …"""
FARTHER = 0.3
"""… and where there are none, within this."""


class Lattice(NamedTuple):
    """What is known."""

    bounds: tuple[float, float, float, float]
    radius: float
    pieces: Float[np.ndarray, "n 4"]
    """Seen pieces [m], those of one line joined."""
    closed: UInt8[np.ndarray, "rows columns"]
    """Of each node the bit k is set where the link to neighbour k is closed."""

    @classmethod
    def of(cls, bounds: tuple[float, float, float, float], radius: float) -> "Lattice":
        """Nothing is known but the bounds."""
        x_min, y_min, x_max, y_max = bounds
        columns, rows = (round(long / CELL) + 1 for long in (x_max - x_min, y_max - y_min))
        closed = np.zeros((rows, columns), np.uint8)
        for k in range(8):
            mask = np.uint8(1 << k)
            if GO_X[k]:
                closed[:, -1 if GO_X[k] > 0 else 0] |= mask
            if GO_Y[k]:
                closed[-1 if GO_Y[k] > 0 else 0, :] |= mask
        return cls(bounds, radius, np.empty((0, 4)), closed)

    def with_pieces(self, seen: Float[np.ndarray, "n 4"]) -> "Lattice":
        """With these pieces known as well."""
        new = news(self.pieces, seen)
        if not len(new):
            return self
        closed = self.closed.copy()
        close_links(closed, new, self.bounds[0], self.bounds[1], self.radius)
        return self._replace(pieces=joined(self.pieces, new), closed=closed)

    def is_cut(self, path: Float[np.ndarray, "n 2"]) -> bool:
        """Whether a known piece stands in a way."""
        return not is_way_clear(self.pieces, path, self.radius - SOFT)

    def links(self, place: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        """Nodes (flat numbers) that a straight walk from a place reaches, and how far they are [m]."""
        for reach in (LINKED, FARTHER):
            found = links_of(
                self.closed, self.pieces, *place, self.bounds[0], self.bounds[1], self.radius, reach
            )
            if len(found[0]):
                break
        return found

    def is_clear(self, start: tuple[float, float], goal: tuple[float, float]) -> bool:
        """Whether a straight walk leads from one place to another."""
        room = own_room(self.pieces, *start, self.radius)
        return bool(is_clear(self.pieces, *start, *goal, room))

    def places(self, nodes: np.ndarray) -> Float[np.ndarray, "n 2"]:
        """Where nodes are [m]."""
        row, column = np.divmod(nodes, self.closed.shape[1])
        return np.stack([self.bounds[0] + CELL * column, self.bounds[1] + CELL * row], axis=1)


@kernel
def own_room(pieces, x, y, radius):
    """Room that a walk from a place keeps: the radius, or less where the robot touches [m]."""
    return min(radius, clearance(pieces, x, y)) - HAIR


@kernel
def lies_within(piece, px, py):
    """Whether a point lies on a piece."""
    return point_to_piece(px, py, piece[0], piece[1], piece[2], piece[3]) < IN_LINE


@kernel
def news(pieces, seen):
    """Those of the seen pieces that lie on none that is known."""
    new = np.empty((len(seen), 4))
    n = 0
    for k in range(len(seen)):
        is_known = False
        for j in range(len(pieces)):
            one = pieces[j]
            if lies_within(one, seen[k, 0], seen[k, 1]) and lies_within(one, seen[k, 2], seen[k, 3]):
                is_known = True
                break
        if not is_known:
            new[n] = seen[k]
            n += 1
    return new[:n]


@kernel
def joined(pieces, new):
    """Known and new pieces, those of one line that overlap made one."""
    out = np.empty((len(pieces) + len(new), 4))
    n = len(pieces)
    out[:n] = pieces
    for k in range(len(new)):
        done = False
        for j in range(n):
            if extends(out[j], new[k]):
                done = True
                break
        if not done:
            out[n] = new[k]
            n += 1
    return out[:n]


@kernel
def extends(one, other):
    """Makes a piece longer by another of the same line that overlaps it; whether it is one of those."""
    dx, dy = one[2] - one[0], one[3] - one[1]
    long = math.hypot(dx, dy)
    ux, uy = dx / long, dy / long
    low, high = 0.0, long
    for k in (0, 2):
        px, py = other[k] - one[0], other[k + 1] - one[1]
        if abs(ux * py - uy * px) > IN_LINE:
            return False
        along = ux * px + uy * py
        low, high = min(low, along), max(high, along)
    other_long = math.hypot(other[2] - other[0], other[3] - other[1])
    if high - low > long + other_long + IN_LINE:
        return False
    ax, ay = one[0], one[1]
    one[0], one[1], one[2], one[3] = ax + low * ux, ay + low * uy, ax + high * ux, ay + high * uy
    return True


@kernel
def close_links(closed, new, x_min, y_min, radius):
    """Closes the links that new pieces stand in."""
    rows, columns = closed.shape
    room = radius + 1.5 * CELL
    for k in range(len(new)):
        ax, ay, bx, by = new[k, 0], new[k, 1], new[k, 2], new[k, 3]
        first_column = max(int((min(ax, bx) - room - x_min) / CELL), 0)
        last_column = min(int((max(ax, bx) + room - x_min) / CELL) + 1, columns - 1)
        first_row = max(int((min(ay, by) - room - y_min) / CELL), 0)
        last_row = min(int((max(ay, by) + room - y_min) / CELL) + 1, rows - 1)
        for row in range(first_row, last_row + 1):
            y = y_min + CELL * row
            for column in range(first_column, last_column + 1):
                x = x_min + CELL * column
                if point_to_piece(x, y, ax, ay, bx, by) > room:
                    continue
                for way in range(4):
                    there_row, there_column = row + GO_Y[way], column + GO_X[way]
                    if closed[row, column] >> way & 1 or not (
                        0 <= there_row < rows and 0 <= there_column < columns
                    ):
                        continue
                    to_x, to_y = x_min + CELL * there_column, y_min + CELL * there_row
                    if piece_to_piece(x, y, to_x, to_y, ax, ay, bx, by) < radius:
                        closed[row, column] |= np.uint8(1 << way)
                        closed[there_row, there_column] |= np.uint8(1 << (way + 4))


@kernel
def links_of(closed, pieces, x, y, x_min, y_min, radius, reach):
    """Nodes within reach that a straight walk from a place leads to, and their distances [m]."""
    rows, columns = closed.shape
    near, room = int(reach / CELL) + 1, own_room(pieces, x, y, radius)
    nodes, away = np.empty((2 * near + 1) ** 2, np.int64), np.empty((2 * near + 1) ** 2)
    row, column = round((y - y_min) / CELL), round((x - x_min) / CELL)
    n = 0
    for i in range(max(row - near, 0), min(row + near, rows - 1) + 1):
        for j in range(max(column - near, 0), min(column + near, columns - 1) + 1):
            to_x, to_y = x_min + CELL * j, y_min + CELL * i
            far = math.hypot(to_x - x, to_y - y)
            if far <= reach and closed[i, j] != ALL and is_clear(pieces, x, y, to_x, to_y, room):
                nodes[n], away[n] = i * columns + j, far
                n += 1
    return nodes[:n], away[:n]
