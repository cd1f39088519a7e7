"""Joints that a leg of three hinges does not have: wheels, toes, springs, side branches, joints of the trunk.

They are locked as modelled, and told, where that leaves a robot with legs.
"""

import math
from collections import Counter

import mujoco
import numpy as np

from gaitwright.description.aside import Aside, listed
from gaitwright.description.joint_tree import BASE, JointTree, pose_as_modelled
from gaitwright.description.joints_removed import remove_joints

LEG, FEWEST = 3, 4
"""Hinges of a leg; a robot with so many limbs of so many hinges needs nothing locked."""
SHORT = 0.25
"""A toe, or the travel of a spring, is at most this share of the length of the limb above it."""
ROUND = 2.0 * math.pi - 1e-3
"""A hinge that turns this far may be that of a wheel [rad]."""
CENTRED = 0.1
"""The middle of a wheel is this near to its axis, per radius."""
LESSER = 0.8
"""A side branch of a limb reaches at most this share as far as the main one."""
AS_LONG = 0.5
"""What hangs on a joint of the trunk are legs if they reach this share as far as the longest limb."""
MOST_FORKS = 2
"""A trunk has so many joints that carry legs; where there are more, they are forks of legs."""

TRUNK, BRANCH, SPRING = "the joints of the trunk", "the joints of side branches", "the slides of springs"
WHEEL, TOE, COUPLED = "the wheels", "the joints of toes", "the joints that follow others"


def lock(spec: mujoco.MjSpec, m: mujoco.MjModel, aside: Aside) -> tuple[str, ...]:
    """Locks what keeps limbs from being legs; a sentence for each kind of joint.

    `m` is `spec` as compiled; where something was locked, `spec` is to be compiled anew.
    """
    d = pose_as_modelled(m)
    free = [j for j in range(m.njnt) if m.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE]
    trees = [JointTree.of(m, d, int(m.jnt_bodyid[j])) for j in free]
    tree = max(trees, key=lambda tree: len(tree.limbs), default=None)
    if tree is None:
        return ()
    found = to_lock(tree, aside)
    remove_joints(spec, m, found)
    kinds = {kind: [tree.name(j) for j in found if found[j] == kind] for kind in found.values()}
    return tuple(f"{kind} {listed(names)} are locked as modelled" for kind, names in kinds.items())


def to_lock(tree: JointTree, aside: Aside) -> dict[int, str]:
    """Joints to lock, each with what it is; none where there are legs enough, or would be too few."""
    if legs_in(tree) >= FEWEST:
        return {}
    locked = of_trunk(tree)
    rest = tree.without(locked.keys())
    alike = Counter(kind(rest, limb) for limb in rest.limbs)
    for limb in rest.limbs:
        if alike[kind(rest, limb)] > 1:
            locked |= of_limb(rest, limb, aside)
    return locked if legs_in(tree.without(locked.keys())) >= FEWEST else {}


def legs_in(tree: JointTree) -> int:
    """How many limbs are three hinges in a row."""
    return sum(kind(tree, limb) == (LEG, 0, False) for limb in tree.limbs)


def kind(tree: JointTree, limb: int) -> tuple[int, int, bool]:
    """What two legs of one robot share: hinges, other joints, and whether there is a fork."""
    joints = list(tree.below(limb))
    hinges = sum(is_hinge(tree.m, joint) for joint in joints)
    return hinges, len(joints) - hinges, any(len(tree.children[j]) > 1 for j in joints)


def is_hinge(m: mujoco.MjModel, joint: int) -> bool:
    return bool(m.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE)


def of_trunk(tree: JointTree) -> dict[int, str]:
    """Joints that carry two legs or more, and those between them and the base."""
    longest = max((tree.reach(limb, tree.d.xanchor[limb]) for limb in tree.limbs), default=0.0)
    parents = {child: joint for joint, children in tree.children.items() for child in children}
    forks = [joint for joint in parents if legs_on(tree, joint, AS_LONG * longest) > 1]
    found: dict[int, str] = {}
    for fork in forks if len(forks) <= MOST_FORKS else ():
        above = fork
        while above != BASE:
            found[above] = TRUNK
            above = parents[above]
    return found


def legs_on(tree: JointTree, joint: int, length: float) -> int:
    """How many limbs follow a joint that have three joints in a row and reach as far as `length` [m]."""
    following = [child for child in tree.children[joint] if tree.depth(child) >= LEG]
    return sum(tree.reach(child, tree.d.xanchor[child]) >= length for child in following)


def of_limb(tree: JointTree, limb: int, aside: Aside) -> dict[int, str]:
    """What to lock in a limb so that a row of three hinges is left; none where that cannot be."""
    main, locked = main_line(tree, limb)
    at = tree.d.xanchor[main]
    length = float(np.linalg.norm(np.diff(at, axis=0), axis=1).sum()) + tree.reach(main[-1], at[-1])
    locked |= {j: SPRING for j in main if is_spring(tree.m, j, SHORT * length)}
    rest = [joint for joint in main if joint not in locked]
    while len(rest) > LEG:
        above = float(np.linalg.norm(np.diff(tree.d.xanchor[rest], axis=0), axis=1).sum())
        what = of_tip(tree, rest[-1], above, aside)
        if what is None:
            return {}
        locked[rest.pop()] = what
    return locked


def main_line(tree: JointTree, limb: int) -> tuple[list[int], dict[int, str]]:
    """The row of joints that reaches farthest, and those of lesser branches."""
    line, locked = [limb], {}
    while tree.children[line[-1]]:
        anchor = tree.d.xanchor[line[-1]]
        reaches = {child: tree.reach(child, anchor) for child in tree.children[line[-1]]}
        main = max(reaches, key=lambda child: reaches[child])
        lesser = [child for child in reaches if reaches[child] <= LESSER * reaches[main]]
        locked |= {joint: BRANCH for child in lesser for joint in tree.below(child)}
        line.append(main)
    return line, locked


def is_spring(m: mujoco.MjModel, joint: int, travel: float) -> bool:
    """Whether a joint slides by no more than `travel` [m], or against a spring."""
    if m.jnt_type[joint] != mujoco.mjtJoint.mjJNT_SLIDE:
        return False
    low, high = m.jnt_range[joint]
    return bool((m.jnt_limited[joint] and high - low <= travel) or m.jnt_stiffness[joint] > 0.0)


def of_tip(tree: JointTree, joint: int, above: float, aside: Aside) -> str | None:
    """What the last joint of a limb is that may be locked; `above` is the length before it [m]."""
    m = tree.m
    if not is_hinge(m, joint):
        return None
    if is_wheel(tree, joint):
        return WHEEL
    if m.joint(joint).name in aside.coupled:
        return COUPLED
    driven = {int(j) for j in m.actuator_trnid[:, 0]}
    undriven = bool(driven) and joint not in driven and not aside.loops
    idle = m.jnt_stiffness[joint] > 0.0 or undriven
    if idle:
        return TOE
    short = tree.reach(joint, tree.d.xanchor[joint]) <= SHORT * above
    return (TOE if m.jnt_limited[joint] else WHEEL) if short else None


def is_wheel(tree: JointTree, joint: int) -> bool:
    """Whether what a hinge turns is a wheel: round about its axis, or called one."""
    m, d = tree.m, tree.d
    body = int(m.jnt_bodyid[joint])
    if "wheel" in f"{m.joint(joint).name} {m.body(body).name}".lower():
        return True
    if m.jnt_limited[joint] and np.ptp(m.jnt_range[joint]) < ROUND:
        return False
    for geom in np.flatnonzero(tree.moved(joint)[m.geom_bodyid]):
        off = np.linalg.norm(np.cross(d.geom_xpos[geom] - d.xanchor[joint], d.xaxis[joint]))
        if off <= CENTRED * m.geom_rbound[geom]:
            return True
    return False
