"""Road maps of east–west and north–south streets with junctions, and searches on them (appendix A).

The thesis searches from both ends at once and stops at the first level that both fronts share: exact where
all streets are as long as each other. With lengths in metres two fronts must go on until the sum of
their nearest open junctions is no less than the best way that joined them (Pohl 1971). How many junctions
a search went on from is part of its answer.
"""

import heapq
import math
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from gaitwright.errors import WrongUse, unknown

Junction = int
Street = tuple[Junction, Junction]
EW, NS = "EW", "NS"
"""Types of streets: east–west and north–south."""


class StreetRoute(NamedTuple):
    """What a search found."""

    junctions: tuple[Junction, ...]
    """From start to goal; empty where there is no way."""
    length: float
    """[m]; streets, for the searches that count them; infinite where there is no way."""
    expansions: int
    """From how many junctions it was gone on."""


@dataclass(frozen=True)
class StreetMap:
    """Junctions and the streets between neighbours. Streets that are blocked are left out of every search."""

    places: tuple[tuple[float, float], ...]
    """x (east) and y (north) of each junction [m]."""
    streets: frozenset[Street]
    """Pairs of junctions, the smaller number first; each runs east–west or north–south."""

    def __post_init__(self) -> None:
        for a, b in self.streets:
            if not 0 <= a < b < len(self.places):
                raise WrongUse(
                    f"a street needs two junctions of 0 to {len(self.places) - 1}, not {a} and {b}"
                )
            self.type_of(a, b)

    @classmethod
    def grid(cls, xs: Sequence[float], ys: Sequence[float]) -> "StreetMap":
        """Every east–west street at `ys` [m] crosses every north–south street at `xs` [m]."""
        places = tuple((float(x), float(y)) for y in ys for x in xs)
        east = {
            (row * len(xs) + k, row * len(xs) + k + 1) for row in range(len(ys)) for k in range(len(xs) - 1)
        }
        north = {(k, k + len(xs)) for k in range((len(ys) - 1) * len(xs))}
        return cls(places, frozenset(east | north))

    def type_of(self, a: Junction, b: Junction) -> str:
        """The type of the street between two junctions. Raises `WrongUse` for one that runs askew."""
        (xa, ya), (xb, yb) = self.places[a], self.places[b]
        if (xa == xb) == (ya == yb):
            raise WrongUse(f"the street from {(xa, ya)} to {(xb, yb)} runs neither east–west nor north–south")
        return EW if ya == yb else NS

    def blocked(self, *streets: Street) -> "StreetMap":
        """Without streets that were found blocked."""
        return StreetMap(self.places, self.streets - {(min(s), max(s)) for s in streets})

    def opened(self, *streets: Street) -> "StreetMap":
        """With streets that are open (again)."""
        return StreetMap(self.places, self.streets | {(min(s), max(s)) for s in streets})

    def nearest(self, place: tuple[float, float]) -> Junction:
        """The junction nearest to a place [m] (the thesis's `ChangeType` brings a goal to a junction so)."""
        return min(range(len(self.places)), key=lambda k: (math.dist(self.places[k], place), k))

    def length(self, a: Junction, b: Junction) -> float:
        """Of the street between two junctions [m]."""
        (xa, ya), (xb, yb) = self.places[a], self.places[b]
        return abs(xa - xb) + abs(ya - yb)

    @cached_property
    def neighbours(self) -> Mapping[Junction, tuple[Junction, ...]]:
        """Of each junction, in rising order."""
        found: dict[Junction, list[Junction]] = {k: [] for k in range(len(self.places))}
        for a, b in sorted(self.streets):
            found[a].append(b)
            found[b].append(a)
        return {k: tuple(sorted(others)) for k, others in found.items()}


def route(streets: StreetMap, start: Junction, goal: Junction, search: str = "A*") -> StreetRoute:
    """The shortest route by one of `SEARCHES`. Raises `WrongUse` for what does not exist."""
    if search not in SEARCHES:
        raise unknown("search", search, SEARCHES)
    for junction in (start, goal):
        if not 0 <= junction < len(streets.places):
            raise WrongUse(f"no junction {junction}; there are 0 to {len(streets.places) - 1}")
    return SEARCHES[search](streets, start, goal)


def replanned(
    streets: StreetMap, here: Junction, goal: Junction, found_blocked: Iterable[Street], search: str = "A*"
) -> tuple[StreetMap, StreetRoute]:
    """The map without what was found blocked on the way, and the shortest route from here on it."""
    left = streets.blocked(*found_blocked)
    return left, route(left, here, goal, search)


# --- fewest streets: level by level ------------------------------------------------------------------
def breadth_first(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """From the start alone, the goal not looked at before its turn."""
    parent, queue, expansions = {start: start}, deque([start]), 0
    while queue:
        here = queue.popleft()
        if here == goal:
            path = back(parent, goal)
            return StreetRoute(tuple(reversed(path)), len(path) - 1.0, expansions)
        expansions += 1
        for there in streets.neighbours[here]:
            if there not in parent:
                parent[there] = here
                queue.append(there)
    return StreetRoute((), math.inf, expansions)


def alternating(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """From both ends, one level each in turn: appendix A."""
    return two_fronts(streets, start, goal, lambda levels, _: levels[0] <= levels[1])


def smaller_front(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """From both ends, always a level of the front with fewer junctions."""
    return two_fronts(streets, start, goal, lambda _, sizes: sizes[0] <= sizes[1])


def two_fronts(
    streets: StreetMap, start: Junction, goal: Junction, first: Callable[[list[int], list[int]], bool]
) -> StreetRoute:
    """Level by level from both ends until a level meets the other front; `first(levels, sizes)` says whether
    the start's front is next.

    What meets first lies in the other's last level (had it been in an earlier one, they would have met
    before), so every meeting of that level is as short as any other.
    """
    parents = ({start: start}, {goal: goal})
    fronts, levels, expansions = [[start], [goal]], [0, 0], 0
    meeting = start if start == goal else None
    while meeting is None and all(fronts):
        side = 0 if first(levels, [len(front) for front in fronts]) else 1
        new, met = [], []
        for here in fronts[side]:
            expansions += 1
            for there in streets.neighbours[here]:
                if there not in parents[side]:
                    parents[side][there] = here
                    new.append(there)
                    if there in parents[1 - side]:
                        met.append(there)
        fronts[side], levels[side] = new, levels[side] + 1
        meeting = min(met, default=None)
    if meeting is None:
        return StreetRoute((), math.inf, expansions)
    path = (*reversed(back(parents[0], meeting)), *back(parents[1], meeting)[1:])
    return StreetRoute(path, len(path) - 1.0, expansions)


# --- fewest metres -----------------------------------------------------------------------------------
def best_first(
    streets: StreetMap, start: Junction, goal: Junction, left: Callable[[Junction], float]
) -> StreetRoute:
    """By the length so far and the least that is `left` [m]; of equally good ones the nearest goes on."""
    cost, parent, closed = {start: 0.0}, {start: start}, set()
    queue = [(left(start), left(start), start)]
    while queue:
        *_, here = heapq.heappop(queue)
        if here == goal:
            return StreetRoute(tuple(reversed(back(parent, goal))), cost[goal], len(closed))
        if here in closed:
            continue
        closed.add(here)
        for there in streets.neighbours[here]:
            new = cost[here] + streets.length(here, there)
            if new < cost.get(there, math.inf):
                cost[there], parent[there] = new, here
                heapq.heappush(queue, (new + left(there), left(there), there))
    return StreetRoute((), math.inf, len(closed))


def dijkstra(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """From the start to all sides."""
    return best_first(streets, start, goal, lambda _: 0.0)


def a_star(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """|Δx| + |Δy| is left at least, where streets run along the axes."""
    return best_first(streets, start, goal, lambda k: streets.length(k, goal))


def two_way_dijkstra(streets: StreetMap, start: Junction, goal: Junction) -> StreetRoute:
    """From both ends, the nearer open junction first, until no meeting can be shorter than the best one."""
    if start == goal:
        return StreetRoute((start,), 0.0, 0)
    cost, parents = ({start: 0.0}, {goal: 0.0}), ({start: start}, {goal: goal})
    queues, closed = ([(0.0, start)], [(0.0, goal)]), (set(), set())
    best, meeting = math.inf, start
    while all(queues) and queues[0][0][0] + queues[1][0][0] < best:
        side = 0 if queues[0][0] <= queues[1][0] else 1
        _, here = heapq.heappop(queues[side])
        if here in closed[side]:
            continue
        closed[side].add(here)
        for there in streets.neighbours[here]:
            new = cost[side][here] + streets.length(here, there)
            if new < cost[side].get(there, math.inf):
                cost[side][there], parents[side][there] = new, here
                heapq.heappush(queues[side], (new, there))
                if new + cost[1 - side].get(there, math.inf) < best:
                    best, meeting = new + cost[1 - side][there], there
    expansions = len(closed[0]) + len(closed[1])
    if best == math.inf:
        return StreetRoute((), math.inf, expansions)
    path = (*reversed(back(parents[0], meeting)), *back(parents[1], meeting)[1:])
    return StreetRoute(path, best, expansions)


def back(parent: Mapping[Junction, Junction], junction: Junction) -> list[Junction]:
    """From a junction to where its front set out."""
    path = [junction]
    while parent[path[-1]] != path[-1]:
        path.append(parent[path[-1]])
    return path


SEARCHES: Mapping[str, Callable[[StreetMap, Junction, Junction], StreetRoute]] = {
    "breadth-first": breadth_first,
    "alternating": alternating,
    "smaller-front": smaller_front,
    "Dijkstra": dijkstra,
    "two-way Dijkstra": two_way_dijkstra,
    "A*": a_star,
}
"""The first three count streets, the others metres."""
