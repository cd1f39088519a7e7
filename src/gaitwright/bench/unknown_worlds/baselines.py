"""Planners to compare with: what is unknown is free, and the way is planned anew where it is met by
something.

All know the same lattice. They differ in how they search it, so in how long their ways and their searches
are.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.bench.unknown_worlds.incremental import Search
from gaitwright.bench.unknown_worlds.lattice import CELL, Lattice, own_room
from gaitwright.bench.unknown_worlds.lattice_search import a_star, descent, in_units, pulled, theta_star
from gaitwright.bench.unknown_worlds.world import BOUNDS, RADIUS, TOUCH, Point
from gaitwright.signals import Sight

FELT = 0.01
"""What a touch says stands there: a piece as long as this, across the direction [m]."""


class GridWay(NamedTuple):
    """A planned way."""

    path: Float[np.ndarray, "n 2"]
    length: float
    expanded: int
    is_walked: bool = False

    @property
    def optimistic(self) -> float:
        """Every way of these planners is."""
        return self.length


@dataclass(frozen=True)
class AStar:
    """A* over eight neighbours, made anew each time."""

    lattice: Lattice = field(default_factory=lambda: Lattice.of(BOUNDS, RADIUS))

    def seen(self, sight: Sight) -> "AStar":
        """Knows the pieces of a look too."""
        return self.knows(self.lattice.with_pieces(sight.pieces))

    def felt(self, place: Point, direction: float) -> "AStar":
        """Knows that something stands where it touched."""
        ahead = np.array([np.cos(direction), np.sin(direction)])
        across = FELT / 2.0 * np.array([-ahead[1], ahead[0]])
        at = np.array(place) + (RADIUS - TOUCH) * ahead
        return self.knows(self.lattice.with_pieces(np.hstack([at - across, at + across])[None]))

    def walked(self, way: Float[np.ndarray, "n 2"]) -> "AStar":
        """Does not remember ways."""
        return self

    def is_cut(self, path: Float[np.ndarray, "n 2"]) -> bool:
        """Whether a known piece stands in a way."""
        return self.lattice.is_cut(path)

    def knows(self, lattice: Lattice) -> "AStar":
        """The planner with this lattice."""
        return self if lattice is self.lattice else replace(self, lattice=lattice)

    def way(self, start: Point, goal: Point, facing: float = 0.0) -> GridWay | None:
        """The shortest way over the lattice."""
        if self.lattice.is_clear(start, goal):
            return straight(start, goal)
        return self.found(start, goal)

    def found(self, start: Point, goal: Point) -> GridWay | None:
        """The same, where it bends."""
        closed = self.lattice.closed
        (starts, from_start), (ends, to_goal) = self.lattice.links(start), self.lattice.links(goal)
        x, y = self.cells(goal)
        g, before, expanded, _ = a_star(closed, starts, in_units(from_start), ends, in_units(to_goal), x, y)
        if before < 0:
            return None
        first = np.full(closed.size, np.inf)
        first[starts] = in_units(from_start)
        nodes = descent(closed, g, g, first, before)[::-1]
        return along(self.lattice.places(nodes), start, goal, expanded)

    def cells(self, place: Point) -> Point:
        """A place in cells of the lattice."""
        x_min, y_min, *_ = self.lattice.bounds
        return (place[0] - x_min) / CELL, (place[1] - y_min) / CELL


class PulledAStar(AStar):
    """The same, its way pulled straight: an any-angle way after the search."""

    def found(self, start: Point, goal: Point) -> GridWay | None:
        """The way of A*, without the points that a straight walk leaves out."""
        way = super().found(start, goal)
        return way if way is None else self.pulled(start, way.path, way.expanded)

    def pulled(self, start: Point, path: Float[np.ndarray, "n 2"], expanded: int) -> GridWay:
        """A way without the points that a straight walk leaves out."""
        pieces, radius = self.lattice.pieces, self.lattice.radius
        points = pulled(np.vstack([start, path]), pieces, radius, own_room(pieces, *start, radius))
        return GridWay(points[1:], length_of(points), expanded)


class ThetaStar(PulledAStar):
    """Theta*: an any-angle way by the search itself, pulled straight in the end."""

    def found(self, start: Point, goal: Point) -> GridWay | None:
        """The way of Theta*."""
        (starts, from_start), (ends, to_goal) = self.lattice.links(start), self.lattice.links(goal)
        links = (starts, from_start / CELL, ends, to_goal / CELL, self.lattice.bounds[:2])
        points, expanded = theta_star(
            self.lattice.closed,
            self.lattice.pieces,
            self.lattice.radius,
            self.cells(start),
            self.cells(goal),
            links,
        )
        if not len(points):
            return None
        path = np.array(self.lattice.bounds[:2]) + CELL * points[1:]
        path[-1] = goal
        return self.pulled(start, path, expanded)


@dataclass(frozen=True)
class DStarLite(AStar):
    """D* Lite: searched from the goal, mended as links close.

    Its memory is that of the last search: of a line of such planners only the newest may be asked.
    """

    memory: dict[str, Search] = field(default_factory=dict)

    def found(self, start: Point, goal: Point) -> GridWay | None:
        """The way down the lengths that the search keeps."""
        starts, from_start = self.lattice.links(start)
        if not len(starts):
            return None
        here = int(starts[np.argmin(from_start)])
        search = self.memory.get("search")
        if search is None or search.goal != goal:
            search = self.memory["search"] = Search(self.lattice, goal, here)
        else:
            search.moved(self.lattice, here)
        expanded = search.settle(starts)
        lengths = search.rhs[starts] + in_units(from_start)
        first = int(np.argmin(lengths))
        if not np.isfinite(lengths[first]):
            return None
        nodes = descent(search.closed, search.g, search.rhs, search.seed, int(starts[first]))
        return along(self.lattice.places(nodes), start, goal, expanded)


def straight(start: Point, goal: Point) -> GridWay:
    """The way without a bend."""
    path = np.array([goal], dtype=float)
    return GridWay(path, float(np.hypot(*(path[0] - start))), 0)


def along(nodes: Float[np.ndarray, "n 2"], start: Point, goal: Point, expanded: int) -> GridWay:
    """The way over nodes to the goal, without those in the middle of a straight line."""
    points = np.vstack([start, nodes, goal])
    before, after = np.diff(points[:-1], axis=0), np.diff(points[1:], axis=0)
    bends = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]) > 1e-9
    path = points[1:][np.append(bends, True)]
    return GridWay(path, length_of(np.vstack([start, path])), expanded)


def length_of(points: Float[np.ndarray, "n 2"]) -> float:
    """Length of the line through points [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
