"""Trips without physics: a robot drawn along its route, so that a school sees many situations in little time.

Scenes, routes and the scanner are those of real trips; the body is not simulated. It goes as it is told, its
feet follow the gait's phases, and now and then something makes it sway. What a skill can do on the ground is
not learned from this, only where a teacher would use it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.learning.decision_point import DecisionPoint, decision_point
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.navigation.navigator import Navigator
from gaitwright.numerics.geometry import GRAVITY, quaternion_of, upright_rotation
from gaitwright.perception.known_ground import KnownGround
from gaitwright.signals import Mission, Route, Sensed, SkillCall
from gaitwright.skills.measured import measured

Driver = Callable[[Route, Sensed, SkillCall | None], SkillCall]
"""Who chooses the skills."""

TICK = 0.6
"""Time from choice to choice [s], at h = 0.29 m."""
UNREST = 0.08
"""Share of the moments at which something makes the body sway, or turns it off its course."""
LONGEST = 120
"""Moments of a trip at most."""


@dataclass(frozen=True)
class Course:
    """A mission in a scene, for a robot that starts anyhow."""

    robot: Robot
    navigator: Navigator
    perception: KnownGround
    scene: Scene
    mission: Mission
    yaw: float
    name: str


def moments_of(course: Course, driver: Driver, rng: np.random.Generator) -> list[DecisionPoint]:
    """The moments of one trip, driven by `driver`."""
    body = Body(course, rng)
    sensed = body.sensed(0.0, None)
    navigator, perception, ground = course.navigator, course.perception, course.perception.ground
    scan = perception.look(ground, sensed)
    route, travel = navigator.set_out(course.mission, sensed, ground, scan)
    now: SkillCall | None = None
    moments = []
    for k in range(LONGEST):
        route = met(course, route, rng)
        raw = measured(course.robot, route, sensed, now)
        moments.append(decision_point(f"{course.name}, moment {k + 1}", raw, now))
        now = driver(route, sensed, now)
        if route.arrived or not route.path:
            break
        before = body.x, body.y
        body.go(now, route)
        travel = navigator.been(travel, *between(before, (body.x, body.y)))
        sensed = body.sensed(TICK * (k + 1), now)
        scan = perception.look(ground, sensed)
        route, travel = navigator.plan(route, sensed, ground, scan, travel)
    return moments


def met(course: Course, route: Route, rng: np.random.Generator) -> Route:
    """The route, where now and then something stands in the way that no map shows."""
    if route.ahead is None or rng.uniform() > UNREST:
        return route
    away = float(rng.uniform(0.3, 4.0)) * course.robot.body_length
    return replace(route, ahead=replace(route.ahead, obstacle=min(away, route.ahead.obstacle)))


def between(start: tuple[float, float], end: tuple[float, float]) -> list[tuple[float, float]]:
    """Places on the way from one to another."""
    shares = np.linspace(0.0, 1.0, 12).tolist()
    return [(start[0] + k * (end[0] - start[0]), start[1] + k * (end[1] - start[1])) for k in shares]


class Body:
    """A place, a direction and a speed that follow what is called for."""

    def __init__(self, course: Course, rng: np.random.Generator) -> None:
        self.course, self.rng = course, rng
        self.x, self.y, _ = course.scene.start
        self.yaw, self.phase, self.forward = course.yaw, float(rng.uniform()), 0.0
        self.q, _ = angles(course.robot, course.robot.nominal_feet)

    def go(self, call: SkillCall, route: Route) -> None:
        """One tick of motion, no farther than the next point of the path."""
        k = math.sqrt(self.course.robot.height / 0.29)
        seconds = TICK * k
        astray = 0.5 if self.rng.uniform() < UNREST else 0.03
        self.yaw += call.turn * seconds + float(self.rng.normal(0.0, astray))
        self.forward += 0.7 * (call.velocity[0] - self.forward)
        far = min(self.forward * seconds, math.dist((self.x, self.y), route.path[0]))
        self.x += far * math.cos(self.yaw)
        self.y += far * math.sin(self.yaw)
        self.phase = (self.phase + float(self.rng.uniform(0.8, 1.2)) * 0.37) % 1.0

    def sensed(self, time: float, call: SkillCall | None) -> Sensed:
        """What the robot would sense: ground and gait as they are, with noise and some unrest."""
        robot, rng = self.course.robot, self.rng
        normal = np.asarray(self.course.scene.normal(self.x, self.y), dtype=float).ravel()
        unrest = (
            float(rng.uniform(0.15, 0.6)) if rng.uniform() < UNREST else abs(float(rng.normal(0.0, 0.05)))
        )
        share = float(rng.uniform())
        pose = upright_rotation(tuple(normal.tolist()), self.yaw)
        omega = np.array([unrest * share * robot.natural_frequency, 0.0, call.turn if call else 0.0])
        aside = unrest * (1.0 - share) * robot.natural_frequency * robot.height
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        velocity = np.array([self.forward * c - aside * s, self.forward * s + aside * c, 0.0])
        height = float(np.asarray(self.course.scene.height(self.x, self.y))) + robot.height
        position = np.array([self.x, self.y, height])
        still = np.zeros_like(self.q)
        return Sensed(time, position, quaternion_of(pose), velocity, omega, self.q, still, self.loads(call))

    def loads(self, call: SkillCall | None) -> np.ndarray:
        """The weight shared by the feet that the gait has down."""
        robot, down = self.course.robot, np.ones(self.course.robot.n, dtype=bool)
        if call is not None and call.gait.duty < 1.0:
            down = (self.phase + np.array(call.gait.offsets)) % 1.0 < call.gait.duty
        shares = down * self.rng.uniform(0.6, 1.4, robot.n)
        most = float(self.rng.uniform(0.8, 2.0))
        return shares / max(1.0, float(shares.sum())) * most * robot.total_mass * GRAVITY
