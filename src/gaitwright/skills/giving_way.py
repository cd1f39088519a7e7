"""Gives way to what moves: slows down, stands until it has passed, or steps out of its way, and says so.

What moves is taken to go on as it does. Of the ways that a robot could go on, the first is taken on which
nothing comes too near, if it goes on so or if it soon stops: as was chosen, slower, not at all, aside, back.
(A choice of velocities as in P. Fiorini and Z. Shiller, Motion planning in dynamic environments using
velocity obstacles, 1998.)
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
import shapely
from jaxtyping import Float
from shapely.geometry.base import BaseGeometry

from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation, wrap
from gaitwright.signals import GroundMap, Moving, Route, Sensed, SkillCall
from gaitwright.skills.foothold_guard import FootholdGuard
from gaitwright.skills.library import fastest, feet_reach, find_skill, gait_of, speed_scale
from gaitwright.stages import Chooser, Map, Now

AHEAD, EVERY, STOPS = 3.0, 0.15, 0.45
"""It is looked so far ahead in time, and so often; who stops stands after so long: at a body height of 0.29 m
[s]."""
LATER, STEPPED = 6.0, 2.5
"""Who steps out of the way should still be out of it after so long, once it has stepped for so long [s]."""
ROOM, MORE = 0.5, 1.5
"""Room beside the feet's reach that is kept to what moves, in body heights. Who gives way already goes on if
there is so many times that."""
HAIR = 0.03
"""What comes nearer by less than this, in body heights, comes no nearer."""
SLOWER = (0.6, 0.3)
"""Shares of the chosen velocity that are tried."""
LASTS = 1.0
"""A step out of the way needs free ground for so long, at a body height of 0.29 m [s]."""
NEAR = 5.0
"""Ground that stops a robot may be what moves, or where it was seen, within so many body heights of it."""
HALF = math.sqrt(0.5)
"""Of each speed of a step that goes back and aside."""
ASIDE, BACK = "walk-sideways", "walk-backward"
"""Skills that step out of the way."""


class Thing(NamedTuple):
    """What moves, where it is now."""

    outline: BaseGeometry
    velocity: Float[np.ndarray, "2"]
    """World [m/s]."""

    @classmethod
    def of(cls, seen: Moving, time: float) -> "Thing":
        """What was there for sure at a time, or before."""
        velocity = np.array(seen.velocity)
        places = seen.edge + (time - seen.time) * velocity
        return cls(shapely.MultiPoint(places).convex_hull, velocity)


class Way(NamedTuple):
    """A way to go on."""

    call: SkillCall
    does: str
    steps: bool = False
    """Whether it leads off the way that was chosen, so that ground is needed there."""


class Gap(NamedTuple):
    """How much room would be lacking [m], and to what."""

    soon: float
    later: float
    """Where it went on so for `STEPPED`, and stood then."""
    thing: Thing

    def lacks(self, steps: bool) -> float:
        """What matters of a way: one that steps aside should end out of the way."""
        return self.soon + self.later if steps else self.soon


@dataclass(frozen=True)
class GivesWay:
    """Another chooser's choice, unless something that moves would come too near."""

    chooser: Chooser
    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The other's choice, or what gives way, with a sentence that says to what."""
        call = self.chooser.choose(route, sensed, now, ground)
        if ground is None or not ground.moving:
            return call
        here, yaw = sensed.position_w[:2], heading(rotation(sensed.orientation_wb))
        things = [Thing.of(one, sensed.time) for one in ground.moving]
        if call.halt is not None and self.is_near(here, things):
            call = self.stop(call, "waits: what moves is in the way")
        room = self.reach + self.robot.height * ROOM * (MORE if now is not None and now.yields else 1.0)
        first, least = self.gap(call, here, yaw, things, room), HAIR * self.robot.height
        if first.soon <= least:
            return call
        way = Way(self.stop(call, "") if any(call.velocity) else call, "waits")  # where nothing helps
        best = self.gap(way.call, here, yaw, things, room).lacks(True)
        for other in self.others(call, now):
            if other.steps and not self.is_free(other.call, sensed, ground):
                continue
            gap = self.gap(other.call, here, yaw, things, room)
            if gap.lacks(other.steps) <= least:
                way = other
                break
            if gap.lacks(True) < best - least:
                way, best = other, gap.lacks(True)
        because = f"gives way to what comes from {side_of(first.thing, here, yaw)}: {way.does}"
        return replace(way.call, because=because, yields=True)

    @cached_property
    def reach(self) -> float:
        """Radius of a circle that holds the robot, seen from above [m]."""
        return feet_reach(self.robot) + float(self.robot.foot_radius.max())

    @cached_property
    def guard(self) -> FootholdGuard:
        """Who knows whether feet find ground on a way."""
        return FootholdGuard(self.chooser, self.robot)

    def others(self, call: SkillCall, now: Now) -> Iterator[Way]:
        """Other ways to go on than a call, the calmest first; who is under way to a side does not turn to the
        other: what moves is seen a little otherwise from look to look."""
        forward, left = call.velocity
        if any(call.velocity):
            for share in SLOWER:
                yield Way(replace(call, velocity=(share * forward, share * left)), "slows down")
            yield Way(self.stop(call, ""), "waits")
        side, back = (fastest(find_skill(name, self.robot), self.robot) for name in (ASIDE, BACK))
        steps = [
            *(self.step(call, ASIDE, (0.0, one), "steps aside") for one in (side, -side)),
            *(self.step(call, BACK, (-HALF * back, HALF * one), "steps back") for one in (side, -side)),
            self.step(call, BACK, (-back, 0.0), "steps back"),
        ]
        if forward > 0.0:
            aside = (replace(call, velocity=(SLOWER[0] * forward, one)) for one in (side, -side))
            steps = [*(Way(one, "steps aside", True) for one in aside), *steps]
        under_way = now.velocity[1] if now is not None and now.yields else 0.0
        yield from (way for way in steps if way.call.velocity[1] * under_way >= 0.0)

    def step(self, call: SkillCall, skill: str, velocity: tuple[float, float], does: str) -> Way:
        """A step out of the way."""
        gait = gait_of(find_skill(skill, self.robot), self.robot)
        return Way(replace(call, skill=skill, gait=gait, velocity=velocity, turn=0.0), does, True)

    def stop(self, call: SkillCall, because: str) -> SkillCall:
        """A call that goes nowhere for now; the trip goes on."""
        gait = gait_of(find_skill("stop", self.robot), self.robot)
        still = {"velocity": (0.0, 0.0), "turn": 0.0, "halt": None, "blocked": None, "yields": True}
        return replace(call, skill="stop", gait=gait, because=because, **still)

    def gap(
        self, call: SkillCall, here: Float[np.ndarray, "2"], yaw: float, things: list[Thing], room: float
    ) -> Gap:
        """How far something would come nearer than the room [m], or than it is where it is nearer already."""
        scale, velocity = speed_scale(self.robot), turned(call.velocity, yaw)
        times = scale * np.arange(0.0, LATER, EVERY)[:, None]
        soon = len(times) * AHEAD / LATER
        ways = [here + np.minimum(times, scale * until) * velocity for until in (AHEAD, STOPS, STEPPED)]
        found = []
        for thing in things:
            places = shapely.points(np.array(ways) - times * thing.velocity)
            apart = np.asarray(shapely.distance(places, thing.outline))
            near = np.append(apart[:2, : round(soon)].min(axis=1), apart[2].min())
            found.append(np.maximum(min(room, float(apart[0, 0])) - near, 0.0))
        goes, stops, steps = np.array(found).T
        lacks = goes if goes.max() <= stops.max() else stops
        return Gap(float(lacks.max()), float(steps.max()), things[int(lacks.argmax())])

    def is_near(self, here: Float[np.ndarray, "2"], things: list[Thing]) -> bool:
        """Whether something that moves is near the robot."""
        place = shapely.Point(here)
        return min(thing.outline.distance(place) for thing in things) < NEAR * self.robot.height

    def is_free(self, call: SkillCall, sensed: Sensed, ground: GroundMap) -> bool:
        """Whether a step out of the way finds ground, and nothing that stands there."""
        here, yaw = sensed.position_w[:2], heading(rotation(sensed.orientation_wb))
        there = here + LASTS * speed_scale(self.robot) * turned(call.velocity, yaw)
        x_min, y_min, x_max, y_max = ground.bounds
        if not shapely.box(x_min, y_min, x_max, y_max).buffer(-self.reach).covers(shapely.Point(there)):
            return False
        path = shapely.LineString([here, there])
        if any(shapely.Polygon(one).distance(path) < self.reach for one in ground.obstacles):
            return False
        return self.guard.trouble(call, NOWHERE, sensed, ground) is None


NOWHERE = Route((), 0.0, None)


def turned(velocity: tuple[float, float], yaw: float) -> Float[np.ndarray, "2"]:
    """A velocity, forward and left, in world axes."""
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([c * velocity[0] - s * velocity[1], s * velocity[0] + c * velocity[1]])


def side_of(thing: Thing, here: Float[np.ndarray, "2"], yaw: float) -> str:
    """From where a thing comes, to one who looks along `yaw`."""
    if thing.velocity.any():
        x, y = -thing.velocity
    else:
        at = thing.outline.centroid
        x, y = at.x - here[0], at.y - here[1]
    angle = float(wrap(math.atan2(y, x) - yaw))
    if abs(angle) <= math.pi / 4:
        return "ahead"
    if abs(angle) >= 3 * math.pi / 4:
        return "behind"
    return "the left" if angle > 0.0 else "the right"
