"""A compiled MuJoCo model → its legs: which hinges and bodies belong to which leg (row R2)."""

import math
from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.description.arms import sorted_out
from gaitwright.description.aside import listed
from gaitwright.description.feet import find_foot
from gaitwright.description.heading import LEG_NAMES, Heading, Limb
from gaitwright.description.joint_tree import BASE, joints_after
from gaitwright.description.leg_shape import Frame, shape_of
from gaitwright.description.upright import Up, upright
from gaitwright.description.validate import ABSURD
from gaitwright.errors import BadFile
from gaitwright.model.nominal_pose import LegShape

FAR_OFF = np.array([0.6, 0.6, 0.06])
"""The base's origin is at most this far from the middle of the hips in x, y and z, per length of the legs.

Heights and speeds count from it: with hips 0.14 of a leg above it a trotting robot rolls
twice as much.
"""


class Chain(NamedTuple):
    """Joints of one limb from the base outwards; `branched` where one joint carries two others."""

    joints: tuple[int, ...]
    branched: bool


class Legs(NamedTuple):
    """The floating body, its legs in order, the pose in which they are at zero angles, and the base frame."""

    base: int
    names: tuple[str, ...]
    joints: np.ndarray
    """`(legs, 3)` joint ids."""
    owner: np.ndarray
    """Per body: the leg joint that moves it, `BASE`, or `ELSEWHERE` for what is not the robot."""
    data: mujoco.MjData
    """Kinematics at zero leg angles, all other joints locked at home."""
    frame: Frame
    """The base frame: the floating body's own, or turned and moved to where its legs are."""
    notes: tuple[str, ...] = ()
    """What was taken for granted in finding them, a sentence each."""


ELSEWHERE = -2


def find_legs(m: mujoco.MjModel) -> Legs:
    """The legs of the robot in `m`. Raises `BadFile` where no floating body has 4, 6 or 8 of them."""
    bases = floating_bodies(m)
    if not bases:
        raise BadFile(f"no floating body{on_the_world(m)}; expected a body with a free joint")
    chains = {base: limbs(m, base) for base in bases}
    base = max(bases, key=lambda b: (len(three_hinges(m, chains[b])), m.body_subtreemass[b]))
    joints = np.array(three_hinges(m, chains[base]), dtype=int).reshape(-1, 3)
    if len(joints) < 4:
        raise BadFile(
            f"{len(joints)} legs of three hinges where 4, 6 or 8 are expected; {told(m, chains[base])}"
        )
    data = pose_at_zero(m, joints)
    up = upright(read_limbs(m, base, joints, file_frame(data, base)), file_frame(data, base))
    found = read_limbs(m, base, joints, up.frame)
    kept, way, notes = sorted_out(found)
    found, joints = [found[kept[i]] for i in way.order], joints[kept][way.order]
    data = pose_at_zero(m, joints)
    frame, moves = framed(found, up, way)
    names, notes = LEG_NAMES[len(joints)], only_one(m, base, bases) + up.notes + notes + moves
    return Legs(base, names, joints, owners(m, base, joints), data, frame, notes)


def read_limbs(m: mujoco.MjModel, base: int, joints: np.ndarray, frame: Frame) -> list[Limb]:
    """Limbs `(limbs, 3)` of joints in a frame of the base, each with its shape if it has one of a leg."""
    data, owner = pose_at_zero(m, joints), owners(m, base, joints)
    hips = frame.points(data.xanchor[joints[:, 0]])
    shapes = [shape_if_any(m, data, owner, row, frame) for row in joints]
    names = [m.joint(int(row[0])).name for row in joints]
    return [Limb(name, hip, shape) for name, hip, shape in zip(names, hips, shapes, strict=True)]


def shape_if_any(m, data, owner: np.ndarray, joints: np.ndarray, frame: Frame) -> LegShape | None:
    """The shape of a limb as far as it can be a leg's; what is wrong with one is told once it is one."""
    if not (np.abs(data.xanchor[joints]) < ABSURD).all():
        return None
    foot = find_foot(m, data, np.flatnonzero(owner == joints[2]), data.xanchor[joints[2]])
    if foot is None:
        return None
    try:
        shape = shape_of(m, data, joints, foot, frame, "")
    except BadFile:
        return None
    return shape if shape.shortest > 0.0 else None


def file_frame(data: mujoco.MjData, base: int) -> Frame:
    """The frame of the floating body as the file has it."""
    return Frame(data.xmat[base].reshape(3, 3), data.xpos[base])


def framed(limbs: list[Limb], up: Up, way: Heading) -> tuple[Frame, tuple[str, ...]]:
    """The base frame turned so that x is forward and moved to the hips where it lies off, and sentences."""
    frame, notes = up.frame, []
    lengths = [limb.shape.stretched for limb in limbs if limb.shape is not None]
    middle = np.mean([limb.hip for limb in limbs], axis=0)
    if lengths and (np.abs(middle) > FAR_OFF * np.median(lengths)).any():
        frame = frame._replace(origin=frame.origin + frame.axes @ middle)
        x, y, z = middle
        notes.append(
            f"the middle of the hips is at ({x:.3g}, {y:.3g}, {z:.3g}) m in the file: the base's origin is "
            "moved there"
        )
    if way.turn:
        c, s = math.cos(way.turn), math.sin(way.turn)
        frame = frame._replace(axes=frame.axes @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))
        notes.append(
            f"forward is {way.words(*up.names)}, {way.why}: the robot is turned so that forward is x"
        )
    return frame, tuple(notes)


def floating_bodies(m: mujoco.MjModel) -> list[int]:
    """Bodies with a free joint."""
    return [int(m.jnt_bodyid[j]) for j in range(m.njnt) if m.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]


def on_the_world(m: mujoco.MjModel) -> str:
    """What to add where it is the world that carries the legs, as if the trunk had been melted into it."""
    legs = [chain for chain in limbs(m, 0) if len(chain.joints) >= 3]
    if len(legs) < 4:
        return ""
    names = listed([repr(m.joint(leg.joints[0]).name) for leg in legs])
    return f", for the limbs from {names} hang on the world itself, without a trunk and its mass"


def only_one(m: mujoco.MjModel, base: int, bases: list[int]) -> tuple[str, ...]:
    """A sentence where other bodies float than the robot's own."""
    others = [repr(m.body(body).name) for body in bases if body != base]
    if not others:
        return ()
    return (f"of the bodies that float {m.body(base).name!r} is taken, without {listed(others)}",)


def limbs(m: mujoco.MjModel, base: int) -> list[Chain]:
    """Limbs of the floating body: maximal trees of joints, each listed from the base outwards."""
    children = joints_after(m, base)
    return [chain_from(joint, children) for joint in children[BASE]]


def chain_from(root: int, children: dict[int, list[int]]) -> Chain:
    """All joints from `root` outwards."""
    joints, branched = [root], False
    for joint in joints:
        joints.extend(children[joint])
        branched |= len(children[joint]) > 1
    return Chain(tuple(joints), branched)


def three_hinges(m: mujoco.MjModel, chains: list[Chain]) -> list[tuple[int, ...]]:
    """The limbs that are legs by their joints: exactly three hinges in a row."""
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    return [
        c.joints
        for c in chains
        if len(c.joints) == 3 and not c.branched and all(m.jnt_type[j] == hinge for j in c.joints)
    ]


def told(m: mujoco.MjModel, chains: list[Chain]) -> str:
    """What limbs there are, for an error."""
    if not chains:
        return "the floating body has no joints"
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    kinds = []
    for joints, branched in chains:
        others = sum(m.jnt_type[j] != hinge for j in joints)
        what = f"{number_of_joints(joints)}{f' ({others} of them no hinge)' if others else ''}"
        kinds.append(f"{what}{' with a fork' if branched else ''} from {m.joint(joints[0]).name!r}")
    return "found limbs of " + ", ".join(kinds[:8])


def number_of_joints(joints: tuple[int, ...]) -> str:
    """So many joints, in words."""
    return f"{len(joints)} joint{'s' if len(joints) > 1 else ''}"


def pose_at_zero(m: mujoco.MjModel, joints: np.ndarray) -> mujoco.MjData:
    """Kinematics with the leg joints at zero and all others as in the `home` keyframe, or as modelled."""
    data = mujoco.MjData(m)
    home = home_pose(m)
    data.qpos[:] = m.qpos0 if home is None else home
    data.qpos[m.jnt_qposadr[joints.ravel()]] = 0.0
    mujoco.mj_kinematics(m, data)
    mujoco.mj_comPos(m, data)
    return data


def home_pose(m: mujoco.MjModel) -> np.ndarray | None:
    """Joint positions of the keyframe called `home`, if there is one."""
    key = mujoco.mj_name2id(m, mujoco.mjtObj.mjOBJ_KEY, "home")
    return m.key_qpos[key].copy() if key >= 0 else None


def owners(m: mujoco.MjModel, base: int, joints: np.ndarray) -> np.ndarray:
    """Per body the leg joint that moves it last: what is fixed to a link belongs to the link."""
    owner = np.full(m.nbody, ELSEWHERE)
    owner[base] = BASE
    for body in range(base + 1, m.nbody):
        owner[body] = owner[m.body_parentid[body]]
        first = int(m.body_jntadr[body])
        own = [j for j in range(first, first + int(m.body_jntnum[body])) if j in joints]
        if own:
            owner[body] = own[-1]
    return owner
