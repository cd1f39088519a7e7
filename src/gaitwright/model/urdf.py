"""Robot → URDF text, for programs that compute with the very numbers that we do, or that show a robot."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import roll_pitch_yaw

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
UNLIMITED_RADPS = 1e3
"""URDF wants a velocity limit; ours has none [rad/s]."""
LIMB = 0.75
"""Radius of the links that are drawn over that of the foot [-]."""
COLOURS = {"body": "0.25 0.28 0.33 1", "leg": "0.75 0.77 0.80 1", "foot": "0.10 0.10 0.12 1"}


@dataclass(frozen=True)
class Names:
    """What the three links of a leg, and their hinges, are called after the leg's name."""

    links: tuple[str, str, str] = ("hip", "thigh", "calf")
    joints: tuple[str, str, str] = ("hip_joint", "thigh_joint", "calf_joint")


def write_urdf(robot: Robot, names: Names = Names(), shapes: bool = False) -> str:
    """URDF of the robot: root link `base`, feet `FL_foot`, …; link axes are the robot's link frames.

    With `shapes` it can be seen: a box for the trunk, cylinders with round ends for the links, spheres for
    the feet. Rotor inertia and friction are not in it.
    """
    root = Element("robot", name=robot.name)
    base = _link(root, "base", robot.base_mass, robot.base_com, robot.base_inertia)
    if shapes:
        _shape(base, "body", "box", robot.trunk[0], size=_text(2.0 * robot.trunk[1]))
    for index in range(robot.n):
        _leg(root, robot, index, names, shapes)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode")


def _leg(root: Element, robot: Robot, index: int, names: Names, shapes: bool) -> None:
    """Three hinged links and the foot frame of one leg."""
    leg, radius = robot.legs[index], LIMB * float(robot.foot_radius[index])
    parent = "base"
    places = (robot.hip[index], robot.offset[index, 0], robot.offset[index, 1])
    axes = (AXES[0], AXES[1], tuple(robot.sign[index] * np.array(AXES[1])))
    for hinge, part in enumerate(names.links):
        child = f"{leg}_{part}"
        link = _link(
            root, child, robot.mass[index, hinge], robot.com[index, hinge], robot.inertia[index, hinge]
        )
        if shapes:
            _limb(link, robot.offset[index, hinge], radius)
        joint = _joint(root, f"{leg}_{names.joints[hinge]}", "revolute", parent, child)
        turn = robot.leg_frame[index] if hinge == 0 else np.eye(3)
        ElementTree.SubElement(joint, "origin", xyz=_text(places[hinge]), rpy=_text(roll_pitch_yaw(turn)))
        ElementTree.SubElement(joint, "axis", xyz=_text(axes[hinge]))
        limits = {"lower": robot.q_min, "upper": robot.q_max, "effort": robot.tau_max}
        values = {name: _text([array[index, hinge]]) for name, array in limits.items()}
        ElementTree.SubElement(joint, "limit", values | {"velocity": _text([UNLIMITED_RADPS])})
        parent = child
    foot = ElementTree.SubElement(root, "link", name=f"{leg}_foot")
    if shapes:
        _shape(foot, "foot", "sphere", np.zeros(3), radius=_text([robot.foot_radius[index]]))
    fixed = _joint(root, f"{leg}_foot_joint", "fixed", parent, f"{leg}_foot")
    ElementTree.SubElement(fixed, "origin", xyz=_text(robot.offset[index, 2]))


# --- what is seen ----------------------------------------------------------------------------------
def _limb(link: Element, end: Float[np.ndarray, "3"], radius: float) -> None:
    """A ball at the hinge of a link, and a cylinder from there to its end [m]."""
    _shape(link, "leg", "sphere", np.zeros(3), radius=_text([radius]))
    length = float(np.linalg.norm(end))
    if length > radius:
        aside = math.atan2(math.hypot(end[0], end[1]), end[2])
        turn = np.array([0.0, aside, math.atan2(end[1], end[0])])
        _shape(link, "leg", "cylinder", end / 2, turn, radius=_text([radius]), length=_text([length]))


def _shape(
    link: Element,
    colour: str,
    kind: str,
    centre: Float[np.ndarray, "3"],
    turn: Float[np.ndarray, "3"] | None = None,
    **size: str,
) -> None:
    """Something to see of a link: `turn` is roll, pitch, yaw [rad]."""
    visual = ElementTree.SubElement(link, "visual")
    rpy = _text(np.zeros(3) if turn is None else turn)
    ElementTree.SubElement(visual, "origin", xyz=_text(centre), rpy=rpy)
    ElementTree.SubElement(ElementTree.SubElement(visual, "geometry"), kind, size)
    material = ElementTree.SubElement(visual, "material", name=colour)
    ElementTree.SubElement(material, "color", rgba=COLOURS[colour])


# --- links and joints ------------------------------------------------------------------------------
def _link(
    root: Element,
    name: str,
    mass: float,
    com: Float[np.ndarray, "3"],
    inertia: Float[np.ndarray, "3 3"],
) -> Element:
    """A link with its mass [kg], centre of mass [m] and inertia about it [kg·m²]; a massless one has none."""
    link = ElementTree.SubElement(root, "link", name=name)
    if mass == 0.0:
        return link
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "origin", xyz=_text(com))
    ElementTree.SubElement(inertial, "mass", value=_text([mass]))
    entries = {
        f"i{'xyz'[row]}{'xyz'[col]}": _text([inertia[row, col]]) for row in range(3) for col in range(row, 3)
    }
    ElementTree.SubElement(inertial, "inertia", entries)
    return link


def _joint(root: Element, name: str, kind: str, parent: str, child: str) -> Element:
    joint = ElementTree.SubElement(root, "joint", name=name, type=kind)
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    return joint


def _text(numbers: Iterable[float]) -> str:
    """Numbers as URDF has them, in full."""
    return " ".join(repr(float(number)) for number in numbers)
