"""A compiled MuJoCo model → its legs: which hinges and bodies belong to which leg (row R2)."""

from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.errors import BadFile

MIDLINE = 1e-3
"""A chain of three hinges this close to the middle plane [m] is a neck or an arm, not a leg."""
SIX_NAMES = ("FL", "FR", "ML", "MR", "RL", "RR")
LEG_NAMES = {
    4: ("FL", "FR", "RL", "RR"),
    6: SIX_NAMES,
    8: ("FL", "FR", "M1L", "M1R", "M2L", "M2R", "RL", "RR"),
}


class Chain(NamedTuple):
    """Joints of one limb from the base outwards; `branched` where one joint carries two others."""

    joints: tuple[int, ...]
    branched: bool


class Legs(NamedTuple):
    """The floating body, its legs in order, and the pose in which they are at zero angles."""

    base: int
    names: tuple[str, ...]
    joints: np.ndarray
    """`(legs, 3)` joint ids."""
    owner: np.ndarray
    """Per body: the leg joint that moves it, `BASE`, or `ELSEWHERE` for what is not the robot."""
    data: mujoco.MjData
    """Kinematics at zero leg angles, all other joints locked at home."""
    notes: tuple[str, ...] = ()
    """What was taken for granted in finding them, a sentence each."""


BASE, ELSEWHERE = -1, -2


def find_legs(m: mujoco.MjModel) -> Legs:
    """The legs of the robot in `m`. Raises `BadFile` where no floating body has 4, 6 or 8 of them."""
    bases = floating_bodies(m)
    if not bases:
        raise BadFile("no floating body: expected a body with a free joint")
    chains = {base: limbs(m, base) for base in bases}
    base = max(bases, key=lambda b: (len(three_hinges(m, chains[b])), m.body_subtreemass[b]))
    joints = np.array(three_hinges(m, chains[base]), dtype=int).reshape(-1, 3)
    data = pose_at_zero(m, joints)
    anchors = to_body(data, base, data.xanchor[joints[:, 0]])
    beside = np.abs(anchors[:, 1]) > MIDLINE
    joints, anchors = joints[beside], anchors[beside]
    if len(joints) < 4:
        raise BadFile(
            f"{len(joints)} legs of three hinges where 4, 6 or 8 are expected; {told(m, chains[base])}"
        )
    order = in_order(anchors)
    joints = joints[order]
    return Legs(base, LEG_NAMES[len(joints)], joints, owners(m, base, joints), data)


def floating_bodies(m: mujoco.MjModel) -> list[int]:
    """Bodies with a free joint."""
    return [int(m.jnt_bodyid[j]) for j in range(m.njnt) if m.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]


def limbs(m: mujoco.MjModel, base: int) -> list[Chain]:
    """Limbs of the floating body: maximal trees of joints, each listed from the base outwards."""
    last_joint = {base: BASE}
    children: dict[int, list[int]] = {BASE: []}
    for body in range(base + 1, m.nbody):
        parent = last_joint.get(int(m.body_parentid[body]))
        if parent is None:
            continue
        first = int(m.body_jntadr[body])
        for joint in range(first, first + int(m.body_jntnum[body])):
            children[parent].append(joint)
            children[joint] = []
            parent = joint
        last_joint[body] = parent
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
    kinds = [
        f"{len(c.joints)} joints{' with a fork' if c.branched else ''} from {m.joint(c.joints[0]).name!r}"
        for c in chains
    ]
    return "found limbs of " + ", ".join(kinds[:8])


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


def to_body(data: mujoco.MjData, body: int, points: np.ndarray) -> np.ndarray:
    """World points in the axes of a body."""
    return (points - data.xpos[body]) @ data.xmat[body].reshape(3, 3)


def in_order(anchors: np.ndarray) -> np.ndarray:
    """Indices of the legs in pairs from front to rear, left first."""
    left, right = np.flatnonzero(anchors[:, 1] > 0.0), np.flatnonzero(anchors[:, 1] < 0.0)
    if len(left) != len(right) or len(anchors) not in LEG_NAMES:
        raise BadFile(
            f"{len(left)} legs on the left (y > 0) and {len(right)} on the right; expected 2, 3 or 4 pairs"
        )
    front_to_rear = [side[np.argsort(-anchors[side, 0], kind="stable")] for side in (left, right)]
    return np.column_stack(front_to_rear).ravel()


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
