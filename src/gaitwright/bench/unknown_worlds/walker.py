"""A disc that has never been here: it turns, walks, looks, feels, and asks a planner which way.

It never enters an obstacle: what its planner does not know of, it touches.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from gaitwright.bench.unknown_worlds.body import advance, touched
from gaitwright.bench.unknown_worlds.eyes import Camera, blurred, look
from gaitwright.bench.unknown_worlds.world import RADIUS, TOUCH, Point, World
from gaitwright.signals import Sight

STEP, TURN = 0.1, 0.3
"""It looks each time it has gone so far [m] or turned so far [rad]."""
SPEED, RATE = 0.5, 1.0
"""Of walking [m/s] and of turning [rad/s]."""
FARTHEST = 3000.0
"""A trip as long as this has failed [m]."""
MOST_CONTACTS, MOST_PLANS = 200, 20_000
"""A trip with more contacts or plans has failed."""
HERE = 1e-9
"""Way-points nearer than this are passed [m]."""
AT_GOAL = 1e-6
"""It has arrived within this [m]."""
ARRIVED, NONE, LOST = "arrived", "none", "lost"
"""How a trip ends; `lost` is one that came to no end within its bounds."""


@runtime_checkable
class Way(Protocol):
    """A planned way."""

    @property
    def path(self) -> Sequence[Point] | Float[np.ndarray, "n 2"]:
        """Way-points [m], the start left out, the goal included."""
        ...

    @property
    def length(self) -> float:
        """[m]"""
        ...

    @property
    def is_walked(self) -> bool:
        """Whether it leads over ground that was seen to be free, being near enough to the shortest."""
        ...

    @property
    def optimistic(self) -> float:
        """Length of the shortest way where all that is unknown is free [m]."""
        ...


@runtime_checkable
class Planner(Protocol):
    """A map and a search in it: what learns more is another one."""

    def seen(self, sight: Sight) -> "Planner":
        """The planner after a look."""
        ...

    def felt(self, place: Point, direction: float) -> "Planner":
        """The planner after a touch: where the disc's middle is, and in which direction [rad] it touches."""
        ...

    def walked(self, way: Float[np.ndarray, "n 2"]) -> "Planner":
        """The planner after a trip that went this way, from its start to its end."""
        ...

    def way(self, start: Point, goal: Point, facing: float) -> Way | None:
        """The way to go for who faces `facing` [rad], or `None` where there is none."""
        ...

    def is_cut(self, path: Float[np.ndarray, "n 2"]) -> bool:
        """Whether the way through these points, the first of them the robot's place, meets what is known."""
        ...


@runtime_checkable
class Counted(Protocol):
    """A way that tells how many nodes were expanded for it."""

    @property
    def expanded(self) -> int: ...


@dataclass(frozen=True)
class Trip:
    """What became of one trip."""

    end: str
    """ARRIVED, NONE or LOST."""
    metres: float
    seconds: float
    """At `SPEED` and `RATE`, thinking not counted."""
    way: Float[np.ndarray, "n 2"]
    """Where it went [m]."""
    plans: tuple[float, ...]
    """How long each plan took [ms], the first included."""
    learning: float
    """Time that the planner took for looks [ms], and …"""
    looks: int
    contacts: int
    expanded: int
    """Nodes, where the planner counts them."""
    promised: float
    """Of the first plan: the optimistic length [m]."""
    excess: float
    """Largest length of a walked way that was chosen over its optimistic length; 0 where none was."""
    nearest: float
    """Least distance from an obstacle [m]."""


class Walker:
    """A simulated disc with an eye in front, and what it went through since the last trip began."""

    def __init__(
        self, world: World, planner: Planner, camera: Camera, blur: int | None = None, body: float = RADIUS
    ) -> None:
        """`blur`: seed of the camera's noise, `None` sees exactly; `body`: radius of the disc [m]."""
        self.world, self.planner, self.camera, self.body = world, planner, camera, body
        self.rng = None if blur is None else np.random.default_rng(blur)
        self.place = world.start
        self.heading = toward(world.start, world.goal)
        self.begin()

    def begin(self) -> None:
        """Sets what is counted to nothing."""
        self.trace = [self.place]
        self.metres = self.turned = self.learning = self.excess = self.promised = 0.0
        self.plans: list[float] = []
        self.looks = self.contacts = self.expanded = 0
        self.nearest = math.inf

    def trip(self, goal: Point) -> Trip:
        """Goes there from where it is."""
        self.begin()
        self.look()
        end = None
        while end is None:
            way = self.plan(goal)
            if way is None:
                end = NONE
            else:
                self.follow(way)
                if math.dist(self.place, goal) < AT_GOAL:
                    end = ARRIVED
                elif self.is_lost:
                    end = LOST
        trace = np.array(self.trace)
        if end == ARRIVED:
            self.planner = self.planner.walked(trace)
        return Trip(
            end, self.metres, self.metres / SPEED + self.turned / RATE, trace, tuple(self.plans),
            self.learning, self.looks, self.contacts, self.expanded, self.promised, self.excess, self.nearest,
        )  # fmt: skip

    @property
    def is_lost(self) -> bool:
        """Whether the trip has gone beyond its bounds."""
        return self.metres > FARTHEST or self.contacts > MOST_CONTACTS or len(self.plans) > MOST_PLANS

    def plan(self, goal: Point) -> Float[np.ndarray, "n 2"] | None:
        """Way-points to the goal, or `None`."""
        began = perf_counter()
        way = self.planner.way(self.place, goal, self.heading)
        self.plans.append(1e3 * (perf_counter() - began))
        if way is None:
            return None
        if isinstance(way, Counted):
            self.expanded += way.expanded
        if way.is_walked:
            self.excess = max(self.excess, way.length / max(way.optimistic, HERE))
        if len(self.plans) == 1:
            self.promised = way.optimistic
        return np.array(way.path, dtype=float).reshape(-1, 2)

    def follow(self, path: Float[np.ndarray, "n 2"]) -> None:
        """Turns and walks along a path until its end, or until it is cut, or something is touched."""
        for k, (x, y) in enumerate(path.tolist()):
            if not self.go_to((x, y), path[k:]):
                return

    def go_to(self, point: Point, rest: Float[np.ndarray, "n 2"]) -> bool:
        """Turns to a point and walks there; whether it came there with the way still free."""
        away = math.dist(self.place, point)
        if away < HERE:
            self.place = point
            return True
        bearing = toward(self.place, point)
        turn = math.remainder(bearing - self.heading, 2.0 * math.pi)
        parts = math.ceil(abs(turn) / TURN)
        for _ in range(parts):
            self.heading += turn / parts
            self.turned += abs(turn) / parts
            if self.look_is_cut(rest):
                return False
        self.heading = bearing
        steps = math.ceil(away / STEP)
        for step in range(1, steps + 1):
            if self.stops(point if step == steps else None, away / steps):
                return False
            if self.metres > FARTHEST or self.look_is_cut(rest):
                return self.place == point and len(rest) == 1
        return True

    def stops(self, point: Point | None, metres: float) -> bool:
        """One step ahead, onto `point` where that is its end; whether something was touched."""
        x, y = self.place
        free = advance(self.world.edges, x, y, self.heading, metres, self.body - TOUCH)
        at = (x + free * math.cos(self.heading), y + free * math.sin(self.heading))
        if free >= metres and point is not None:
            at = point
        self.metres += free
        self.place = at
        self.trace.append(at)
        if free >= metres:
            return False
        self.contacts += 1
        px, py = touched(self.world.edges, *at)
        self.planner = self.planner.felt(at, toward(at, (px, py)))
        self.look()
        return True

    def look_is_cut(self, rest: Float[np.ndarray, "n 2"]) -> bool:
        """Looks; whether what is left of the way is cut by what is known now."""
        self.look()
        return bool(self.planner.is_cut(np.vstack([self.place, rest])))

    def look(self) -> None:
        """Looks ahead, and tells the planner."""
        sight = look(self.world, self.place, self.heading, self.camera)
        if self.rng is not None:
            sight = blurred(sight, self.rng)
        px, py = touched(self.world.edges, *self.place)
        self.nearest = min(self.nearest, math.dist(self.place, (px, py)))
        began = perf_counter()
        self.planner = self.planner.seen(sight)
        self.learning += 1e3 * (perf_counter() - began)
        self.looks += 1


def toward(here: Point, there: Point) -> float:
    """Direction from one place to another [rad]."""
    return math.atan2(there[1] - here[1], there[0] - here[0])
