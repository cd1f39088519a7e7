"""A URDF tree → one of links, joints and collision shapes alone, whose meshes have absolute paths."""

import xml.etree.ElementTree as ET

from gaitwright.description.meshes import Meshes
from gaitwright.description.xmlfile import is_finite, keep
from gaitwright.errors import BadFile

URDF_SECTIONS = {"link", "joint", "mujoco"}
URDF_MENDERS = {"balanceinertia", "boundmass", "boundinertia"}
"""MuJoCo's own remedies for the inertias of a URDF, in `<mujoco><compiler …/></mujoco>`."""
URDF_DROPPED = {"visual", "mimic", "safety_controller", "calibration"}
AXISLESS = ("fixed", "floating")
"""Joints whose axes mean nothing."""


def plain_urdf(root: ET.Element, meshes: Meshes, visuals: bool) -> ET.Element:
    """A URDF tree with links, joints and collision shapes, and nothing else.

    Where `visuals`, what a link looks like stands for collision shapes that it lacks.
    """
    if any("xacro" in str(element.tag) for element in root.iter()):
        raise BadFile("it is a xacro template; expected the URDF that xacro makes of it")
    keep(root, lambda child: child.tag in URDF_SECTIONS)
    for link in root.findall("link"):
        choose_shapes(link, meshes, visuals)
    for element in list(root.iter()):
        keep(element, lambda child: child.tag not in URDF_DROPPED)
    for compiler in root.findall("mujoco/compiler"):
        compiler.attrib = {name: value for name, value in compiler.attrib.items() if name in URDF_MENDERS}
    paths_stay = ET.SubElement(ET.SubElement(root, "mujoco"), "compiler")
    paths_stay.set("strippath", "false")
    for joint in root.findall("joint"):
        if joint.get("type") in AXISLESS:
            keep(joint, lambda child: child.tag != "axis")
    for limit in root.findall("joint/limit"):
        limit.attrib = {name: value for name, value in limit.attrib.items() if is_finite(value)}
    floating = [joint for joint in root.findall("joint") if joint.get("type") == "floating"]
    if len(floating) == 1:
        keep_below(root, floating[0])
    return root


def keep_below(root: ET.Element, floating: ET.Element) -> None:
    """Makes the child of a floating joint the root link: what is above it is the world."""
    outwards = {end(joint, "parent"): [] for joint in root.findall("joint")}
    for joint in root.findall("joint"):
        outwards[end(joint, "parent")].append(end(joint, "child"))
    below = [end(floating, "child")]
    for link in below:
        below += [child for child in outwards.get(link, ()) if child not in below]
    of = {"link": lambda link: link.get("name"), "joint": lambda joint: end(joint, "parent")}
    keep(root, lambda child: child.tag == "mujoco" or of[child.tag](child) in below)


def end(joint: ET.Element, which: str) -> str:
    """Name of the `parent` or `child` link of a URDF joint."""
    link = joint.find(which)
    return "" if link is None else link.get("link", "")


def choose_shapes(link: ET.Element, meshes: Meshes, visuals: bool) -> None:
    """Keeps the collision shapes of a link whose meshes are there, by their absolute paths.

    A link whose only shapes are meshes that are missing is entered in `meshes.lost`.
    """
    kept, missing = usable(link.findall("collision"), meshes)
    if not kept and (visuals or missing):
        kept, more = usable(link.findall("visual"), meshes) if visuals else ([], [])
        missing = missing or more
        for shape in kept:
            shape.tag = "collision"
        if not kept and missing:
            meshes.lost[link.get("name", "")] = missing[0]
    keep(link, lambda child: child.tag not in ("collision", "visual") or child in kept)


def usable(shapes: list[ET.Element], meshes: Meshes) -> tuple[list[ET.Element], list[str]]:
    """Those shapes that are not missing, and the names of the meshes that are."""
    kept, missing = [], []
    for shape in shapes:
        mesh = shape.find("geometry/mesh")
        if mesh is not None:
            name = mesh.get("filename", "")
            path = meshes.find(name)
            if path is None:
                missing.append(name)
                continue
            mesh.set("filename", str(path))
        kept.append(shape)
    return kept, missing
