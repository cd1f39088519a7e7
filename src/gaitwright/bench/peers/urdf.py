"""Robot → URDF text, so that a peer computes with the very numbers that we do."""

from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np
from jaxtyping import Float

from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import roll_pitch_yaw

PARTS = ("hip", "thigh", "calf")
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
UNLIMITED_RADPS = 1e3
"""URDF wants a velocity limit; ours has none [rad/s]."""


def write_urdf(robot: Robot) -> str:
    """URDF of the robot: root link `base`, feet `FL_foot`, …

    Hinges are `FL_hip_joint`, `FL_thigh_joint`, `FL_calf_joint`, …; link axes are the robot's link frames.
    Rotor inertia, friction and shapes are not in it.
    """
    root = ElementTree.Element("robot", name=robot.name)
    _link(root, "base", robot.base_mass, robot.base_com, robot.base_inertia)
    for index in range(robot.n):
        _leg(root, robot, index)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode")


def _leg(root: ElementTree.Element, robot: Robot, index: int) -> None:
    """Three hinged links and the foot frame of one leg."""
    leg = robot.legs[index]
    parent = "base"
    places = (robot.hip[index], robot.offset[index, 0], robot.offset[index, 1])
    axes = (AXES[0], AXES[1], tuple(robot.sign[index] * np.array(AXES[1])))
    for hinge, part in enumerate(PARTS):
        child = f"{leg}_{part}"
        _link(root, child, robot.mass[index, hinge], robot.com[index, hinge], robot.inertia[index, hinge])
        joint = _joint(root, f"{child}_joint", "revolute", parent, child)
        turn = robot.leg_frame[index] if hinge == 0 else np.eye(3)
        ElementTree.SubElement(joint, "origin", xyz=_text(places[hinge]), rpy=_text(roll_pitch_yaw(turn)))
        ElementTree.SubElement(joint, "axis", xyz=_text(axes[hinge]))
        limits = {"lower": robot.q_min, "upper": robot.q_max, "effort": robot.tau_max}
        values = {name: _text([array[index, hinge]]) for name, array in limits.items()}
        ElementTree.SubElement(joint, "limit", values | {"velocity": _text([UNLIMITED_RADPS])})
        parent = child
    ElementTree.SubElement(root, "link", name=f"{leg}_foot")
    fixed = _joint(root, f"{leg}_foot_joint", "fixed", parent, f"{leg}_foot")
    ElementTree.SubElement(fixed, "origin", xyz=_text(robot.offset[index, 2]))


def _link(
    root: ElementTree.Element,
    name: str,
    mass: float,
    com: Float[np.ndarray, "3"],
    inertia: Float[np.ndarray, "3 3"],
) -> None:
    """A link with its mass [kg], centre of mass [m] and inertia about it [kg·m²]; a massless one has none."""
    link = ElementTree.SubElement(root, "link", name=name)
    if mass == 0.0:
        return
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "origin", xyz=_text(com))
    ElementTree.SubElement(inertial, "mass", value=_text([mass]))
    entries = {
        f"i{'xyz'[row]}{'xyz'[col]}": _text([inertia[row, col]]) for row in range(3) for col in range(row, 3)
    }
    ElementTree.SubElement(inertial, "inertia", entries)


def _joint(root: ElementTree.Element, name: str, kind: str, parent: str, child: str) -> ElementTree.Element:
    joint = ElementTree.SubElement(root, "joint", name=name, type=kind)
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    return joint


def _text(numbers: Iterable[float]) -> str:
    """Numbers as URDF has them, in full."""
    return " ".join(repr(float(number)) for number in numbers)
