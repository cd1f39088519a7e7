"""Joints taken out of a model, with what refers to them: motors and places in keyframes."""

from collections.abc import Iterable

import mujoco
import numpy as np

WIDTH = {mujoco.mjtJoint.mjJNT_FREE: 7, mujoco.mjtJoint.mjJNT_BALL: 4}
"""Numbers of a joint in a keyframe; 1 for the others."""


def remove_joints(spec: mujoco.MjSpec, m: mujoco.MjModel, joints: Iterable[int]) -> None:
    """Fixes joints of the compiled `m` where they are modelled; `spec` is to be compiled anew."""
    chosen = set(joints)
    names = {m.joint(j).name for j in chosen} - {""}
    gone = [at for j in chosen for at in places(m, j)]
    for actuator in list(spec.actuators):
        if actuator.target in names:
            spec.delete(actuator)
    for key in spec.keys:
        qpos = np.array(key.qpos)
        if len(qpos) == m.nq:
            key.qpos = np.delete(qpos, gone)
    for joint in [joint for joint in spec.joints if joint.id in chosen]:
        spec.delete(joint)


def add_free_joint(spec: mujoco.MjSpec, m: mujoco.MjModel, body: int) -> None:
    """Lets a body of the compiled `m` float that stands in the world; it has no joints of its own."""
    before = sum(len(places(m, j)) for j in range(m.njnt) if m.jnt_bodyid[j] < body)
    pose = [*m.body_pos[body], *m.body_quat[body]]
    for key in spec.keys:
        if len(key.qpos):
            key.qpos = np.insert(np.array(key.qpos), before, pose)
    next(found for found in spec.bodies if found.id == body).add_freejoint()


def places(m: mujoco.MjModel, joint: int) -> range:
    """Where the numbers of a joint stand in a keyframe."""
    first = int(m.jnt_qposadr[joint])
    return range(first, first + WIDTH.get(mujoco.mjtJoint(m.jnt_type[joint]), 1))
