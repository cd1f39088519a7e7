"""A compiled MuJoCo model → `Robot`: every number read or derived, none set by hand (rows R1, R2)."""

import math
from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.description.feet import Foot, find_foot, lowest, required, solid
from gaitwright.description.legs import BASE, Legs, find_legs, home_pose, to_body
from gaitwright.description.validate import check, check_finite
from gaitwright.errors import BadFile
from gaitwright.model import nominal_pose as stance
from gaitwright.model.kinematics import HINGES, angles
from gaitwright.model.nominal_pose import LegShape
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY

AXES_TOLERANCE = 1e-3
"""Largest deviation [rad] of the hinges from: second square to the first, third parallel to the second."""
BELLY = 0.2
"""The trunk's box reaches at most this far below the lowest hip, per length of the stretched leg."""
SHORTEST_LINK = 1e-6
"""A thigh or shank must be longer than this [m]."""


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


def derive(m: mujoco.MjModel, name: str) -> tuple[Robot, tuple[str, ...]]:
    """The robot in `m`, and sentences about what the model did not say and was derived.

    Raises `BadFile` with what is wrong, without the file's name.
    """
    legs = find_legs(m)
    parts = [derive_leg(m, legs, i) for i in range(len(legs.names))]
    shapes = [shape for shape, _ in parts]
    numbers = stacked(shapes) | stacked([leg for _, leg in parts])
    mass, com, inertia = merged(m, legs.data, legs.owner == BASE, axes_of(legs), origin_of(legs))
    total = mass + numbers["mass"].sum()
    numbers["tau_max"], of_torques = with_torque_limits(legs.names, shapes, numbers["tau_max"], total)
    robot = Robot(
        name=name,
        legs=legs.names,
        base_mass=mass,
        base_com=com,
        base_inertia=inertia,
        trunk=trunk(m, legs, shapes),
        **numbers,
    )
    check(robot)
    return robot, legs.notes + of_torques + outside_limits(robot, shapes)


def stacked(legs: list) -> dict[str, np.ndarray]:
    """The fields of some legs as arrays, legs first."""
    return {field: np.array([getattr(leg, field) for leg in legs]) for field in legs[0]._fields}


def axes_of(legs: Legs) -> np.ndarray:
    """Rotation that takes base components to world ones, in the zero pose."""
    return legs.data.xmat[legs.base].reshape(3, 3)


def origin_of(legs: Legs) -> np.ndarray:
    """Origin of the base in the world, in the zero pose [m]."""
    return legs.data.xpos[legs.base]


# --- one leg ---------------------------------------------------------------------------------------
def derive_leg(m: mujoco.MjModel, legs: Legs, i: int) -> tuple[LegShape, LegBody]:
    """All numbers of leg `i`."""
    d, joints, name = legs.data, legs.joints[i], legs.names[i]
    frame, sign = leg_frame(d.xaxis[joints], name)
    anchors = d.xanchor[joints]
    for joint, anchor in zip(HINGES, anchors, strict=True):
        check_finite(f"the place of leg {name}, {joint},", anchor)
    foot = required(find_foot(m, d, np.flatnonzero(legs.owner == joints[2]), anchors[2]), name)
    limited = m.jnt_limited[joints].astype(bool)[:, None]
    q_min, q_max = np.where(limited, m.jnt_range[joints], (-math.pi, math.pi)).T
    bare = LegShape(
        hip=to_body(d, legs.base, anchors[0]),
        leg_frame=axes_of(legs).T @ frame,
        offset=offsets(anchors, foot, frame),
        sign=sign,
        q_min=q_min,
        q_max=q_max,
    )
    home = home_pose(m)
    q_home = None if home is None else home[m.jnt_qposadr[joints]]
    place, branch = posture(bare, q_home, name)
    if len(foot.points):
        down = frame @ stance.down_in_shank(bare, stance.branch_angles(bare, place)[branch])
        foot = lowest(foot, down, frame[:, 1], float(np.linalg.norm(bare.offset[2])))
    shape = bare._replace(offset=offsets(anchors, foot, frame))
    place, branch = posture(shape, q_home, name)
    links = [merged(m, d, legs.owner == j, frame, anchor) for j, anchor in zip(joints, anchors, strict=True)]
    dofs = m.jnt_dofadr[joints]
    return shape, LegBody(
        mass=np.array([link[0] for link in links]),
        com=np.array([link[1] for link in links]),
        inertia=np.array([link[2] for link in links]),
        armature=m.dof_armature[dofs],
        damping=m.dof_damping[dofs],
        friction=m.dof_frictionloss[dofs],
        tau_max=np.array([torque_limit(m, int(j)) for j in joints]),
        foot_radius=foot.radius,
        branch=branch,
        nominal_feet=place,
    )


def offsets(anchors: np.ndarray, foot: Foot, frame: np.ndarray) -> np.ndarray:
    """Rows hinge 1 → hinge 2 → hinge 3 → foot in the leg frame [m], from world points."""
    return np.diff(np.vstack([anchors, foot.centre]), axis=0) @ frame


def posture(leg: LegShape, q_home: np.ndarray | None, name: str) -> tuple[np.ndarray, tuple[int, int]]:
    """Nominal foothold and branch of a leg. Raises `BadFile` where its lengths do not let it stand."""
    for row, link, ends in ((1, "thigh", "hip 2 and knee"), (2, "shank", "knee and foot")):
        length = float(np.hypot(leg.offset[row, 0], leg.offset[row, 2]))
        if not length > SHORTEST_LINK:
            raise BadFile(
                f"leg {name}: its {link} has no length: {ends} are {length:.3g} m apart, seen along the axis "
                f"of the knee; expected more than {SHORTEST_LINK:g} m"
            )
    place = stance.nominal_foot(leg)
    branch = stance.nominal_branch(leg, place, q_home)
    if branch is None:
        raise BadFile(f"leg {name} cannot stand: no posture brings its foot to {place.round(3).tolist()} m")
    return place, branch


def leg_frame(axes: np.ndarray, name: str) -> tuple[np.ndarray, float]:
    """Orthonormal frame on the first two axes of a leg (rows of `axes`, world), and the sign of the third."""
    first, second, third = axes
    off_square = math.asin(min(1.0, abs(float(first @ second))))
    off_parallel = math.asin(min(1.0, float(np.linalg.norm(np.cross(second, third)))))
    if off_square > AXES_TOLERANCE:
        raise BadFile(
            f"leg {name}: its second hinge is {math.degrees(off_square):.2f}° from square to the first"
        )
    if off_parallel > AXES_TOLERANCE:
        raise BadFile(
            f"leg {name}: its third hinge is {math.degrees(off_parallel):.2f}° from parallel to the second"
        )
    y = second - (second @ first) * first
    y /= np.linalg.norm(y)
    return np.column_stack([first, y, np.cross(first, y)]), math.copysign(1.0, float(second @ third))


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


# --- torque limits ---------------------------------------------------------------------------------
def torque_limit(m: mujoco.MjModel, joint: int) -> float:
    """Torque limit of one joint [N·m], by its actuators and by itself; NaN where neither says."""
    bounds = [
        joint_bound(m, joint),
        max(filter(None, (actuator_bound(m, a) for a in drives(m, joint))), default=0.0),
    ]
    given = [bound for bound in bounds if bound > 0.0]
    return min(given, default=math.nan)


def drives(m: mujoco.MjModel, joint: int) -> list[int]:
    """Actuators that pull at the joint."""
    on_joint = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    return [a for a in range(m.nu) if m.actuator_trntype[a] in on_joint and m.actuator_trnid[a, 0] == joint]


def joint_bound(m: mujoco.MjModel, joint: int) -> float:
    """The joint's own limit of actuator torque [N·m], as URDF's `effort`; 0 where there is none."""
    return both_ways(m.jnt_actfrcrange[joint]) if m.jnt_actfrclimited[joint] else 0.0


def actuator_bound(m: mujoco.MjModel, a: int) -> float:
    """What one actuator can do at its joint [N·m], by its force range and, if a motor, its control range."""
    gear = abs(float(m.actuator_gear[a, 0]))
    bounds = []
    if m.actuator_forcelimited[a]:
        bounds.append(gear * both_ways(m.actuator_forcerange[a]))
    is_motor = m.actuator_gaintype[a] == mujoco.mjtGain.mjGAIN_FIXED and not m.actuator_biastype[a]
    if m.actuator_ctrllimited[a] and is_motor:
        bounds.append(gear * abs(float(m.actuator_gainprm[a, 0])) * both_ways(m.actuator_ctrlrange[a]))
    return min((bound for bound in bounds if bound > 0.0), default=0.0)


def both_ways(limits: np.ndarray) -> float:
    """What a range allows in both directions."""
    return max(0.0, min(-float(limits[0]), float(limits[1])))


def with_torque_limits(names: tuple[str, ...], shapes: list[LegShape], tau_max: np.ndarray, total: float):
    """Torque limits without gaps, and a sentence where there were some; `total` is the robot's mass [kg].

    A joint without a limit gets the torque that carries the whole weight on two legs, with a lever of
    half a leg.
    """
    levers = [0.5 * shape.stretched for shape in shapes]
    derived = np.tile(0.5 * total * GRAVITY * np.array(levers)[:, None], 3)
    missing = np.isnan(tau_max)
    if not missing.any():
        return tau_max, ()
    where = ", ".join(name for name, gaps in zip(names, missing, strict=True) if gaps.any())
    note = (
        f"no torque limit is given for {missing.sum()} joints (legs {where}): taken as "
        f"{derived[missing].max():.1f} N·m, which carries the weight on two legs with a lever of half a leg"
    )
    return np.where(missing, derived, tau_max), (note,)


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
    return to_body(d, legs.base, d.geom_xpos[geom] + corners @ d.geom_xmat[geom].reshape(3, 3).T)


def outside_limits(robot: Robot, shapes: list[LegShape]) -> tuple[str, ...]:
    """A sentence where the joint limits forbid the nominal stance."""
    q, _ = angles(robot, robot.nominal_feet)
    slack = [shape.margin(q_leg) for shape, q_leg in zip(shapes, q, strict=True)]
    tight = [f"{name} by {-s:.2f} rad" for name, s in zip(robot.legs, slack, strict=True) if s < 0.0]
    return (f"the nominal stance is outside the joint limits of {', '.join(tight)}",) if tight else ()
