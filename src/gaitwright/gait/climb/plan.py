"""Up and down stairs by joint coordination alone: feet on the treads, the body by regulation (rows J5 … J8).

The thesis's test of its kinematics (section 6.3): a stairway of 45° that its robot cannot climb without
tilting its body. One foot moves at a time. Before it does, the body shifts until the centre of mass is over
the feet that stay; its height, pitch and roll are `regulate`d from the feet, and where a leg would come near
a limit the body gives way: lower, farther ahead or behind. Statics only: no force is asked for, so it is
slow. Along +x, at yaw 0.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.gait.climb.checks import (
    Margins,
    balance_room,
    checked,
    joint_room,
    leg_room,
    links,
    to_world,
    trunk_room,
)
from gaitwright.gait.climb.motion import SHIFT, BodyPose, ClimbStep, Motion, motion
from gaitwright.gait.regulation import regulate
from gaitwright.ground.scene import Scene
from gaitwright.model.kinematics import REACHED
from gaitwright.model.robot import Robot
from gaitwright.numerics.polygon import hull, leaned

STRIDE = 0.4
"""Longest stride that is not forced by a deeper tread, in body heights."""
EDGE = 0.2
"""How far from the edges of a tread a foot keeps, in body heights; on a shallow one it takes the middle."""
STEEP = 2.0
"""Ground that rises or falls faster than this, metre per metre, is an edge."""
CLEARANCE = 0.06
"""How high a foot is carried over what is under its way, in body heights."""
INSIDE = 0.12
"""How far inside the support polygon the centre of mass is put, in body heights."""
COMFORT = Margins(joint=0.15, foot=1.0, leg=0.02, trunk=0.03, balance=0.06)
"""Room beyond which more is not looked for: [rad] for joints, else body heights. Feet have `CLEARANCE`."""
STANDS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4)
"""Heights that the body may take over the plane of its feet, per nominal height, in this order."""
AHEAD = (0.0, 0.15, -0.15, 0.3, -0.3)
"""How far ahead of the middle of its feet the body may be, in body heights, in this order."""
SLOW = 4.0
"""Duration of a step, times √(h/g) [s]."""


@dataclass(frozen=True)
class Ascent:
    """A climb: its steps, the motion they make, and whether all of it fits."""

    robot: Robot
    steps: tuple[ClimbStep, ...]
    seconds: float
    """Duration of a step [s]."""
    motion: Motion
    """Sampled from start to end."""
    margins: Margins
    faults: tuple[str, ...]
    """A sentence for everything that does not fit; none where the climb is sound."""

    def at(self, time: Float[np.ndarray, "n"]) -> Motion:
        """The motion at times from the start [s]."""
        return motion(self.robot, self.steps, self.seconds, time)


def climb(
    robot: Robot,
    scene: Scene,
    distance: float | None = None,
    stride: float | None = None,
    tilts: bool = True,
    dt: float = 0.1,
) -> Ascent:
    """A climb from the scene's start, `distance` [m] along +x; `None`: until all feet are past the last box.

    `stride`: of every foot [m]; `None`: a tread, or as many as fit in `STRIDE`. `tilts`: whether the body
    takes the pitch and roll of the ground, or stays level. `dt`: between samples [s]. Raises `WrongUse` for
    numbers that are none or not above 0, and for a start that does not look along +x.
    """
    if abs(scene.start[2]) > 1e-9:
        raise WrongUse(
            f"a climb goes along +x; the start of scene {scene.name} looks {scene.start[2]:g} rad off"
        )
    for what, value in (("distance", distance), ("stride", stride), ("dt", dt)):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise WrongUse(
                f"a climb with a {what} of {value:g} is asked for; expected a finite number above 0"
            )
    distance = past_the_boxes(robot, scene) if distance is None else distance
    stride = stride_for(robot, scene, distance) if stride is None else stride
    steps = tuple(plan(robot, scene, math.ceil(distance / stride - 1e-9), stride, tilts))
    seconds = SLOW / robot.natural_frequency
    made = motion(robot, steps, seconds, np.arange(0.0, len(steps) * seconds + dt, dt))
    margins, faults = checked(robot, scene, made)
    return Ascent(robot, steps, seconds, made, margins, faults)


def past_the_boxes(robot: Robot, scene: Scene) -> float:
    """How far the body goes until even the hindmost foot is past the last box [m]."""
    end = max((box.x + box.radius if box.yaw else box.x + box.lx / 2 for box in scene.boxes), default=0.0)
    return max(end - scene.start[0], 0.0) - float(robot.stance[:, 0].min()) + STRIDE * robot.height


# --- footholds -------------------------------------------------------------------------------------
def stride_for(robot: Robot, scene: Scene, distance: float) -> float:
    """As many of the shallowest treads on the way as fit in the longest stride, at least one [m]."""
    longest, x, y = STRIDE * robot.height, scene.start[0], scene.start[1]
    spacing = longest / 100.0
    along = np.arange(x, x + distance, spacing)
    edges = edges_of(np.asarray(scene.height(along, np.full_like(along, y))), spacing)
    treads = np.diff(along[edges])
    treads = treads[(treads > 0.1 * longest) & (treads < 2.0 * longest)]
    if not len(treads):
        return longest
    tread = float(np.median(treads))
    return tread * max(1, math.floor(longest / tread + 0.05))


def edges_of(heights: Float[np.ndarray, "n"], spacing: float) -> np.ndarray:
    """Places between which the ground steps up or down."""
    return np.flatnonzero(np.abs(np.diff(heights)) > STEEP * spacing)


def foothold(robot: Robot, scene: Scene, leg: int, x: float, y: float) -> Float[np.ndarray, "3"]:
    """Centre of a foot on the tread at x, y, at least `EDGE` from its edges or in its middle [m]."""
    room = EDGE * robot.height
    along = x + np.linspace(-2.0 * room, 2.0 * room, 401)
    edges = (
        along[edges_of(np.asarray(scene.height(along, np.full_like(along, y))), 0.01 * room)] + 0.005 * room
    )
    low = max(edges[edges <= x], default=-math.inf) + room
    high = min(edges[edges > x], default=math.inf) - room
    x = 0.5 * (low + high) if low > high else min(max(x, low), high)
    return np.array([x, y, float(np.asarray(scene.height(x, y))) + robot.foot_radius[leg]])


def carried_over(robot: Robot, scene: Scene, leg: int, start: np.ndarray, end: np.ndarray) -> float:
    """Height of the centre of a foot that clears all ground on its way [m]."""
    radius = robot.foot_radius[leg]
    share = np.linspace(0.0, 1.0, 101)
    x = start[0] - radius + (end[0] - start[0] + 2.0 * radius) * share
    top = float(np.max(scene.height(x, start[1] + (end[1] - start[1]) * share)))
    return top + radius + CLEARANCE * robot.height


def order_of(legs: int) -> tuple[int, ...]:
    """Legs in the order in which a walk lifts them: each side from rear to front, left first."""
    return (*range(legs - 2, -1, -2), *range(legs - 1, 0, -2))


# --- the plan --------------------------------------------------------------------------------------
def plan(robot: Robot, scene: Scene, cycles: int, stride: float, tilts: bool) -> Iterator[ClimbStep]:
    """The steps of a climb: every foot `cycles` strides ahead."""
    x, y, _ = scene.start
    nominal = robot.stance[:, :2] + (x, y)
    feet = np.array([foothold(robot, scene, leg, *nominal[leg]) for leg in range(robot.n)])
    body = regulated(feet, np.array([x, y]), robot.stand, tilts)
    for cycle, leg in product(range(1, cycles + 1), order_of(robot.n)):
        landing = foothold(robot, scene, leg, nominal[leg, 0] + cycle * stride, nominal[leg, 1])
        apex = carried_over(robot, scene, leg, feet[leg], landing)
        step = comfortable(robot, scene, ClimbStep(leg, feet.copy(), landing, apex, body, body), tilts)
        yield step
        body = step.body
        feet[leg] = landing


def regulated(
    feet: Float[np.ndarray, "legs 3"], place: Float[np.ndarray, "2"], stand: float, tilts: bool
) -> BodyPose:
    """The body at a place, height, roll and pitch from the feet (row J5); level where it does not tilt."""
    pose = regulate(feet, np.array([place[0], place[1], 0.0]), stand)
    turn = (pose.roll, pose.pitch) if tilts else (0.0, 0.0)
    return np.array([place[0], place[1], pose.height, *turn])


def comfortable(robot: Robot, scene: Scene, step: ClimbStep, tilts: bool) -> ClimbStep:
    """The step with the first body pose that has room on all sides, else with the one that has most."""
    best, most = step, -math.inf
    for stand, ahead in product(STANDS, AHEAD):
        tried = balanced(robot, step, stand * robot.stand, ahead * robot.height, tilts)
        ease = ease_of(robot, scene, tried)
        if ease > most:
            best, most = tried, ease
        if ease >= 1.0:
            break
    return best


def balanced(robot: Robot, step: ClimbStep, stand: float, ahead: float, tilts: bool) -> ClimbStep:
    """The step with a body whose centre of mass is over the feet that stay."""
    staying = np.delete(step.feet_w, step.leg, axis=0)[:, :2]
    middle = step.feet_w[:, :2].mean(axis=0) + np.array([ahead, 0.0])
    goal = leaned(hull(staying), middle, INSIDE * robot.height)
    place = goal
    for _ in range(2):
        body = regulated(step.feet_w, place, stand, tilts)
        standing = motion(robot, (replace(step, before=body, body=body),), 1.0, np.array([SHIFT]))
        centre = to_world(standing, links(robot, standing.q).centre[:, None])[0, 0]
        place = place + goal - centre[:2]
    return replace(step, body=regulated(step.feet_w, place, stand, tilts))


def ease_of(robot: Robot, scene: Scene, step: ClimbStep) -> float:
    """How much room a step leaves, 1 where it is as much as `COMFORT` asks; below 0 it does not fit."""
    made = motion(robot, (step,), 1.0, np.array([0.5 * SHIFT, SHIFT, 0.5 + 0.5 * SHIFT, 1.0]))
    of, height = links(robot, made.q), robot.height
    joint = float(joint_room(robot, made.q).min())
    if (made.codes != REACHED).any():
        return joint - 1e3
    if joint < 0.0:
        return joint - 1e2
    return float(
        min(
            joint / COMFORT.joint,
            leg_room(scene, made, of).min() / (COMFORT.leg * height),
            trunk_room(robot, scene, made).min() / (COMFORT.trunk * height),
            balance_room(made, of).min() / (COMFORT.balance * height),
        )
    )
