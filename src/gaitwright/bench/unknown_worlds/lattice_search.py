"""Shortest ways on a lattice: A* over eight neighbours, and Theta*, whose ways bend anywhere; compiled.

A*: Hart, Nilsson and Raphael 1968. Theta*: Nash, Daniel, Koenig and Felner, AAAI 2007 (basic Theta*), with
lines of sight that are exact walks among the known pieces.
"""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.bench.unknown_worlds.heap import drop, push
from gaitwright.bench.unknown_worlds.lattice import CELL, GO_X, GO_Y
from gaitwright.bench.unknown_worlds.segments import is_clear
from gaitwright.numerics.compiled import kernel

UNIT = 1e6
"""A cell in units of length: lengths over links are whole numbers of them, so that equal ones are equal."""
DIAGONAL = 1414214.0
"""A diagonal link [units]."""
SLACK = 0.25 * UNIT
"""The last link, to the goal, is straight, and the estimate goes by eight directions: off by less."""
ROOT = math.sqrt(2.0)
STRAIGHT = 1e-9
"""Any-angle ways that differ by less are as long as each other [cells]."""
TOWARD_GOAL = 1e-6
"""Of two nodes that promise nearly the same the one nearer to the goal is looked at first."""


def in_units(metres: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Lengths as whole numbers [units]."""
    return np.round(metres / CELL * UNIT)


@kernel
def octile(dx, dy):
    """Length of the shortest way by eight directions over so many cells [units], rounded down."""
    dx, dy = abs(dx), abs(dy)
    return math.floor(UNIT * max(dx, dy) + (DIAGONAL - UNIT) * min(dx, dy))


@kernel
def a_star(closed, starts, from_start, ends, to_goal, goal_x, goal_y):
    """Lengths from the start [units] of the nodes looked at, the last node before the goal or −1, how many.

    `starts`, `ends`: nodes linked with start and goal; `from_start`, `to_goal`: how far they are [units]; the
    goal in cells. Last comes the length of the way.
    """
    rows, columns = closed.shape
    size = rows * columns
    g, done = np.full(size, math.inf), np.zeros(size, np.bool_)
    last = np.full(size, math.inf)
    heap, place, f, h = np.empty(size, np.int64), np.full(size, -1), np.empty(size), np.empty(size)
    for k in range(len(ends)):
        last[ends[k]] = to_goal[k]
    count, expanded, best, before = 0, 0, math.inf, -1
    for k in range(len(starts)):
        node = starts[k]
        g[node] = from_start[k]
        h[node] = octile(node % columns - goal_x, node // columns - goal_y)
        f[node] = g[node] + max(h[node] - SLACK, 0.0)
        count = push(heap, place, f, h, count, node)
    while count > 0 and f[heap[0]] < best:
        node = heap[0]
        count = drop(heap, place, f, h, count, node)
        done[node] = True
        expanded += 1
        if g[node] + last[node] < best:
            best, before = g[node] + last[node], node
        for k in range(8):
            if closed[node // columns, node % columns] >> k & 1:
                continue
            to = node + GO_Y[k] * columns + GO_X[k]
            length = g[node] + (DIAGONAL if k % 2 else UNIT)
            if not done[to] and length < g[to]:
                g[to] = length
                h[to] = octile(to % columns - goal_x, to // columns - goal_y)
                f[to] = length + max(h[to] - SLACK, 0.0)
                count = push(heap, place, f, h, count, to)
    return g, before, expanded, best


@kernel
def descent(closed, g, rhs, ends, first):
    """Nodes from `first` down to where lengths begin (`ends`, by a link), straight on where that is as short.

    Only nodes whose two lengths agree are gone over; A* has one length only.
    """
    rows, columns = closed.shape
    nodes = np.empty(rows * columns, np.int64)
    nodes[0], n, way = first, 1, -1
    while ends[nodes[n - 1]] > rhs[nodes[n - 1]] and n < len(nodes):
        node, best, chosen = nodes[n - 1], math.inf, -1
        for k in range(8):
            to = node + GO_Y[k] * columns + GO_X[k]
            if closed[node // columns, node % columns] >> k & 1 or g[to] != rhs[to]:
                continue
            length = g[to] + (DIAGONAL if k % 2 else UNIT)
            if length < best or (k == way and length == best):
                best, chosen = length, k
        way = chosen
        nodes[n] = node + GO_Y[way] * columns + GO_X[way]
        n += 1
    return nodes[:n]


@kernel
def theta_star(closed, pieces, radius, start, goal, links):
    """Way-points [cells] from start to goal (both in cells), or none, and how many nodes were looked at.

    `links`: nodes linked with start and with goal. A node's parent is any node that a straight walk leads
    from.
    """
    rows, columns = closed.shape
    size = rows * columns
    starts, from_start, ends, to_goal, origin = links
    g, done, last = np.full(size, math.inf), np.zeros(size, np.bool_), np.full(size, math.inf)
    parent = np.full(size, -1)  # −1: the start itself
    heap, place, f, h = np.empty(size, np.int64), np.full(size, -1), np.empty(size), np.empty(size)
    for k in range(len(ends)):
        last[ends[k]] = to_goal[k]
    count, expanded, best, before = 0, 0, math.inf, -1
    for k in range(len(starts)):
        node = starts[k]
        g[node] = from_start[k]
        h[node] = math.hypot(node % columns - goal[0], node // columns - goal[1])
        f[node] = g[node] + h[node] * (1.0 + TOWARD_GOAL)
        count = push(heap, place, f, h, count, node)
    while count > 0 and f[heap[0]] < best:
        node = heap[0]
        count = drop(heap, place, f, h, count, node)
        done[node] = True
        expanded += 1
        if g[node] + last[node] < best:
            best, before = g[node] + last[node], node
        above = parent[node]
        for k in range(8):
            if closed[node // columns, node % columns] >> k & 1:
                continue
            to = node + GO_Y[k] * columns + GO_X[k]
            if done[to]:
                continue
            from_above, ax, ay = 0.0, start[0], start[1]
            if above >= 0:
                from_above, ax, ay = g[above], float(above % columns), float(above // columns)
            x, y = float(to % columns), float(to // columns)
            straight = from_above + math.hypot(x - ax, y - ay)
            came, length = node, g[node] + (ROOT if k % 2 else 1.0)
            if straight < min(length, g[to]) and is_walk(pieces, ax, ay, x, y, radius, origin):
                came, length = above, straight
            if length < g[to] - STRAIGHT:
                g[to], parent[to] = length, came
                h[to] = math.hypot(x - goal[0], y - goal[1])
                f[to] = length + h[to] * (1.0 + TOWARD_GOAL)
                count = push(heap, place, f, h, count, to)
    return back(parent, before, columns, start, goal), expanded


@kernel
def is_walk(pieces, ax, ay, bx, by, radius, origin):
    """Whether a straight walk leads from one place to another, both in cells."""
    return is_clear(
        pieces,
        origin[0] + CELL * ax,
        origin[1] + CELL * ay,
        origin[0] + CELL * bx,
        origin[1] + CELL * by,
        radius,
    )


@kernel
def back(parent, before, columns, start, goal):
    """Way-points from start to goal by the parents of nodes, or none."""
    if before < 0:
        return np.empty((0, 2))
    n, node = 2, before
    while node >= 0:
        n, node = n + 1, parent[node]
    points = np.empty((n, 2))
    points[0, 0], points[0, 1] = start[0], start[1]
    points[n - 1, 0], points[n - 1, 1] = goal[0], goal[1]
    node = before
    for k in range(n - 2, 0, -1):
        points[k, 0], points[k, 1] = node % columns, node // columns
        node = parent[node]
    return points


@kernel
def pulled(points, pieces, radius, room):
    """A way [m] without the points that a straight walk leaves out; `room` is that of its start [m]."""
    out = np.empty((len(points), 2))
    out[0] = points[0]
    n, here = 1, 0
    while here < len(points) - 1:
        there = len(points) - 1
        keep = room if here == 0 else radius
        while there > here + 1 and not is_clear(
            pieces, points[here, 0], points[here, 1], points[there, 0], points[there, 1], keep
        ):
            there -= 1
        out[n] = points[there]
        n, here = n + 1, there
    return out[:n]
