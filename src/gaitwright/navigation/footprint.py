"""The body from above, a rectangle: what comes near to it where it stands, turns, or goes as it stands.

A disc of half the width is enough for a robot that goes forward along its path; one that is longer than wide
sweeps more where it turns in place.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.kinematics import angles, knees
from gaitwright.model.robot import Robot
from gaitwright.navigation.piece_grid import point_apart2
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import wrap

SWAY = 0.05
"""A body that walks comes this much nearer to things than one that stands, in body lengths."""
TURNED, GONE = math.radians(3.0), 0.02
"""Poses so far from each other are looked at [rad, m]."""
BENDS = math.radians(360.0)
"""A robot that goes along a path turns by no more than this [rad/m]."""
ALIGNED = math.radians(15.0)
"""It looks along its path when it is no more than this off [rad]."""
HAIR, SHRINKS = 1e-3, 30
"""A pose may have this much less room than the first one [m]; by as much, and so many times, a body that
touches things is taken for smaller."""

Pose = tuple[float, float, float]
"""World x, y [m] and yaw [rad]."""
Pieces = Float[np.ndarray, "_ 4"]


class Footprint(NamedTuple):
    """Trunk, knees and feet in the nominal stance."""

    front: float
    back: float
    side: float
    """How far they reach from the origin of the base [m]."""
    sway: float
    """Room that walking takes around it [m]."""

    @property
    def radius(self) -> float:
        """Of the disc in which the robot turns in place [m]."""
        return math.hypot(max(self.front, self.back) + self.sway, self.side + self.sway)


def footprint_of(robot: Robot) -> Footprint:
    """The footprint of a robot."""
    centre, half = robot.trunk
    bent, _ = angles(robot, robot.nominal_feet)
    limbs = np.vstack([robot.nominal_feet, knees(robot, bent), robot.hip])[:, :2]
    thick = float(robot.foot_radius.max())
    low = np.minimum(limbs.min(axis=0) - thick, (centre - half)[:2])
    high = np.maximum(limbs.max(axis=0) + thick, (centre + half)[:2])
    sway = SWAY * robot.body_length
    return Footprint(float(high[0]), float(-low[0]), float(max(high[1], -low[1])), sway)


def near(pieces: Pieces, place: tuple[float, float], far: float) -> Pieces:
    """The pieces that may be within some distance of a place [m]: their boxes are."""
    x, y = place
    low_x, high_x = np.minimum(pieces[:, 0], pieces[:, 2]), np.maximum(pieces[:, 0], pieces[:, 2])
    low_y, high_y = np.minimum(pieces[:, 1], pieces[:, 3]), np.maximum(pieces[:, 1], pieces[:, 3])
    is_near = (low_x < x + far) & (high_x > x - far) & (low_y < y + far) & (high_y > y - far)
    return np.ascontiguousarray(pieces[is_near])


def fitted(pieces: Pieces, pose: Pose, body: Footprint) -> Footprint:
    """The footprint with as much sway as there is room for where it stands; smaller, where it touches things
    already: then they come no nearer."""
    room = float(room_around(pieces, *pose, body, body.sway))
    fit = body
    for _ in range(SHRINKS):
        if room > HAIR:
            break
        fit = fit._replace(front=fit.front - HAIR, back=fit.back - HAIR, side=fit.side - HAIR)
        room = float(room_around(pieces, *pose, fit, body.sway))
    return fit._replace(sway=max(min(body.sway, room - HAIR), 0.0))


def turns(pieces: Pieces, pose: Pose, by: float, body: Footprint) -> float:
    """How far a body can turn in place, of an angle [rad]."""
    return float(turned(pieces, *pose, by, fitted(pieces, pose, body)))


def goes(pieces: Pieces, pose: Pose, towards: float, far: float, body: Footprint) -> float:
    """How far a body can go as it stands in a world direction [rad], of a distance [m]."""
    return float(gone(pieces, *pose, towards, far, fitted(pieces, pose, body)))


def follows(
    pieces: Pieces, pose: Pose, path: Sequence[tuple[float, float]], most: float, body: Footprint
) -> bool:
    """Whether a body that goes along a path, and turns as far as there is room, looks along it in the end."""
    way = np.array(path).reshape(-1, 2)
    return bool(followed(pieces, way, pose, fitted(pieces, pose, body), most, False, 0.0) >= 0.0)


def backs(
    pieces: Pieces, pose: Pose, path: Sequence[tuple[float, float]], wanted: float, body: Footprint
) -> float:
    """How far a body goes backwards along a path, until it has `wanted` [m] all round; -1: it cannot."""
    way = np.array(path).reshape(-1, 2)
    return float(followed(pieces, way, pose, fitted(pieces, pose, body), math.inf, True, wanted))


def drives(
    pieces: Pieces, pose: Pose, velocity: tuple[float, float, float], seconds: float, body: Footprint
) -> float:
    """How long a body can hold a velocity, forward, left [m/s] and yaw rate [rad/s], of a time [s]."""
    return float(driven(pieces, *pose, velocity, seconds, fitted(pieces, pose, body)))


# --- kernels ---------------------------------------------------------------------------------------
@kernel
def room_around(pieces, x, y, yaw, body, most):
    """Distance of the nearest piece from a footprint, at most `most` [m]; 0: it is within."""
    c, s = math.cos(yaw), math.sin(yaw)
    half_x, half_y = (body.front + body.back) / 2.0, body.side
    ahead = (body.front - body.back) / 2.0
    least = most
    for k in range(len(pieces)):
        ax, ay, bx, by = pieces[k, 0] - x, pieces[k, 1] - y, pieces[k, 2] - x, pieces[k, 3] - y
        line = (c * ax + s * ay - ahead, c * ay - s * ax, c * bx + s * by - ahead, c * by - s * bx)
        least = min(least, box_apart(line, half_x, half_y))
    return least


@kernel
def box_apart(line, half_x, half_y):
    """Distance of a segment from a box about the origin; 0: it enters it."""
    x0, y0, x1, y1 = line
    t0, t1 = 0.0, 1.0
    for at, way, half in ((x0, x1 - x0, half_x), (y0, y1 - y0, half_y)):
        if abs(way) < 1e-12:
            if abs(at) > half:
                t0 = 2.0
        else:
            ta, tb = (-half - at) / way, (half - at) / way
            t0, t1 = max(t0, min(ta, tb)), min(t1, max(ta, tb))
    if t0 <= t1:
        return 0.0
    least = min(
        math.hypot(max(abs(x0) - half_x, 0.0), max(abs(y0) - half_y, 0.0)),
        math.hypot(max(abs(x1) - half_x, 0.0), max(abs(y1) - half_y, 0.0)),
    )
    for sx in (-1.0, 1.0):
        for sy in (-1.0, 1.0):
            least = min(least, math.sqrt(point_apart2(sx * half_x, sy * half_y, line)))
    return least


@kernel
def turned(pieces, x, y, yaw, by, body):
    """How far of an angle `by` a footprint turns while the pieces keep its sway from it."""
    steps = max(math.ceil(abs(by) / TURNED), 1)
    for k in range(1, steps + 1):
        if room_around(pieces, x, y, yaw + by * k / steps, body, body.sway) < body.sway:
            return by * (k - 1) / steps
    return by


@kernel
def gone(pieces, x, y, yaw, towards, far, body):
    """How far of `far` a footprint goes in a direction while the pieces keep its sway from it."""
    c, s = math.cos(towards), math.sin(towards)
    steps = max(math.ceil(far / GONE), 1)
    for k in range(1, steps + 1):
        d = far * k / steps
        if room_around(pieces, x + d * c, y + d * s, yaw, body, body.sway) < body.sway:
            return far * (k - 1) / steps
    return far


@kernel
def followed(pieces, path, pose, body, most, tail, wanted):
    """How far a footprint goes along a path, as it stands and turning as far as there is room, until it looks
    along it [m]; -1: it cannot, or not within `most`.

    With `tail` it looks back along it, and goes on until a place has `wanted` [m] all round.
    """
    x, y, yaw = pose
    distance, leg = 0.0, 0
    while distance < most and leg < len(path):
        dx, dy = path[leg, 0] - x, path[leg, 1] - y
        left = math.hypot(dx, dy)
        if left < 1e-6:
            leg += 1
            continue
        step = min(GONE, left)
        x, y, distance = x + step * dx / left, y + step * dy / left, distance + step
        aim = math.atan2(dy, dx) + (math.pi if tail else 0.0)
        off = wrap(aim - yaw)
        by = math.copysign(min(abs(off), BENDS * step), off)
        if room_around(pieces, x, y, yaw + by, body, body.sway) >= body.sway:
            yaw += by
        elif room_around(pieces, x, y, yaw, body, body.sway) < body.sway:
            return -1.0
        if not tail and abs(wrap(aim - yaw)) < ALIGNED:
            return distance
        if tail and place_apart(pieces, x, y, wanted) >= wanted:
            return distance
    return distance if tail and leg == len(path) else -1.0


@kernel
def place_apart(pieces, x, y, most):
    """Distance of the nearest piece from a place, at most `most` [m]."""
    least = most * most
    for k in range(len(pieces)):
        least = min(least, point_apart2(x, y, pieces[k]))
    return math.sqrt(least)


@kernel
def driven(pieces, x, y, yaw, velocity, seconds, body):
    """How long of `seconds` a footprint holds a velocity while the pieces keep its sway from it."""
    forward, left, turn = velocity
    steps = max(math.ceil(seconds * max(math.hypot(forward, left) / GONE, abs(turn) / TURNED)), 1)
    dt = seconds / steps
    for k in range(steps):
        middle = yaw + turn * dt / 2.0
        c, s = math.cos(middle), math.sin(middle)
        x, y, yaw = x + dt * (c * forward - s * left), y + dt * (s * forward + c * left), yaw + turn * dt
        if room_around(pieces, x, y, yaw, body, body.sway) < body.sway:
            return k * dt
    return seconds
