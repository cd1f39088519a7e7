"""Whether a motion fits robot and ground: joints, reach, ground, balance; what does not gets a sentence."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.gait.climb.motion import Motion
from gaitwright.ground.scene import Scene
from gaitwright.model.centre_of_mass import centres_of_mass, on_link
from gaitwright.model.kinematics import HINGES, REACHED
from gaitwright.model.reach import reach
from gaitwright.model.robot import Robot
from gaitwright.numerics.polygon import hull, margins

ROUNDING = 1e-6
"""A margin this little below nothing, per height of the robot or radian, is none."""
ALONG_LEG = np.array([0.0, 0.25, 0.5, 0.75, 0.95])
"""Places along thigh and shank, each a line, that must be over the ground."""
UNDER_TRUNK = (31, 3)
"""Places along and across the trunk's box, on its underside, that must be over the ground."""
RING = np.arange(8) * np.pi / 4
"""Directions in which the side of a foot must be beside the ground."""


class Links(NamedTuple):
    """Points of the legs at some moments, base frame `(n, legs, 3)` [m]."""

    hip: np.ndarray
    """Hinge 2."""
    knee: np.ndarray
    foot: np.ndarray
    centre: np.ndarray
    """`(n, 3)` centre of mass of the whole robot."""


class Margins(NamedTuple):
    """What is left at the worst moment of a motion; negative where it does not fit."""

    joint: float
    """From the nearest joint limit [rad]."""
    foot: float
    """Of a foot's sphere from the ground [m]; 0 where it stands."""
    leg: float
    """Of thighs and shanks from the ground below them [m]."""
    trunk: float
    """Of the underside of the trunk from the ground below it [m]."""
    balance: float
    """Of the centre of mass, seen from above, from the edge of the support polygon [m]."""


def links(robot: Robot, q: Float[np.ndarray, "n legs 3"]) -> Links:
    """Hinges, feet and the centre of mass for joint angles [rad]."""
    hip, knee, foot = (on_link(robot, q, robot.offset[:, link], link) for link in range(3))
    return Links(hip, knee, foot, centres_of_mass(robot, q))


def to_world(made: Motion, points_b: np.ndarray) -> np.ndarray:
    """Points `(n, …, 3)` of the base frame in the world."""
    flat = points_b.reshape(len(points_b), -1, 3)
    return (made.position_w[:, None] + flat @ made.rotation_wb.transpose(0, 2, 1)).reshape(points_b.shape)


def over_ground(scene: Scene, points: np.ndarray) -> np.ndarray:
    """How far points `(…, 3)` are over the ground straight below or above them [m]."""
    return points[..., 2] - np.asarray(scene.height(points[..., 0], points[..., 1]))


def joint_room(robot: Robot, q: np.ndarray) -> np.ndarray:
    """Distance of joint angles `(…, legs, 3)` from their nearest limit [rad]."""
    return np.minimum(q - robot.q_min, robot.q_max - q)


def foot_room(robot: Robot, scene: Scene, made: Motion) -> np.ndarray:
    """Of the lowest point and the sides of every foot from the ground `(n, legs)` [m]."""
    radius = robot.foot_radius[:, None]
    side = made.feet_w[:, :, None] + radius[..., None] * np.stack(
        [np.cos(RING), np.sin(RING), np.zeros_like(RING)], axis=1
    )
    below = over_ground(scene, made.feet_w) - robot.foot_radius
    return np.minimum(below, over_ground(scene, side).min(axis=2))


def leg_room(scene: Scene, made: Motion, of: Links) -> np.ndarray:
    """Of thigh and shank from the ground `(n, legs)` [m]."""
    share = ALONG_LEG[:, None]
    points = [
        start[:, :, None] + share * (end - start)[:, :, None]
        for start, end in ((of.hip, of.knee), (of.knee, of.foot))
    ]
    return over_ground(scene, to_world(made, np.concatenate(points, axis=2))).min(axis=2)


def trunk_room(robot: Robot, scene: Scene, made: Motion) -> np.ndarray:
    """Of the underside of the trunk from the ground `(n,)` [m]."""
    centre, half = robot.trunk
    x, y = (np.linspace(-1.0, 1.0, count) for count in UNDER_TRUNK)
    unit = np.stack(np.meshgrid(x, y, [-1.0], indexing="ij"), axis=-1).reshape(-1, 3)
    points = np.broadcast_to(centre + half * unit, (len(made.time), len(unit), 3))
    return over_ground(scene, to_world(made, points)).min(axis=1)


def balance_room(made: Motion, of: Links) -> np.ndarray:
    """Of the centre of mass, seen from above, from the edge of the support polygon `(n,)` [m]."""
    centre = to_world(made, of.centre[:, None])[:, 0, :2]
    out = np.empty(len(centre))
    # Standing feet do not move: the polygon is the same as long as the same feet stand in the same places.
    still = np.where(made.stance[..., None], made.feet_w, np.nan).reshape(len(centre), -1)
    changed = ~np.isclose(still[1:], still[:-1], rtol=0.0, atol=1e-12, equal_nan=True).all(axis=1)
    edges = [0, *(np.flatnonzero(changed) + 1).tolist(), len(centre)]
    for i in range(len(edges) - 1):
        rows = slice(edges[i], edges[i + 1])
        feet = made.feet_w[edges[i]][made.stance[edges[i]]]
        out[rows] = margins(hull(feet[:, :2]), centre[rows])
    return out


def checked(robot: Robot, scene: Scene, made: Motion) -> tuple[Margins, tuple[str, ...]]:
    """The margins of a motion, and a sentence on the worst moment of each kind that does not fit."""
    of = links(robot, made.q)
    joints, feet, legs = joint_room(robot, made.q), foot_room(robot, scene, made), leg_room(scene, made, of)
    trunk, balance = trunk_room(robot, scene, made), balance_room(made, of)
    faults = [*out_of_reach(robot, made), *beyond_limits(robot, made, joints)]
    least = -ROUNDING * robot.height
    for what, room in (("foot", feet), ("thigh or shank", legs)):
        i, leg = np.unravel_index(int(np.argmin(room)), room.shape)
        if room[i, leg] < least:
            faults.append(
                f"leg {robot.legs[leg]}: its {what} is {-room[i, leg]:.3g} m inside the ground at "
                f"{made.time[i]:.2f} s"
            )
    i = int(np.argmin(trunk))
    if trunk[i] < least:
        faults.append(f"the trunk is {-trunk[i]:.3g} m inside the ground at {made.time[i]:.2f} s")
    i = int(np.argmin(balance))
    if balance[i] < least:
        down = ", ".join(leg for leg, stands in zip(robot.legs, made.stance[i], strict=True) if stands)
        faults.append(
            f"the centre of mass is {-balance[i]:.3g} m outside the support of {down} at {made.time[i]:.2f} s"
        )
    return Margins(*(float(room.min()) for room in (joints, feet, legs, trunk, balance))), tuple(faults)


def out_of_reach(robot: Robot, made: Motion) -> list[str]:
    """The first moment at which a leg does not reach its foothold."""
    missed = np.argwhere(made.codes != REACHED)
    if not len(missed):
        return []
    i, leg = missed[0]
    told = reach(robot, (made.feet_w[i] - made.position_w[i]) @ made.rotation_wb[i])[leg]
    return [f"{told.sentence}, at {made.time[i]:.2f} s"]


def beyond_limits(robot: Robot, made: Motion, room: np.ndarray) -> list[str]:
    """The moment at which a joint is farthest beyond its limit."""
    i, leg, joint = np.unravel_index(int(np.argmin(room)), room.shape)
    if room[i, leg, joint] >= -ROUNDING:
        return []
    angle, low, high = made.q[i, leg, joint], robot.q_min[leg, joint], robot.q_max[leg, joint]
    return [
        f"leg {robot.legs[leg]}: {HINGES[joint]} would stand at {angle:.3g} rad at {made.time[i]:.2f} s, "
        f"beyond its limit of {low if angle < low else high:.3g} rad"
    ]
