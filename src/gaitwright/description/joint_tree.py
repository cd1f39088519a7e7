"""The joints that hang on a body, as a tree."""

from collections.abc import Iterator, Set
from typing import NamedTuple

import mujoco
import numpy as np

BASE = -1
"""Stands for the body that all limbs hang on."""


class JointTree(NamedTuple):
    """Joints outwards from a body of a compiled model, and where all are in the pose as modelled."""

    m: mujoco.MjModel
    d: mujoco.MjData
    children: dict[int, list[int]]
    """By joint, those that follow it; those of `BASE` begin the limbs."""

    @staticmethod
    def of(m: mujoco.MjModel, d: mujoco.MjData, base: int) -> "JointTree":
        """The limbs of a body."""
        return JointTree(m, d, joints_after(m, base))

    @property
    def limbs(self) -> list[int]:
        """The first joint of each limb."""
        return self.children[BASE]

    def below(self, joint: int) -> Iterator[int]:
        """A joint and all beyond it."""
        waiting = [joint]
        while waiting:
            found = waiting.pop()
            waiting += reversed(self.children[found])
            yield found

    def without(self, locked: Set[int]) -> "JointTree":
        """The tree in which these joints are fixed."""
        children = {}
        for joint, direct in self.children.items():
            if joint not in locked:
                waiting, free = list(reversed(direct)), []
                while waiting:
                    child = waiting.pop()
                    if child in locked:
                        waiting += reversed(self.children[child])
                    else:
                        free.append(child)
                children[joint] = free
        return self._replace(children=children)

    def depth(self, joint: int) -> int:
        """How many joints there are in a row from this one outwards, itself included."""
        row, count = [joint], 0
        while row:
            row, count = [child for each in row for child in self.children[each]], count + 1
        return count

    def reach(self, joint: int, anchor: np.ndarray) -> float:
        """How far what a joint moves reaches from a point of the world [m]."""
        m, d, moved = self.m, self.d, self.moved(joint)
        shapes = np.flatnonzero(moved[m.geom_bodyid])
        places = np.vstack([d.xpos[moved], d.xipos[moved & (m.body_mass > 0.0)]])
        far = np.linalg.norm(places - anchor, axis=1).max(initial=0.0)
        edges = np.linalg.norm(d.geom_xpos[shapes] - anchor, axis=1) + m.geom_rbound[shapes]
        return float(max(far, edges.max(initial=0.0)))

    def moved(self, joint: int) -> np.ndarray:
        """Mask of the bodies that a joint moves."""
        moved = np.zeros(self.m.nbody, dtype=bool)
        moved[self.m.jnt_bodyid[joint]] = True
        for body in range(int(self.m.jnt_bodyid[joint]) + 1, self.m.nbody):
            moved[body] = moved[self.m.body_parentid[body]]
        return moved

    def name(self, joint: int) -> str:
        """What a joint is called, in quotes."""
        return repr(self.m.joint(joint).name or f"joint {joint}")


def pose_as_modelled(m: mujoco.MjModel) -> mujoco.MjData:
    """Where all is with the joints as modelled."""
    d = mujoco.MjData(m)
    mujoco.mj_kinematics(m, d)
    mujoco.mj_comPos(m, d)
    return d


def joints_after(m: mujoco.MjModel, base: int) -> dict[int, list[int]]:
    """The joints that hang on each joint of a body's limbs, and on the body itself (`BASE`)."""
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
    return children
