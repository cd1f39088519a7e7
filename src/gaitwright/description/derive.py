"""A compiled MuJoCo model → `Robot`: every number read or derived, none set by hand (rows R1, R2)."""

from collections.abc import Mapping
from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.description.doubts import left_out, possible, unbalanced
from gaitwright.description.feet import Foot, find_foot, lowest, required, solid
from gaitwright.description.leg_shape import leg_frame, shape_of
from gaitwright.description.legs import BASE, Legs, find_legs, home_pose
from gaitwright.description.limits import rate_limits, resisted, torque_limit, with_torque_limits
from gaitwright.description.validate import check, check_finite
from gaitwright.errors import BadFile
from gaitwright.model import nominal_pose as stance
from gaitwright.model.kinematics import HINGES, angles
from gaitwright.model.nominal_pose import LegShape
from gaitwright.model.robot import Robot

BELLY = 0.2
"""The trunk's box reaches at most this far below the lowest hip, per length of the stretched leg."""
SHORTEST_LINK = 1e-6
"""A thigh or shank must be longer than this [m]."""


class Posture(NamedTuple):
    """How a leg stands: where its foot is, base frame [m], and its branch."""

    place: np.ndarray
    branch: tuple[int, int]


class LegBody(NamedTuple):
    """One leg as numbers; the fields are those of `Robot` for one leg, less those of its shape."""

    mass: np.ndarray
    com: np.ndarray
    inertia: np.ndarray
    armature: np.ndarray
    damping: np.ndarray
    friction: np.ndarray
    tau_max: np.ndarray
    foot_radius: float
    branch: tuple[int, int]
    nominal_feet: np.ndarray


def derive(
    m: mujoco.MjModel, name: str, rates: Mapping[str, float] | None = None
) -> tuple[Robot, tuple[str, ...]]:
    """The robot in `m`, and sentences about what the model did not say and was derived.

    `rates`: velocity limits by the names of joints [rad/s], which a model does not hold. Raises `BadFile`
    with what is wrong, without the file's name.
    """
    legs = find_legs(m)
    feet, shapes, postures = stood(m, legs)
    m, of_inertias = possible(m, legs, shapes)
    parts = [leg_body(m, legs, i, feet[i], postures[i]) for i in range(len(legs.names))]
    numbers = stacked(shapes) | stacked(parts)
    mass, com, inertia = merged(m, legs.data, legs.owner == BASE, *legs.frame)
    total = mass + numbers["mass"].sum()
    resisting = resisted(shapes, numbers["damping"], numbers["friction"])
    numbers["tau_max"], of_torques = with_torque_limits(
        legs.names, shapes, numbers["tau_max"], total, resisting
    )
    rate_max, of_rates = rate_limits(m, legs.joints, shapes, rates or {})
    robot = Robot(
        name=name,
        legs=legs.names,
        base_mass=mass,
        base_com=com,
        base_inertia=inertia,
        trunk=trunk(m, legs, shapes),
        rate_max=rate_max,
        **numbers,
    )
    check(robot)
    notes = legs.notes + left_out(m, legs) + of_torques + of_rates + of_inertias
    return robot, notes + outside_limits(robot, shapes) + unbalanced(m, legs, robot)


def stacked(legs: list) -> dict[str, np.ndarray]:
    """The fields of some legs as arrays, legs first."""
    return {field: np.array([getattr(leg, field) for leg in legs]) for field in legs[0]._fields}


# --- the legs --------------------------------------------------------------------------------------
def stood(m: mujoco.MjModel, legs: Legs) -> tuple[list[Foot], list[LegShape], list[Posture]]:
    """Foot, shape and nominal posture of each leg."""
    feet = [foot_of(m, legs, i) for i in range(len(legs.names))]
    bare = shapes_of(m, legs, feet)
    postures = nominal_postures(m, legs, bare)
    feet = [
        foot if not len(foot.points) else lowered(foot, shape, posture, legs)
        for foot, shape, posture in zip(feet, bare, postures, strict=True)
    ]
    shapes = shapes_of(m, legs, feet)
    return feet, shapes, nominal_postures(m, legs, shapes)


def foot_of(m: mujoco.MjModel, legs: Legs, i: int) -> Foot:
    """The foot of leg `i`. Raises `BadFile` where there is none or a hinge lies nowhere."""
    joints, name = legs.joints[i], legs.names[i]
    anchors = legs.data.xanchor[joints]
    for joint, anchor in zip(HINGES, anchors, strict=True):
        check_finite(f"the place of leg {name}, {joint},", anchor)
    last = np.flatnonzero(legs.owner == joints[2])
    return required(
        find_foot(m, legs.data, last, anchors[2]), name, [m.body(int(body)).name for body in last]
    )


def shapes_of(m: mujoco.MjModel, legs: Legs, feet: list[Foot]) -> list[LegShape]:
    """Legs that end in these feet."""
    names = [
        f"{name} (from joint {m.joint(int(row[0])).name!r})"
        for name, row in zip(legs.names, legs.joints, strict=True)
    ]
    named = zip(legs.joints, feet, names, strict=True)
    return [shape_of(m, legs.data, joints, foot, legs.frame, name) for joints, foot, name in named]


def lowered(foot: Foot, leg: LegShape, posture: Posture, legs: Legs) -> Foot:
    """A foot guessed from a surface, now that it is known which side of it is down."""
    frame = legs.frame.axes @ leg.leg_frame
    down = frame @ stance.down_in_shank(leg, stance.branch_angles(leg, posture.place)[posture.branch])
    return lowest(foot, down, frame[:, 1], float(np.linalg.norm(leg.offset[2])))


def nominal_postures(m: mujoco.MjModel, legs: Legs, shapes: list[LegShape]) -> list[Posture]:
    """Where the feet stand, and how the legs bend. Raises `BadFile` where a leg's lengths do not let it."""
    for leg, name in zip(shapes, legs.names, strict=True):
        check_links(leg, name)
    places = [stance.nominal_foot(leg) for leg in shapes]
    home = home_pose(m)
    homes = [None if home is None else home[m.jnt_qposadr[joints]] for joints in legs.joints]
    postures = []
    for name, place, branch in zip(
        legs.names, places, stance.nominal_branches(shapes, places, homes), strict=True
    ):
        if branch is None:
            raise BadFile(
                f"leg {name} cannot stand: no posture brings its foot to {place.round(3).tolist()} m"
            )
        postures.append(Posture(place, branch))
    return postures


def leg_body(m: mujoco.MjModel, legs: Legs, i: int, foot: Foot, posture: Posture) -> LegBody:
    """The other numbers of leg `i`."""
    d, joints = legs.data, legs.joints[i]
    frame, _ = leg_frame(d.xaxis[joints], legs.frame, legs.names[i])
    anchors = d.xanchor[joints]
    links = [merged(m, d, legs.owner == j, frame, anchor) for j, anchor in zip(joints, anchors, strict=True)]
    dofs = m.jnt_dofadr[joints]
    return LegBody(
        mass=np.array([link[0] for link in links]),
        com=np.array([link[1] for link in links]),
        inertia=np.array([link[2] for link in links]),
        armature=m.dof_armature[dofs],
        damping=m.dof_damping[dofs],
        friction=m.dof_frictionloss[dofs],
        tau_max=np.array([torque_limit(m, int(j)) for j in joints]),
        foot_radius=foot.radius,
        branch=posture.branch,
        nominal_feet=posture.place,
    )


def check_links(leg: LegShape, name: str) -> None:
    """Raises `BadFile` where a thigh or shank has no length."""
    for row, link, ends in ((1, "thigh", "hip 2 and knee"), (2, "shank", "knee and foot")):
        length = float(np.hypot(leg.offset[row, 0], leg.offset[row, 2]))
        if not length > SHORTEST_LINK:
            raise BadFile(
                f"leg {name}: its {link} has no length: {ends} are {length:.3g} m apart, seen along the axis "
                f"of the knee; expected more than {SHORTEST_LINK:g} m"
            )


def merged(m, d, bodies: np.ndarray, axes: np.ndarray, origin: np.ndarray):
    """Mass [kg], centre of mass [m] and inertia about it [kg·m²] of some bodies (a mask), as one.

    `axes` (rotation to the world) and `origin` (world) are the frame in which the answer is given.
    """
    chosen = np.flatnonzero(bodies)
    masses = m.body_mass[chosen]
    mass = float(masses.sum())
    if mass <= 0.0:
        return 0.0, np.zeros(3), np.zeros((3, 3))
    centres = (d.xipos[chosen] - origin) @ axes
    com = masses @ centres / mass
    inertia = np.zeros((3, 3))
    for body, weight, away in zip(chosen, masses, centres - com, strict=True):
        turn = axes.T @ d.ximat[body].reshape(3, 3)
        inertia += turn @ np.diag(m.body_inertia[body]) @ turn.T
        inertia += weight * (away @ away * np.eye(3) - np.outer(away, away))
    return mass, com, inertia


# --- the whole robot -------------------------------------------------------------------------------
def trunk(m: mujoco.MjModel, legs: Legs, shapes: list[LegShape]) -> np.ndarray:
    """Box around the floating body's shapes, else around its hips: centre and half sizes, base frame [m]."""
    length = float(np.mean([shape.stretched for shape in shapes]))
    hips = np.array([shape.hip for shape in shapes])
    fixed = np.flatnonzero(m.body_weldid == legs.base)
    corners = [box_corners(m, legs, g) for g in solid(m, fixed)]
    points = np.concatenate(corners) if corners else np.vstack([hips - 0.1 * length, hips + 0.1 * length])
    low, high = points.min(axis=0), points.max(axis=0)
    low[2] = max(low[2], hips[:, 2].min() - BELLY * length)
    high[2] = max(high[2], low[2] + 0.02 * length)
    return np.array([0.5 * (low + high), 0.5 * (high - low)])


def box_corners(m: mujoco.MjModel, legs: Legs, geom: int) -> np.ndarray:
    """Corners `(8, 3)` of the box around one shape, base frame [m]."""
    d = legs.data
    centre, half = m.geom_aabb[geom].reshape(2, 3)
    corners = centre + half * np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, 8).T
    return legs.frame.points(d.geom_xpos[geom] + corners @ d.geom_xmat[geom].reshape(3, 3).T)


def outside_limits(robot: Robot, shapes: list[LegShape]) -> tuple[str, ...]:
    """A sentence where the joint limits forbid the nominal stance."""
    q, _ = angles(robot, robot.nominal_feet)
    slack = [shape.margin(q_leg) for shape, q_leg in zip(shapes, q, strict=True)]
    tight = [f"{name} by {-s:.2f} rad" for name, s in zip(robot.legs, slack, strict=True) if s < 0.0]
    return (f"the nominal stance is outside the joint limits of {', '.join(tight)}",) if tight else ()
