"""D* Lite: a search from the goal that is mended, not made anew, when links close; compiled.

Koenig and Likhachev, AAAI 2002, the optimised version (figure 4), over the links of a lattice. The goal is no
node: `seed` is how far it is from the nodes linked with it, so every rhs is a least over neighbours and that.
"""

import math

import numpy as np

from gaitwright.bench.unknown_worlds.heap import drop, push
from gaitwright.bench.unknown_worlds.lattice import GO_X, GO_Y, Lattice
from gaitwright.bench.unknown_worlds.lattice_search import DIAGONAL, UNIT, in_units, octile
from gaitwright.numerics.compiled import kernel


class Search:
    """One search, kept between plans: it belongs to one goal."""

    def __init__(self, lattice: Lattice, goal: tuple[float, float], here: int) -> None:
        size = lattice.closed.size
        self.goal, self.closed, self.here, self.km = goal, lattice.closed, here, 0.0
        self.seed = seeds(lattice, goal)
        self.g, self.rhs = np.full(size, math.inf), self.seed.copy()
        self.heap, self.place = np.empty(size, np.int64), np.full(size, -1)
        self.first, self.second = np.full(size, math.inf), np.full(size, math.inf)
        self.count = 0
        self.mend(np.flatnonzero(np.isfinite(self.seed)))

    def moved(self, lattice: Lattice, here: int) -> None:
        """The robot stands elsewhere, and more may be known."""
        columns = lattice.closed.shape[1]
        self.km += octile(here % columns - self.here % columns, here // columns - self.here // columns)
        self.here = here
        if lattice.closed is self.closed:
            return
        seed = seeds(lattice, self.goal)
        changed = np.flatnonzero((lattice.closed != self.closed).ravel() | (seed != self.seed))
        self.closed, self.seed = lattice.closed, seed
        self.mend(changed)

    def mend(self, nodes: np.ndarray) -> None:
        """Nodes whose links changed."""
        self.count = mend(*self.tables, self.count, nodes, self.here, self.km)

    def settle(self, nodes: np.ndarray) -> int:
        """Searches on until the lengths of these nodes are right; how many nodes were expanded."""
        self.count, expanded = settle(*self.tables, self.count, nodes, self.here, self.km)
        return expanded

    @property
    def tables(self) -> tuple[np.ndarray, ...]:
        """What kernels work on."""
        return (
            self.closed, self.seed, self.g, self.rhs, self.heap, self.place, self.first, self.second
        )  # fmt: skip


def seeds(lattice: Lattice, goal: tuple[float, float]) -> np.ndarray:
    """Of every node how far the goal is by a straight link [units], or infinity."""
    nodes, away = lattice.links(goal)
    out = np.full(lattice.closed.size, math.inf)
    out[nodes] = in_units(away)
    return out


@kernel
def key(g, rhs, node, here, km, columns):
    """Both keys of a node."""
    least = min(g[node], rhs[node])
    return least + octile(node % columns - here % columns, node // columns - here // columns) + km, least


@kernel
def update(g, rhs, heap, place, first, second, count, node, here, km, columns):
    """Puts a node where it belongs: into the heap if its two lengths differ."""
    if g[node] != rhs[node]:
        first[node], second[node] = key(g, rhs, node, here, km, columns)
        return push(heap, place, first, second, count, node)
    if place[node] >= 0:
        return drop(heap, place, first, second, count, node)
    return count


@kernel
def looked_ahead(closed, seed, g, node):
    """The rhs of a node: least over its open links and the goal's."""
    columns = closed.shape[1]
    best = seed[node]
    for k in range(8):
        if not closed[node // columns, node % columns] >> k & 1:
            best = min(best, g[node + GO_Y[k] * columns + GO_X[k]] + (DIAGONAL if k % 2 else UNIT))
    return best


@kernel
def mend(closed, seed, g, rhs, heap, place, first, second, count, nodes, here, km):
    """Works the rhs of nodes out anew; the number of nodes in the heap then."""
    for node in nodes:
        rhs[node] = looked_ahead(closed, seed, g, node)
        count = update(g, rhs, heap, place, first, second, count, node, here, km, closed.shape[1])
    return count


@kernel
def is_settled(g, rhs, heap, first, second, node, here, km, columns):
    """Whether no node in the heap can make this one's length another."""
    one, two = key(g, rhs, node, here, km, columns)
    top = heap[0]
    is_first = first[top] < one or (first[top] == one and second[top] < two)
    return not is_first and rhs[node] <= g[node]


@kernel
def settle(closed, seed, g, rhs, heap, place, first, second, count, nodes, here, km):
    """ComputeShortestPath for each of some nodes; how many nodes are in the heap then, how many expanded."""
    columns = closed.shape[1]
    expanded = 0
    for start in nodes:
        while count > 0 and not is_settled(g, rhs, heap, first, second, start, here, km, columns):
            node = heap[0]
            old, older = first[node], second[node]
            one, two = key(g, rhs, node, here, km, columns)
            if old < one or (old == one and older < two):
                first[node], second[node] = one, two
                count = push(heap, place, first, second, count, node)
                continue
            expanded += 1
            if g[node] > rhs[node]:
                g[node] = rhs[node]
                count = drop(heap, place, first, second, count, node)
                for k in range(8):
                    if not closed[node // columns, node % columns] >> k & 1:
                        to = node + GO_Y[k] * columns + GO_X[k]
                        rhs[to] = min(rhs[to], g[node] + (DIAGONAL if k % 2 else UNIT))
                        count = update(g, rhs, heap, place, first, second, count, to, here, km, columns)
            else:
                before = g[node]
                g[node] = math.inf
                count = update(g, rhs, heap, place, first, second, count, node, here, km, columns)
                for k in range(8):
                    if not closed[node // columns, node % columns] >> k & 1:
                        to = node + GO_Y[k] * columns + GO_X[k]
                        if rhs[to] == before + (DIAGONAL if k % 2 else UNIT):
                            rhs[to] = looked_ahead(closed, seed, g, to)
                            count = update(g, rhs, heap, place, first, second, count, to, here, km, columns)
    return count, expanded
