"""A trunk that a file holds in the world, by nothing or by slides and hinges, is let go."""

import mujoco

from gaitwright.description.aside import listed
from gaitwright.description.joint_tree import JointTree, pose_as_modelled
from gaitwright.description.joints_removed import add_free_joint, remove_joints

FEWEST = 3
"""A body that carries so many limbs of two or more hinges is a trunk."""


def let_trunk_float(spec: mujoco.MjSpec, m: mujoco.MjModel) -> tuple[str, ...]:
    """Gives a trunk a free joint in place of what holds it in the world; what was done, if anything.

    `m` is `spec` as compiled; where something was done, `spec` is to be compiled anew.
    """
    best = max(range(1, m.nbody), key=lambda body: legs_on(m, body), default=0)
    if legs_on(m, best) < FEWEST or floats(m, best):
        return ()
    line = [best]
    while m.body_parentid[line[-1]] != 0:
        line.append(int(m.body_parentid[line[-1]]))
    held = [j for j in range(m.njnt) if m.jnt_bodyid[j] in line]
    names = [repr(m.joint(j).name or f"joint {j}") for j in held]
    remove_joints(spec, m, held)
    add_free_joint(spec, spec.compile(), line[-1])
    how = (
        f"held in the world by the joints {listed(names)}: they are taken away"
        if held
        else "fixed in the world"
    )
    return (f"the trunk {m.body(best).name!r} is {how}, and it floats",)


def legs_on(m: mujoco.MjModel, body: int) -> int:
    """How many limbs of two or more joints a body carries."""
    if body == 0:
        return 0
    tree = JointTree.of(m, pose_as_modelled(m), body)
    return sum(tree.depth(limb) >= 2 for limb in tree.limbs)


def floats(m: mujoco.MjModel, body: int) -> bool:
    """Whether a body or one that carries it has a free joint."""
    root = int(m.body_rootid[body])
    return bool((m.jnt_type[m.jnt_bodyid == root] == mujoco.mjtJoint.mjJNT_FREE).any())
